//! `flexframe solve`: a search for a better frame.

use std::process::ExitCode;
use std::sync::Arc;

use super::failure::Failure;
use super::frame_text::{self, Line};
use super::options::{Common, FrameOption};
use super::progress::Progress;
use super::session;
use super::terminal;
use crate::mechanics::settings::MechanicsSettings;
use crate::params::Frame;
use crate::params::frame_file::Value;
use crate::variant::{
    Aim, Evaluation, Goal, MEASURES, MECHANICS_CAVEAT, Measure, PEAK_CAVEAT, SearchProblem, Solution, SolveError, Vary, measure,
    measure_names, solve,
};

/// Search for the frame with the least of a measure that keeps every limit.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe solve --minimise mass --vary arm_rod,cage_rod,strut_rod,motor_position -o light\n  flexframe solve cognifly --minimise envelope.volume --subject-to 'clearance.propeller>=3mm' --vary arm_rod=70..90,cage_rod\n\nMeasures: mass, mass.printed, mass.rods, envelope.width, envelope.depth, envelope.height, envelope.volume, clearance.propeller,\nclearance.part, clearance.ground, engagement, hinge.strain, wall, printed.volume, peak; and of the frame's own mechanics, which\ntake a second or two a frame: stiffness, design_drop.peak, design_drop.travel, design_drop.strain. It is a local search: another start may\nlead elsewhere. Exit code 1 when no frame keeps every limit."
)]
pub(super) struct Args {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// What to make small: a measure.
    #[arg(long, value_name = "MEASURE")]
    pub minimise: String,
    /// What to keep besides the frame's limits, such as 'clearance.propeller>=3mm'; may be given several times.
    #[arg(long, value_delimiter = ',', value_name = "GOAL")]
    pub subject_to: Vec<String>,
    /// What may vary: keys, by 20 % of the frame's value, or within bounds such as arm_rod=70..90.
    #[arg(long, value_delimiter = ',', required = true, value_name = "KEY,…")]
    pub vary: Vec<String>,
    /// With a measure of the mechanics: their numbers instead of those that come with the program.
    #[arg(long, value_name = "TOML")]
    pub mechanics: Option<String>,
    /// Most frames to look at.
    #[arg(long, default_value_t = 150, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=5000))]
    pub frames: u16,
    /// Write the answer as NAME.toml.
    #[arg(short, long, value_name = "NAME")]
    pub output: Option<String>,
}

/// Searches, says what it found, and writes it when asked to; exits 1 when no frame keeps every limit.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let usage = |message: String| Failure::Usage { message };
    let aim = measure(&args.minimise)
        .ok_or_else(|| usage(format!("--minimise: there is no measure `{}`; there are {}", args.minimise, measure_names())))?;
    let goals = args.subject_to.iter().map(|text| Goal::parse(text)).collect::<Result<Vec<_>, _>>();
    let goals = goals.map_err(|error| usage(format!("--subject-to: {error}")))?;
    let place = args.output.as_ref().map(|name| frame_text::place(name)).transpose()?;
    let base = place.as_ref().map(|place| frame_text::base_for(place, &args.frame.frame)).transpose()?;
    let (before, file) = session::load(&args.frame)?;
    let vary = args.vary.iter().map(|text| vary(text, &before)).collect::<Result<Vec<_>, _>>()?;
    if let Some(twice) = vary.iter().enumerate().find(|(at, v)| vary[..*at].iter().any(|other| other.key() == v.key())) {
        return Err(usage(format!("--vary: {} stands there twice", twice.1.key())));
    }
    let asked = aim.is_mechanics() || goals.iter().any(|goal| goal.measure.is_mechanics());
    if args.mechanics.is_some() && !asked {
        return Err(usage(
            "--mechanics: neither aim nor goal is one of the mechanics: stiffness, design_drop.peak, .travel, .strain".into(),
        ));
    }
    let mechanics = asked.then(|| MechanicsSettings::load(args.mechanics.as_deref())).transpose()?;
    let working = Progress::of("searching", common);
    let most = usize::from(args.frames);
    let problem = SearchProblem { file: &file, aim: Aim::Measure(aim), goals, vary, start: Vec::new(), most, mechanics };
    let found = solve(&problem);
    drop(working);
    let solution = match found {
        Ok(solution) => solution,
        Err(error @ SolveError::Infeasible { .. }) => {
            terminal::tell(&format!("no answer: {error}"));
            return Ok(ExitCode::from(1));
        }
        Err(error) => return Err(usage(error.to_string())),
    };
    if common.json {
        terminal::print_json(&json(&solution))?;
    } else if !common.quiet {
        let begun = Evaluation::quick(before.clone(), &Arc::default()).ok();
        let begun = match &problem.mechanics {
            None => begun,
            Some(settings) => begun.and_then(|begun| begun.strengthened(settings).ok()),
        };
        terminal::print(&formatted(&solution, &before.name, begun.as_ref()))?;
    }
    if let (Some(place), Some(base)) = (place, base) {
        let mut lines: Vec<Line> = solution.values.iter().map(|(vary, before, after)| line(vary, *before, *after)).collect();
        lines.extend(args.frame.rigid.as_ref().map(|rigid| Line {
            key: "materials.rigid".into(),
            value: Value::Text(rigid.clone()),
            why: "--rigid".into(),
        }));
        let what = format!("{} made small by flexframe solve", aim.doc);
        frame_text::write(&place, &base, &what, &lines)?;
        if !common.quiet && !common.json {
            terminal::print(&format!("{}: written\n", place.display()))?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// How far a parameter without bounds of its own may vary, in shares of its value.
const REACH: f64 = 0.2;

/// A parameter that varies: `arm_rod` or `arm_rod=70..90`.
fn vary(text: &str, frame: &Frame) -> Result<Vary, Failure> {
    let (key, range) = text.split_once('=').map_or((text, None), |(key, range)| (key, Some(range)));
    let parameter = session::parameter(key.trim())?;
    let bounds = [parameter.min, parameter.max];
    if let Some(range) = range {
        let wrong =
            || Failure::Usage { message: format!("--vary {text}: give bounds as {key}=LEAST..MOST within {} to {}", bounds[0], bounds[1]) };
        let (least, most) = range.split_once("..").ok_or_else(wrong)?;
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| (bounds[0]..=bounds[1]).contains(value));
        let stated = [number(least).ok_or_else(wrong)?, number(most).ok_or_else(wrong)?];
        if stated[0] > stated[1] {
            return Err(wrong());
        }
        return Ok(Vary { parameter, bounds: stated });
    }
    Ok(Vary::around(parameter, frame, REACH))
}

/// How many frames a search looked at, in words.
pub(super) fn looked_at(count: usize) -> String {
    if count == 1 { "1 frame was looked at".into() } else { format!("{count} frames were looked at") }
}

fn line(vary: &Vary, before: f64, after: f64) -> Line {
    Line { key: vary.key(), value: Value::Number(after), why: format!("was {before}") }
}

/// What was found beside what there was; the frame that the search began at need not be one that can be built.
fn formatted(solution: &Solution, before: &str, begun: Option<&Evaluation>) -> String {
    let mut text = format!("{}\n\n{:<34} {:>10} {:>10}\n", looked_at(solution.looked_at), "", before, "solved");
    for (vary, before, after) in &solution.values {
        text += &format!("{:<34} {before:>10.3} {after:>10.3} {}\n", vary.key(), vary.parameter.unit());
    }
    text.push('\n');
    for measure in known(&solution.evaluation) {
        let [was, is] = [begun, Some(&solution.evaluation)].map(|evaluation| measure.reported(evaluation.and_then(|e| measure.of(e))));
        text += &format!("{:<34} {was:>10} {is:>10} {}\n", measure.name, measure.unit);
    }
    text += "\nwhat holds it back\n";
    for binding in &solution.binding {
        text += &format!("  {} (room {:.3} {})\n", binding.what, binding.margin, binding.unit);
    }
    if solution.binding.is_empty() {
        text += "  no limit and no bound is reached: a minimum within, a cliff, or the search ended early\n";
    }
    if !solution.refused.is_empty() {
        text += "\nwhat is wrong with the nearest frames beyond\n";
        solution.refused.iter().for_each(|reason| text += &format!("  {reason}\n"));
    }
    let mechanics = if solution.evaluation.prediction.is_some() { format!("{MECHANICS_CAVEAT}\n") } else { String::new() };
    format!("{text}\n{PEAK_CAVEAT}\n{mechanics}")
}

/// The measures that were asked for.
fn known(evaluation: &Evaluation) -> impl Iterator<Item = &'static Measure> {
    let mechanics = evaluation.prediction.is_some();
    MEASURES.iter().filter(move |measure| mechanics || !measure.is_mechanics())
}

fn json(solution: &Solution) -> serde_json::Value {
    let value = |(vary, before, after): &(Vary, f64, f64)| serde_json::json!({ "key": vary.key(), "before": before, "after": after });
    let binding = |b: &crate::variant::Binding| serde_json::json!({ "what": b.what, "margin": b.margin, "unit": b.unit });
    let measures: serde_json::Map<String, serde_json::Value> =
        known(&solution.evaluation).map(|m| (m.name.to_string(), serde_json::json!(m.of(&solution.evaluation)))).collect();
    serde_json::json!({
        "schema_version": 1,
        "looked_at": solution.looked_at,
        "values": solution.values.iter().map(value).collect::<Vec<_>>(),
        "measures": measures,
        "refused": solution.refused,
        "binding": solution.binding.iter().map(binding).collect::<Vec<_>>(),
        "peak": PEAK_CAVEAT,
    })
}
