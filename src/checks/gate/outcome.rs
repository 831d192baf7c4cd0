//! What became of a frame at the gate.

use super::baseline::Baseline;
use super::blame::{Spot, spots};
use crate::checks::{Finding, Verdict};
use crate::frame::assembly::mass::MassTable;
use crate::params::refusal::Refusal;
use crate::params::{Frame, FrameFile};

/// What a finding means to a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Standing {
    /// The limit is kept, or it is a remark.
    Good,
    /// A note beyond its figure; nothing fails.
    Warning,
    /// It would fail, but is on the list of accepted findings.
    Accepted,
    /// The job fails.
    Fails,
}

/// What decides about a finding besides its verdict.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rules<'a> {
    /// Warnings fail too.
    pub strict: bool,
    /// What was accepted before.
    pub baseline: Option<&'a Baseline>,
}

impl Rules<'_> {
    /// What a finding means.
    pub fn standing(&self, frame: &str, finding: &Finding) -> Standing {
        let warns = finding.verdict == Verdict::Note && finding.margin < 0.0;
        let fails = finding.verdict == Verdict::Violated || (warns && self.strict);
        match (fails, warns) {
            (true, _) if self.baseline.is_some_and(|baseline| baseline.accepts(frame, finding)) => Standing::Accepted,
            (true, _) => Standing::Fails,
            (false, true) => Standing::Warning,
            (false, false) => Standing::Good,
        }
    }
}

/// A finding and what it means.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The finding.
    pub finding: Finding,
    /// What it means.
    pub standing: Standing,
    /// Where the frame file drives it, the first most; empty for what is good.
    pub spots: Vec<Spot>,
}

/// A frame that was held against its limits.
#[derive(Clone, Debug)]
pub struct Held {
    /// Its name.
    pub frame: String,
    /// Its findings, in the order of the rules.
    pub findings: Vec<Judged>,
    /// Its masses.
    pub masses: MassTable,
}

impl Held {
    /// Judges the findings of a frame.
    pub fn new(frame: &Frame, file: &FrameFile, findings: Vec<Finding>, masses: MassTable, rules: Rules) -> Self {
        let judge = |finding: Finding| {
            let standing = rules.standing(&frame.name, &finding);
            let spots = if standing == Standing::Good { Vec::new() } else { spots(&finding, file, &masses) };
            Judged { finding, standing, spots }
        };
        let findings = findings.into_iter().map(judge).collect();
        Self { frame: frame.name.clone(), findings, masses }
    }

    /// How many findings have a standing.
    pub fn count(&self, standing: Standing) -> usize {
        self.findings.iter().filter(|judged| judged.standing == standing).count()
    }

    /// Findings of a standing.
    pub fn of(&self, standing: Standing) -> impl Iterator<Item = &Judged> {
        self.findings.iter().filter(move |judged| judged.standing == standing)
    }
}

/// A frame that could not be held against anything.
#[derive(Clone, Debug)]
pub struct Refused {
    /// Why.
    pub message: String,
    /// What to change.
    pub remedy: String,
    /// Where.
    pub spot: Option<Spot>,
    /// Whether the machine failed, not the input.
    pub machine: bool,
}

impl Refused {
    /// A refusal of a frame file.
    pub fn of(refusal: &Refusal) -> Self {
        let spot = refusal.place.as_ref().map(|place| Spot::at("", place));
        Self { message: refusal.message(), remedy: refusal.reason.remedy(), spot, machine: false }
    }
}

/// A frame at the gate: what was asked for, and what became of it.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// A preset's name or a path, as asked for.
    pub asked: String,
    /// What became of it.
    pub result: Result<Held, Refused>,
}

impl Outcome {
    /// The exit code that this frame alone asks for.
    pub fn exit_code(&self) -> u8 {
        match &self.result {
            Ok(held) => u8::from(held.count(Standing::Fails) > 0),
            Err(refused) if refused.machine => 3,
            Err(_) => 2,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finding(verdict: Verdict, margin: f64) -> Finding {
        Finding {
            rule: "mass_budget".into(),
            subject: "take-off mass".into(),
            verdict,
            value: 250.0 - margin,
            limit: 250.0,
            margin,
            unit: "g".into(),
            message: String::new(),
            levers: Vec::new(),
        }
    }

    #[test]
    fn analytic_what_fails_a_job() {
        let (lax, strict) = (Rules::default(), Rules { strict: true, baseline: None });
        for (finding, standing, strictly) in [
            (finding(Verdict::Holds, 3.0), Standing::Good, Standing::Good),
            (finding(Verdict::Note, 3.0), Standing::Good, Standing::Good),
            (finding(Verdict::Note, -3.0), Standing::Warning, Standing::Fails),
            (finding(Verdict::Violated, -3.0), Standing::Fails, Standing::Fails),
        ] {
            assert_eq!((lax.standing("a", &finding), strict.standing("a", &finding)), (standing, strictly), "{finding:?}");
        }
        let accepted = Baseline::of([("a", &finding(Verdict::Violated, -3.0))].into_iter());
        let rules = Rules { strict: false, baseline: Some(&accepted) };
        assert_eq!(rules.standing("a", &finding(Verdict::Violated, -3.0)), Standing::Accepted);
        assert_eq!(rules.standing("a", &finding(Verdict::Violated, -2.0)), Standing::Accepted, "it got better");
        assert_eq!(rules.standing("a", &finding(Verdict::Violated, -3.1)), Standing::Fails, "it got worse");
        assert_eq!(rules.standing("b", &finding(Verdict::Violated, -3.0)), Standing::Fails, "of another frame");
    }
}
