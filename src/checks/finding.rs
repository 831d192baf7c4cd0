//! What a rule found.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::figures::{decimals, told_apart};

/// How far a length measured between meshes may be off, mm. Circles are polygons of
/// [`SEGMENTS_PER_TURN`](crate::solid::SEGMENTS_PER_TURN) chords there: a round wall is thinner by 0.2 % (1.7 µm of 0.8 mm), and
/// the middle of a chord lies 5 µm inside an arc of 2.3 mm radius. A limit in mm that is missed by no more than this is
/// kept; volumes, masses, angles and strains are compared as they are.
pub(super) const MEASURING_MM: f64 = 0.005;

/// Whether a distance is less than its limit by more than it may be mismeasured.
pub(super) fn falls_short_mm(value_mm: f64, limit_mm: f64) -> bool {
    value_mm < limit_mm - MEASURING_MM
}

/// How a finding ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The limit is kept.
    Holds,
    /// The limit is broken.
    Violated,
    /// Worth knowing; nothing is broken.
    Note,
}

/// What a rule found, with its numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The rule.
    pub rule: Cow<'static, str>,
    /// What it looked at.
    pub subject: String,
    /// How it ends.
    pub verdict: Verdict,
    /// What was measured.
    pub value: f64,
    /// What it is held against.
    pub limit: f64,
    /// How far the value is on the good side of the limit; 0 when it misses by less than it may be mismeasured, negative
    /// when by more.
    pub margin: f64,
    /// Unit of the three numbers.
    pub unit: Cow<'static, str>,
    /// One sentence with the numbers in it.
    pub message: String,
    /// The keys that change it most directly, three at the most.
    pub levers: Vec<Cow<'static, str>>,
}

/// Findings that say the same of different places, shown by their tightest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tightest<'a> {
    /// The one with the least margin.
    pub finding: &'a Finding,
    /// How many there are.
    pub of: usize,
}

/// What a person has to read: every violation and note, and of what holds the tightest of each rule, unit and limit.
pub fn tightest(findings: &[Finding]) -> Vec<Tightest<'_>> {
    let mut shown: Vec<Tightest> = Vec::new();
    for finding in findings {
        let alike = |t: &Tightest| {
            let (a, b) = (t.finding, finding);
            a.verdict == Verdict::Holds && (&a.rule, &a.unit) == (&b.rule, &b.unit) && a.limit == b.limit && a.aspect() == b.aspect()
        };
        match shown.iter_mut().find(|t| finding.verdict == Verdict::Holds && alike(t)) {
            Some(group) => {
                group.of += 1;
                if finding.margin < group.finding.margin {
                    group.finding = finding;
                }
            }
            None => shown.push(Tightest { finding, of: 1 }),
        }
    }
    shown
}

impl Finding {
    /// Value, limit and margin for a table: two decimals, more where a limit is broken by less than shows.
    pub fn figures(&self) -> [String; 3] {
        if self.verdict != Verdict::Violated {
            return [self.value, self.limit, self.margin].map(|number| decimals(number, 2));
        }
        let [value, limit] = told_apart(self.value, self.limit, 2);
        [value, limit, told_apart(self.margin, 0.0, 2)[0].clone()]
    }

    /// What of its subject was measured: the words after its last colon.
    fn aspect(&self) -> &str {
        self.subject.rsplit_once(": ").map_or("", |(_, aspect)| aspect)
    }
}

/// A measured number and its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Measure {
    pub rule: &'static str,
    pub value: f64,
    pub limit: f64,
    pub unit: &'static str,
    pub levers: &'static [&'static str],
}

impl Measure {
    /// Good when the value is the limit or less.
    pub fn at_most(self, subject: String, message: String) -> Finding {
        self.finding(subject, message, self.limit - self.value)
    }

    /// Good when the value is the limit or more.
    pub fn at_least(self, subject: String, message: String) -> Finding {
        self.finding(subject, message, self.value - self.limit)
    }

    /// Neither good nor bad.
    pub fn note(self, subject: String, message: String) -> Finding {
        Finding { verdict: Verdict::Note, ..self.at_most(subject, message) }
    }

    /// Value and limit as a message says them, never so short that a broken limit looks kept.
    pub fn figures(&self, places: usize) -> [String; 2] {
        told_apart(self.value, self.limit, places)
    }

    fn finding(self, subject: String, message: String, margin: f64) -> Finding {
        let Self { rule, value, limit, unit, levers } = self;
        let mismeasured = if unit == "mm" { MEASURING_MM } else { 0.0 };
        let margin = if (-mismeasured..0.0).contains(&margin) { 0.0 } else { margin };
        let verdict = if margin >= 0.0 { Verdict::Holds } else { Verdict::Violated };
        let levers = levers.iter().copied().map(Cow::Borrowed).collect();
        Finding { rule: rule.into(), subject, verdict, value, limit, margin, unit: unit.into(), message, levers }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(subject: &str, value: f64) -> Finding {
        let measure = Measure { rule: "seating", value, limit: 4.0, unit: "mm", levers: &[] };
        measure.at_least(subject.into(), String::new())
    }

    #[test]
    fn analytic_the_tightest_of_what_holds_and_all_that_does_not() {
        let all = [found("a: depth", 6.0), found("b: depth", 5.0), found("c: depth", 3.0), found("d: depth", 2.0), found("a: wall", 9.0)];
        let shown: Vec<(&str, usize)> = tightest(&all).iter().map(|t| (t.finding.subject.as_str(), t.of)).collect();
        assert_eq!(shown, [("b: depth", 2), ("c: depth", 1), ("d: depth", 1), ("a: wall", 1)]);
    }

    #[test]
    fn analytic_a_length_is_held_to_what_can_be_measured() {
        assert_eq!((found("a", 3.996).verdict, found("a", 3.996).margin), (Verdict::Holds, 0.0));
        assert_eq!(found("a", 3.994).verdict, Verdict::Violated);
        let grams = Measure { rule: "mass", value: 250.001, limit: 250.0, unit: "g", levers: &[] };
        assert_eq!(grams.figures(1), ["250.001", "250.000"]);
        assert_eq!(grams.at_most("all".into(), String::new()).verdict, Verdict::Violated);
    }
}
