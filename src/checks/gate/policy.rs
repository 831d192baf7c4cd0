//! What a finding means to a job.

use super::baseline::{Baseline, ListedFrame};
use crate::checks::{CATALOGUE, Finding, Rule, Verdict};

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

/// What decides about a finding besides its verdict, and what its rule says of it.
#[derive(Clone, Copy)]
pub struct Policy<'a> {
    /// Warnings fail too.
    pub strict: bool,
    /// What was accepted before.
    pub baseline: Option<&'a Baseline>,
    /// The frame's file, as the list names it; none where no list is asked.
    pub file: Option<&'a str>,
    /// The rules that the findings are of.
    pub rules: &'a [&'static Rule],
}

impl Default for Policy<'_> {
    fn default() -> Self {
        Self { strict: false, baseline: None, file: None, rules: &CATALOGUE }
    }
}

impl Policy<'_> {
    /// The rule of a finding.
    pub fn rule(&self, finding: &Finding) -> Option<&'static Rule> {
        self.rules.iter().find(|rule| rule.id == finding.rule).copied()
    }

    /// What a finding means.
    pub fn standing(&self, frame: ListedFrame, finding: &Finding) -> Standing {
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
        let (lax, strict) = (Policy::default(), Policy { strict: true, ..Policy::default() });
        for (finding, standing, strictly) in [
            (finding(Verdict::Holds, 3.0), Standing::Good, Standing::Good),
            (finding(Verdict::Note, 3.0), Standing::Good, Standing::Good),
            (finding(Verdict::Note, -3.0), Standing::Warning, Standing::Fails),
            (finding(Verdict::Violated, -3.0), Standing::Fails, Standing::Fails),
        ] {
            let a = ListedFrame { name: "a", file: None };
            assert_eq!((lax.standing(a, &finding), strict.standing(a, &finding)), (standing, strictly), "{finding:?}");
        }
        let [here, there] = ["a.toml", "other/a.toml"].map(|file| ListedFrame { name: "a", file: Some(file) });
        let accepted = Baseline::of([(here, &finding(Verdict::Violated, -3.0))].into_iter());
        let policy = Policy { baseline: Some(&accepted), ..Policy::default() };
        let standing = |frame, margin: f64| policy.standing(frame, &finding(Verdict::Violated, margin));
        assert_eq!(standing(here, -3.0), Standing::Accepted);
        assert_eq!(standing(here, -2.0), Standing::Accepted, "it got better");
        assert_eq!(standing(here, -3.1), Standing::Fails, "it got worse");
        assert_eq!(standing(ListedFrame { name: "b", ..here }, -3.0), Standing::Fails, "of another frame");
        assert_eq!(standing(there, -3.0), Standing::Fails, "of another frame of that name");
        let unfiled = Baseline::of([(ListedFrame { name: "a", file: None }, &finding(Verdict::Violated, -3.0))].into_iter());
        let policy = Policy { baseline: Some(&unfiled), ..Policy::default() };
        assert_eq!(policy.standing(there, &finding(Verdict::Violated, -3.0)), Standing::Accepted, "by a list that says no file");
    }
}
