//! `flexframe fold`: how a frame is put together, as data and as motion.

use std::process::ExitCode;

use super::arguments::{Common, FoldOptions};
use super::output;
use super::progress::Progress;
use super::session::{self, Failure};
use super::terminal;
use crate::assembly::fold::FoldSequence;
use crate::export::{fold_glb, fold_json};

/// Writes `FRAME-fold` with fold.json and fold.glb.
pub(super) fn fold(options: &FoldOptions, common: &Common) -> Result<ExitCode, Failure> {
    let working = Progress::of("folding", common);
    let design = session::design(&options.frame)?;
    let sequence = match FoldSequence::new(&design.frame, &design.skeleton) {
        Ok(sequence) => sequence,
        Err(error) => {
            terminal::tell(&format!("error: {} cannot be folded: {error}", design.frame.name));
            return Ok(ExitCode::from(1));
        }
    };
    let machine = |error: std::io::Error| Failure::Machine { what: "cannot write the fold".into(), error };
    let steps = fold_json::fold_json(&design.frame.name, &sequence).map_err(|error| machine(error.into()))?;
    let motion = fold_glb::fold(&design, &sequence).map_err(|error| machine(std::io::Error::other(error)))?;
    let files = vec![("fold.json".to_string(), steps), ("fold.glb".to_string(), motion)];
    drop(working);
    let place = output::write_folder(&options.output, &format!("{}-fold", design.frame.name), &files)?;
    if common.json {
        terminal::print(&String::from_utf8_lossy(&files[0].1))?;
    } else if !common.quiet {
        let lines = sequence.steps.iter().map(|s| format!("{:>2}  {} x  {}\n", s.number, s.repeats, s.title));
        terminal::print(&format!("{}{}: {} steps\n", lines.collect::<String>(), place.display(), sequence.steps.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}
