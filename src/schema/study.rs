//! The schema of plans of studies.

use serde_json::{Map, Value, json};

use super::element::{closed, number, put, table};
use crate::params::parameters;
use crate::params::roles::ROLES;
use crate::study::recovery::plan_keys;
use crate::study::{KEYS, KINDS, PlanKey, Takes};

/// One schema for both kinds: which keys a plan may have depends on its `kind`.
pub(super) fn schema() -> Value {
    let [mut frames, mut recovery] = [Map::new(), Map::new()];
    KEYS.iter().for_each(|key| put(&mut frames, key.key, taken(key)));
    frames.insert("vary".into(), ranges());
    frames.insert("choose".into(), choices());
    plan_keys().for_each(|key| put(&mut recovery, key.key, taken(&key)));
    let kinds = [of_kind(&recovery, &["seeds"]), of_kind(&frames, &[])];
    let mut all = frames;
    for (key, takes) in recovery {
        let is_same = all.get(&key).is_none_or(|other| *other == takes);
        all.insert(key, if is_same { takes } else { json!({}) });
    }
    let mut schema = closed(all, &[]);
    schema["if"] = json!({ "required": ["kind"], "properties": { "kind": { "const": KINDS[1] } } });
    let [then, otherwise] = kinds;
    schema["then"] = then;
    schema["else"] = otherwise;
    schema
}

/// What one kind of plan asks beside what all keys take: its own keys alone, and its own columns.
fn of_kind(keys: &Map<String, Value>, required: &[&str]) -> Value {
    let names: Vec<&String> = keys.keys().collect();
    json!({ "required": required, "propertyNames": { "enum": names }, "properties": { "measures": keys["measures"] } })
}

fn taken(PlanKey { takes, doc, .. }: &PlanKey) -> Value {
    let whole = |bounds: [f64; 2]| {
        let mut whole = number("", "1", bounds, None);
        whole["type"] = "integer".into();
        whole
    };
    let list = |items: Value| json!({ "type": "array", "minItems": 1, "items": items, "description": doc });
    let each_once = |items: Value| {
        let mut list = list(items);
        list["uniqueItems"] = true.into();
        list
    };
    match takes {
        Takes::Text => json!({ "type": "string", "description": doc }),
        Takes::Word(words) => json!({ "enum": words, "description": doc }),
        Takes::Whole(bounds) => {
            let mut schema = whole(*bounds);
            schema["description"] = format!("{doc} {} to {}.", bounds[0], bounds[1]).into();
            schema
        }
        Takes::Number(bounds, unit) => number(doc, unit, *bounds, None),
        Takes::Numbers(bounds, unit) => each_once(number("", unit, *bounds, None)),
        Takes::Wholes(bounds) => each_once(whole(*bounds)),
        Takes::Names(names) => list(json!({ "enum": names() })),
        Takes::Seeds(bounds) => {
            let mut range = list(whole(*bounds));
            range["minItems"] = 2.into();
            range["maxItems"] = 2.into();
            range
        }
    }
}

/// What varies: a parameter with its table, or by a name as `flexframe params` takes it.
fn ranges() -> Value {
    let mut tables = Map::new();
    for p in parameters() {
        put(&mut tables, &format!("{}.{}", p.table, p.key), range(number(p.doc, p.unit(), [p.min, p.max], None)));
        // Within a table, too, a key may be shortened.
        tables[p.table]["additionalProperties"] = range(json!({ "type": "number" }));
    }
    let mut ranges = table("Numbers that vary, and their ranges.", tables);
    ranges["additionalProperties"] = range(json!({ "type": "number" }));
    ranges
}

/// Least and most of a number.
fn range(of: Value) -> Value {
    json!({ "type": "array", "minItems": 2, "maxItems": 2, "items": of })
}

/// What names vary: any key of a frame file that takes a name.
fn choices() -> Value {
    let names = json!({ "type": "array", "minItems": 1, "uniqueItems": true, "items": { "type": "string" } });
    let mut tables = Map::new();
    ROLES.iter().for_each(|(role, ..)| put(&mut tables, &format!("bought.{role}"), names.clone()));
    ["flexible", "rigid"].iter().for_each(|role| put(&mut tables, &format!("materials.{role}"), names.clone()));
    let mut choices = table("Names that vary: of bought parts, of materials, of the printer.", tables);
    choices["additionalProperties"] = json!({ "anyOf": [names, { "type": "object" }] });
    choices
}
