//! Parameters of the chosen set, each with its interval.

use nalgebra::DMatrix;

use super::adequacy::Adequacy;
use super::candidate::{Candidate, EARNS, PRICE};
use super::clipping::Clipping;
use crate::impact::effects::{Listed, SENSOR_SATURATION};
use crate::impact::fit::{FitProblem, Fitted, Free, Layout, NORMAL_97_5, inverse};

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

/// What an effect of a set has that was not fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldParameter {
    /// Effect's id.
    pub effect: &'static str,
    /// Key.
    pub key: &'static str,
    /// What it is.
    pub value: HeldValue,
}

/// A number or a word.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum HeldValue {
    /// The default of a parameter.
    Default(f64),
    /// The word that fits best.
    Word(&'static str),
}

/// What the effects on top of the base have that was not fitted.
pub fn held(chosen: &Candidate) -> Vec<HeldParameter> {
    let is_free = |effect: &str, at: usize| chosen.fitted.layout.free.iter().any(|free| free.spec.id == effect && free.at == at);
    let of = |listed: &Listed| {
        let spec = listed.spec;
        let defaults = spec.parameters.iter().zip(&listed.values).enumerate();
        let mut all: Vec<HeldParameter> = defaults
            .filter(|(at, (parameter, _))| parameter.default.is_some() && !is_free(spec.id, *at))
            .map(|(_, (parameter, value))| HeldParameter { effect: spec.id, key: parameter.key, value: HeldValue::Default(*value) })
            .collect();
        let word = spec.choice.and_then(|choice| Some((choice.key, *choice.words.get(listed.word)?)));
        all.extend(word.map(|(key, word)| HeldParameter { effect: spec.id, key, value: HeldValue::Word(word) }));
        all
    };
    chosen.model().effects.iter().filter(|listed| !listed.spec.is_base()).flat_map(of).collect()
}

/// The parameters of a set with their intervals, and their correlations.
pub(super) fn estimates(
    problem: &FitProblem,
    chosen: &Candidate,
    adequacy: &Adequacy,
    clipping: Option<&Clipping>,
) -> Option<(Vec<EffectEstimate>, DMatrix<f64>)> {
    let minimum = &chosen.fitted.minimum;
    let covariance = covariance(problem, &chosen.fitted)?;
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

/// What the drops may tell a damping to be off its default without its being freed, in the sum of squares ([`super::candidate`]).
const UNTOLD: f64 = PRICE + EARNS;

/// Of the free parameters. What of the set was not fitted may be off its default by as much as is thought of it, or as the drops leave untold; the
/// parameters move along.
fn covariance(problem: &FitProblem, fitted: &Fitted) -> Option<DMatrix<f64>> {
    let own = &fitted.minimum.jacobian;
    let mut covariance = inverse(&(own.transpose() * own))?;
    let whole = problem.fit(Layout::whole(fitted.model().clone()), 0)?;
    let is_free = |free: &Free| fitted.layout.free.iter().any(|one| one.spec.id == free.spec.id && one.at == free.at);
    let told = inverse(&(whole.minimum.jacobian.transpose() * &whole.minimum.jacobian));
    let along = &covariance * own.transpose();
    for (at, free) in whole.layout.free.iter().enumerate().filter(|(_, free)| !is_free(free)) {
        let untold = told.as_ref().map_or(f64::INFINITY, |told| UNTOLD * told[(at, at)]);
        let variance = free.default_spread().powi(2).min(untold);
        let moved = &along * whole.minimum.jacobian.column(at);
        covariance += variance * &moved * moved.transpose();
    }
    Some(covariance)
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
