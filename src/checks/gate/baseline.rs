//! Accepted findings: what is known to be beyond its limit, so that only what is new or worse fails a job.

use serde::{Deserialize, Serialize};

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
    /// The file that describes it, by its path from the list's folder, or the preset's name. A list that says nothing here
    /// accepts the finding of every frame of that name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The rule.
    pub rule: String,
    /// What it looked at.
    pub subject: String,
    /// How far beyond its limit it was, negative.
    pub margin: f64,
    /// Unit of the margin.
    pub unit: String,
}

/// A frame as a list tells it from others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ListedFrame<'a> {
    /// Its name.
    pub name: &'a str,
    /// The file that describes it, as [`Accepted::file`]; none where no list is asked.
    pub file: Option<&'a str>,
}

impl Accepted {
    fn key(&self) -> [&str; 5] {
        [&self.frame, &self.rule, &self.subject, self.file.as_deref().unwrap_or(""), &self.unit]
    }

    /// Whether it is about a frame.
    pub fn is_of(&self, frame: ListedFrame) -> bool {
        self.frame == frame.name && self.file.as_deref().is_none_or(|file| frame.file == Some(file))
    }

    /// Whether it is a finding of a rule about something, whatever the frame and the numbers. Numbers of another unit are another finding.
    pub fn is(&self, finding: &Finding) -> bool {
        (self.rule.as_str(), &self.subject, self.unit.as_str()) == (&*finding.rule, &finding.subject, &*finding.unit)
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
    /// A list of the findings given, each with its frame.
    pub fn of<'a>(findings: impl Iterator<Item = (ListedFrame<'a>, &'a Finding)>) -> Self {
        let accept = |(frame, f): (ListedFrame, &Finding)| Accepted {
            frame: frame.name.into(),
            file: frame.file.map(String::from),
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

    /// The list with these entries besides.
    pub fn with(mut self, entries: impl Iterator<Item = Accepted>) -> Self {
        self.accepted.extend(entries);
        self.accepted.sort_by(|a, b| a.key().cmp(&b.key()));
        self
    }

    /// Its entries, by frame, rule and subject.
    pub fn entries(&self) -> &[Accepted] {
        &self.accepted
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
    pub fn accepts(&self, frame: ListedFrame, finding: &Finding) -> bool {
        self.accepted.iter().any(|entry| entry.is_of(frame) && entry.is(finding) && finding.margin >= entry.margin - SAME)
    }

    /// Whether an entry about frames of a name does not say of which file.
    pub fn is_of_any_file(&self, name: &str) -> bool {
        self.accepted.iter().any(|entry| entry.frame == name && entry.file.is_none())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::measure::Measure;
    use crate::checks::planted::TOY;

    /// A fold that has no order is not the fold whose plug is too short.
    #[test]
    fn planted_a_finding_in_another_unit_is_not_the_accepted_one() {
        let found = |unit: &'static str, value: f64| {
            Measure { rule: TOY.id, value, limit: 4.0, unit, levers: &[] }.at_least("fold".into(), String::new())
        };
        let frame = ListedFrame { name: "a", file: None };
        let list = Baseline::of([(frame, &found("mm", 2.0))].into_iter());
        assert!(
            list.accepts(frame, &found("mm", 2.5)) && !list.accepts(frame, &found("mm", 1.5)) && !list.accepts(frame, &found("steps", 3.0))
        );
        let both = Baseline::of([(frame, &found("mm", 2.0)), (frame, &found("steps", 3.0))].into_iter());
        assert_eq!(both.entries().len(), 2);
    }

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
