//! A table of samples: rows that a study takes as they are.

use std::collections::BTreeSet;

use super::axis::{Axis, Input, twice};
use super::frame_key::{can_vary, refused_name};
use super::plan_keys::impossible;
use crate::params::frame_file::Value;
use crate::params::lookup::known;
use crate::params::refusal::{Reason, Refusal};
use crate::params::{Frame, FrameFile, ImpactFile};

/// Most columns: each is looked up among the keys of a frame.
const MOST_COLUMNS: usize = 1000;

/// The axes and rows of a table of samples that a plan names: a head of keys, then numbers and names. Whether they make frames is not looked at.
///
/// # Errors
/// When the table is none, a key is none of a frame's or follows from the base's target size, or the plan, which names it, lets something vary
/// beside it.
pub fn samples(
    file: &ImpactFile,
    name: &str,
    text: &str,
    base: &FrameFile,
    frame: &Frame,
) -> Result<(Vec<Axis>, Vec<Vec<Input>>), Refusal> {
    let refuse = |message: String| {
        file.refuse("table", impossible(format!("{name}: {message}"), "a head of keys, then a row a frame, with commas between".into()))
    };
    if file.entries.keys().any(|key| key.starts_with("vary.") || key.starts_with("choose.")) {
        return Err(refuse("with a table, its columns vary, and nothing else".into()));
    }
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let head = reader.headers().map_err(|error| refuse(error.to_string()))?.clone();
    if head.len() > MOST_COLUMNS {
        return Err(refuse(format!("the table has {} columns, more than {MOST_COLUMNS}", head.len())));
    }
    let records = reader.records().map(|record| record.map_err(|error| refuse(error.to_string()))).collect::<Result<Vec<_>, _>>()?;
    let first = |at: usize| records.first().and_then(|record| record.get(at)).unwrap_or_default();
    let mut axes =
        head.iter().enumerate().map(|(at, key)| axis(file, key, first(at), base, frame)).collect::<Result<Vec<Axis>, Refusal>>()?;
    if let Some(axis) = twice(&axes) {
        return Err(refuse(format!("`{}` has two columns", axis.key())));
    }
    let mut known: Vec<BTreeSet<String>> = vec![BTreeSet::new(); axes.len()];
    let mut rows = Vec::new();
    for (at, record) in records.iter().enumerate() {
        let mut row = Vec::new();
        for ((axis, known), field) in axes.iter_mut().zip(&mut known).zip(record) {
            row.push(match axis {
                Axis::Name { names, .. } => {
                    if known.insert(field.into()) {
                        names.push(field.into());
                    }
                    Input::Name(field.into())
                }
                Axis::Number(_) | Axis::Listed(_) | Axis::Stated(_) => {
                    let number = field.parse::<f64>().ok().filter(|value| value.is_finite());
                    let none = || refuse(format!("row {at}, as `study.csv` counts: {field:?} is no number for {}", axis.key()));
                    Input::Number(number.ok_or_else(none)?)
                }
            });
        }
        rows.push(row);
    }
    if rows.is_empty() || axes.is_empty() {
        return Err(refuse("the table has no rows".into()));
    }
    Ok((axes, rows))
}

/// A column: a parameter, another number of a frame, or names.
fn axis(file: &ImpactFile, key: &str, first: &str, base: &FrameFile, frame: &Frame) -> Result<Axis, Refusal> {
    if let Some(parameter) = known(key) {
        can_vary(file, "table", parameter, frame)?;
        return Ok(Axis::Listed(parameter));
    }
    let reason = |value: Value| refused_name(base, key, value, format!("the column {key} of the table"));
    match reason(Value::Text(first.into())) {
        Some(unknown @ Reason::UnknownKey { .. }) => Err(file.refuse("table", unknown)),
        Some(Reason::WrongType { .. }) if !matches!(reason(Value::Number(1.0)), Some(Reason::WrongType { .. })) => {
            Ok(Axis::Stated(key.into()))
        }
        _ => Ok(Axis::Name { key: key.into(), names: Vec::new() }),
    }
}
