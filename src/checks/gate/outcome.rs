//! What became of a frame at the gate.

use std::borrow::Cow;

use super::baseline::ListedFrame;
use super::blame::{Spot, masses_named, spots};
use super::policy::{Policy, Standing};
use crate::checks::Finding;
use crate::frame::assembly::mass::MassTable;
use crate::params::refusal::Refusal;
use crate::params::{Frame, FrameFile, LoadError};

/// A finding and what it means.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The finding.
    pub finding: Finding,
    /// What it means.
    pub standing: Standing,
    /// Where the frame file drives it, the first most; empty for what is good.
    pub spots: Vec<Spot>,
    /// The change that clears it, tested on the frame, as a clause after its message; empty if none was requested.
    pub advice: String,
    /// What its value is made of, as a clause that goes after its message; empty where the message says all.
    pub made_of: String,
}

impl Judged {
    /// Its message, with the change that clears it where one was requested.
    pub fn message(&self) -> Cow<'_, str> {
        if self.advice.is_empty() {
            Cow::Borrowed(&self.finding.message)
        } else {
            format!("{}; {}", self.finding.message, self.advice).into()
        }
    }

    /// The finding as it is reported: tested changes replace the keys that might clear it.
    pub fn reported(&self) -> Finding {
        let mut finding = self.finding.clone();
        if !self.advice.is_empty() {
            finding.message = self.message().into_owned();
            finding.levers.clear();
        }
        finding
    }
}

/// A frame that was checked against its limits.
#[derive(Clone, Debug)]
pub struct CheckedFrame {
    /// Its name.
    pub frame: String,
    /// Its file, as a list of accepted findings names it; none where no list is asked.
    pub file: Option<String>,
    /// Its findings, in the order of the rules.
    pub findings: Vec<Judged>,
    /// Its masses.
    pub masses: MassTable,
}

impl CheckedFrame {
    /// Judges the findings of a frame.
    pub fn new(frame: &Frame, file: &FrameFile, findings: Vec<Finding>, masses: MassTable, policy: Policy) -> Self {
        let listed = ListedFrame { name: &frame.name, file: policy.file };
        let judge = |finding: Finding| {
            let (rule, standing) = (policy.rule(&finding), policy.standing(listed, &finding));
            let spots = if standing == Standing::Good { Vec::new() } else { spots(&finding, rule, file, &masses) };
            let made_of = rule.map_or(String::new(), |rule| masses_named(rule, &masses));
            Judged { finding, standing, spots, advice: String::new(), made_of }
        };
        let findings = findings.into_iter().map(judge).collect();
        Self { frame: frame.name.clone(), file: policy.file.map(String::from), findings, masses }
    }

    /// The frame as a list of accepted findings knows it.
    pub fn listed(&self) -> ListedFrame<'_> {
        ListedFrame { name: &self.frame, file: self.file.as_deref() }
    }

    /// The same with what was tried for each of its findings, in their order.
    pub fn advised(mut self, advice: Vec<String>) -> Self {
        for (judged, advice) in self.findings.iter_mut().zip(advice) {
            judged.advice = advice;
        }
        self
    }

    /// The same after all that fails was put on a list of accepted findings.
    fn accepted(mut self) -> Self {
        for judged in self.findings.iter_mut().filter(|judged| judged.standing == Standing::Fails) {
            judged.standing = Standing::Accepted;
        }
        self
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

/// A frame that could not be checked.
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

/// What to do about a frame that cannot be read at all.
pub const NO_FRAME_REMEDY: &str = "`flexframe check --help` says what a frame is";

impl Refused {
    /// A frame that could not be read, or whose file is refused.
    pub fn of_load(error: &LoadError) -> Self {
        match error {
            LoadError::Refused(refusal) => Self::of(refusal),
            other => {
                let remedy = match other {
                    LoadError::NoSuchModel { .. } => "`flexframe list models` lists the models",
                    LoadError::NoSuchPlan { .. } => "docs/diagnosis.md lists the keys of a plan",
                    _ => NO_FRAME_REMEDY,
                };
                Self { message: other.to_string(), remedy: remedy.into(), spot: None, machine: other.is_of_machine() }
            }
        }
    }

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
    pub result: Result<CheckedFrame, Refused>,
}

impl Outcome {
    /// The same after all that fails was put on a list of accepted findings.
    pub fn accepted(self) -> Self {
        Self { result: self.result.map(CheckedFrame::accepted), ..self }
    }

    /// The exit code for this frame alone.
    pub fn exit_code(&self) -> u8 {
        match &self.result {
            Ok(held) => u8::from(held.count(Standing::Fails) > 0),
            Err(refused) if refused.machine => 3,
            Err(_) => 2,
        }
    }
}
