//! Frames that come with the program.

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

fn names_of(catalogue: &str, table: &str, kind: &str) -> Vec<String> {
    let all: toml::Table = toml::from_str(catalogue).unwrap_or_default();
    let entries = all.get(table).and_then(toml::Value::as_table).cloned().unwrap_or_default();
    let of_kind = |entry: &toml::Value| entry.get("kind").and_then(toml::Value::as_str) == Some(kind);
    entries.iter().filter(|(_, entry)| of_kind(entry)).map(|(name, _)| name.clone()).collect()
}
