//! What a search keeps on every frame, and by how much it is kept.

use super::goal::Goal;
use super::measures::Evaluation;
use crate::checks::{Finding, Rule, Verdict};

/// A constraint of a search: the tightest of some findings of a rule.
#[derive(Clone, Copy)]
pub(super) struct Constraint {
    /// The rule.
    pub rule: &'static Rule,
    /// Which findings, in words: [`Rule::concerns`].
    pub subject: &'static str,
}

impl Constraint {
    /// Those of all rules that a search keeps on every frame.
    pub fn of_all(rules: &[&'static Rule]) -> Vec<Self> {
        rules.iter().flat_map(|rule| rule.constraints().into_iter().map(|subject| Self { rule, subject })).collect()
    }

    /// Whether a finding is one of its own. Notes never are.
    pub fn concerns(&self, finding: &Finding) -> bool {
        finding.rule == self.rule.id && self.rule.concerns(self.subject, &finding.subject) && finding.verdict != Verdict::Note
    }
}

/// What of a unit is as much as a millimetre.
pub(super) fn scale(unit: &str) -> f64 {
    match unit {
        "g" => 10.0,
        "%" | "deg" => 20.0,
        "cm3" => 100.0,
        "" => 0.1,
        _ => 1.0,
    }
}

/// Margins beyond this say no more, scaled; far enough that the planes through the first points are not flat.
pub(super) const FAR: f64 = 50.0;

/// Scaled margins: every constraint's tightest, then the goals'.
pub(super) fn margins(evaluation: &Evaluation, constraints: &[Constraint], goals: &[Goal]) -> Vec<f64> {
    let tightest = |constraint: &Constraint| {
        let found = evaluation.findings.iter().filter(|finding| constraint.concerns(finding));
        found.map(|f| f.margin / scale(&f.unit)).fold(FAR, f64::min).max(-FAR)
    };
    let goal = |goal: &Goal| {
        let margin = goal.measure.of(evaluation).map_or(-FAR, |value| goal.margin(value) / scale(goal.measure.unit));
        margin.clamp(-FAR, FAR)
    };
    constraints.iter().map(tightest).chain(goals.iter().map(goal)).collect()
}
