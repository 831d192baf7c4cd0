//! What frame files state of parts, materials and printers, and of their extras, where it differs.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;
use serde_json::Value;

use super::changed::Changed;
use crate::figures::decimals;
use crate::params::frame::Extra;
use crate::params::{Frame, preset};

/// Ends of the keys that say where a figure comes from: another source is no other frame.
const SOURCE: &str = "source";
/// Decimals of a number in a list.
const PLACES: usize = 3;

/// Values by their path in a frame file.
type Stated = BTreeMap<String, Value>;

/// Values that differ of what is on both sides; of what one side has alone, those that its file states; and extras.
pub(super) fn changes(frames: [&Frame; 2]) -> Vec<Changed> {
    let entries = frames.map(entries);
    let shipped = if entries[0].keys().eq(entries[1].keys()) { Stated::new() } else { shipped() };
    let paths: BTreeSet<&String> = entries.iter().flat_map(BTreeMap::keys).collect();
    let of_path = |path: &String| {
        let sides = entries.each_ref().map(|side| side.get(path).map(fields));
        match sides {
            [Some(a), Some(b)] => differing(path, [a, b]),
            one_side => {
                let as_shipped = shipped.get(path).map(fields).unwrap_or_default();
                differing(path, one_side.map(|side| side.map_or(Stated::new(), |own| without(own, &as_shipped))))
            }
        }
    };
    let mut changes: Vec<Changed> = paths.into_iter().flat_map(of_path).collect();
    changes.extend(differing("extras", frames.map(extras)));
    changes
}

/// What a frame takes from the catalogue, by the table in which a file states other values of it.
fn entries(frame: &Frame) -> Stated {
    let parts = frame.bought.values().map(|item| (path("parts", &item.name), value(&item.part)));
    let materials = [&frame.flexible, &frame.rigid, &frame.rod_material];
    let materials = materials.map(|named| (path("materials", &named.name), value(&named.material)));
    let printer = (path("printers", &frame.printer_name), value(&frame.printer));
    parts.chain(materials).chain([printer]).collect()
}

/// The same of all that the catalogues hold.
fn shipped() -> Stated {
    let parts = preset::bought_parts().into_iter().map(|(name, part)| (path("parts", &name), value(&part)));
    let materials = preset::materials().into_iter().map(|(name, material)| (path("materials", &name), value(&material)));
    let printers = preset::printers().into_iter().map(|(name, printer)| (path("printers", &name), value(&printer)));
    parts.chain(materials).chain(printers).collect()
}

/// The table of an entry in a frame file; a name with a dot stands in quotes there.
fn path(catalogue: &str, name: &str) -> String {
    let is_bare = name.chars().all(|letter| letter.is_ascii_alphanumeric() || matches!(letter, '-' | '_'));
    let name = if is_bare { name.into() } else { Value::from(name).to_string() };
    format!("override.{catalogue}.{name}")
}

/// The values that are none of these.
fn without(mut own: Stated, of: &Stated) -> Stated {
    own.retain(|key, value| of.get(key) != Some(value));
    own
}

/// Mass, position and covered roles of each extra, by its name and the key.
fn extras(frame: &Frame) -> Stated {
    let stated = |(name, extra): (&String, &Extra)| {
        [("mass_g", value(&extra.mass_g)), ("position_mm", value(&extra.position_mm)), ("covers", value(&extra.covers))]
            .map(|(key, value)| (format!("{name}.{key}"), value))
            .into_iter()
            .filter(|(_, value)| !value.is_null())
    };
    frame.extras.iter().flat_map(stated).collect()
}

fn value<T: Serialize + ?Sized>(of: &T) -> Value {
    serde_json::to_value(of).unwrap_or_default()
}

fn fields(entry: &Value) -> Stated {
    let fields = entry.as_object().into_iter().flatten();
    fields.filter(|(key, value)| !key.ends_with(SOURCE) && !value.is_null()).map(|(key, value)| (key.clone(), value.clone())).collect()
}

fn differing(path: &str, sides: [Stated; 2]) -> Vec<Changed> {
    let keys: BTreeSet<&String> = sides.iter().flat_map(BTreeMap::keys).collect();
    let change = |key: &String| {
        let values = sides.each_ref().map(|side| side.get(key));
        (values[0] != values[1]).then(|| changed(format!("{path}.{key}"), values))
    };
    keys.into_iter().filter_map(change).collect()
}

fn changed(name: String, values: [Option<&Value>; 2]) -> Changed {
    if values.iter().flatten().all(|value| value.is_number()) {
        return Changed::numbers(name, "", values.map(|value| value.and_then(Value::as_f64)), 2);
    }
    Changed::words(name, values.map(|value| value.map_or(String::new(), words)))
}

/// A value as a frame file has it.
fn words(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Number(number) => number.as_f64().map_or(number.to_string(), |number| decimals(number, PLACES)),
        Value::Array(values) => format!("[{}]", values.iter().map(words).collect::<Vec<_>>().join(", ")),
        _ => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::FrameFile;

    fn frame(text: &str) -> Frame {
        Frame::resolve(&FrameFile::parse("planted.toml", &format!("base = \"cognifly\"\n{text}")).expect("is TOML")).expect("is a frame")
    }

    fn reported(a: &str, b: &str) -> Vec<(String, [String; 2])> {
        changes([&frame(a), &frame(b)]).into_iter().map(|change| (change.name, change.reported)).collect()
    }

    fn line(name: &str, reported: [&str; 2]) -> (String, [String; 2]) {
        (name.into(), reported.map(String::from))
    }

    #[test]
    fn planted_values_of_one_name_and_moved_extras_are_told() {
        let heavier = "override.materials.tpu-95a.density_g_cm3 = 1.3\n";
        assert_eq!(reported("", heavier), [line("override.materials.tpu-95a.density_g_cm3", ["1.22", "1.30"])]);
        let extra = |y: &str| {
            format!("[extras.lamp]\nmass_g = 2.0\nmass_basis = \"estimate\"\nsource = \"a guess\"\nposition_mm = [0.0, {y}, 0.0]\n")
        };
        assert_eq!(
            reported(&extra("10.0"), &extra("40.0")),
            [line("extras.lamp.position_mm", ["[0.000, 10.000, 0.000]", "[0.000, 40.000, 0.000]"])]
        );
        assert_eq!(reported("", &extra("10.0"))[1], line("extras.lamp.mass_g", ["", "2.00"]));
    }

    #[test]
    fn planted_values_of_what_one_side_has_alone_are_told() {
        let own = "printer = \"ender-3\"\n[override.printers.ender-3]\nhole_undersize_mm = 0.3\n";
        assert_eq!(reported("", own), [line("override.printers.ender-3.hole_undersize_mm", ["", "0.30"])]);
        let dotted = "[override.printers.\"generic-0.4\"]\nhole_undersize_mm = 0.15\n";
        assert_eq!(reported(dotted, own)[0], line("override.printers.\"generic-0.4\".hole_undersize_mm", ["0.15", ""]));
    }

    #[test]
    fn analytic_another_source_or_another_name_is_no_other_value() {
        assert_eq!(reported("", "override.materials.tpu-95a.source = \"another table\"\n"), []);
        assert_eq!(reported("", "materials.flexible = \"tpu-85a\"\n"), []);
        assert_eq!(reported("", "printer = \"prusa-mini\"\n"), []);
        assert_eq!(reported("", ""), []);
    }
}
