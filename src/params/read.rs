//! Texts of a frame file, and what is said of entries that do not read.

use super::frame_file::{FrameFile, Value};
use super::refusal::{Reason, Refusal};

/// A text as typed; `None` when no file states it.
pub(super) fn text(file: &FrameFile, key: &str) -> Result<Option<String>, Refusal> {
    match file.entries.get(key).map(|entry| &entry.value) {
        None => Ok(None),
        Some(Value::Text(text)) => Ok(Some(text.clone())),
        Some(other) => {
            let reason = Reason::WrongType { key: key.into(), found: other.kind().into(), expected: "a text in quotes".into() };
            Err(file.refuse(key, reason))
        }
    }
}

/// A text that has to be stated.
pub(super) fn stated_text(file: &FrameFile, key: &str) -> Result<String, Refusal> {
    text(file, key)?.ok_or_else(|| file.refuse(key, Reason::Missing { key: key.into() }))
}

/// An entry that does not read.
pub(super) fn bad_entry(file: &FrameFile, key: &str, kind: &str, name: &str, message: &str) -> Refusal {
    file.refuse(key, Reason::BadEntry { kind: kind.into(), name: name.into(), message: in_words(message.trim()) })
}

/// What the reader of entries says, in the words of a frame file.
fn in_words(message: &str) -> String {
    let mut told = message.replace("unknown variant", "there is no");
    for (typed, plain) in [
        ("expected an array of length 2", "expected two numbers"),
        ("expected an array of length 3", "expected three numbers"),
        ("expected an array of length 4", "expected four numbers"),
        ("expected a sequence", "expected a list"),
        ("invalid length", "a list of"),
        ("invalid type: string", "a text,"),
        ("invalid type: floating point", "a number,"),
        ("invalid type: integer", "a number,"),
        ("invalid type: boolean", "true or false,"),
        ("invalid type: sequence", "a list"),
        ("invalid type: map", "a table"),
        ("expected a string", "expected a text"),
        ("expected f64", "expected a number"),
        ("expected u32", "expected a whole number"),
        ("expected a boolean", "expected true or false"),
    ] {
        told = told.replace(typed, plain);
    }
    told
}

/// Refuses a name that is more than a line of text: it stands in tables and in logs, where a line may be a command.
pub(super) fn in_one_line(file: &FrameFile, key: &str, kind: &str, name: &str) -> Result<(), Refusal> {
    if name.contains(char::is_control) { Err(bad_entry(file, key, kind, name, "its name has a control character in it")) } else { Ok(()) }
}

/// The key of a field of the file's own whose value does not read: without it the entry reads, or lacks just that field.
pub(super) fn to_blame<T: serde::de::DeserializeOwned>(entry: &toml::Value, file: &FrameFile, own: &str) -> Option<String> {
    let is_to_blame = |field: &str| {
        let mut without = entry.clone();
        without.as_table_mut().is_some_and(|table| table.remove(field).is_some())
            && without.try_into::<T>().map_or_else(|error| error.message().contains(&format!("missing field `{field}`")), |_| true)
    };
    file.entries.keys().find(|key| key.strip_prefix(own).is_some_and(is_to_blame)).cloned()
}
