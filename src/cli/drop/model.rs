//! `flexframe drop --model MODEL`: the drops of an impact model.

use std::process::ExitCode;

use super::arguments::Args;
use crate::cli::failure::Failure;
use crate::cli::options::{Common, FrameOption};
use crate::cli::progress::Progress;
use crate::cli::{output, session, terminal};
use crate::frame::assembly::mass;
use crate::impact::body::{DropBody, Origin};
use crate::impact::effects::Model;
use crate::impact::sim::{Balance, SolverOptions, System, Trace, simulate};
use crate::report::chart::drop_plots;
use crate::report::data::drop_data;

/// Simulates the drops of a model and writes their folder.
pub(super) fn run(args: &Args, heights_m: &[f64], common: &Common) -> Result<ExitCode, Failure> {
    for (given, name) in [(!args.fit.is_empty(), "--fit"), (!args.tilt.is_empty(), "--tilt"), (args.mechanics.is_some(), "--mechanics")] {
        if given {
            return Err(Failure::Usage { message: format!("{name} goes with --model frame, the frame's own geometry") });
        }
    }
    let mut model = Model::load(&args.model)?;
    let working = Progress::of("dropping", common);
    if let Some(frame) = &args.frame {
        let design = session::design(&FrameOption { frame: frame.clone(), rigid: args.rigid.clone() }, common)?;
        model.body = DropBody::of(&design, &mass::table(&design));
    }
    let system = System::new(&model);
    let traces: Vec<Trace> = heights_m.iter().map(|height_m| simulate(&system, *height_m, &SolverOptions::REPORT)).collect();
    let json = drop_data::json(&model, &traces, args.trace);
    let mut files = drop_plots::plots(&model, &traces)?;
    files.push(("results.csv".into(), drop_data::results_csv(&traces)?.into_bytes()));
    files.push(("trace.csv".into(), drop_data::trace_csv(&traces)?.into_bytes()));
    files.push(("samples.csv".into(), drop_data::samples_csv(&model, &traces)?.into_bytes()));
    files.push(("model.toml".into(), model.to_toml().into_bytes()));
    files.push(("drop.json".into(), format!("{json:#}\n").into_bytes()));
    drop(working);
    let place = output::write_folder(&args.output, &folder(&model), &files)?;
    if common.json {
        terminal::print_json(&json)?;
    } else if !common.quiet {
        terminal::print(&format!("{}{}: {} files\n", table(&model, &traces), place.display(), files.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn folder(model: &Model) -> String {
    match &model.body.origin {
        Origin::Model(_) => format!("drop-{}", model.name),
        Origin::Frame(frame) => format!("drop-{}-{frame}", model.name),
    }
}

/// What came out, height by height, validity warnings below.
fn table(model: &Model, traces: &[Trace]) -> String {
    let DropBody { mass_kg, gap_m, origin, .. } = &model.body;
    let mut text = format!("mass {:.1} g and gap {:.1} mm of {origin}\n\n", mass_kg * 1e3, gap_m * 1e3);
    text += "                ---------- peak, g ----------                     - balance, % of m g (h + x) -   - paper, % of m g h -\n";
    text += "height   impact  coordinate   proper   sensor  contact  largest   stored    lost  motion  rigid   damper  spring  rigid\n";
    text += "     m      m/s       |x''|      F/m               ms       mm\n";
    for trace in traces {
        text += &row(trace);
    }
    text.push('\n');
    for trace in traces {
        for warning in &trace.warnings {
            text += &format!("warning  {} m: {warning}\n", trace.height_m);
        }
    }
    text
}

fn row(trace: &Trace) -> String {
    let or_none = |value: Option<f64>, width: usize| value.map_or(format!("{:>width$}", "-"), |value| format!("{value:>width$.2}"));
    let shares = trace.compression.as_ref().map_or([None; 4], |balance: &Balance| {
        [balance.stored_j, balance.dissipated_j + balance.air_j, balance.kinetic_j, balance.collision_j]
            .map(|part| Some(100.0 * part / balance.input_j))
    });
    let paper = trace.paper.map_or([None; 3], |paper| [paper.damper_percent, paper.spring_percent, paper.rigid_percent].map(Some));
    let tenths = |value: Option<f64>, width: usize| value.map_or(format!("{:>width$}", "-"), |value| format!("{:>width$.1}", value + 0.0));
    format!(
        "{:>6} {:>8.3} {} {} {} {} {}  {} {} {} {}   {} {} {}\n",
        trace.height_m,
        trace.impact_speed_m_s,
        tenths(trace.peaks.map(|peaks| peaks.coordinate_g), 11),
        tenths(trace.peaks.map(|peaks| peaks.proper_g), 8),
        tenths(trace.peaks.map(|peaks| peaks.sensor_g), 8),
        or_none(trace.contact_s.map(|t_s| t_s * 1e3), 8),
        or_none(trace.max_displacement_m.map(|x_m| x_m * 1e3), 8),
        tenths(shares[0], 7),
        tenths(shares[1], 7),
        tenths(shares[2], 7),
        tenths(shares[3], 6),
        tenths(paper[0], 6),
        tenths(paper[1], 7),
        tenths(paper[2], 6),
    )
}
