//! Schemas of catalogue entries, from the structs that they are read into.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema};
use serde_json::{Value, json};

use crate::params::catalogue::{BoughtPart, Material, Printer};
use crate::params::figure::Figure;
use crate::params::frame::Extra;

fn of<T: JsonSchema>(figures: &[Figure]) -> Value {
    let settings = SchemaSettings::draft07().with(|settings| {
        settings.inline_subschemas = true;
        settings.meta_schema = None;
    });
    let schema: Schema = settings.into_generator().into_root_schema_for::<T>();
    let mut value = schema.to_value();
    if let Some(value) = value.as_object_mut() {
        value.remove("title");
    }
    for Figure { key, min, max, unit } in figures {
        let property = &mut value["properties"][key];
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        property["description"] = format!("{} {min} to {max}{unit}.", property["description"].as_str().unwrap_or_default()).into();
        let number = if property["items"].is_object() { &mut property["items"] } else { property };
        number["minimum"] = (*min).into();
        number["maximum"] = (*max).into();
    }
    value
}

pub(super) fn part() -> Value {
    of::<BoughtPart>(&BoughtPart::FIGURES)
}

pub(super) fn material() -> Value {
    of::<Material>(&Material::FIGURES)
}

pub(super) fn extra() -> Value {
    of::<Extra>(&Extra::FIGURES)
}

pub(super) fn printer() -> Value {
    of::<Printer>(&Printer::FIGURES)
}

/// An entry of which single figures may be stated: the rest stands in the catalogue.
pub(super) fn partial(mut entry: Value) -> Value {
    if let Some(entry) = entry.as_object_mut() {
        entry.remove("required");
    }
    entry
}

pub(super) fn bought() -> Value {
    all("parts", "Bought parts by name.", part())
}

pub(super) fn materials() -> Value {
    all("materials", "Materials by name.", material())
}

fn all(table: &str, what: &str, entry: Value) -> Value {
    json!({
        "type": "object",
        "additionalProperties": false,
        "required": [table],
        "properties": { table: { "type": "object", "description": what, "additionalProperties": entry } },
    })
}

pub(super) fn baseline() -> Value {
    let text = |what: &str| json!({ "type": "string", "description": what });
    json!({
        "type": "object",
        "additionalProperties": false,
        "required": ["schema_version", "accepted"],
        "properties": {
            "schema_version": { "const": 1 },
            "accepted": { "type": "array", "items": {
                "type": "object",
                "additionalProperties": false,
                "required": ["frame", "rule", "subject", "margin", "unit"],
                "properties": {
                    "frame": text("Name of the frame."),
                    "file": text("The file that describes it, from the list's folder, or the preset's name; without it the frame's name alone counts."),
                    "rule": text("The rule."),
                    "subject": text("What it looked at."),
                    "margin": { "type": "number", "description": "How far beyond its limit it was; worse fails." },
                    "unit": text("Unit of the margin."),
                },
            } },
        },
    })
}
