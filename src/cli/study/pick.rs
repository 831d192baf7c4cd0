//! `flexframe study pick`.

use std::process::ExitCode;

use super::study_option::load;
use crate::cli::failure::Failure;
use crate::cli::frame_text::{self, Line};
use crate::cli::options::Common;
use crate::cli::terminal;
use crate::params::frame_file::Value;
use crate::study::Input;

/// Write the frame of a row as a frame file.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// The plan: a TOML file.
    #[arg(value_name = "PLAN")]
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
    let base = frame_text::base_for(&place, &study.base_name)?;
    let line = |(axis, input): (&crate::study::Axis, Input)| Line {
        key: axis.key(),
        value: match input {
            Input::Number(value) => Value::Number(value),
            Input::Name(name) => Value::Text(name),
        },
        why: format!("row {row}"),
    };
    let lines: Vec<Line> = study.axes.iter().zip(study.inputs(row)).map(line).collect();
    frame_text::write(&place, &base, &format!("Row {row} of the study {}", study.name), &lines)?;
    if !common.quiet && !common.json {
        terminal::print(&format!("{}: written\n", place.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}
