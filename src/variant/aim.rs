//! What a search makes small.

use super::measures::{Evaluation, Measure};

/// What counts as nothing of a measure, as a share of its value at the start, or of what is much of its unit where that is more: 0.05 g of 250 g; and of a distance, in shares of the bounds.
const ALIKE: f64 = 2e-4;
const ALIKE_NEAR: f64 = 5e-3;

/// What is made small.
#[derive(Clone)]
pub enum Aim {
    /// The sum of these measures, each by its weight and as a share of its value at the start, or of what is much of its unit. A weight below zero asks for more.
    Least(Vec<(&'static Measure, f64)>),
    /// The distance of a measure from a value.
    Toward(&'static Measure, f64),
    /// The distance from these values, each in shares of its bounds.
    Near(Vec<f64>),
}

impl Aim {
    /// The least of a measure.
    pub fn least(measure: &'static Measure) -> Self {
        Self::Least(vec![(measure, 1.0)])
    }

    /// The measures that it is made of.
    pub(super) fn measures(&self) -> Vec<&'static Measure> {
        match self {
            Self::Least(terms) => terms.iter().map(|(measure, _)| *measure).collect(),
            Self::Toward(measure, _) => vec![*measure],
            Self::Near(_) => Vec::new(),
        }
    }

    /// Its value: of measures in their order, each as a share of these scales, and of a squared distance from the values that are
    /// to be near.
    pub(super) fn of(&self, shares: &[f64], scales: &[f64], distance: f64) -> f64 {
        match self {
            Self::Least(terms) => terms.iter().zip(shares).map(|((_, weight), share)| weight * share).sum(),
            Self::Toward(_, wanted) => (shares[0] - wanted / scales[0]).abs(),
            Self::Near(_) => distance,
        }
    }

    /// Whether two of its values are as good as equal: so far that nobody would build another frame for it.
    pub(super) fn is_alike(&self, a: f64, b: f64) -> bool {
        match self {
            Self::Near(_) => (a.sqrt() - b.sqrt()).abs() < ALIKE_NEAR,
            _ => (a - b).abs() < ALIKE,
        }
    }

    /// What the measures of a frame are as shares of these scales; infinite where the frame has no such measure.
    pub(super) fn shares(&self, evaluation: &Evaluation, scales: &[f64]) -> Vec<f64> {
        let share = |(measure, scale): (&'static Measure, &f64)| measure.of(evaluation).unwrap_or(f64::INFINITY) / scale;
        self.measures().into_iter().zip(scales).map(share).collect()
    }
}
