//! A measured number and its limit, on the way to a finding.

use std::borrow::Cow;

use super::finding::{Finding, Verdict};
use crate::figures::told_apart;

/// How far a length measured between meshes may be off, mm. Circles are polygons of
/// [`SEGMENTS_PER_TURN`](crate::solid::SEGMENTS_PER_TURN) chords there: a round wall is thinner by 0.2 % (1.7 µm of 0.8 mm), and
/// the middle of a chord lies 5 µm inside an arc of 2.3 mm radius. A limit in mm that is missed by no more than this is
/// kept; volumes, masses, angles and strains are compared as they are.
pub(super) const MEASURING_MM: f64 = 0.005;

/// Whether a distance is less than its limit by more than it may be mismeasured.
pub(super) fn falls_short_mm(value_mm: f64, limit_mm: f64) -> bool {
    value_mm < limit_mm - MEASURING_MM
}

/// A measured number and its limit.
#[derive(Clone, Copy)]
pub(super) struct Measure {
    /// The rule's id.
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

    fn finding(self, subject: String, mut message: String, margin: f64) -> Finding {
        let Self { rule, value, limit, unit, levers } = self;
        let mismeasured = if unit == "mm" { MEASURING_MM } else { 0.0 };
        let is_within = (-mismeasured..0.0).contains(&margin);
        if is_within {
            message += &format!(", missed by no more than the {MEASURING_MM} mm that it may be mismeasured by");
        }
        let margin = if is_within { 0.0 } else { margin };
        let verdict = if margin >= 0.0 { Verdict::Holds } else { Verdict::Violated };
        let levers = levers.iter().copied().map(Cow::Borrowed).collect();
        Finding { rule: rule.into(), subject, verdict, value, limit, margin, unit: unit.into(), message, levers }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::TOY;

    fn found(value: f64) -> Finding {
        Measure { rule: TOY.id, value, limit: 4.0, unit: "mm", levers: &[] }.at_least("a".into(), String::new())
    }

    #[test]
    fn analytic_a_length_is_compared_as_far_as_it_can_be_measured() {
        assert_eq!((found(3.996).verdict, found(3.996).margin), (Verdict::Holds, 0.0));
        assert!(found(3.996).message.ends_with("0.005 mm that it may be mismeasured by") && found(4.0).message.is_empty());
        assert_eq!((found(3.994).verdict, found(3.994).message.as_str()), (Verdict::Violated, ""));
        let grams = Measure { rule: TOY.id, value: 250.001, limit: 250.0, unit: "g", levers: &[] };
        assert_eq!(grams.figures(1), ["250.001", "250.000"]);
        assert_eq!(grams.at_most("all".into(), String::new()).verdict, Verdict::Violated);
    }
}
