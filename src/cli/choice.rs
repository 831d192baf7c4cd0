//! Keys of a frame file that hold a name instead of a number: what they choose, which names there are, what follows from them.

use super::failure::Failure;
use crate::params::frame_file::Value;
use crate::params::parameter::Parameter;
use crate::params::refusal::{Place, Reason, nearest};
use crate::params::roles::ROLES;
use crate::params::sleeve_direction::SleeveDirection;
use crate::params::{Frame, FrameFile, follows, parameters, preset};

/// Keys beside the roles of bought parts, each with what it is.
const KEYS: [(&str, &str); 5] = [
    ("base", "The frame that this one differs from: a file beside it, or a preset. What the file does not state is the base's."),
    ("printer", "The printer: its bed has to hold every part, its nozzle says how thin a wall may be."),
    ("materials.flexible", "Material of the joints; its density, and how far a hinge of it stretches."),
    ("materials.rigid", "Material of the rigid centre; its density."),
    (SleeveDirection::KEY, SleeveDirection::DOC),
];

/// A key that holds a name.
pub(super) struct Choice {
    /// The key.
    pub key: String,
    /// What it chooses.
    pub what: String,
    /// The name that holds, and where it was typed; none when no file states it.
    pub value: Option<(String, Place)>,
    /// The names there are, those of the frame file included.
    pub names: Vec<String>,
    /// Further names of the kind, of parts that the frame has nothing to carry with in this role.
    pub not_carried: Vec<String>,
    /// How else it may be chosen.
    pub or: Vec<String>,
    /// Whether it may be `none`.
    pub without: bool,
    /// The parameters that follow from it.
    pub sets: Vec<Followed>,
}

/// A parameter that follows from a choice.
pub(super) struct Followed {
    /// Its key with its table.
    pub key: String,
    /// Its value.
    pub value: Option<f64>,
    /// Its unit.
    pub unit: &'static str,
    /// Where a file states it; then it does not follow.
    pub stated: Option<Place>,
}

/// Whether a key holds a name.
pub(super) fn is_one(key: &str) -> bool {
    key_of(key).is_some() || role(key).is_some()
}

/// The choice by its key; none when the key is none of a name.
///
/// # Errors
/// When it is one of a table of names that has no such key.
pub(super) fn of(key: &str, frame: &Frame, file: &FrameFile) -> Result<Option<Choice>, Failure> {
    if let Some((known, what)) = key_of(key) {
        return Ok(Some(named(known, what, file)));
    }
    if let Some(role) = role(key) {
        return Ok(Some(bought(role, frame, file)));
    }
    if !["bought.", "materials."].iter().any(|table| key.starts_with(table)) {
        return Ok(None);
    }
    let known = keys();
    let meant = nearest(key, known.iter().map(String::as_str)).first().map_or(String::new(), |near| format!(", did you mean `{near}`?"));
    Err(Failure::Usage { message: format!("there is no key `{key}`{meant}; keys of names are {}", known.join(", ")) })
}

/// One of the keys beside the roles, with or without its table.
fn key_of(key: &str) -> Option<&'static (&'static str, &'static str)> {
    KEYS.iter().find(|(known, _)| *known == key || known.rsplit('.').next() == Some(key))
}

/// Every key that holds a name.
pub(super) fn keys() -> Vec<String> {
    KEYS.iter().map(|(key, _)| key.to_string()).chain(ROLES.iter().map(|(role, ..)| bought_key(role))).collect()
}

fn bought_key(role: &str) -> String {
    format!("bought.{role}")
}

/// The role of a bought part that a key chooses.
fn role(key: &str) -> Option<&'static str> {
    let role = key.strip_prefix("bought.")?;
    ROLES.iter().map(|(known, ..)| *known).find(|known| *known == role)
}

/// One of the keys beside the roles.
fn named(key: &str, what: &str, file: &FrameFile) -> Choice {
    let (names, own): (Vec<String>, _) = match key {
        "base" => (preset::names().map(String::from).collect(), Some("a file beside it, such as base = \"mine\" for mine.toml")),
        "printer" => {
            (with_own(preset::printer_names().map(String::from), file, "printers", None), Some("one described below [override.printers]"))
        }
        SleeveDirection::KEY => (SleeveDirection::WORDS.map(String::from).into(), None),
        _ => (
            with_own(preset::material_names("printed"), file, "materials", Some("printed")),
            Some("one described below [override.materials]"),
        ),
    };
    let value = if key == "base" { file.base.clone().map(|place| (typed(&place), place)) } else { stated(file, key) };
    Choice {
        key: key.into(),
        what: what.into(),
        value,
        names,
        not_carried: Vec::new(),
        or: own.into_iter().map(String::from).collect(),
        without: false,
        sets: Vec::new(),
    }
}

fn bought(role: &'static str, frame: &Frame, file: &FrameFile) -> Choice {
    let key = bought_key(role);
    let (quantity, kind) = ROLES.iter().find(|(known, ..)| *known == role).map_or((1, ""), |(_, quantity, kind)| (*quantity, *kind));
    let mut or = vec!["one described below [override.parts]".to_string()];
    // The reader knows best what a frame can be without, and what it carries.
    let with = |name: &str| {
        let mut chosen = file.clone();
        chosen.set(&key, Value::Text(name.into()));
        Frame::resolve(&chosen)
    };
    let without = with("none").is_ok();
    let (shipped, offered) = (preset::part_names(kind), preset::names_in(role));
    let is_carried = |name: &String| match with(name) {
        Ok(_) => true,
        // What is refused for another reason may go with another choice.
        Err(refusal) => !matches!(*refusal.reason, Reason::NotCarried { .. }) && (offered.contains(name) || !shipped.contains(name)),
    };
    let (names, not_carried) = with_own(shipped.clone(), file, "parts", Some(kind)).into_iter().partition(is_carried);
    if without {
        or.push("\"none\" for a frame without".into());
    }
    let followed = |p: &Parameter| {
        let key = format!("{}.{}", p.table, p.key);
        Followed { value: frame.value(p.table, p.key), unit: p.unit(), stated: file.entries.get(&key).map(|e| e.place.clone()), key }
    };
    Choice {
        what: format!("The {}: what is bought for it, {quantity} of the kind `{kind}`.", role.replace('_', " ")),
        value: stated(file, &key),
        names,
        not_carried,
        or,
        without,
        sets: parameters().filter(|p| follows::role_in(&frame.bought, p.key) == Some(role)).map(followed).collect(),
        key,
    }
}

/// The shipped names, and those that the frame file describes itself.
fn with_own(shipped: impl IntoIterator<Item = String>, file: &FrameFile, table: &str, kind: Option<&str>) -> Vec<String> {
    let mut names: Vec<String> = shipped.into_iter().collect();
    let prefix = format!("override.{table}.");
    for (key, entry) in &file.entries {
        // A name may have dots in it, a field's name has none.
        let Some((name, field)) = key.strip_prefix(&prefix).and_then(|rest| rest.rsplit_once('.')) else { continue };
        let fits = kind.is_none_or(|kind| field == "kind" && matches!(&entry.value, Value::Text(text) if text == kind));
        if fits && !names.iter().any(|known| known == name) {
            names.push(name.into());
        }
    }
    names
}

/// The name that a file states for a key, and where.
pub(super) fn stated(file: &FrameFile, key: &str) -> Option<(String, Place)> {
    let entry = file.entries.get(key)?;
    match &entry.value {
        Value::Text(name) => Some((name.clone(), entry.place.clone())),
        _ => None,
    }
}

/// The name in `base = "cognifly"`.
fn typed(place: &Place) -> String {
    let text = place.source.text.get(place.span.clone()).unwrap_or_default();
    text.split_once('=').map_or("", |(_, value)| value).trim().trim_matches(['"', '\'']).into()
}
