//! The elements that the schemas are put together from.

use serde_json::{Value, json};

/// A table with these keys and no others.
pub(super) fn table(description: &str, properties: serde_json::Map<String, Value>) -> Value {
    json!({ "type": "object", "description": description, "additionalProperties": false, "properties": properties })
}

/// A file with these keys and no others.
pub(super) fn closed(keys: serde_json::Map<String, Value>, required: &[&str]) -> Value {
    json!({ "type": "object", "additionalProperties": false, "required": required, "properties": keys })
}

/// A number within bounds.
pub(super) fn number(description: &str, unit: &str, [min, max]: [f64; 2], example: Option<f64>) -> Value {
    let unit = if unit.is_empty() || unit == "1" { String::new() } else { format!(" Unit: {unit}.") };
    let description = format!("{}{unit} {min} to {max}.", description.trim());
    let mut schema = json!({ "type": "number", "description": description.trim(), "minimum": min, "maximum": max });
    if let Some(example) = example.map(|example| (example * 1e6).round() / 1e6) {
        schema["examples"] = json!([example]);
    }
    schema
}

/// Puts a value at a dotted key, with the tables on the way.
pub(super) fn put(root: &mut serde_json::Map<String, Value>, key: &str, value: Value) {
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
