//! `flexframe explain`: what a parameter is and does.

use std::process::ExitCode;

use super::candidates;
use super::choice::{self, Choice, Followed};
use super::failure::Failure;
use super::options::{Common, FrameOption, MechanicsOption};
use super::progress::Progress;
use super::session;
use super::terminal;
use crate::figures::decimals;
use crate::params::parameter::Parameter;
use crate::params::refusal::Place;
use crate::params::target::{self, TargetKey};
use crate::params::{Frame, FrameFile, follows};
use crate::variant::{MEASURES, MECHANICS_CAVEAT, PEAK_CAVEAT, Response, sensitivity, units};

/// Explain a parameter: its meaning, the parts it drives, the effect of ±5 %.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe explain arm_pitch_mm\n  flexframe explain arm_rod light.toml --json\n  flexframe explain strut_rod --strength\n  flexframe explain bought.battery"
)]
pub(super) struct Args {
    /// The parameter: its key, with or without its table, or the beginning of the key; or a key that holds a name, such as bought.battery.
    #[arg(value_name = "KEY", add = candidates::keys())]
    pub key: String,
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Whether the mechanics are computed.
    #[command(flatten)]
    pub mechanics: MechanicsOption,
}

/// By how much the parameter is changed.
const SHARE: f64 = 0.05;

/// What is said instead of an effect where a target size gives a number.
const GIVEN: &str =
    "The frame has no other value of it: [target] gives the rod lengths. `flexframe explain target.width_mm` tells of its keys.";

/// Whether a target size gives a parameter's number.
fn is_given(parameter: &Parameter, frame: &Frame) -> bool {
    target::gives(frame, &format!("{}.{}", parameter.table, parameter.key))
}

/// Explains a parameter, or a choice of a name.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let (frame, file) = session::load(&args.frame)?;
    if let Some(choice) = choice::of(&args.key, &frame, &file)? {
        if common.json {
            terminal::print_json(&choice_json(&choice))?;
        } else {
            terminal::print(&choice_text(&choice))?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    if let Some(key) = target::key(&args.key) {
        if common.json {
            terminal::print_json(&target_json(key, &file))?;
        } else {
            terminal::print(&target_text(key, &file))?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    let parameter = session::parameter(&args.key)?;
    let frame = session::with_lengths(frame, &file, common)?;
    let settings = session::mechanics(&args.mechanics)?;
    let working = Progress::of("trying values", common);
    let responses = if is_given(parameter, &frame) { Vec::new() } else { sensitivity(&file, &frame, parameter, SHARE, settings.as_ref()) };
    drop(working);
    if common.json {
        terminal::print_json(&json(parameter, &frame, &responses))?;
    } else if is_given(parameter, &frame) {
        terminal::print(&format!("{}\n{GIVEN}\n", head(parameter, &frame, &file)))?;
    } else {
        let mechanics = if settings.is_some() { format!("{MECHANICS_CAVEAT}\n") } else { String::new() };
        terminal::print(&format!("{}\n{}\n{PEAK_CAVEAT}\n{mechanics}", head(parameter, &frame, &file), table(parameter, &responses)))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn head(p: &Parameter, frame: &Frame, file: &FrameFile) -> String {
    let unit = p.unit();
    let value = frame.value(p.table, p.key).unwrap_or(f64::NAN);
    let mut text = format!("{}.{}\n  {}\n", p.table, p.key, p.doc.trim());
    text += format!("  value    {} {unit}", round(value)).trim_end();
    let stated = file.entries.get(&format!("{}.{}", p.table, p.key)).map(|entry| &entry.place);
    text += &match (stated, follows::followed_key_in(&frame.bought, p.key)) {
        _ if is_given(p, frame) => " (follows from [target])\n".into(),
        (Some(place), _) => format!(" ({})\n", line_of(place)),
        (None, Some(followed)) => format!(" (follows from {followed})\n"),
        (None, None) => "\n".into(),
    };
    text += format!("  bounds   {} to {} {unit}", p.min, p.max).trim_end();
    let drives: Vec<&str> = p.drives.iter().map(|part| part.slug()).collect();
    let shapes = if drives.is_empty() { "the shape of no printed part".into() } else { drives.join(", ") };
    text + &format!("\n  drives   {shapes}\n")
}

/// File and line of a place.
fn line_of(place: &Place) -> String {
    format!("{}:{}", place.source.name, place.line_column()[0])
}

fn target_text(target: &TargetKey, file: &FrameFile) -> String {
    let TargetKey { key, min, max, unit, doc } = target;
    let value = match file.entries.get(*key) {
        Some(entry) => format!("{} {unit} ({})", entry.value.to_toml(), line_of(&entry.place)),
        None => "no file states it; the frame's rod lengths are stated".into(),
    };
    format!("{key}\n  {doc}\n  value    {value}\n  bounds   {min} to {max} {unit}\n  sets     {}\n", target::LENGTHS.join(", "))
}

fn target_json(target: &TargetKey, file: &FrameFile) -> serde_json::Value {
    let TargetKey { key, min, max, unit, doc } = target;
    let value = file.entries.get(*key).map(|entry| entry.value.to_toml());
    serde_json::json!({
        "schema_version": 1,
        "key": key,
        "what": doc,
        "unit": unit,
        "value": value,
        "bounds": [min, max],
        "sets": target::LENGTHS,
    })
}

fn choice_text(choice: &Choice) -> String {
    let mut text = format!("{}\n  {}\n", choice.key, choice.what);
    text += &match &choice.value {
        Some((name, place)) => format!("  value    {name} ({})\n", line_of(place)),
        None => "  value    no file states it\n".into(),
    };
    text += &format!("  names    {}\n", choice.names.join(", "));
    choice.or.iter().for_each(|or| text += &format!("           or {or}\n"));
    for (at, Followed { key, value, unit, stated }) in choice.sets.iter().enumerate() {
        let value = value.map_or("-".into(), |value| round(value).to_string());
        let stated = stated.as_ref().map_or(String::new(), |place| format!(" (stated, does not follow: {})", line_of(place)));
        let head = if at == 0 { "sets" } else { "" };
        text += format!("  {head:<8} {key} = {value} {unit}").trim_end();
        text += &format!("{stated}\n");
    }
    text
}

fn choice_json(choice: &Choice) -> serde_json::Value {
    let set = |set: &Followed| serde_json::json!({ "key": set.key, "value": set.value, "unit": set.unit, "stated": set.stated.is_some() });
    serde_json::json!({
        "schema_version": 1,
        "key": choice.key,
        "what": choice.what,
        "value": choice.value.as_ref().map(|(name, _)| name),
        "names": choice.names,
        "or": choice.or,
        "sets": choice.sets.iter().map(set).collect::<Vec<_>>(),
    })
}

/// What a column's value is to the frame's own, which stands in the middle.
fn title(p: &Parameter, responses: &[Response], at: usize) -> String {
    let own = responses.get(1).map_or(f64::NAN, |response| response.value);
    let value = responses[at].value;
    let [which, farthest] = if at == 0 { ["less", "at its least"] } else { ["more", "at its most"] };
    if at == 1 {
        "as it is".into()
    } else if value == p.min || value == p.max {
        farthest.into()
    } else if own == 0.0 {
        which.into()
    } else {
        format!("{} % {which}", round(SHARE * 100.0))
    }
}

fn table(p: &Parameter, responses: &[Response]) -> String {
    let mut text = format!("{:<25}", "");
    (0..responses.len()).for_each(|at| text += &format!(" {:>12}", title(p, responses, at)));
    text += &format!("\n{:<20} {:<4}", "value", p.unit());
    responses.iter().for_each(|response| text += &format!(" {:>12}", round(response.value)));
    text.push('\n');
    let (mut still, mut moves) = (Vec::new(), false);
    for (at, measure) in MEASURES.iter().enumerate() {
        let of = |response: &Response| response.measures.as_ref().ok().and_then(|measures| measures[at]);
        if measure.is_mechanics() && responses.iter().all(|response| of(response).is_none()) {
            continue;
        }
        let middle = responses.get(1).and_then(of);
        let same = |response: &Response| {
            of(response).zip(middle).is_some_and(|(a, b)| decimals(a - b, measure.places()) == decimals(0.0, measure.places()))
        };
        if responses.iter().all(same) {
            still.push(measure.name);
            continue;
        }
        moves = true;
        text += &format!("{:<20} {:<4}", measure.name, measure.unit);
        for (column, response) in responses.iter().enumerate() {
            let formatted = match (of(response), middle) {
                (Some(value), Some(middle)) if column != 1 => signed(value - middle, measure.places()),
                (value, _) => measure.reported(value),
            };
            text += &format!(" {formatted:>12}");
        }
        text.push('\n');
    }
    if !still.is_empty() {
        let line = format!("without effect on: {}", still.join(", "));
        text += &(textwrap::fill(&line, textwrap::Options::new(80).subsequent_indent("  ")) + "\n");
    }
    if moves && responses.get(1).is_some_and(|own| own.measures.is_ok()) {
        text += "left and right of the middle stands the change against the frame as it is\n";
    }
    for response in responses {
        if let Err(why) = &response.measures {
            text += &format!("no such frame with {}: {why}\n", round(response.value));
        }
    }
    text
}

/// A value to a millionth.
fn round(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

fn signed(change: f64, places: usize) -> String {
    let formatted = decimals(change, places);
    if change > 0.0 && formatted.chars().any(|c| ('1'..='9').contains(&c)) { format!("+{formatted}") } else { formatted }
}

fn json(p: &Parameter, frame: &Frame, responses: &[Response]) -> serde_json::Value {
    let response = |response: &Response| match &response.measures {
        Ok(measures) => {
            let named: serde_json::Map<String, serde_json::Value> = MEASURES
                .iter()
                .zip(measures)
                .filter(|(measure, value)| value.is_some() || !measure.is_mechanics())
                .map(|(measure, value)| (measure.name.to_string(), serde_json::json!(value)))
                .collect();
            serde_json::json!({ "value": response.value, "measures": named })
        }
        Err(why) => serde_json::json!({ "value": response.value, "refused": why }),
    };
    serde_json::json!({
        "schema_version": 1,
        "key": format!("{}.{}", p.table, p.key),
        "what": p.doc.trim(),
        "unit": p.unit(),
        "value": frame.value(p.table, p.key),
        "bounds": [p.min, p.max],
        "drives": p.drives.iter().map(|part| part.slug()).collect::<Vec<_>>(),
        "follows": if is_given(p, frame) { Some("target") } else { follows::followed_in(&frame.bought, p.key) },
        "responses": responses.iter().map(response).collect::<Vec<_>>(),
        "units": units(MEASURES.iter()),
        "peak": PEAK_CAVEAT,
    })
}
