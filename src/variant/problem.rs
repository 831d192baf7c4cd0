//! What a search is asked for, and what it answers.

use super::aim::Aim;
use super::ended::Ended;
use super::goal::Goal;
use super::measures::Evaluation;
use std::ops::ControlFlow;
use std::sync::Arc;

use crate::frame::skeleton::SAWN_MM;
use crate::mechanics::settings::MechanicsSettings;
use crate::memo::Memo;
use crate::params::parameter::Parameter;
use crate::params::{Frame, FrameFile, parameters, target};

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

    /// The value at a share of the way between the bounds, as it is written: in thousandths.
    pub fn at(&self, share: f64) -> f64 {
        let [least, most] = self.bounds;
        let value = least + share.clamp(0.0, 1.0) * (most - least);
        ((value * 1000.0).round() / 1000.0).clamp(least, most)
    }

    /// These values with this one of them moved by a share of the bounds: the way in which there is room, and the other way.
    pub(super) fn beside(&self, values: &[f64], at: usize, reach: f64) -> [Vec<f64>; 2] {
        let [least, most] = self.bounds;
        let step = self.whole(reach * (most - least));
        let up = values[at] + step <= most;
        [up, !up].map(|up| {
            let mut moved = values.to_vec();
            moved[at] = self.at(self.share(values[at] + if up { step } else { -step }));
            moved
        })
    }

    /// A step across which rods are sawn by the same amount; sockets take up what is sawn off, and a shorter step would measure
    /// the saw.
    fn whole(&self, step: f64) -> f64 {
        if self.parameter.table == "rods" { (step / SAWN_MM).round().max(1.0) * SAWN_MM } else { step.max(0.001) }
    }

    /// How far a value is on the way between the bounds.
    pub(super) fn share(&self, value: f64) -> f64 {
        let [least, most] = self.bounds;
        if most > least { ((value - least) / (most - least)).clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// What to search for.
#[derive(Clone)]
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
    /// Who follows the search, and may end it.
    pub follows: &'a (dyn Fn(&SearchProgress) -> ControlFlow<()> + Sync + 'a),
    /// Numbers of the frame's own mechanics, where the aim or a goal is one of their measures: a second or two a frame.
    pub mechanics: Option<MechanicsSettings>,
    /// What was computed of frames before; an empty one will do.
    pub memo: Arc<Memo>,
}

/// Where a search is.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchProgress {
    /// How many frames were looked at.
    pub looked_at: usize,
    /// How many may be.
    pub most: usize,
    /// The aim's first measure, in its unit, of the best frame that keeps the quick rules, or its squared distance; none where there
    /// is no such frame yet.
    pub best: Option<f64>,
    /// What the best one misses most, where it misses something.
    pub missed: Option<String>,
}

impl<'a> SearchProblem<'a> {
    /// Who follows a part of the search that begins after so many frames: told of all of them.
    pub(super) fn followed_from(&self, before: usize) -> impl Fn(&SearchProgress) -> ControlFlow<()> + Sync + use<'a> {
        let (follows, most) = (self.follows, self.most);
        move |now| follows(&SearchProgress { looked_at: before + now.looked_at, most, ..now.clone() })
    }

    /// Whether what varies is the frame's to state.
    ///
    /// # Errors
    /// When a rod length varies that follows from the frame's target size.
    pub(super) fn can_vary(&self, frame: &Frame) -> Result<(), SolveError> {
        match self.vary.iter().map(Vary::key).find(|key| target::gives(frame, key)) {
            Some(key) => Err(SolveError::FromTarget { key }),
            None => Ok(()),
        }
    }

    /// The same with what varies in the order of the catalogue of parameters, in which order ever it was asked for: a search treats one number after
    /// the other, and the same numbers lead to the same answer.
    #[must_use]
    pub(super) fn in_catalogue_order(&self) -> Self {
        let place = |at: &usize| parameters().position(|parameter| is_same(parameter, self.vary[*at].parameter));
        let mut order: Vec<usize> = (0..self.vary.len()).collect();
        order.sort_by_key(place);
        let ordered = |values: &[f64]| if values.is_empty() { Vec::new() } else { order.iter().map(|at| values[*at]).collect() };
        let aim = if let Aim::Near(from) = &self.aim { Aim::Near(ordered(from)) } else { self.aim.clone() };
        Self { vary: order.iter().map(|at| self.vary[*at]).collect(), start: ordered(&self.start), aim, ..self.clone() }
    }

    /// The place of one that varies.
    pub(super) fn place_of(&self, vary: &Vary) -> Option<usize> {
        self.vary.iter().position(|own| is_same(own.parameter, vary.parameter))
    }

    /// The squared distance of values from others, in shares of their bounds.
    pub(super) fn distance(&self, values: &[f64], from: &[f64]) -> f64 {
        let part = |((vary, a), b): ((&Vary, &f64), &f64)| (vary.share(*a) - vary.share(*b)).powi(2);
        self.vary.iter().zip(values).zip(from).map(part).sum()
    }

    /// The aim's value of a frame, in the units of its measures.
    pub(super) fn value(&self, evaluation: &Evaluation) -> f64 {
        let ones = vec![1.0; self.aim.measures().len()];
        self.aim.of(&self.aim.shares(evaluation, &ones), &ones, 0.0)
    }

    /// A frame as far as the problem wants to know it.
    pub(super) fn with_mechanics(&self, evaluation: Evaluation) -> Result<Evaluation, String> {
        match &self.mechanics {
            None => Ok(evaluation),
            Some(settings) => evaluation.strengthened(settings).map_err(|error| error.to_string()),
        }
    }
}

fn is_same(a: &Parameter, b: &Parameter) -> bool {
    (a.table, a.key) == (b.table, b.key)
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
    /// Why it ended.
    pub ended: Ended,
}

/// That no frame keeps all limits, in words; of frames of which none could be designed nothing more is known.
fn infeasible(looked_at: usize, ended: Ended, nearest: &str, missed: &[String]) -> String {
    match (missed, looked_at) {
        ([], 0) => "the search ended before a frame was tried".into(),
        ([], _) => format!("{} {looked_at} frames, none of which could be designed", ended.words()),
        _ => format!(
            "{} {looked_at} frames, none of which keeps every limit; the nearest, {nearest}, misses these: {}",
            ended.words(),
            missed.join("; ")
        ),
    }
}

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum SolveError {
    /// Nothing varies, or a goal or bound is impossible.
    #[error("{0}")]
    Problem(String),
    /// A rod length varies that follows from a target size.
    #[error(
        "`{key}` cannot vary: it follows from [target] of the frame; state the three rod lengths instead of [target], `flexframe params FRAME --filter rod_length` shows them"
    )]
    FromTarget {
        /// The rod length.
        key: String,
    },
    /// No frame that was looked at keeps all limits; there may be one.
    #[error("{}", infeasible(*looked_at, *ended, nearest, missed))]
    Infeasible {
        /// How many were looked at.
        looked_at: usize,
        /// Why it ended.
        ended: Ended,
        /// Which is the nearest one, in words.
        nearest: String,
        /// What the nearest one misses.
        missed: Vec<String>,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_search_that_missed_nothing_it_knows_of_says_so() {
        let said = |looked_at: usize, missed: &[&str]| {
            let missed = missed.iter().map(|word| word.to_string()).collect();
            SolveError::Infeasible { looked_at, ended: Ended::Stopped, nearest: "the first".into(), missed }.to_string()
        };
        assert_eq!(said(0, &[]), "the search ended before a frame was tried");
        assert_eq!(said(3, &[]), "was ended after 3 frames, none of which could be designed");
        assert!(said(3, &["a", "b"]).ends_with("none of which keeps every limit; the nearest, the first, misses these: a; b"));
    }
}
