//! A fit: the minimum of an objective, and how far other drops move it.

use nalgebra::DVector;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::fit_error::FitError;
use super::free::Layout;
use super::least_squares::{Minimum, inverse, minimise};
use crate::impact::effects::Model;
use crate::impact::measured::Spread;

/// Steps of a fit at the most.
const MOST_STEPS: usize = 60;
/// Factors on each starting value, one after the other, for further starts.
const STARTS: [f64; 2] = [0.4, 2.5];

/// Fewest fits to other drops whose errors say what 95 % are: of fewer, the largest error holds less.
pub const LEAST_RESAMPLED: usize = 19;
/// Fewest drops of a height whose resampling says how far a parameter is known: one alone is always the same.
pub const LEAST_DROPS: usize = 4;

/// Something to be made small by a model.
pub trait Objective: Sync + Sized {
    /// Drops a height.
    fn counts(&self) -> Vec<usize>;
    /// Numbers whose squares are summed; `None` where the simulation diverges.
    fn residual(&self, model: &Model) -> Option<DVector<f64>>;
    /// Height, m, and what a model reads from it at each sample from the trigger on, g.
    fn waves(&self, model: &Model) -> Vec<(f64, Vec<f64>)>;
    /// What the sum of squares is reported as.
    fn value(&self, sum: f64) -> f64;
    /// The same with what only a fit tells of how records vary; `at` are the fitted values on their own scales.
    fn around(&self, layout: &Layout, at: &[f64]) -> Self;
    /// The same of other drops that may as well have been measured, where `waves` are those of the fitted model ([`Self::waves`]); none where they
    /// cannot be drawn.
    fn another(&self, waves: &[(f64, Vec<f64>)], rng: &mut Pcg64) -> Option<Self>;
    /// What 95 % intervals are made of.
    const INTERVALS: Intervals;
}

/// What 95 % intervals are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Intervals {
    /// The middle of the fits to other drops.
    Middle,
    /// The errors of fits to simulated drops, over the errors that these fits state: the covariance of the records is estimated in each, as it
    /// was in the fit.
    BySimulatedErrors,
}

/// A parameter that was free.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ParameterEstimate {
    /// Its effect.
    pub effect: &'static str,
    /// Its key.
    #[serde(skip)]
    pub key: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Where the fit began.
    pub start: f64,
    /// Where it ended.
    pub value: f64,
    /// 95 % interval; none from fewer than [`LEAST_RESAMPLED`] fits, nor from resampled drops where a height has fewer than four.
    pub ci95: Option<[f64; 2]>,
    /// Whether it ended at a bound.
    pub at_bound: bool,
}

/// What came out.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The fitted model.
    pub model: Model,
    /// Its free parameters.
    pub estimates: Vec<ParameterEstimate>,
    /// The objective at the start and at the end.
    pub objective: [f64; 2],
    /// What it reads: height, m, and a reading a sample from the trigger on, g.
    pub waves: Vec<(f64, Vec<f64>)>,
    /// Fits to other drops that ended.
    pub resampled: usize,
    /// Share of simulated sets of this model whose fits leave as much, this one among them; none where none are simulated.
    pub p: Option<f64>,
}

/// Fits what a layout leaves free; intervals by so many other sets of drops.
///
/// # Errors
/// When the simulation diverges at the starting values, more parameters are free than numbers are compared, or nothing that is compared depends on a free
/// parameter.
pub fn fit<O: Objective>(objective: &O, layout: &Layout, samples: usize, seed: u64) -> Result<Fit, FitError> {
    let started = objective.residual(&layout.model).ok_or(FitError::Diverges)?;
    let (numbers, free) = (started.len(), layout.free.len());
    if numbers < free {
        return Err(FitError::TooFewNumbers { numbers, free });
    }
    let started = started.norm_squared();
    let best = starts(layout)
        .iter()
        .filter_map(|start| minimum(objective, layout, start))
        .min_by(|a, b| a.sum.total_cmp(&b.sum))
        .ok_or(FitError::Diverges)?;
    if let Some(free) = layout.free.iter().enumerate().find_map(|(at, free)| is_idle(objective, layout, &best.at, at).then_some(free)) {
        return Err(FitError::NoInfluence { key: free.key() });
    }
    let model = layout.model_at(&best.at);
    let waves = objective.waves(&model);
    let others = others(&objective.around(layout, &best.at), &waves, samples, seed);
    let ended: Vec<Minimum> =
        others.par_iter().map(|other| minimum(other, layout, &best.at)).collect::<Vec<_>>().into_iter().flatten().collect();
    let outward = |at: usize, scaled: f64| layout.free[at].outward(scaled);
    let bounds = layout.bounds();
    let is_simulated = O::INTERVALS == Intervals::BySimulatedErrors;
    let estimate = |(at, free): (usize, &super::free::Free)| ParameterEstimate {
        effect: free.spec.id,
        key: free.key(),
        unit: free.spec.parameters[free.at].unit,
        start: layout.model.value(free.spec.id, free.key()).unwrap_or(0.0),
        value: outward(at, best.at[at]),
        ci95: match is_simulated {
            _ if ended.len() < LEAST_RESAMPLED => None,
            false if objective.counts().into_iter().any(|drops| drops < LEAST_DROPS) => None,
            false => Spread::middle(ended.iter().map(|other| outward(at, other.at[at])), 0.95),
            true => by_errors(at, &best, &ended).map(|ends| ends.map(|end| outward(at, end.clamp(bounds[at][0], bounds[at][1])))),
        },
        at_bound: best.at_bound[at],
    };
    let as_much = ended.iter().filter(|other| other.sum >= best.sum).count();
    Ok(Fit {
        waves,
        model,
        estimates: layout.free.iter().enumerate().map(estimate).collect(),
        objective: [objective.value(started), objective.value(best.sum)],
        resampled: ended.len(),
        p: (is_simulated && !ended.is_empty()).then(|| (as_much + 1) as f64 / (ended.len() + 1) as f64),
    })
}

/// Whether what is compared stays the same to the last bit where one parameter goes a step to either side.
fn is_idle<O: Objective>(objective: &O, layout: &Layout, scaled: &[f64], at: usize) -> bool {
    let at_step = |step: f64| {
        let mut moved = scaled.to_vec();
        moved[at] += step;
        objective.residual(&layout.model_at(&moved))
    };
    let step = layout.free[at].step();
    let there = at_step(0.0);
    there.is_some() && at_step(step) == there && at_step(-step) == there
}

/// Objectives of other sets of drops.
fn others<O: Objective>(objective: &O, waves: &[(f64, Vec<f64>)], samples: usize, seed: u64) -> Vec<O> {
    let mut rng = Pcg64::seed_from_u64(seed);
    (0..samples).filter_map(|_| objective.another(waves, &mut rng)).collect()
}

/// An interval, on a parameter's own scale, that is as many stated errors wide as hold the errors of 95 % of simulated fits.
fn by_errors(at: usize, best: &Minimum, simulated: &[Minimum]) -> Option<[f64; 2]> {
    let ratio = |other: &Minimum| Some((other.at[at] - best.at[at]).abs() / stated_error(other, at)?);
    let mut ratios: Vec<f64> = simulated.iter().filter_map(ratio).collect();
    ratios.sort_by(f64::total_cmp);
    let within = (0.95 * (ratios.len() + 1) as f64).ceil() as usize;
    let half = ratios.get(within.checked_sub(1)?.min(ratios.len().checked_sub(1)?))? * stated_error(best, at)?;
    Some([best.at[at] - half, best.at[at] + half])
}

/// Standard error of a parameter by the curvature at a minimum, on its own scale.
fn stated_error(minimum: &Minimum, at: usize) -> Option<f64> {
    inverse(&(minimum.jacobian.transpose() * &minimum.jacobian)).map(|covariance| covariance[(at, at)].sqrt()).filter(|error| *error > 0.0)
}

fn minimum(objective: &impl Objective, layout: &Layout, start: &[f64]) -> Option<Minimum> {
    let residual = |scaled: &[f64]| objective.residual(&layout.model_at(scaled));
    minimise(residual, start, &layout.bounds(), &layout.steps(), MOST_STEPS)
}

/// The model's own values, and others around them: an objective may have more than one minimum.
fn starts(layout: &Layout) -> Vec<Vec<f64>> {
    let own = layout.values();
    let mut starts = vec![own.clone()];
    for (at, free) in layout.free.iter().enumerate() {
        for factor in STARTS {
            let mut moved = own.clone();
            moved[at] = free.inward(free.outward(own[at]) * factor);
            starts.push(moved);
        }
    }
    starts
}
