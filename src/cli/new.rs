//! `flexframe new`: a variant of a frame, solved to keep its limits.

use std::process::ExitCode;

use super::candidates;
use super::failure::Failure;
use super::frame_text::{self, Line};
use super::options::{Common, FrameOption};
use super::searching::{self, Following, SearchOptions};
use super::session;
use super::terminal;
use super::varied::varied;
use crate::params::frame_file::Value;
use crate::params::{Frame, LoadError, amend};
use crate::variant::{CreateError, Creation, Ended, Request, SolveError, create, fitting_motor_screw, movable};

/// Write a variant of a frame, with the changes that it needs to keep every limit.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe new small --from cognifly --propeller propeller-65mm --envelope 190x190x110\n  flexframe new long --battery battery-2s-2000 --mass 265\n  flexframe new longer --envelope 210x240x120 --vary cage_side_ratio=1.1..1.14\n\nRod lengths and motor positions change as little as keeps every limit, and in a frame that is or may be longer than wide cage_side_ratio. Exit code 1, and nothing is written, when no such frame is found."
)]
pub(super) struct Args {
    /// Name of the variant; NAME.toml is written.
    pub name: String,
    /// The frame to start from.
    #[arg(long, default_value = "cognifly", value_name = "FRAME", add = candidates::frames())]
    pub from: String,
    /// Another battery: a name of params/bought.toml.
    #[arg(long, value_name = "PART", add = candidates::bought("battery"))]
    pub battery: Option<String>,
    /// Another propeller.
    #[arg(long, value_name = "PART", add = candidates::bought("propeller"))]
    pub propeller: Option<String>,
    /// Another motor.
    #[arg(long, value_name = "PART", add = candidates::bought("motor"))]
    pub motor: Option<String>,
    /// Another rod.
    #[arg(long, value_name = "PART", add = candidates::bought("rod"))]
    pub rod: Option<String>,
    /// Largest size, mm.
    #[arg(long, value_name = "WxDxH")]
    pub envelope: Option<String>,
    /// Largest mass, g.
    #[arg(long, value_name = "G", value_parser = super::bounded::number([20.0, 2000.0], "g"))]
    pub mass: Option<f64>,
    /// Further keys that may move, by 20 % or within bounds, such as cage_side_ratio or bay_height=18..25; bounds of a rod replace its own.
    #[arg(long, value_delimiter = ',', value_name = "KEY,…", add = candidates::numbers_between_commas())]
    pub vary: Vec<String>,
    /// Limits of the search.
    #[command(flatten)]
    pub search: SearchOptions,
}

/// Writes a variant; exits 1, and writes nothing, when no frame near by keeps every limit.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let place = frame_text::place(&args.name)?;
    let base = frame_text::base_for(&place, &args.from)?;
    let (from, mut file) = session::load(&FrameOption { frame: args.from.clone(), rigid: None })?;
    let envelope_mm = args.envelope.as_deref().map(envelope).transpose()?;
    let mut lines = wishes(args, envelope_mm, file.entries.contains_key(DEPTH));
    if lines.is_empty() {
        return Err(Failure::Usage {
            message: "say what is to be different: --battery, --propeller, --motor, --rod, --envelope or --mass".into(),
        });
    }
    for Line { key, value, .. } in &lines {
        file.ask(key, value.clone(), asked_by(key, value));
    }
    if let Some(screw) = args.motor.as_ref().and_then(|_| fitting_motor_screw(&Frame::resolve(&file).ok()?)) {
        let line = Line { key: "bought.motor_screw".into(), value: Value::Text(screw), why: "has the thread of the motor's holes".into() };
        file.ask(&line.key, line.value.clone(), format!("--motor, with {}", amend::formatted(&line.value)));
        lines.push(line);
    }
    file.name = place.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let following = Following::begin(&args.search, "away in squared shares of the bounds", common);
    let follows = |standing: &_| following.hears(standing);
    let (most, vary) = (usize::from(args.search.frames), varied(&args.vary, &from)?);
    let request = Request { file: &file, from: &from, envelope_mm, vary: &vary, most, follows: &follows };
    let created = create(&request);
    following.ends();
    let creation = match created {
        Ok(creation) => creation,
        Err(CreateError::Refused(refusal)) => return Err(LoadError::Refused(refusal).into()),
        Err(CreateError::Unsolved(error @ SolveError::Infeasible { looked_at: 0, ended: Ended::Stopped, .. })) => {
            return Err(Failure::Impossible { message: format!("no such variant was found: {error}") });
        }
        Err(CreateError::Unsolved(error @ SolveError::Infeasible { .. })) => {
            let looked = movable(&request)
                .iter()
                .map(|vary| format!("{} {:.1} to {:.1}", vary.key(), vary.bounds[0], vary.bounds[1]))
                .collect::<Vec<_>>();
            let message = format!(
                "no such variant was found: {error}\nlooked at: {}; for a size beyond, take a frame near it with --from\n\
                 ask for less, or free more parameters with --vary",
                looked.join(", ")
            );
            return Err(Failure::Impossible { message });
        }
        Err(CreateError::Unsolved(error)) => return Err(Failure::Usage { message: error.to_string() }),
    };
    for moved in &creation.moved {
        let why = format!("was {}; moved to keep every limit", moved.before);
        lines.push(Line { key: moved.key.clone(), value: Value::Number(moved.after), why });
    }
    frame_text::write(&place, &base, &format!("Variant of {}", from.name), &lines)?;
    if common.json {
        terminal::print_json(&json(&creation, &place.display().to_string()))?;
    } else if !common.quiet {
        terminal::print(&formatted(&creation, &lines, &place.display().to_string()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The words of the command line that ask for a value.
fn asked_by(key: &str, value: &Value) -> String {
    let value = amend::formatted(value);
    match key.split_once('.') {
        Some(("bought", role)) => format!("--{role} {value}"),
        Some((_, "mass_budget_g")) => format!("--mass {value}"),
        Some((_, "envelope_width_mm")) => format!("--envelope, width {value} mm"),
        Some((_, "envelope_depth_mm")) => format!("--envelope, depth {value} mm"),
        _ => format!("--envelope, height {value} mm"),
    }
}

/// Follows the width unless a file states it.
const DEPTH: &str = "limits.envelope_depth_mm";

/// What was asked for, as lines of the file; the depth is one of them where it is not the width, or where the frame states its own.
fn wishes(args: &Args, envelope_mm: Option<[f64; 3]>, states_depth: bool) -> Vec<Line> {
    let choices = [
        ("bought.battery", &args.battery),
        ("bought.propeller", &args.propeller),
        ("bought.motor", &args.motor),
        ("bought.rod", &args.rod),
    ];
    let asked = "asked for";
    let choice = |(key, name): (&str, &Option<String>)| {
        name.as_ref().map(|name| Line { key: key.into(), value: Value::Text(name.clone()), why: asked.into() })
    };
    let mut lines: Vec<Line> = choices.into_iter().filter_map(choice).collect();
    if let Some([x, y, z]) = envelope_mm {
        let depth = (x != y || states_depth).then_some((DEPTH, y));
        for (key, value) in [("limits.envelope_width_mm", x)].into_iter().chain(depth).chain([("limits.envelope_height_mm", z)]) {
            lines.push(Line { key: key.into(), value: Value::Number(value), why: asked.into() });
        }
    }
    lines.extend(args.mass.map(|mass| Line { key: "limits.mass_budget_g".into(), value: Value::Number(mass), why: asked.into() }));
    lines
}

/// `180x180x110`: width, depth and height, mm.
fn envelope(text: &str) -> Result<[f64; 3], Failure> {
    let wrong = || Failure::Usage { message: format!("--envelope {text}: give width x depth x height in mm, such as 180x180x110") };
    let sides: Vec<f64> = text.split('x').filter_map(|side| side.trim().parse().ok()).collect();
    match sides[..] {
        [x, y, z] if text.split('x').count() == 3 && [x, y, z].iter().all(|side: &f64| side.is_finite()) => Ok([x, y, z]),
        _ => Err(wrong()),
    }
}

fn formatted(creation: &Creation, lines: &[Line], place: &str) -> String {
    let mut text = String::new();
    for message in &creation.why {
        text += &format!("as asked for: {message}\n");
    }
    for line in lines {
        let value = match &line.value {
            Value::Number(number) => number.to_string(),
            Value::Text(name) => name.clone(),
            Value::Other(other) => other.to_string(),
        };
        text += &format!("{:<34} {value:>16}  {}\n", line.key, line.why);
    }
    let fails = "keeps every limit";
    format!(
        "{text}{place}: {:.1} g, {fails}; {}\n",
        creation.evaluation.masses.total_g,
        searching::summary(creation.looked_at, creation.ended)
    )
}

fn json(creation: &Creation, place: &str) -> serde_json::Value {
    let moved = |m: &crate::variant::Moved| serde_json::json!({ "key": m.key, "before": m.before, "after": m.after });
    serde_json::json!({
        "schema_version": 1,
        "file": place,
        "as_asked_for": creation.why,
        "moved": creation.moved.iter().map(moved).collect::<Vec<_>>(),
        "mass_g": creation.evaluation.masses.total_g,
        "looked_at": creation.looked_at,
        "ended": searching::id(creation.ended),
    })
}
