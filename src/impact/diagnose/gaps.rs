//! Gaps of a model.

use super::candidate::Candidate;
use super::gap::{Gap, gap, left_out_heights, left_out_trials};
use crate::impact::fit::{FitProblem, Waves};

/// Gaps of a model.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gaps {
    /// At the fitted heights.
    pub fitted: Gap,
    /// At the held-out heights, or at each height fitted to the others.
    pub held_out: Gap,
    /// To every second drop, fitted to the others.
    pub trials: Gap,
}

impl Gaps {
    /// Those of a candidate at the fitted heights, the held-out ones and between trials.
    pub(super) fn of(problem: &FitProblem, fitted: &Waves, held_out: Option<&Waves>, candidate: &Candidate) -> Option<Self> {
        Some(Self {
            fitted: gap(problem, fitted, candidate.model())?,
            held_out: match held_out {
                Some(waves) => gap(problem, waves, candidate.model())?,
                None if fitted.groups.len() > 1 => left_out_heights(problem, fitted, candidate)?,
                None => Gap::UNKNOWN,
            },
            trials: left_out_trials(problem, fitted, candidate)?,
        })
    }
}
