//! `flexframe study pick`.

use std::path::Path;
use std::process::ExitCode;

use super::journal_file::outcomes;
use super::study_option::{journal_of, load};
use crate::cli::candidates;
use crate::cli::failure::Failure;
use crate::cli::frame_text::{self, Line};
use crate::cli::options::Common;
use crate::cli::output;
use crate::cli::terminal;
use crate::params::frame_file::Value;
use crate::study::{Axis, Evaluator, Input, Outcome, Outcomes, Study, Subject};

/// Write the frame of a row as a frame file, or the drops of a row as a plan for `flexframe synthesize`.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// The plan: a TOML file.
    #[arg(value_name = "PLAN", add = candidates::toml_files())]
    plan: String,
    /// The row's number.
    #[arg(value_name = "ROW")]
    row: usize,
    /// Write it as NAME.toml.
    #[arg(short, long, value_name = "NAME")]
    output: String,
}

pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let study = load(&args.plan)?;
    let row = args.row;
    if row >= study.rows() {
        return Err(Failure::Usage { message: format!("row {row}: the study has the rows 0 to {}", study.rows() - 1) });
    }
    let place = frame_text::place(&args.output)?;
    match &study.subject {
        Subject::Frames(frames) => write_frame(&study, &frames.base_name, row, &place)?,
        Subject::Recovery(recovery) => {
            let drops = recovery.drops(row).map_err(|why| Failure::Usage { message: format!("row {row}: {why}") })?;
            let failed = |error| Failure::Machine { what: format!("cannot write {}", place.display()), error };
            output::write_new(&place, drops.to_toml().as_bytes()).map_err(failed)?;
        }
    }
    let known = known(&study);
    let refused = match study.subject {
        Subject::Frames(_) => refused(&study, row, known.as_ref().and_then(|known| known.as_ref().ok())),
        Subject::Recovery(_) => None,
    };
    if common.json {
        terminal::print_json(
            &serde_json::json!({ "schema_version": 1, "file": place.display().to_string(), "row": row, "refused": refused }),
        )?;
    } else if !common.quiet {
        terminal::print(&format!("{}: written\n", place.display()))?;
    }
    if known.is_some_and(|known| known.is_err()) {
        terminal::tell(
            "note: the rows in the folder out are of another plan, base or version of the program: this may not be the frame of its row",
        );
    }
    if let Some(why) = refused {
        terminal::tell(&format!("note: row {row} is no frame: {why}"));
    }
    Ok(ExitCode::SUCCESS)
}

/// What the usual folder says of this study, where it has rows of a study of this name: an error where these are another's.
fn known(study: &Study) -> Option<Result<Outcomes, Failure>> {
    let journal = journal_of(&Path::new("out").join(format!("study-{}", study.name)));
    journal.exists().then(|| outcomes(&journal, study))
}

/// Why the study refuses a row: as its run has found, or would find.
fn refused(study: &Study, row: usize, known: Option<&Outcomes>) -> Option<String> {
    let outcome = known.and_then(|known| known.of(row).cloned()).unwrap_or_else(|| Evaluator::new(study).row(row));
    match outcome {
        Outcome::Refused(why) => Some(why),
        Outcome::Figures(_) => None,
    }
}

fn write_frame(study: &Study, base_name: &str, row: usize, place: &Path) -> Result<(), Failure> {
    let base = frame_text::base_for(place, base_name)?;
    let line = |(axis, input): (&Axis, Input)| {
        Some(Line {
            key: axis.key(),
            value: match input {
                Input::Number(value) => Some(Value::Number(value)),
                Input::Name(name) => Some(Value::Text(name)),
                Input::None => None,
            }?,
            why: format!("row {row}"),
        })
    };
    let lines: Vec<Line> = study.axes.iter().zip(study.inputs(row)).filter_map(line).collect();
    frame_text::write(place, &base, &format!("Row {row} of the study {}", study.name), &lines)
}
