//! Parameters of the chosen set, each with its interval.

use nalgebra::DMatrix;

use super::adequacy::Adequacy;
use super::candidate::Candidate;
use super::clipping::Clipping;
use crate::impact::effects::SENSOR_SATURATION;
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
pub(super) fn estimates(
    chosen: &Candidate,
    adequacy: &Adequacy,
    clipping: Option<&Clipping>,
) -> Option<(Vec<EffectEstimate>, DMatrix<f64>)> {
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
    let fitted = chosen.fitted.layout.free.iter().enumerate().map(one);
    Some((fitted.chain(seen_limit(chosen, clipping)).collect(), correlations))
}

/// The limit of a sensor that was read where readings pile up, and not fitted.
fn seen_limit(chosen: &Candidate, clipping: Option<&Clipping>) -> Option<EffectEstimate> {
    let limit = &SENSOR_SATURATION.parameters[0];
    let is_fitted = chosen.fitted.layout.free.iter().any(|free| free.spec.id == SENSOR_SATURATION.id);
    let value = chosen.model().value(SENSOR_SATURATION.id, limit.key).filter(|_| !is_fitted)?;
    let half = NORMAL_97_5 * clipping?.error_g();
    let ci95 = [value - half, value + half];
    Some(EffectEstimate { effect: SENSOR_SATURATION.id, key: limit.key, unit: limit.unit, value, ci95, at_bound: false })
}
