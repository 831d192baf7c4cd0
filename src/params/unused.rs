//! What a frame file describes and does not choose: a part is described in one place and chosen in another.

use std::collections::BTreeSet;

use super::frame::Frame;
use super::frame_file::{FrameFile, Value};
use super::roles::ROLES;

/// Tables of own entries, and what one of each is called.
const TABLES: [(&str, &str); 3] = [("parts", "part"), ("printers", "printer"), ("materials", "material")];

/// How an entry of a table is chosen; a part under the first role of its kind.
fn choice(file: &FrameFile, table: &str, name: &str) -> String {
    let (under, key) = match table {
        "printers" => return format!("write printer = \"{name}\""),
        "materials" => ("[materials]", Some("rigid")),
        _ => {
            let kind = file.entries.get(&format!("override.parts.{name}.kind")).map(|entry| &entry.value);
            let fits = |of_kind: &str| matches!(kind, Some(Value::Text(kind)) if kind == of_kind);
            ("[bought]", ROLES.iter().find(|(.., of_kind)| fits(of_kind)).map(|(role, ..)| *role))
        }
    };
    format!("name it under {under}{}", key.map_or_else(String::new, |key| format!(", such as {key} = \"{name}\"")))
}

/// A sentence for each part, printer and material that the frame file itself describes and nothing of the frame is, by name.
pub fn unused(file: &FrameFile, frame: &Frame) -> Vec<String> {
    let parts = frame.bought.values().map(|item| item.name.as_str());
    let rods = frame.bought.values().filter_map(|item| item.part.material.as_deref());
    let chosen: [BTreeSet<&str>; 3] = [
        parts.collect(),
        BTreeSet::from([frame.printer_name.as_str()]),
        [frame.flexible.name.as_str(), frame.rigid.name.as_str()].into_iter().chain(rods).collect(),
    ];
    let mut told = Vec::new();
    for ((table, what), chosen) in TABLES.into_iter().zip(&chosen) {
        let own = format!("override.{table}.");
        let of_file = file.entries.iter().filter(|(_, entry)| entry.depth == 0);
        // A name may have dots in it, a field's name has none.
        let names: BTreeSet<&str> = of_file.filter_map(|(key, _)| Some(key.strip_prefix(&own)?.rsplit_once('.')?.0)).collect();
        let unused = names.into_iter().filter(|name| !chosen.contains(name));
        let words = |name| {
            format!("the {what} {name} is described in {}, and nothing of the frame is one: {}", file.name, choice(file, table, name))
        };
        told.extend(unused.map(words));
    }
    told
}

#[cfg(test)]
mod tests {
    use super::super::files::Memory;
    use super::*;

    #[test]
    fn planted_what_is_described_and_not_chosen_is_told() {
        let pack = "[override.parts.my-pack]\nkind = \"battery\"\nsize_mm = [58.0, 31.0, 16.0]\nmass_g = 49.0\nmass_basis = \"measured\"\nsource = \"scale\"\n";
        let told = |more: &str| {
            let text = format!("base = \"cognifly\"\n{more}{pack}[override.printers.ender-3]\nnozzle_mm = 0.6\n");
            let files = Memory([("a.toml".into(), text.into_bytes())].into_iter().collect());
            let file = FrameFile::load_from("a.toml", &files).expect("reads");
            let frame = Frame::resolve(&file).expect("resolves");
            unused(&file, &frame)
        };
        let found = told("");
        assert!(
            found.len() == 2
                && found[0].contains("the part my-pack")
                && found[0].ends_with("[bought], such as battery = \"my-pack\"")
                && found[1].contains("the printer ender-3"),
            "{found:?}"
        );
        assert_eq!(told("printer = \"ender-3\"\nbought.battery = \"my-pack\"\n"), Vec::<String>::new());
    }
}
