//! What the kinds of plans have in common: keys, and texts, whole numbers and names as typed. The schema has the keys from the same lists.

use crate::params::ImpactFile;
use crate::params::frame_file::Value;
use crate::params::refusal::{Reason, Refusal, nearest};

/// What the rows of a plan may be; a plan that does not say has frames.
pub const KINDS: [&str; 2] = ["frames", "recovery"];

/// A key of a plan.
pub struct PlanKey {
    /// As it is stated, with its table.
    pub key: &'static str,
    /// What it takes.
    pub takes: Takes,
    /// What it is, in a sentence.
    pub doc: &'static str,
}

/// What a key takes.
pub enum Takes {
    /// A text.
    Text,
    /// One of these words.
    Word(&'static [&'static str]),
    /// A whole number within bounds.
    Whole([f64; 2]),
    /// A number within bounds, in its unit.
    Number([f64; 2], &'static str),
    /// A list of different numbers within bounds, in their unit.
    Numbers([f64; 2], &'static str),
    /// A list of different whole numbers within bounds.
    Wholes([f64; 2]),
    /// A list of names; what there are.
    Names(fn() -> Vec<String>),
    /// First seed, and the seed after the last, within bounds.
    Seeds([f64; 2]),
}

pub(super) const fn plan_key(key: &'static str, takes: Takes, doc: &'static str) -> PlanKey {
    PlanKey { key, takes, doc }
}

/// A reason in words.
pub(super) fn impossible(message: String, remedy: String) -> Reason {
    Reason::Impossible { message, remedy }
}

/// Refuses the first key that is none of these and does not begin like one of `tables`.
pub(super) fn only_known(file: &ImpactFile, keys: &[PlanKey], tables: &[&str]) -> Result<(), Refusal> {
    let keys: Vec<&str> = keys.iter().map(|known| known.key).collect();
    let known =
        |key: &str| keys.contains(&key) || tables.iter().any(|table| key.strip_prefix(table).is_some_and(|rest| rest.starts_with('.')));
    let Some(key) = file.entries.keys().find(|key| !known(key)) else { return Ok(()) };
    let all: Vec<&str> = keys.iter().chain(tables).copied().collect();
    let reason = match nearest(key, keys.iter().copied()) {
        near if near.is_empty() => {
            impossible(format!("unknown key `{key}`"), format!("the keys and tables of such a study are {}", all.join(", ")))
        }
        near => Reason::UnknownKey { key: key.clone(), nearest: near },
    };
    Err(file.refuse(key, reason))
}

/// Refuses the first of these keys that is stated: beside `what` it would do nothing.
pub(super) fn none_of(file: &ImpactFile, keys: &[&str], what: &str) -> Result<(), Refusal> {
    match keys.iter().find(|key| file.entries.contains_key(**key)) {
        Some(key) => Err(file.refuse(key, impossible(format!("`{key}` does nothing with {what}"), "leave it out".into()))),
        None => Ok(()),
    }
}

/// Refuses a list that has something twice: it would count twice in every figure.
pub(super) fn each_once<T: PartialEq + std::fmt::Display>(file: &ImpactFile, key: &str, values: &[T]) -> Result<(), Refusal> {
    match (0..values.len()).find(|at| values[..*at].contains(&values[*at])) {
        Some(at) => {
            let message = format!("`{key}` has {} twice", values[at]);
            Err(file.refuse(key, impossible(message, "state each once".into())))
        }
        None => Ok(()),
    }
}

/// A text, where it is stated.
pub(super) fn text(file: &ImpactFile, key: &str) -> Result<Option<String>, Refusal> {
    match file.entries.get(key).map(|entry| &entry.value) {
        None => Ok(None),
        Some(Value::Text(text)) => Ok(Some(text.clone())),
        Some(other) => Err(file.refuse(key, Reason::WrongType { key: key.into(), found: other.kind().into(), expected: "a text".into() })),
    }
}

/// A whole number, where it is stated.
pub(super) fn whole(file: &ImpactFile, key: &str, bounds: [f64; 2]) -> Result<Option<usize>, Refusal> {
    file.number(key, bounds, "1")?.map(|value| as_whole(file, key, value)).transpose()
}

/// Whole numbers, where they are stated.
pub(super) fn wholes(file: &ImpactFile, key: &str, bounds: [f64; 2]) -> Result<Option<Vec<usize>>, Refusal> {
    if !file.entries.contains_key(key) {
        return Ok(None);
    }
    file.numbers(key, bounds, "1")?.into_iter().map(|value| as_whole(file, key, value)).collect::<Result<_, _>>().map(Some)
}

fn as_whole(file: &ImpactFile, key: &str, value: f64) -> Result<usize, Refusal> {
    if value.fract() != 0.0 {
        return Err(file.refuse(key, impossible(format!("`{key}` = {value} is no whole number"), "give a whole number".into())));
    }
    Ok(value as usize)
}

/// What a name stands for, or the refusal that names the nearest.
pub(super) fn named<T>(file: &ImpactFile, key: &str, kind: &str, name: &str, found: Option<T>, known: &[String]) -> Result<T, Refusal> {
    found.ok_or_else(|| {
        let near: Vec<String> = nearest(name, known.iter().map(String::as_str)).iter().map(|near| format!("`{near}`")).collect();
        let meant = if near.is_empty() { String::new() } else { format!("; did you mean {}?", near.join(" or ")) };
        file.refuse(key, impossible(format!("there is no {kind} `{name}`{meant}"), format!("there are {}", known.join(", "))))
    })
}
