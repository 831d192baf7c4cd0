//! Frames that come with the program, and the catalogues that they choose from.

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;

use super::carried::is_carried;
use super::catalogue::{BoughtPart, Material, Printer};
use super::roles::ROLES;
use super::sleeve_direction::SleeveDirection;

/// Name and text of each preset; the first is the default.
const PRESETS: [(&str, &str); 6] = [
    ("cognifly", include_str!("../../params/frames/cognifly.toml")),
    ("cognifly-v8", include_str!("../../params/frames/cognifly-v8.toml")),
    ("cognifly-1106", include_str!("../../params/frames/cognifly-1106.toml")),
    ("cognifly-bamboo", include_str!("../../params/frames/cognifly-bamboo.toml")),
    ("cognifly-mini", include_str!("../../params/frames/cognifly-mini.toml")),
    ("cognifly-2s2000", include_str!("../../params/frames/cognifly-2s2000.toml")),
];

/// Bought parts that come with the program.
pub(super) const BOUGHT: &str = include_str!("../../params/bought.toml");

/// Materials that come with the program.
pub(super) const MATERIALS: &str = include_str!("../../params/materials.toml");

/// Name and text of each printer.
pub(super) const PRINTERS: [(&str, &str); 8] = [
    ("generic-0.4", include_str!("../../params/printers/generic-0.4.toml")),
    ("prusa-mk4", include_str!("../../params/printers/prusa-mk4.toml")),
    ("prusa-mini", include_str!("../../params/printers/prusa-mini.toml")),
    ("bambu-a1-mini", include_str!("../../params/printers/bambu-a1-mini.toml")),
    ("bambu-p1s", include_str!("../../params/printers/bambu-p1s.toml")),
    ("ender-3", include_str!("../../params/printers/ender-3.toml")),
    ("ultimaker-2-plus", include_str!("../../params/printers/ultimaker-2-plus.toml")),
    ("flsun-qqs-pro", include_str!("../../params/printers/flsun-qqs-pro.toml")),
];

/// Numbers of the frame's mechanics that come with the program.
pub(super) const MECHANICS: &str = include_str!("../../params/mechanics.toml");

/// Name and text of each impact model; the first is the default.
pub(super) const IMPACTS: [(&str, &str); 2] = [
    ("paper", include_str!("../../params/impact/paper.toml")),
    ("paper-corrected", include_str!("../../params/impact/paper-corrected.toml")),
];

/// The presets' names, the default first.
pub fn names() -> impl Iterator<Item = &'static str> {
    PRESETS.iter().map(|(name, _)| *name)
}

/// The text of a preset.
pub fn text(name: &str) -> Option<&'static str> {
    PRESETS.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// What a preset says of itself; empty when it says nothing.
pub fn description(name: &str) -> String {
    let file = text(name).and_then(|text| text.parse::<toml::Table>().ok());
    file.and_then(|file| file.get("description")?.as_str().map(String::from)).unwrap_or_default()
}

/// The names of the catalogues that a key of a frame file can have: a printer, a material, a bought part, or a direction of the sleeve. Empty for any other key.
pub fn names_for(key: &str) -> Vec<String> {
    let of_kind = |text: &str, table: &str, kind: &str| -> Vec<String> {
        let all: toml::Table = toml::from_str(text).unwrap_or_default();
        let entries = all.get(table).and_then(toml::Value::as_table).into_iter().flatten();
        let fits = |entry: &toml::Value| entry.get("kind").and_then(toml::Value::as_str) == Some(kind);
        entries.filter(|(_, entry)| fits(entry)).map(|(name, _)| name.clone()).collect()
    };
    match key.split_once('.') {
        None if key == "printer" => printer_names().map(String::from).collect(),
        Some(_) if key == SleeveDirection::KEY => SleeveDirection::WORDS.map(String::from).into(),
        Some(("materials", _)) => of_kind(MATERIALS, "materials", "printed"),
        Some(("bought", role)) => names_in(role),
        _ => Vec::new(),
    }
}

/// The printers' names.
pub fn printer_names() -> impl Iterator<Item = &'static str> {
    PRINTERS.iter().map(|(name, _)| *name)
}

/// The names of the materials of a kind: `printed` or `rod`.
pub fn material_names(kind: &str) -> Vec<String> {
    names_of(MATERIALS, "materials", kind)
}

/// The names of the bought parts of a kind.
pub fn part_names(kind: &str) -> Vec<String> {
    names_of(BOUGHT, "parts", kind)
}

/// The names of the bought parts that a frame can carry in a role.
pub fn names_in(role: &str) -> Vec<String> {
    let kind = ROLES.iter().find(|(known, ..)| *known == role).map_or("", |(.., kind)| *kind);
    let carried = |(name, part): (String, BoughtPart)| (part.kind == kind && is_carried(role, &part)).then_some(name);
    bought_parts().into_iter().filter_map(carried).collect()
}

/// The bought parts that come with the program, by name.
pub fn bought_parts() -> BTreeMap<String, BoughtPart> {
    entries(BOUGHT, "parts")
}

/// The materials that come with the program, by name.
pub fn materials() -> BTreeMap<String, Material> {
    entries(MATERIALS, "materials")
}

/// The printers that come with the program, by name.
pub fn printers() -> BTreeMap<String, Printer> {
    PRINTERS.iter().filter_map(|(name, text)| Some(((*name).to_string(), toml::from_str(text).ok()?))).collect()
}

/// The entries of a catalogue's table. A test reads them all, so that none is left out for being no entry.
fn entries<T: DeserializeOwned>(catalogue: &str, table: &str) -> BTreeMap<String, T> {
    let all: BTreeMap<String, BTreeMap<String, T>> = toml::from_str(catalogue).unwrap_or_default();
    all.into_iter().find(|(name, _)| name == table).map(|(_, entries)| entries).unwrap_or_default()
}

fn names_of(catalogue: &str, table: &str, kind: &str) -> Vec<String> {
    let all: toml::Table = toml::from_str(catalogue).unwrap_or_default();
    let entries = all.get(table).and_then(toml::Value::as_table).cloned().unwrap_or_default();
    let of_kind = |entry: &toml::Value| entry.get("kind").and_then(toml::Value::as_str) == Some(kind);
    entries.iter().filter(|(_, entry)| of_kind(entry)).map(|(name, _)| name.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_every_entry_of_the_catalogues_reads() {
        let listed =
            |text: &str, table: &str| toml::from_str::<toml::Table>(text).expect("is TOML")[table].as_table().expect("a table").len();
        assert_eq!(bought_parts().len(), listed(BOUGHT, "parts"));
        assert_eq!(materials().len(), listed(MATERIALS, "materials"));
        assert_eq!(printers().len(), PRINTERS.len());
    }

    #[test]
    fn analytic_the_choices_of_a_key_are_of_its_kind() {
        let motors = names_for("bought.motor");
        assert!(!motors.is_empty() && motors.len() < bought_parts().len());
        let kinds: toml::Table = toml::from_str(BOUGHT).expect("is TOML");
        assert!(motors.iter().all(|name| kinds["parts"][name]["kind"].as_str() == Some("motor")), "{motors:?}");
        assert_eq!(names_for("bought.tail"), Vec::<String>::new());
        assert_eq!(names_for("materials.flexible"), material_names("printed"));
        assert!(names_for("printer").iter().eq(printer_names()));
    }
}
