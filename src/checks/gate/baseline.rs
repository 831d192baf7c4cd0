//! Accepted findings: what is known to be beyond its limit, so that only what is new or worse fails a job.

use serde::{Deserialize, Serialize};

use super::outcome::{Outcome, Standing};
use crate::checks::Finding;

/// How much worse than recorded a finding may be, in its own unit: records are rounded to a millionth.
const SAME: f64 = 2e-6;

/// Version of the file's form.
const VERSION: u32 = 1;

/// An accepted finding. Subject and rule say which; the margin says how bad it was.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Accepted {
    /// Name of the frame.
    pub frame: String,
    /// The rule.
    pub rule: String,
    /// What it looked at.
    pub subject: String,
    /// How far beyond its limit it was, negative.
    pub margin: f64,
    /// Unit of the margin.
    pub unit: String,
}

impl Accepted {
    fn key(&self) -> [&str; 3] {
        [&self.frame, &self.rule, &self.subject]
    }
}

/// A list of accepted findings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Baseline {
    schema_version: u32,
    accepted: Vec<Accepted>,
}

/// Why a list cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum BaselineError {
    /// Not of this form.
    #[error("{0}")]
    Form(#[from] serde_json::Error),
    /// Of another version.
    #[error("its schema_version is {found}, this flexframe reads {VERSION}")]
    Version {
        /// What it says.
        found: u32,
    },
}

impl Baseline {
    /// A list of the findings given, each with the name of its frame.
    pub fn of<'a>(findings: impl Iterator<Item = (&'a str, &'a Finding)>) -> Self {
        let accept = |(frame, f): (&str, &Finding)| Accepted {
            frame: frame.into(),
            rule: f.rule.clone().into_owned(),
            subject: f.subject.clone(),
            margin: (f.margin * 1e6).round() / 1e6,
            unit: f.unit.clone().into_owned(),
        };
        let mut accepted: Vec<Accepted> = findings.map(accept).collect();
        accepted.sort_by(|a, b| a.key().cmp(&b.key()).then(a.margin.total_cmp(&b.margin)));
        accepted.dedup_by(|next, kept| next.key() == kept.key());
        Self { schema_version: VERSION, accepted }
    }

    /// A list of all that fails, or would without a list; of frames that were not held, what a former list has.
    pub fn of_outcomes(outcomes: &[Outcome], former: Option<Self>) -> Self {
        let held = || outcomes.iter().filter_map(|outcome| outcome.result.as_ref().ok());
        let mut list = Self::of(held().flat_map(|held| {
            let failing = held.findings.iter().filter(|judged| judged.standing >= Standing::Accepted);
            failing.map(|judged| (held.frame.as_str(), &judged.finding))
        }));
        let kept = former.into_iter().flat_map(|former| former.accepted).filter(|a| held().all(|held| held.frame != a.frame));
        list.accepted.extend(kept);
        list.accepted.sort_by(|a, b| a.key().cmp(&b.key()));
        list
    }

    /// Reads a list.
    ///
    /// # Errors
    /// When it is not one.
    pub fn parse(text: &str) -> Result<Self, BaselineError> {
        let list: Self = serde_json::from_str(text)?;
        if list.schema_version == VERSION { Ok(list) } else { Err(BaselineError::Version { found: list.schema_version }) }
    }

    /// The list as it is written.
    pub fn text(&self) -> String {
        // A list of strings and finite numbers is always JSON.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// Whether a finding of a frame is on the list and no worse than there.
    pub fn accepts(&self, frame: &str, finding: &Finding) -> bool {
        self.accepted.iter().any(|a| is(a, frame, finding) && finding.margin >= a.margin - SAME)
    }

    /// Entries of frames that were held and no longer have such a finding.
    pub fn done<'a>(&'a self, outcomes: &'a [Outcome]) -> impl Iterator<Item = &'a Accepted> {
        self.accepted.iter().filter(|a| {
            let held = outcomes.iter().filter_map(|outcome| outcome.result.as_ref().ok()).find(|held| held.frame == a.frame);
            held.is_some_and(|held| {
                !held.findings.iter().any(|judged| judged.standing >= Standing::Accepted && is(a, &held.frame, &judged.finding))
            })
        })
    }
}

fn is(accepted: &Accepted, frame: &str, finding: &Finding) -> bool {
    (accepted.frame.as_str(), accepted.rule.as_str(), accepted.subject.as_str()) == (frame, &*finding.rule, finding.subject.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_lists_are_read_as_written_and_others_refused() {
        let list = Baseline { schema_version: 1, accepted: Vec::new() };
        assert_eq!(Baseline::parse(&list.text()).expect("reads"), list);
        assert!(matches!(Baseline::parse("{\"schema_version\": 7, \"accepted\": []}"), Err(BaselineError::Version { found: 7 })));
        for wrong in ["", "[]", "{\"accepted\": []}", "{\"schema_version\": 1, \"accepted\": [], \"more\": 1}"] {
            assert!(matches!(Baseline::parse(wrong), Err(BaselineError::Form(_))), "{wrong}");
        }
    }
}
