//! Parameters of the chosen set, each with its interval.

use nalgebra::DMatrix;

use super::adequacy::Adequacy;
use super::candidate::Candidate;
use crate::impact::fit::{Free, NORMAL_97_5, inverse};

/// A parameter with its interval.
#[derive(Clone, Debug, serde::Serialize)]
pub struct EffectEstimate {
    /// Effect's id.
    #[serde(skip)]
    pub effect: &'static str,
    /// Key.
    #[serde(skip)]
    pub key: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Value.
    pub value: f64,
    /// Calibrated 95 % interval.
    pub ci95: [f64; 2],
    /// Whether it lies at a bound.
    pub at_bound: bool,
}

/// The parameters of a set with their intervals, and their correlations.
pub(super) fn estimates(chosen: &Candidate, adequacy: &Adequacy) -> Option<(Vec<EffectEstimate>, DMatrix<f64>)> {
    let minimum = &chosen.fitted.minimum;
    let covariance = inverse(&(minimum.jacobian.transpose() * &minimum.jacobian))?;
    let sd: Vec<f64> = covariance.diagonal().iter().map(|variance| variance.max(1e-300).sqrt()).collect();
    let correlations = DMatrix::from_fn(sd.len(), sd.len(), |i, j| covariance[(i, j)] / (sd[i] * sd[j]));
    let one = |(i, free): (usize, &Free)| {
        let half = adequacy.ratio95.get(i).copied().unwrap_or(NORMAL_97_5) * sd[i];
        EffectEstimate {
            effect: free.spec.id,
            key: free.key(),
            unit: free.spec.parameters[free.at].unit,
            value: free.outward(minimum.at[i]),
            ci95: [free.outward(minimum.at[i] - half), free.outward(minimum.at[i] + half)],
            at_bound: minimum.at_bound[i],
        }
    };
    Some((chosen.fitted.layout.free.iter().enumerate().map(one).collect(), correlations))
}
