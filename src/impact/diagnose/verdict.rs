//! What a diagnosis says, and what that rests on.

use super::adequacy::Adequacy;
use super::alternative::Alternative;
use super::candidate::{Candidate, joined};
use super::constancy::{Constancy, UNSTEADY};
use super::search::RARE;
use crate::figures::p_value;

/// Weight that a set needs for its name, by its number of effects.
const SUPPORT: [f64; 3] = [0.7, 0.7, 0.95];
/// p-value below which a trend over trials is significant.
const TREND: f64 = 0.002;

/// What was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// One set of effects is supported, and enough.
    Named,
    /// Several sets are enough, and the drops cannot distinguish them.
    Ambiguous,
    /// No set of effects explains the drops.
    NoneSuffices,
    /// The base model explains the drops.
    NothingMissing,
}

impl Verdict {
    /// As in files.
    pub fn id(self) -> &'static str {
        match self {
            Self::Named => "named",
            Self::Ambiguous => "ambiguous",
            Self::NoneSuffices => "none_suffices",
            Self::NothingMissing => "nothing_missing",
        }
    }
}

/// What a verdict rests on.
pub(super) struct Evidence<'a> {
    /// Whether the base model is enough.
    pub(super) nothing: bool,
    /// p-values of what is left.
    pub(super) adequacy: &'a Adequacy,
    /// The best-supported set.
    pub(super) chosen: &'a Candidate,
    /// Sets of its size, the best first.
    pub(super) alternatives: &'a [Alternative],
    /// Its parameters by height.
    pub(super) steady: Option<&'a Constancy>,
    /// p-value of the trend over trials.
    pub(super) trend: f64,
    /// The model's own effects where they are not enough, with the p-value of what they leave.
    pub(super) not_enough: Option<&'a (Candidate, f64)>,
}

/// Verdict and reasons, that of the model's own effects among them.
pub(super) fn verdict(evidence: &Evidence) -> (Verdict, Vec<String>) {
    let (verdict, mut reasons) = verdict_of_search(evidence);
    if let Some((given, p)) = evidence.not_enough {
        reasons.push(format!(
            "the model's own {} leaves more than trial variation (p = {}): effects were looked for on its spring, damper and sensor alone",
            joined(given),
            p_value(*p)
        ));
    }
    (verdict, reasons)
}

/// The same of the search alone, whatever effects the model had.
fn verdict_of_search(evidence: &Evidence) -> (Verdict, Vec<String>) {
    let Evidence { nothing, adequacy, chosen, alternatives, steady, trend, .. } = evidence;
    let mut reasons = Vec::new();
    if *trend < TREND {
        reasons.push(format!(
            "the drops show a trend over trials (p = {}), such as wear or loosening; no effect of the catalogue describes it",
            p_value(*trend)
        ));
    }
    if *nothing {
        let model = if chosen.ids().is_empty() { "the base model".into() } else { format!("the model with its own {}", joined(chosen)) };
        reasons.push(format!("the residual of {model} is within trial variation (p = {})", p_value(adequacy.p)));
        return (if *trend < TREND { Verdict::NoneSuffices } else { Verdict::NothingMissing }, reasons);
    }
    if adequacy.p < RARE {
        reasons.push(format!(
            "no set of effects explains the drops: the best, {}, leaves more than trial variation (p = {})",
            joined(chosen),
            p_value(adequacy.p)
        ));
    }
    if let Some(steady) = steady.filter(|steady| steady.p < UNSTEADY) {
        reasons.push(format!("the parameters of {} are not the same at all heights (p = {:.1e})", joined(chosen), steady.p));
    }
    for free in chosen.implausible() {
        reasons.push(format!("{free} ended at its bound"));
    }
    if !reasons.is_empty() {
        return (Verdict::NoneSuffices, reasons);
    }
    let weight = alternatives.first().map_or(0.0, |best| best.weight);
    let needed = SUPPORT[(chosen.ids().len().max(1) - 1).min(SUPPORT.len() - 1)];
    if weight < needed {
        let others: Vec<String> =
            alternatives.iter().skip(1).take(3).map(|other| format!("{} ({:.2})", joined(&other.candidate), other.weight)).collect();
        reasons.push(format!(
            "{} explains the drops, but other sets explain them nearly as well: weight {weight:.2}, {}",
            joined(chosen),
            others.join(", ")
        ));
        return (Verdict::Ambiguous, reasons);
    }
    reasons.push(format!(
        "{} explains the drops (p = {}); no other set explains them as well (weight {weight:.2})",
        joined(chosen),
        p_value(adequacy.p)
    ));
    if steady.is_none() && !chosen.ids().is_empty() {
        reasons.push("whether its numbers are the same at all heights is not tested: that takes drops from a second height".into());
    }
    (Verdict::Named, reasons)
}
