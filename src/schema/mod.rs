//! JSON Schemas (draft 7) of every kind of file that is read, made from the tables that the readers go by: editors that know
//! `#:schema` complete and check with them. They say what each key is; what keys may not be together only the program knows.

mod catalogue;
mod frame;
mod model;

use serde_json::{Value, json};

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A frame.
    Frame,
    /// An impact model.
    Model,
    /// A plan of synthetic drops.
    Plan,
    /// The form of `params/bought.toml`.
    Bought,
    /// The form of `params/materials.toml`.
    Materials,
    /// A printer.
    Printer,
    /// A list of accepted findings.
    Baseline,
}

/// The schema of a kind of file.
pub fn schema(kind: FileKind) -> Value {
    let (title, body) = match kind {
        FileKind::Frame => ("frame of flexframe", frame::schema()),
        FileKind::Model => ("impact model of flexframe", model::schema()),
        FileKind::Plan => ("plan of synthetic drops of flexframe", model::plan()),
        FileKind::Bought => ("bought parts of flexframe", catalogue::bought()),
        FileKind::Materials => ("materials of flexframe", catalogue::materials()),
        FileKind::Printer => ("printer of flexframe", catalogue::printer()),
        FileKind::Baseline => ("accepted findings of flexframe", catalogue::baseline()),
    };
    let mut schema = json!({ "$schema": "http://json-schema.org/draft-07/schema#", "title": title });
    if let (Some(schema), Value::Object(body)) = (schema.as_object_mut(), body) {
        schema.extend(body);
    }
    schema
}

/// A table with these keys and no others.
fn table(description: &str, properties: serde_json::Map<String, Value>) -> Value {
    json!({ "type": "object", "description": description, "additionalProperties": false, "properties": properties })
}

/// A number within bounds.
fn number(description: &str, unit: &str, [min, max]: [f64; 2], example: Option<f64>) -> Value {
    let unit = if unit.is_empty() || unit == "1" { String::new() } else { format!(" Unit: {unit}.") };
    let description = format!("{}{unit} {min} to {max}.", description.trim());
    let mut schema = json!({ "type": "number", "description": description.trim(), "minimum": min, "maximum": max });
    if let Some(example) = example.map(|example| (example * 1e6).round() / 1e6) {
        schema["examples"] = json!([example]);
    }
    schema
}

/// Puts a value at a dotted key, with the tables on the way.
fn put(root: &mut serde_json::Map<String, Value>, key: &str, value: Value) {
    match key.split_once('.') {
        None => drop(root.insert(key.into(), value)),
        Some((head, rest)) => {
            let inner = root.entry(head).or_insert_with(|| table("", serde_json::Map::new()));
            if let Some(properties) = inner["properties"].as_object_mut() {
                put(properties, rest, value);
            }
        }
    }
}
