//! `flexframe explain`: what a parameter is and does.

use std::process::ExitCode;

use super::arguments::{Common, ExplainOptions};
use super::progress::Progress;
use super::session::{self, Failure};
use super::terminal;
use crate::params::parameter::Parameter;
use crate::params::{Frame, FrameFile, follows};
use crate::variant::{MEASURES, PEAK_CAVEAT, Response, sensitivity};

/// By how much the parameter is changed.
const SHARE: f64 = 0.05;

/// Explains a parameter.
pub(super) fn explain(options: &ExplainOptions, common: &Common) -> Result<ExitCode, Failure> {
    let parameter = session::parameter(&options.key)?;
    let (frame, file) = session::load(&options.frame)?;
    let working = Progress::of("trying values", common);
    let responses = sensitivity(&file, &frame, parameter, SHARE);
    drop(working);
    if common.json {
        terminal::print_json(&json(parameter, &frame, &responses))?;
    } else {
        terminal::print(&format!("{}\n{}\n{PEAK_CAVEAT}\n", head(parameter, &frame, &file), table(parameter, &responses)))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn head(p: &Parameter, frame: &Frame, file: &FrameFile) -> String {
    let unit = p.unit();
    let value = frame.value(p.table, p.key).unwrap_or(f64::NAN);
    let mut text = format!("{}.{}\n  {}\n", p.table, p.key, p.doc.trim());
    text += format!("  value    {value} {unit}").trim_end();
    let stated = file.entries.get(&format!("{}.{}", p.table, p.key)).map(|entry| &entry.place);
    text += &match (stated, follows::role_of(p.key)) {
        (Some(place), _) => format!(" ({}:{})\n", place.source.name, place.line_column()[0]),
        (None, Some(role)) => format!(" (follows from bought.{role})\n"),
        (None, None) => "\n".into(),
    };
    text += format!("  bounds   {} to {} {unit}", p.min, p.max).trim_end();
    let drives: Vec<&str> = p.drives.iter().map(|part| part.slug()).collect();
    let shapes = if drives.is_empty() { "the shape of no printed part".into() } else { drives.join(", ") };
    text + &format!("\n  drives   {shapes}\n")
}

fn table(p: &Parameter, responses: &[Response]) -> String {
    let mut text = format!("{:<20} {:<4}", "", p.unit());
    responses.iter().for_each(|response| text += &format!(" {:>12}", round(response.value)));
    text.push('\n');
    for (at, measure) in MEASURES.iter().enumerate() {
        let of = |response: &Response| response.measures.as_ref().ok().and_then(|measures| measures[at]);
        let middle = responses.get(1).and_then(of);
        text += &format!("{:<20} {:<4}", measure.name, measure.unit);
        for (column, response) in responses.iter().enumerate() {
            let told = match (of(response), middle) {
                (Some(value), Some(middle)) if column != 1 => signed(value - middle, measure.places()),
                (value, _) => measure.told(value),
            };
            text += &format!(" {told:>12}");
        }
        text.push('\n');
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
    let told = crate::figures::decimals(change, places);
    if change > 0.0 && told.chars().any(|c| ('1'..='9').contains(&c)) { format!("+{told}") } else { told }
}

fn json(p: &Parameter, frame: &Frame, responses: &[Response]) -> serde_json::Value {
    let response = |response: &Response| match &response.measures {
        Ok(measures) => {
            let named: serde_json::Map<String, serde_json::Value> =
                MEASURES.iter().zip(measures).map(|(measure, value)| (measure.name.to_string(), serde_json::json!(value))).collect();
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
        "follows": follows::role_of(p.key),
        "responses": responses.iter().map(response).collect::<Vec<_>>(),
        "peak": PEAK_CAVEAT,
    })
}
