//! What a rule found.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::figures::{decimals, told_apart};
use crate::frame::skeleton::MODULE_NAMES;
use crate::params::PartName;

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
    /// What it is compared with.
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
    /// Whether its subject names a part: all that are printed of it, or the one of a module.
    pub fn names(&self, part: PartName) -> bool {
        let is_of_module = |rest: &str| rest.strip_prefix('_').is_some_and(|rest| MODULE_NAMES.contains(&rest));
        let mut words = self.subject.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        words.any(|word| word.strip_prefix(part.slug()).is_some_and(|rest| rest.is_empty() || is_of_module(rest)))
    }

    /// Whether it is a warning: a note beyond its figure.
    pub fn warns(&self) -> bool {
        self.verdict == Verdict::Note && self.margin < 0.0
    }

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

#[cfg(test)]
mod tests {
    use super::*;

    fn found(subject: &str, value: f64) -> Finding {
        let verdict = if value < 4.0 { Verdict::Violated } else { Verdict::Holds };
        let (subject, margin) = (subject.into(), value - 4.0);
        let (message, levers) = (String::new(), Vec::new());
        Finding { rule: "seating".into(), subject, verdict, value, limit: 4.0, margin, unit: "mm".into(), message, levers }
    }

    #[test]
    fn analytic_the_tightest_of_what_holds_and_all_that_does_not() {
        let all = [found("a: depth", 6.0), found("b: depth", 5.0), found("c: depth", 3.0), found("d: depth", 2.0), found("a: wall", 9.0)];
        let shown: Vec<(&str, usize)> = tightest(&all).iter().map(|t| (t.finding.subject.as_str(), t.of)).collect();
        assert_eq!(shown, [("b: depth", 2), ("c: depth", 1), ("d: depth", 1), ("a: wall", 1)]);
    }

    #[test]
    fn analytic_a_subject_names_a_part_by_its_whole_name() {
        for (subject, names) in [
            ("hub: wall", &[PartName::Hub][..]),
            ("hub_joint: wall", &[PartName::HubJoint]),
            ("hub_joint_FR and camera", &[PartName::HubJoint]),
            ("hub and hub_joint_BL", &[PartName::HubJoint, PartName::Hub]),
            ("battery", &[]),
        ] {
            let named: Vec<PartName> = PartName::ALL.into_iter().filter(|part| found(subject, 5.0).names(*part)).collect();
            assert_eq!(named, names, "{subject}");
        }
    }
}
