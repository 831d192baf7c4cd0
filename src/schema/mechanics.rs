//! The schema of the numbers of the frame's mechanics.

use serde_json::{Map, Value, json};

use super::element::{closed, number, put};
use crate::mechanics::settings::{KEYS, Key, TENSILE};

pub(super) fn schema() -> Value {
    let mut root = Map::new();
    let mut required: Vec<&str> = Vec::new();
    for Key { name, bounds, unit, .. } in &KEYS {
        put(&mut root, name, number("", unit, *bounds, None));
        let (table, key) = name.split_once('.').unwrap_or(("", name));
        match root[table]["required"].as_array_mut() {
            Some(keys) => keys.push(key.into()),
            None => {
                root[table]["required"] = json!([key]);
                required.push(table);
            }
        }
    }
    let (name, bounds, unit) = TENSILE;
    put(&mut root, name, number("Of the data sheet of that material; it may be missing.", unit, bounds, None));
    closed(root, &required)
}
