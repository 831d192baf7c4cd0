//! The schema of a frame file.

use serde_json::{Map, Value, json};

use super::catalogue;
use super::element::{number, put, table};
use crate::params::roles::ROLES;
use crate::params::sleeve_direction::SleeveDirection;
use crate::params::target::{self, TargetKey};
use crate::params::{Frame, FrameFile, follows, parameters, preset};

pub(super) fn schema() -> Value {
    let mut root = Map::new();
    root.insert(
        "base".into(),
        json!({
            "type": "string",
            "description": "The frame that this one differs from: a file beside it, or a preset.",
            "examples": preset::names().collect::<Vec<_>>(),
        }),
    );
    root.insert("schema".into(), json!({ "const": 1, "description": "Version of the file's form." }));
    let name = json!({ "type": "string", "pattern": "^[A-Za-z0-9_-][A-Za-z0-9._-]*$", "description": "The folder in out/; without it, the file's own name." });
    root.insert("name".into(), name);
    root.insert("description".into(), json!({ "type": "string", "description": "One line for the report." }));
    let printers = preset::printer_names().collect::<Vec<_>>();
    root.insert("printer".into(), json!({ "type": "string", "description": "A printer of params/printers, or one described below [override.printers].", "examples": printers }));
    numbers(&mut root);
    put(&mut root, SleeveDirection::KEY, json!({ "enum": SleeveDirection::WORDS, "description": SleeveDirection::DOC }));
    root.insert("materials".into(), materials());
    root.insert("bought".into(), bought());
    root.insert("target".into(), target());
    root.insert("extras".into(), extras());
    root.insert("override".into(), overrides());
    json!({ "type": "object", "additionalProperties": false, "properties": root })
}

/// The tables of numbers.
fn numbers(root: &mut Map<String, Value>) {
    let default = Frame::load("cognifly").ok().map(|(frame, _)| frame);
    for p in parameters() {
        let value = default.as_ref().and_then(|frame| frame.value(p.table, p.key));
        let drives: Vec<&str> = p.drives.iter().map(|part| part.slug()).collect();
        let mut text = p.doc.trim().to_string();
        if !drives.is_empty() {
            text += &format!(" Drives {}.", drives.join(", "));
        }
        if let Some(followed) = follows::followed_key(p.key) {
            text += &format!(" Follows from {followed} unless stated.");
        }
        put(root, &format!("{}.{}", p.table, p.key), number(&text, p.unit(), [p.min, p.max], value));
        root[p.table]["description"] = p.table_doc.trim().into();
    }
}

fn materials() -> Value {
    let mut keys = Map::new();
    for (key, what) in [("flexible", "Material of the joints"), ("rigid", "Material of the centre")] {
        let names = preset::material_names("printed");
        keys.insert(key.into(), json!({ "type": "string", "description": format!("{what}: a name of params/materials.toml, or of [override.materials]."), "examples": names }));
    }
    table("Materials of the printed parts.", keys)
}

fn bought() -> Value {
    let mut roles = Map::new();
    for (role, quantity, kind) in ROLES {
        let names = preset::names_in(role);
        let text = format!("{quantity} {kind}: a name of params/bought.toml or of [override.parts], or \"none\".");
        roles.insert(role.into(), json!({ "type": "string", "description": text, "examples": names }));
    }
    table("What is bought, by role.", roles)
}

fn target() -> Value {
    let mut keys = Map::new();
    for TargetKey { key, min, max, unit, doc } in target::KEYS {
        keys.insert(key.trim_start_matches("target.").into(), number(doc, unit, [min, max], None));
    }
    let mut target = table("A size that the rod lengths are solved for, instead of the lengths.", keys);
    // What is missing may stand in a base, so nothing is required.
    target["minProperties"] = 1.into();
    target
}

/// Extras of presets may be stated in part: the rest stands in the base. Of an extra that only a base of the user's own has, the schema asks all.
fn extras() -> Value {
    let of_presets = preset::names().filter_map(|name| FrameFile::parse(name, preset::text(name)?).ok());
    let keys = of_presets.flat_map(|file| file.entries.into_keys());
    let names = keys.filter_map(|key| Some(key.strip_prefix("extras.")?.split('.').next()?.to_string()));
    let known: Map<String, Value> = names.map(|name| (name, catalogue::partial(catalogue::extra()))).collect();
    json!({
        "type": "object",
        "description": "Masses that no bought part stands for, each with a source.",
        "properties": known,
        "additionalProperties": catalogue::extra(),
    })
}

fn overrides() -> Value {
    let of = |what: &str, entry: Value| json!({ "type": "object", "description": what, "additionalProperties": catalogue::partial(entry) });
    let mut kinds = Map::new();
    kinds.insert("parts".into(), of("Changes of bought parts, or parts of your own.", catalogue::part()));
    kinds.insert("materials".into(), of("Changes of materials, or materials of your own.", catalogue::material()));
    kinds.insert("printers".into(), of("Changes of printers, or printers of your own.", catalogue::printer()));
    table("Figures of the catalogues that this frame sees differently.", kinds)
}
