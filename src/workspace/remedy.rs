//! A remedy: the change of one key that clears a violation.

use std::borrow::Cow;
use std::fmt;

use crate::checks::{Finding, Verdict};
use crate::figures::decimals;
use crate::params::preset;

/// Remedies that are named for a violation.
const NAMED: usize = 2;

/// A change that clears a violation.
#[derive(Clone, Debug, PartialEq)]
pub struct Remedy {
    /// The key, with its table.
    pub key: String,
    /// Its value now.
    pub from: String,
    /// The value that clears the violation.
    pub to: String,
    /// By how much the frame gets heavier, g.
    pub heavier_g: f64,
    /// What it breaks that was not violated before, or worsens: the first of it, and how much more.
    pub breaks: Option<String>,
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { key, from, to, heavier_g, breaks } = self;
        let sign = if *heavier_g < 0.0 { "" } else { "+" };
        write!(f, "{key} {from} -> {to} clears it ({sign}{} g)", decimals(*heavier_g, 1))?;
        breaks.as_ref().map_or(Ok(()), |broken| write!(f, ", but {broken}"))
    }
}

/// Whether one remedy is to clear both.
pub(super) fn alike(a: &Finding, b: &Finding) -> bool {
    let both_warn = [a, b].iter().all(|f| f.verdict == Verdict::Note);
    a.rule == b.rule && a.levers == b.levers && (a.unit == b.unit || both_warn)
}

/// Whether remedies are looked for: of a violation, and of a warning that another choice may clear.
pub(super) fn asks(finding: &Finding) -> bool {
    let is_choice = |lever: &Cow<str>| !preset::names_for(lever).is_empty();
    let is_chosen = !finding.levers.is_empty() && finding.levers.iter().all(is_choice);
    finding.verdict == Verdict::Violated || finding.warns() && is_chosen
}

/// As a person reads them.
pub(super) fn joined(remedies: &[Remedy]) -> String {
    remedies.iter().map(Remedy::to_string).collect::<Vec<_>>().join("; or ")
}

/// Of changes that keep what the file asks for, and of those that take it back: what breaks nothing. Where only the latter have that, the first of the
/// former stands before them with what it breaks.
pub(super) fn named(mut kept: Vec<Remedy>, mut back: Vec<Remedy>) -> Vec<Remedy> {
    let is_clean = |remedy: &Remedy| remedy.breaks.is_none();
    let [clean_kept, clean_back] = [&kept, &back].map(|remedies| remedies.iter().any(is_clean));
    if clean_kept {
        kept.retain(is_clean);
    } else if clean_back {
        kept.truncate(1);
    }
    if clean_kept || clean_back {
        back.retain(is_clean);
    }
    kept.extend(back);
    kept.truncate(NAMED);
    kept
}
