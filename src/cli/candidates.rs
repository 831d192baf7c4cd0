//! What a shell offers for the word at the cursor: names that the program knows, beside files.

use std::ffi::OsStr;

use clap_complete::engine::{ArgValueCompleter, CompletionCandidate, PathCompleter, ValueCompleter};

use super::choice;
use super::names::{What, names};
use crate::impact::effects::Model;
use crate::params::parameter::Parameter;
use crate::params::{PartName, parameters, target};
use crate::printing::coupon::Fit;
use crate::variant::MEASURES;

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

/// Parameters by their keys, keys of a target size, and keys of names.
pub(super) fn keys() -> ArgValueCompleter {
    let targets = || target::KEYS.iter().map(|target| (target.key.into(), target.doc.into()));
    ArgValueCompleter::new(move |current: &OsStr| beginning(current, numbers(current).into_iter().chain(targets()).chain(choices())))
}

/// The last of some parameters between commas.
pub(super) fn numbers_between_commas() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| between_commas(current, numbers))
}

/// The last of some keys of names between commas.
pub(super) fn choices_between_commas() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| between_commas(current, |_| choices().collect()))
}

/// Measures of a frame by their names, the last of some between commas.
pub(super) fn measures() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| between_commas(current, |_| measured("").collect()))
}

/// Measures that a value follows, such as `mass=`.
pub(super) fn measures_with_values() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| beginning(current, measured("=")))
}

/// What is found on a coupon, such as `held=`, and tables of folded hinges.
pub(super) fn found_on_a_coupon() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| {
        let mut all = beginning(current, Fit::ALL.map(|fit| (format!("{}=", fit.name()), fit.words().into())));
        all.extend(files(current, "csv"));
        all
    })
}

/// Parameters of the model that the command line names, or else of `model`.
pub(super) fn parameters_of_model(model: &'static str) -> ArgValueCompleter {
    ArgValueCompleter::new(move |current: &OsStr| {
        let named = named_model().and_then(|named| Model::load(&named).ok()).or_else(|| Model::load(model).ok());
        let effects = named.map(|model| model.effects).unwrap_or_default();
        let parameters =
            effects.iter().flat_map(|listed| listed.spec.parameters.iter().map(|one| (one.key.into(), listed.spec.title.into())));
        between_commas(current, |_| parameters.collect())
    })
}

/// TOML files.
pub(super) fn toml_files() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| files(current, "toml"))
}

/// A name and what it is.
type Named = (String, String);

/// Parameters with their tables; without, too, where something is typed and no other table has the key.
fn numbers(typed: &OsStr) -> Vec<Named> {
    let named = |key: String, p: &Parameter| (key, p.doc.trim().to_string());
    let is_of_one_table = |p: &&Parameter| parameters().filter(|other| other.key == p.key).count() == 1;
    let short = parameters().filter(|p| !typed.is_empty() && is_of_one_table(p)).map(|p| named(p.key.into(), p));
    parameters().map(|p| named(format!("{}.{}", p.table, p.key), p)).chain(short).collect()
}

fn measured(ending: &str) -> impl Iterator<Item = Named> {
    MEASURES.iter().map(move |measure| (format!("{}{ending}", measure.name), measure.doc.into()))
}

/// The model that the command line names, which a shell gives whole.
fn named_model() -> Option<String> {
    let words: Vec<String> = std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect();
    let follows = words.iter().position(|word| word == "--model").and_then(|at| words.get(at + 1).cloned());
    follows.or_else(|| words.iter().find_map(|word| word.strip_prefix("--model=").map(String::from)))
}

/// Files whose names end so, and folders.
fn files(current: &OsStr, ending: &'static str) -> Vec<CompletionCandidate> {
    PathCompleter::any().filter(move |path| path.extension().is_some_and(|own| own == ending)).complete(current)
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
pub(super) fn beginning(current: &OsStr, of: impl IntoIterator<Item = Named>) -> Vec<CompletionCandidate> {
    between(current, "", of)
}

/// The names that begin as what is typed after the last comma.
fn between_commas(current: &OsStr, of: impl FnOnce(&OsStr) -> Vec<Named>) -> Vec<CompletionCandidate> {
    let typed = current.to_string_lossy();
    let before = typed.rfind(',').map_or("", |comma| &typed[..=comma]);
    let last = OsStr::new(&typed[before.len()..]);
    between(last, before, of(last))
}

fn between(current: &OsStr, before: &str, of: impl IntoIterator<Item = Named>) -> Vec<CompletionCandidate> {
    let typed = current.to_string_lossy();
    let offered = |(name, what): Named| {
        let help = (!what.is_empty()).then(|| what.into());
        CompletionCandidate::new(format!("{before}{name}")).help(help)
    };
    of.into_iter().filter(|(name, _)| name.starts_with(&*typed)).map(offered).collect()
}
