//! `flexframe solve`: a search for a better frame, or for the front of several goals.

mod front;
mod told;
mod wish;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use super::failure::Failure;
use super::frame_text::{self, Line};
use super::options::{Common, FrameOption};
use super::searching::{Following, SearchOptions};
use super::session;
use super::terminal;
use crate::params::frame_file::Value;
use crate::variant::{Chosen, Evaluation, SearchProblem, SolveError, choose};
use wish::Wanted;

/// Search for the frame with the least of a measure that keeps every limit.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe solve --minimise mass --vary arm_rod,cage_rod,strut_rod,motor_position -o light\n  flexframe solve cognifly --minimise envelope.volume --subject-to 'clearance.propeller>=3mm' --vary arm_rod=70..90,cage_rod\n  flexframe solve --aim stiffness=10 --vary strut_rod\n  flexframe solve --minimise mass --choose bought.battery,materials.rigid --vary cage_rod,arm_rod,strut_rod\n  flexframe solve --pareto mass,envelope.width --vary cage_rod,arm_rod,strut_rod,motor_position -o out\n\nMeasures: mass, mass.printed, mass.rods, envelope.width, envelope.depth, envelope.height, envelope.volume, clearance.propeller,\nclearance.part, clearance.ground, engagement, hinge.strain, wall, printed.volume, peak; and of the frame's own mechanics, which\ntake a second or two a frame: stiffness, design_drop.peak, design_drop.travel, design_drop.strain. It is a local search: another start may\nlead elsewhere. Ctrl-C ends it with the best so far. Exit code 1 when no frame keeps every limit."
)]
pub(super) struct Args {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// What to make small: a measure.
    #[arg(long, value_name = "MEASURE", required_unless_present_any = ["aim", "pareto"], conflicts_with_all = ["aim", "pareto"])]
    pub minimise: Option<String>,
    /// What to come near to, such as stiffness=10.
    #[arg(long, value_name = "MEASURE=VALUE", conflicts_with = "pareto")]
    pub aim: Option<String>,
    /// Frames of which none is better than another in all of two or three measures.
    #[arg(long, value_delimiter = ',', value_name = "MEASURE,…", conflicts_with = "choose")]
    pub pareto: Vec<String>,
    /// What to keep besides the frame's limits, such as 'clearance.propeller>=3mm'; may be given several times.
    #[arg(long, value_delimiter = ',', value_name = "GOAL")]
    pub subject_to: Vec<String>,
    /// What may vary: keys, by 20 % of the frame's value, or within bounds such as arm_rod=70..90.
    #[arg(long, value_delimiter = ',', required_unless_present = "choose", value_name = "KEY,…")]
    pub vary: Vec<String>,
    /// Whole choices: keys of names, of all there are or of some, such as 'bought.battery=battery-2s-850|battery-2s-1100'.
    #[arg(long, value_delimiter = ',', value_name = "KEY,…")]
    pub choose: Vec<String>,
    /// With a measure of the mechanics: their numbers instead of those that come with the program.
    #[arg(long, value_name = "TOML")]
    pub mechanics: Option<String>,
    /// How long the search goes on.
    #[command(flatten)]
    pub search: SearchOptions,
    /// Write the answer as NAME.toml; a front as CSV, JSON and picture into the folder `pareto-FRAME` of this one.
    #[arg(short, long, value_name = "NAME")]
    pub output: Option<String>,
}

/// Searches, says what it found, and writes it when asked to; exits 1 when no frame keeps every limit.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let (wanted, goals) = (Wanted::read(args)?, wish::goals(args)?);
    let written = match (&wanted, &args.output) {
        (Wanted::Frame { .. }, Some(name)) => Some(frame_text::place(name)?),
        _ => None,
    };
    let base = written.as_ref().map(|place| frame_text::base_for(place, &args.frame.frame)).transpose()?;
    let (before, file) = session::load(&args.frame)?;
    let (vary, choices) = (wish::varied(args, &before)?, wish::choices(args, &before, &file)?);
    let mechanics = wish::mechanics(args, &wanted, &goals)?;
    let following = Following::begin(&args.search, wanted.measures()[0].unit, common);
    let (most, follows) = (usize::from(args.search.frames), |standing: &_| following.hears(standing));
    let aim = match &wanted {
        Wanted::Frame { aim, .. } => aim.clone(),
        Wanted::Front(goals) => crate::variant::Aim::least(goals[0]),
    };
    let problem = SearchProblem { file: &file, aim, goals, vary, start: Vec::new(), most, follows: &follows, mechanics: mechanics.clone() };
    let Wanted::Frame { doc, .. } = &wanted else {
        let found = crate::variant::front(&problem, &wanted.measures());
        following.ends();
        return front::told(&answered(found)?, &before.name, args.output.as_ref().map(Path::new), common);
    };
    let found = choose(&problem, &choices);
    following.ends();
    let Some(chosen) = answered(found)? else { return Ok(ExitCode::from(1)) };
    if common.json {
        terminal::print_json(&told::json(&chosen))?;
    } else if !common.quiet {
        let begun = Evaluation::quick(before.clone(), &Arc::default()).ok();
        let begun = match &mechanics {
            None => begun,
            Some(settings) => begun.and_then(|begun| begun.strengthened(settings).ok()),
        };
        terminal::print(&told::formatted(&chosen, &before.name, begun.as_ref()))?;
    }
    if let (Some(place), Some(base)) = (written, base) {
        write(&place, &base, &format!("{doc} by flexframe solve"), &chosen, args)?;
        if !common.quiet && !common.json {
            terminal::print(&format!("{}: written\n", place.display()))?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The answer; none, and it was said, where no frame keeps every limit.
fn answered<T>(found: Result<T, SolveError>) -> Result<Option<T>, Failure> {
    match found {
        Ok(answer) => Ok(Some(answer)),
        Err(error @ SolveError::Infeasible { .. }) => {
            terminal::tell(&format!("no answer: {error}"));
            Ok(None)
        }
        Err(error) => Err(Failure::Usage { message: error.to_string() }),
    }
}

fn write(place: &PathBuf, base: &str, what: &str, chosen: &Chosen, args: &Args) -> Result<(), Failure> {
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
