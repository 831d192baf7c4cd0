//! What a study of hidden effects says of each row.

use super::findings::{Asks, Findings};
use crate::impact::diagnose::Verdict;
use crate::impact::effects::CATALOGUE;
use crate::impact::landing::GATES;

/// A column of a study of hidden effects.
pub struct RecoveryMeasure {
    /// Its name.
    pub name: &'static str,
    /// The unit of its figures; empty for words, plain numbers, and where it depends on the effect.
    pub unit: &'static str,
    /// The words that its figures stand for, by their place; none where they are numbers.
    pub words: Option<&'static [&'static str]>,
    /// What it takes to know it.
    pub asks: Asks,
    of: fn(&Findings) -> Option<f64>,
}

/// The verdicts, as the figures of the column count them.
const VERDICTS: [Verdict; 4] = [Verdict::Named, Verdict::Ambiguous, Verdict::NoneSuffices, Verdict::NothingMissing];
/// Their words.
static VERDICT_WORDS: [&str; 4] = ["named", "ambiguous", "none_suffices", "nothing_missing"];
/// Ids of the catalogue.
static EFFECTS: [&str; CATALOGUE.len()] = {
    let mut ids = [""; CATALOGUE.len()];
    let mut at = 0;
    while at < ids.len() {
        ids[at] = CATALOGUE[at].id;
        at += 1;
    }
    ids
};

impl RecoveryMeasure {
    const fn number(name: &'static str, unit: &'static str, asks: Asks, of: fn(&Findings) -> Option<f64>) -> Self {
        Self { name, unit, words: None, asks, of }
    }

    const fn effect(name: &'static str, asks: Asks, of: fn(&Findings) -> Option<f64>) -> Self {
        Self { name, unit: "", words: Some(&EFFECTS), asks, of }
    }

    const fn diagnosed(name: &'static str, unit: &'static str, of: fn(&Findings) -> Option<f64>) -> Self {
        Self::number(name, unit, Asks::Diagnosis, of)
    }

    /// Whether every study has it that does not say what it asks for: those that are not take a multiple of the time, or are of drops with
    /// lateral axes alone.
    pub(super) fn is_usual(&self) -> bool {
        !matches!(self.asks, Asks::Ceiling | Asks::KnownCovariance | Asks::Landings)
    }

    /// Its figure of a row; none where the row has no such thing.
    pub(super) fn of(&self, findings: &Findings) -> Option<f64> {
        (self.of)(findings)
    }
}

fn place_of(id: Option<&str>) -> Option<f64> {
    EFFECTS.iter().position(|known| Some(*known) == id).map(|at| at as f64)
}

fn named(findings: &Findings, at: usize) -> Option<f64> {
    place_of(findings.named().get(at).copied())
}

fn verdict(findings: &Findings) -> Option<f64> {
    let verdict = findings.diagnosis.as_ref()?.verdict;
    VERDICTS.iter().position(|known| *known == verdict).map(|at| at as f64)
}

/// A figure of a parameter: the truth, the estimate, and the ends of its interval.
fn estimate<const PARAMETER: usize, const FIGURE: usize>(findings: &Findings) -> Option<f64> {
    findings.estimates[PARAMETER][FIGURE]
}

/// A figure of the legs' dry friction: the truth, the estimate, and the ends of its interval.
fn friction<const FIGURE: usize>(findings: &Findings) -> Option<f64> {
    findings.friction()?[FIGURE]
}

/// The first test of landings that failed.
fn failed(findings: &Findings) -> Option<f64> {
    let failed = findings.landing.as_ref()?.gates.iter().find(|gate| !gate.passed)?.id;
    GATES.iter().position(|id| *id == failed).map(|at| at as f64)
}

/// Every column that there is.
pub static RECOVERY_MEASURES: [RecoveryMeasure; 55] = [
    RecoveryMeasure { name: "verdict", unit: "", words: Some(&VERDICT_WORDS), asks: Asks::Diagnosis, of: verdict },
    RecoveryMeasure::diagnosed("right", "", |row| row.is_right().map(|right| f64::from(u8::from(right)))),
    RecoveryMeasure::effect("named", Asks::Diagnosis, |row| named(row, 0)),
    RecoveryMeasure::effect("named.2", Asks::Diagnosis, |row| named(row, 1)),
    RecoveryMeasure::effect("named.3", Asks::Diagnosis, |row| named(row, 2)),
    RecoveryMeasure::effect("first", Asks::Diagnosis, |row| place_of(row.first())),
    RecoveryMeasure::diagnosed("rank", "", |row| row.rank().map(|rank| rank as f64)),
    RecoveryMeasure::diagnosed("weight", "", |row| row.diagnosis.as_ref()?.alternatives.first().map(|best| best.weight)),
    RecoveryMeasure::diagnosed("p.before", "", |row| Some(row.diagnosis.as_ref()?.base_adequacy.p)),
    RecoveryMeasure::diagnosed("p.after", "", |row| Some(row.diagnosis.as_ref()?.adequacy.p)),
    RecoveryMeasure::diagnosed("p.trend", "", |row| Some(row.diagnosis.as_ref()?.trend_p)),
    RecoveryMeasure::diagnosed("gap.before", "g", |row| Some(row.diagnosis.as_ref()?.before.held_out.net_g)),
    RecoveryMeasure::diagnosed("gap.after", "g", |row| Some(row.diagnosis.as_ref()?.after.held_out.net_g)),
    RecoveryMeasure::number("held_out.before", "g", Asks::HeldOut, |row| row.held_out_g[0]),
    RecoveryMeasure::number("held_out.after", "g", Asks::HeldOut, |row| row.held_out_g[1]),
    RecoveryMeasure::diagnosed("k.true", "N/m", estimate::<0, 0>),
    RecoveryMeasure::diagnosed("k.found", "N/m", estimate::<0, 1>),
    RecoveryMeasure::diagnosed("k.least", "N/m", estimate::<0, 2>),
    RecoveryMeasure::diagnosed("k.most", "N/m", estimate::<0, 3>),
    RecoveryMeasure::diagnosed("c.true", "N s/m", estimate::<1, 0>),
    RecoveryMeasure::diagnosed("c.found", "N s/m", estimate::<1, 1>),
    RecoveryMeasure::diagnosed("c.least", "N s/m", estimate::<1, 2>),
    RecoveryMeasure::diagnosed("c.most", "N s/m", estimate::<1, 3>),
    RecoveryMeasure::diagnosed("parameter.1.true", "", estimate::<2, 0>),
    RecoveryMeasure::diagnosed("parameter.1.found", "", estimate::<2, 1>),
    RecoveryMeasure::diagnosed("parameter.1.least", "", estimate::<2, 2>),
    RecoveryMeasure::diagnosed("parameter.1.most", "", estimate::<2, 3>),
    RecoveryMeasure::diagnosed("parameter.2.true", "", estimate::<3, 0>),
    RecoveryMeasure::diagnosed("parameter.2.found", "", estimate::<3, 1>),
    RecoveryMeasure::diagnosed("parameter.2.least", "", estimate::<3, 2>),
    RecoveryMeasure::diagnosed("parameter.2.most", "", estimate::<3, 3>),
    RecoveryMeasure::diagnosed("parameter.3.true", "", estimate::<4, 0>),
    RecoveryMeasure::diagnosed("parameter.3.found", "", estimate::<4, 1>),
    RecoveryMeasure::diagnosed("parameter.3.least", "", estimate::<4, 2>),
    RecoveryMeasure::diagnosed("parameter.3.most", "", estimate::<4, 3>),
    RecoveryMeasure::number("noncentrality", "", Asks::Noncentrality, |row| row.noncentrality),
    RecoveryMeasure::number("left.alone", "", Asks::Left, |row| row.left_alone),
    RecoveryMeasure::number("left.rival", "", Asks::Left, |row| row.left_rival),
    RecoveryMeasure::number("ceiling.right", "", Asks::Ceiling, |row| row.ceiling.map(|share| share.right)),
    RecoveryMeasure::number("ceiling.first", "", Asks::Ceiling, |row| row.ceiling.map(|share| share.first)),
    RecoveryMeasure::number("ceiling.detectable", "", Asks::Ceiling, |row| row.ceiling?.detectable),
    RecoveryMeasure::number("ceiling.single_records", "", Asks::Ceiling, |row| row.ceiling.map(|share| share.in_covariance)),
    RecoveryMeasure::effect("known_covariance.first", Asks::KnownCovariance, |row| place_of(row.with_known_covariance)),
    RecoveryMeasure::number("landing.named", "", Asks::Landings, |row| row.names_landings().map(|named| f64::from(u8::from(named)))),
    RecoveryMeasure { name: "landing.failed", unit: "", words: Some(&GATES), asks: Asks::Landings, of: failed },
    RecoveryMeasure::number("landing.p.enough", "", Asks::Landings, |row| row.landing.as_ref().map(|landing| landing.adequacy.p)),
    RecoveryMeasure::number("landing.p.given_touches", "", Asks::Landings, |row| {
        row.landing.as_ref().map(|landing| landing.given_touches.p)
    }),
    RecoveryMeasure::number("landing.p.spread", "", Asks::Landings, |row| row.landing.as_ref().map(|landing| landing.spread_p)),
    RecoveryMeasure::number("landing.mount", "", Asks::Landings, |row| {
        Some(f64::from(u8::from(row.landing.as_ref()?.fit.legs.mount.is_some())))
    }),
    RecoveryMeasure::number("landing.feet", "", Asks::Landings, |row| {
        Some(f64::from(u8::from(row.landing.as_ref()?.fit.legs.feet.is_some())))
    }),
    RecoveryMeasure::number("landing.friction.true", "N", Asks::Landings, friction::<0>),
    RecoveryMeasure::number("landing.friction.found", "N", Asks::Landings, friction::<1>),
    RecoveryMeasure::number("landing.friction.least", "N", Asks::Landings, friction::<2>),
    RecoveryMeasure::number("landing.friction.most", "N", Asks::Landings, friction::<3>),
    RecoveryMeasure::number("landing.gap", "g", Asks::Landings, |row| row.landing.as_ref().map(|landing| landing.gaps.held_out.net_g)),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_words_are_those_of_files_and_names_differ() {
        assert_eq!(VERDICTS.map(Verdict::id), VERDICT_WORDS);
        assert_eq!(EFFECTS, CATALOGUE.map(|spec| spec.id));
        let names: std::collections::BTreeSet<&str> = RECOVERY_MEASURES.iter().map(|measure| measure.name).collect();
        assert_eq!(names.len(), RECOVERY_MEASURES.len());
    }
}
