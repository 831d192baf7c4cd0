//! What a shell offers for the word at the cursor: names that the program knows, beside files.

use std::ffi::OsStr;

use clap_complete::engine::{ArgValueCompleter, CompletionCandidate, PathCompleter, ValueCompleter};

use super::choice;
use super::names::{What, names};
use crate::params::{PartName, parameters};

/// Presets and frame files.
pub(super) fn frames() -> ArgValueCompleter {
    named_or_toml(What::Presets)
}

/// Impact models and their files.
pub(super) fn models() -> ArgValueCompleter {
    named_or_toml(What::Models)
}

/// Materials.
pub(super) fn materials() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| beginning(current, names(What::Materials)))
}

/// Bought parts of one kind.
pub(super) fn bought(kind: &'static str) -> ArgValueCompleter {
    ArgValueCompleter::new(move |current: &OsStr| {
        // What a list says of a part begins with its kind.
        let of_kind = names(What::Parts).into_iter().filter(|(_, what)| what.split(',').next() == Some(kind));
        beginning(current, of_kind)
    })
}

/// Printed parts.
pub(super) fn printed() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| beginning(current, PartName::ALL.map(|part| (part.slug().into(), String::new()))))
}

/// Parameters by their keys, and keys of names.
pub(super) fn keys() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| beginning(current, numbers().chain(choices())))
}

/// The last of some parameters between commas.
pub(super) fn numbers_between_commas() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| between_commas(current, numbers()))
}

/// The last of some keys of names between commas.
pub(super) fn choices_between_commas() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| between_commas(current, choices()))
}

/// A name and what it is.
type Named = (String, String);

fn numbers() -> impl Iterator<Item = Named> {
    parameters().map(|p| (format!("{}.{}", p.table, p.key), p.doc.trim().into()))
}

fn choices() -> impl Iterator<Item = Named> {
    choice::keys().into_iter().map(|key| (key, String::new()))
}

fn named_or_toml(what: What) -> ArgValueCompleter {
    ArgValueCompleter::new(move |current: &OsStr| {
        let files = PathCompleter::any().filter(|path| path.is_dir() || path.extension().is_some_and(|ending| ending == "toml"));
        let mut all = beginning(current, names(what));
        all.extend(files.complete(current));
        all
    })
}

/// The names that begin as what is typed.
fn beginning(current: &OsStr, of: impl IntoIterator<Item = Named>) -> Vec<CompletionCandidate> {
    between(current, "", of)
}

fn between_commas(current: &OsStr, of: impl IntoIterator<Item = Named>) -> Vec<CompletionCandidate> {
    let typed = current.to_string_lossy();
    let before = typed.rfind(',').map_or("", |comma| &typed[..=comma]);
    between(OsStr::new(&typed[before.len()..]), before, of)
}

fn between(current: &OsStr, before: &str, of: impl IntoIterator<Item = Named>) -> Vec<CompletionCandidate> {
    let typed = current.to_string_lossy();
    let offered = |(name, what): Named| {
        let help = (!what.is_empty()).then(|| what.into());
        CompletionCandidate::new(format!("{before}{name}")).help(help)
    };
    of.into_iter().filter(|(name, _)| name.starts_with(&*typed)).map(offered).collect()
}
