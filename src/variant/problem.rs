//! What a search is asked for, and what it answers.

use super::goal::Goal;
use super::measures::{Evaluation, Measure};
use crate::mechanics::settings::MechanicsSettings;
use crate::params::parameter::Parameter;
use crate::params::{Frame, FrameFile};

/// A parameter that may vary.
#[derive(Clone, Copy, Debug)]
pub struct Vary {
    /// Which.
    pub parameter: &'static Parameter,
    /// Least and most, within the parameter's bounds.
    pub bounds: [f64; 2],
}

impl Vary {
    /// A parameter that may vary by a share of its value in a frame, no farther than its bounds. Bounds as such are far apart, and
    /// most of what lies between them is no frame.
    pub fn around(parameter: &'static Parameter, frame: &Frame, share: f64) -> Self {
        let Parameter { min, max, .. } = *parameter;
        let bounds = match frame.value(parameter.table, parameter.key) {
            Some(value) if value != 0.0 => [-share, share].map(|way| (value + way * value.abs()).clamp(min, max)),
            _ => [min, max],
        };
        Self { parameter, bounds }
    }

    /// Its key with its table.
    pub fn key(&self) -> String {
        format!("{}.{}", self.parameter.table, self.parameter.key)
    }

    /// The value at a share of the way between the bounds, as it is written.
    pub(super) fn at(&self, share: f64) -> f64 {
        let [least, most] = self.bounds;
        let value = least + share.clamp(0.0, 1.0) * (most - least);
        ((value * 1000.0).round() / 1000.0).clamp(least, most)
    }

    /// How far a value is on the way between the bounds.
    pub(super) fn share(&self, value: f64) -> f64 {
        let [least, most] = self.bounds;
        if most > least { ((value - least) / (most - least)).clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// What is made small.
#[derive(Clone)]
pub enum Aim {
    /// A measure.
    Measure(&'static Measure),
    /// The distance from these values, each in shares of its bounds.
    Near(Vec<f64>),
}

/// What to search for.
pub struct SearchProblem<'a> {
    /// The frame that is changed.
    pub file: &'a FrameFile,
    /// What is made small.
    pub aim: Aim,
    /// What is kept besides the rules.
    pub goals: Vec<Goal>,
    /// What varies.
    pub vary: Vec<Vary>,
    /// Where the search begins; the frame's own values when empty.
    pub start: Vec<f64>,
    /// How many frames may be looked at.
    pub most: usize,
    /// Numbers of the frame's own mechanics, where the aim or a goal is one of their measures: a second or two a frame.
    pub mechanics: Option<MechanicsSettings>,
}

impl SearchProblem<'_> {
    /// A frame as far as the problem wants to know it.
    pub(super) fn known(&self, evaluation: Evaluation) -> Result<Evaluation, String> {
        match &self.mechanics {
            None => Ok(evaluation),
            Some(settings) => evaluation.strengthened(settings).map_err(|error| error.to_string()),
        }
    }
}

/// A limit that holds the answer back.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// Which.
    pub what: String,
    /// How much room is left.
    pub margin: f64,
    /// Unit of the margin.
    pub unit: String,
}

/// An answer.
pub struct Solution {
    /// The frame.
    pub evaluation: Evaluation,
    /// What varied, before and after.
    pub values: Vec<(Vary, f64, f64)>,
    /// Limits that hold it back, the tightest first.
    pub binding: Vec<Binding>,
    /// What is wrong with the nearest frames that would be better, the nearest first.
    pub refused: Vec<String>,
    /// How many frames were looked at.
    pub looked_at: usize,
}

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum SolveError {
    /// Nothing varies, or a goal or bound is impossible.
    #[error("{0}")]
    Problem(String),
    /// No frame that was looked at keeps all limits; there may be one.
    #[error("gave up after {looked_at} frames, none of which keeps every limit; the nearest misses these: {}", .missed.join("; "))]
    Infeasible {
        /// How many were looked at.
        looked_at: usize,
        /// What the nearest one misses.
        missed: Vec<String>,
    },
}
