//! What a rule found.

use serde::Serialize;

/// How a finding ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
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
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The rule.
    pub rule: &'static str,
    /// What it looked at.
    pub subject: String,
    /// How it ends.
    pub verdict: Verdict,
    /// What was measured.
    pub value: f64,
    /// What it is held against.
    pub limit: f64,
    /// How far the value is on the good side of the limit; negative when it is not.
    pub margin: f64,
    /// Unit of the three numbers.
    pub unit: &'static str,
    /// One sentence with the numbers in it.
    pub message: String,
    /// The key that changes it most directly.
    pub parameter: &'static str,
}

/// A measured number and its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Measure {
    pub rule: &'static str,
    pub value: f64,
    pub limit: f64,
    pub unit: &'static str,
    pub parameter: &'static str,
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

    fn finding(self, subject: String, message: String, margin: f64) -> Finding {
        let verdict = if margin >= 0.0 { Verdict::Holds } else { Verdict::Violated };
        let Self { rule, value, limit, unit, parameter } = self;
        Finding { rule, subject, verdict, value, limit, margin, unit, message, parameter }
    }
}
