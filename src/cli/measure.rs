//! `flexframe measure`: peaks, impulse and restitution of measured drops.

use std::path::PathBuf;
use std::process::ExitCode;

use super::failure::Failure;
use super::given_drops::{file_format, read_drops};
use super::options::{Common, FormatOptions};
use super::output;
use super::progress::Progress;
use super::terminal;
use crate::impact::measured::{Drop, DropGroup, JudgedDrops, Session, Spread, Summary, Zero};
use crate::report::chart::measure_plots;
use crate::report::data::measure_data;

/// Read measured drops, flag bad records, and write a table of heights and plots.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe measure soft_050cm soft_100cm drops.csv\n  flexframe measure --columns t=Time,z=-Acc_Z --units m/s2,ms soft_050cm --json\n\nA .bin or .bhn file of the logger lies in a folder that names frame and height, as soft_050cm; a .csv or .tsv table has the columns\ntrial,height_m,t_s,accel_g and may have x,y,z (g). docs/physics.md defines the flags."
)]
pub(super) struct Args {
    /// Files of the logger, CSV tables, or folders of them.
    #[arg(required = true, value_name = "PATH")]
    pub paths: Vec<PathBuf>,
    /// How the files are written.
    #[command(flatten)]
    pub format: FormatOptions,
    /// Folder in which to write the folder `measure`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Reads drops, judges each, and writes a folder.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let working = Progress::of("reading", common);
    let set = read_drops(&args.paths, &args.format, &file_format(&args.format)?)?;
    let judged = JudgedDrops::of(&set);
    let groups = &judged.groups;
    let json = measure_data::json(&set, &judged);
    let mut files = measure_plots::plots(groups)?;
    files.push(("heights.csv".into(), measure_data::heights_csv(groups)?.into_bytes()));
    files.push(("drops.csv".into(), measure_data::drops_csv(groups)?.into_bytes()));
    files.push(("measure.json".into(), format!("{json:#}\n").into_bytes()));
    drop(working);
    let place = output::write_folder(&args.output, "measure", &files)?;
    if common.json {
        terminal::print_json(&json)?;
    } else if !common.quiet {
        let notes: String = set.notes.iter().map(|note| format!("note: {note}\n")).collect();
        let (table, sessions, flagged) = (table(groups), sessions(&judged), flagged(groups));
        terminal::print(&format!("{table}\n{sessions}{notes}{flagged}{}: {} files\n", place.display(), files.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// A height a line.
fn table(groups: &[(&DropGroup, Vec<Drop>)]) -> String {
    let mut text = String::from(
        "                                    -- peak, all axes, g --  - peak along axis, g -- | clean drops: medians\n\
         frame       height  drops  clean        q1  median      q3       q1  median      q3  | impulse  restitution     fall   noise\n\
         \x20                m                                                                   |    / v0                     s       g\n",
    );
    for (group, drops) in groups {
        text += &row(&Summary::of(group, drops));
    }
    text
}

fn row(sum: &Summary) -> String {
    let three = |spread: Option<Spread>| match spread {
        Some(spread) => format!("{:>7.1} {:>7.1} {:>7.1}", spread.q1, spread.median, spread.q3),
        None => format!("{:>7} {:>7} {:>7}", "-", "-", "-"),
    };
    let median = |spread: Option<Spread>, width: usize, places: usize| {
        spread.map_or(format!("{:>width$}", "-"), |spread| format!("{:>width$.places$}", spread.median))
    };
    format!(
        "{:<10} {:>7} {:>6} {:>6}   {}  {}  | {} {} {} {}\n",
        sum.frame.as_deref().unwrap_or("-"),
        sum.height_m,
        sum.drops,
        sum.clean,
        three(sum.peak_g),
        three(sum.peak_axial_g),
        median(sum.impulse_over_v0, 7, 2),
        median(sum.restitution, 12, 2),
        median(sum.fall_s, 8, 3),
        median(sum.noise_g, 7, 3),
    )
}

/// Zero and scale of each session, and where clocks stall.
fn sessions(judged: &JudgedDrops) -> String {
    let error = |zero: &Zero| zero.error_g.map_or("-".into(), |error_g| format!("{error_g:.3}"));
    let zero = |zero: &Option<Zero>| zero.map_or(format!("{:>15}", "-"), |zero| format!("{:>+7.3} ± {:>5}", zero.mean_g, error(&zero)));
    let line = |session: &Session| {
        let [x, y, z] = &session.zeros;
        let held = session.held_g.map_or("-".into(), |held| format!("{:.3}", held.median));
        format!("zero     {}: x {}, y {}, z {} g in free fall; held {held} g\n", session.name, zero(x), zero(y), zero(z))
    };
    let known = judged.sessions.iter().filter(|session| session.zeros.iter().any(Option::is_some));
    let mut text: String = known.map(line).collect();
    for (frame, period) in &judged.periods {
        text += &format!(
            "clock    {}: stalls every {:.1} samples, and catches up in the {:.0} samples behind\n",
            frame.as_deref().unwrap_or("all records"),
            period.samples,
            period.stretch
        );
    }
    text
}

/// Every flag with its reason.
fn flagged(groups: &[(&DropGroup, Vec<Drop>)]) -> String {
    let mut text = String::new();
    for (group, drops) in groups {
        for drop in drops.iter().filter(|drop| !drop.flags.is_empty()) {
            let reasons: Vec<String> = drop.flags.iter().map(ToString::to_string).collect();
            text += &format!("flagged  {}, {}: {}\n", measure_data::name(group), drop.record.trial, reasons.join("; "));
        }
    }
    text
}
