//! `flexframe solve`: a search for a better frame, or for the front of several goals.

mod arguments;
mod front;
mod report;
mod wish;

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

use super::failure::Failure;
use super::frame_text::{self, Line};
use super::options::Common;
use super::searching::Following;
use super::session;
use super::terminal;
use super::varied::varied;
use crate::params::frame_file::Value;
use crate::variant::{Chosen, Evaluation, SearchProblem, SolveError, choose};
pub(super) use arguments::Args;
use wish::Wanted;

/// Searches, says what it found, and writes it when asked to; exits 1 when no frame keeps every limit.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let (wanted, goals) = (Wanted::read(args)?, wish::goals(args)?);
    let written = match (&wanted, &args.output) {
        (Wanted::Frame { .. }, Some(name)) => Some(frame_text::place(name)?),
        _ => None,
    };
    let base = written.as_ref().map(|place| frame_text::base_for(place, &args.frame.frame)).transpose()?;
    let (before, file) = session::load(&args.frame)?;
    let (vary, choices) = (varied(&args.vary, &before)?, wish::choices(args, &before, &file)?);
    let mechanics = wish::mechanics(args, &wanted, &goals)?;
    let following = Following::begin(&args.search, wanted.measures()[0].unit, common);
    let (most, follows) = (usize::from(args.search.frames), |standing: &_| following.hears(standing));
    let aim = match &wanted {
        Wanted::Frame { aim, .. } => aim.clone(),
        Wanted::Front(goals) => crate::variant::Aim::least(goals[0]),
    };
    let problem = SearchProblem {
        file: &file,
        aim,
        goals,
        vary,
        start: Vec::new(),
        most,
        follows: &follows,
        mechanics: mechanics.clone(),
        memo: Arc::default(),
    };
    let Wanted::Frame { doc, .. } = &wanted else {
        let found = crate::variant::front(&problem, &wanted.measures());
        following.ends();
        return front::report_front(&answered(found)?, &before.name, args.output.as_ref().map(Path::new), common);
    };
    let found = choose(&problem, &choices);
    following.ends();
    let chosen = answered(found)?;
    let done = match (&written, base) {
        (Some(place), Some(base)) => write(place, &base, &format!("{doc} by flexframe solve"), &chosen, args),
        _ => Ok(()),
    };
    if common.json {
        // A file that cannot be written is the one document that is printed.
        done?;
        terminal::print_json(&report::json(&chosen))?;
        return Ok(ExitCode::SUCCESS);
    }
    if !common.quiet {
        let begun = Evaluation::quick(before.clone(), &problem.memo).ok();
        let begun = match &mechanics {
            None => begun,
            Some(settings) => begun.and_then(|begun| begun.strengthened(settings).ok()),
        };
        terminal::print(&report::formatted(&chosen, &before.name, &file, begun.as_ref()))?;
    }
    // A person has the answer of a long search on the terminal, also where it cannot be written.
    done?;
    if let Some(place) = written.filter(|_| !common.quiet) {
        terminal::print(&format!("{}: written\n", place.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The answer.
///
/// # Errors
/// [`Failure::Impossible`] where no frame keeps every limit.
fn answered<T>(found: Result<T, SolveError>) -> Result<T, Failure> {
    found.map_err(|error| match error {
        SolveError::Infeasible { .. } => Failure::Impossible { message: format!("no answer: {error}") },
        error => Failure::Usage { message: error.to_string() },
    })
}

fn write(place: &Path, base: &str, what: &str, chosen: &Chosen, args: &Args) -> Result<(), Failure> {
    let name = |(key, name): &(String, String)| Line { key: key.clone(), value: Value::Text(name.clone()), why: "chosen".into() };
    let mut lines: Vec<Line> = chosen.names.iter().map(name).collect();
    lines.extend(chosen.solution.values.iter().map(|(vary, before, after)| Line {
        key: vary.key(),
        value: Value::Number(*after),
        why: format!("was {before}"),
    }));
    let rigid = args.frame.rigid.as_ref().filter(|_| chosen.names.iter().all(|(key, _)| key != "materials.rigid"));
    lines.extend(rigid.map(|rigid| Line { key: "materials.rigid".into(), value: Value::Text(rigid.clone()), why: "--rigid".into() }));
    frame_text::write(place, base, what, &lines)
}
