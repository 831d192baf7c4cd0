//! `flexframe study plan`.

use std::process::ExitCode;
use std::time::Instant;

use super::study_option::load;
use crate::cli::candidates;
use crate::cli::failure::Failure;
use crate::cli::options::Common;
use crate::cli::terminal;
use crate::study::{Axis, Column, Evaluator, Outcome, Study};

/// Report the size of a study and its estimated duration.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// The plan: a TOML file.
    #[arg(value_name = "PLAN", add = candidates::toml_files())]
    plan: String,
}

/// Rows that are evaluated to tell the time.
const TRIED: usize = 4;

pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let study = load(&args.plan)?;
    // On one core, as a study's rows are.
    let one_core = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let one_core =
        one_core.map_err(|error| Failure::Machine { what: "cannot begin a thread".into(), error: std::io::Error::other(error) })?;
    let begun = Instant::now();
    let tried = TRIED.min(study.rows());
    let rows = (0..tried).map(|at| at * study.rows() / tried);
    let evaluator = Evaluator::new(&study);
    let is_refused = |row: &usize| matches!(one_core.install(|| evaluator.row(*row)), Outcome::Refused(_));
    let refused = rows.filter(is_refused).count();
    let a_row_s = begun.elapsed().as_secs_f64() / tried.max(1) as f64;
    if common.json {
        terminal::print_json(&json(&study, a_row_s))?;
    } else {
        terminal::print(&formatted(&study, tried, refused, a_row_s))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn formatted(study: &Study, tried: usize, refused: usize, a_row_s: f64) -> String {
    let mut text = format!("{}: {} rows on {}\n\nwhat varies\n", study.name, study.rows(), study.base_name());
    for axis in &study.axes {
        let over = match axis {
            Axis::Number(vary) => format!("{} to {} {}", vary.bounds[0], vary.bounds[1], axis.unit()),
            Axis::Listed(_) => format!("as listed, {}", axis.unit()),
            Axis::Stated(_) => "as stated".into(),
            Axis::Name { names, .. } => names.join(", "),
        };
        text += &format!("  {:<34} {over}\n", axis.key());
    }
    text += "\nwhat is said of each row\n";
    for column in &study.columns {
        text += format!("  {:<34} {}", column.name(), column.unit()).trim_end();
        text.push('\n');
    }
    Column::caveats(&study.columns).iter().for_each(|[_, caveat]| text += &format!("{caveat}\n"));
    let hours = a_row_s * study.rows() as f64 / 3600.0;
    text += &format!("\n{tried} rows tried, {refused} refused: {a_row_s:.2} s a row, about {hours:.2} core hours\n");
    text
}

fn json(study: &Study, a_row_s: f64) -> serde_json::Value {
    let axis = |axis: &Axis| match axis {
        Axis::Number(vary) => serde_json::json!({ "key": axis.key(), "unit": axis.unit(), "bounds": vary.bounds }),
        Axis::Listed(_) | Axis::Stated(_) => serde_json::json!({ "key": axis.key(), "unit": axis.unit() }),
        Axis::Name { names, .. } => serde_json::json!({ "key": axis.key(), "names": names }),
    };
    serde_json::json!({
        "schema_version": 1,
        "study": study.name,
        "base": study.base_name(),
        "rows": study.rows(),
        "axes": study.axes.iter().map(axis).collect::<Vec<_>>(),
        "columns": study.columns.iter().map(|column| serde_json::json!({ "name": column.name(), "unit": column.unit() })).collect::<Vec<_>>(),
        "seconds_a_row": a_row_s,
    })
}
