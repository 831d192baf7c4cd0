//! `flexframe study block`: a task of a cluster.

use std::path::PathBuf;
use std::process::ExitCode;

use super::hq;
use super::study_option::load;
use crate::cli::candidates;
use crate::cli::failure::Failure;
use crate::cli::output;
use crate::study::{Evaluator, begun, line};

/// Evaluate a block of rows as a task on a cluster; `study run --engine hq` calls it.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// The plan: a TOML file.
    #[arg(value_name = "PLAN", add = candidates::toml_files())]
    plan: String,
    /// First row and the row after the last, such as 0-50; without it HyperQueue's HQ_ENTRY.
    #[arg(long, value_name = "FIRST-END", value_parser = hq::block)]
    rows: Option<(usize, usize)>,
    /// Folder that takes the file of the block.
    #[arg(long, value_name = "DIR")]
    into: PathBuf,
}

/// Writes the block's rows as one file, whole: a task that is begun again writes the same.
pub(super) fn run(args: &Args) -> Result<ExitCode, Failure> {
    let study = load(&args.plan)?;
    let (first, end) = rows(args)?;
    if first >= end {
        return Err(Failure::Usage { message: format!("--rows {first}-{end}: give FIRST-END, with END behind the last row of the block") });
    }
    if end > study.rows() {
        return Err(Failure::Usage { message: format!("--rows {first}-{end}: the study has the rows 0 to {}", study.rows() - 1) });
    }
    let place = args.into.join(hq::file_of((first, end)));
    if place.exists() {
        return Ok(ExitCode::SUCCESS);
    }
    let evaluator = Evaluator::new(&study);
    let mut text = begun(&study);
    for row in first..end {
        text += &line(row, &evaluator.row(row));
    }
    let failed = |error| Failure::Machine { what: format!("cannot write {}", place.display()), error };
    output::replace_file(&place, text.as_bytes()).map_err(failed)?;
    Ok(ExitCode::SUCCESS)
}

/// The rows that the command line asks for, or HyperQueue.
fn rows(args: &Args) -> Result<(usize, usize), Failure> {
    if let Some(rows) = args.rows {
        return Ok(rows);
    }
    let entry = std::env::var("HQ_ENTRY").map_err(|_| Failure::Usage { message: "give --rows FIRST-END".into() })?;
    hq::block(&entry).map_err(|message| Failure::Usage { message: format!("HQ_ENTRY: {message}") })
}
