//! `flexframe params`: every parameter of a frame.

use std::process::ExitCode;

use serde::Serialize;

use super::arguments::{Common, ParamsOptions};
use super::session::{self, Failure};
use crate::params::frame_file::{FrameFile, Value};
use crate::params::{Frame, parameters};

/// A parameter as listed.
#[derive(Serialize)]
struct Row {
    key: String,
    unit: &'static str,
    value: Option<f64>,
    default: Option<f64>,
    min: f64,
    max: f64,
    drives: Vec<&'static str>,
    doc: &'static str,
}

/// Lists the parameters; a value that the frame file does not state follows from a bought part.
pub(super) fn list(options: &ParamsOptions, common: &Common) -> Result<ExitCode, Failure> {
    let (_, file) = session::load(&options.frame)?;
    let (_, default) = Frame::load("cognifly")?;
    let stated = |file: &FrameFile, key: &str| match file.entries.get(key).map(|entry| &entry.value) {
        Some(Value::Number(number)) => Some(*number),
        _ => None,
    };
    let rows: Vec<Row> = parameters()
        .map(|p| {
            let key = format!("{}.{}", p.table, p.key);
            Row {
                unit: p.unit(),
                value: stated(&file, &key),
                default: stated(&default, &key),
                min: p.min,
                max: p.max,
                drives: p.drives.iter().map(|part| part.slug()).collect(),
                doc: p.doc.trim(),
                key,
            }
        })
        .filter(|row| options.filter.as_ref().is_none_or(|text| row.key.contains(text.as_str())))
        .collect();
    if common.json {
        let text = serde_json::to_string_pretty(&rows)
            .map_err(|error| Failure::Machine { what: "cannot print the parameters".into(), error: error.into() })?;
        println!("{text}");
        return Ok(ExitCode::SUCCESS);
    }
    println!("{:<48} {:>9} {:>9}  {:<18} what it is; what it drives", "key", "value", "default", "bounds");
    for row in &rows {
        let number = |value: Option<f64>| value.map_or("bought".into(), |value| format!("{value}"));
        let bounds = format!("{} to {} {}", row.min, row.max, row.unit);
        let drives = if row.drives.is_empty() { String::new() } else { format!(" [{}]", row.drives.join(", ")) };
        println!("{:<48} {:>9} {:>9}  {:<18} {}{}", row.key, number(row.value), number(row.default), bounds, row.doc, drives);
    }
    Ok(ExitCode::SUCCESS)
}
