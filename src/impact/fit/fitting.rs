//! A fit: the minimum of an objective, and how far resampled drops move it.

use nalgebra::DVector;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::chosen::FitError;
use super::free::Layout;
use super::least_squares::{Minimum, minimise};
use crate::impact::effects::Model;
use crate::impact::measured::Spread;

/// Steps of a fit at the most.
const MOST_STEPS: usize = 60;
/// Factors on each starting value, one after the other, for further starts.
const STARTS: [f64; 2] = [0.4, 2.5];

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
    /// The same of other drops: for each height which ones, each as often as it is named.
    fn resampled(&self, picks: &[Vec<usize>]) -> Self;
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
    /// Where 95 % of the resampled fits end.
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
    /// Resampled fits that ended.
    pub resampled: usize,
}

/// Fits what a layout leaves free; intervals by so many bootstrap samples of the drops of each height.
///
/// # Errors
/// When the simulation diverges at the starting values.
pub fn fit(objective: &impl Objective, layout: &Layout, samples: usize, seed: u64) -> Result<Fit, FitError> {
    let started = objective.residual(&layout.model).ok_or(FitError::Diverges)?.norm_squared();
    let best = starts(layout)
        .iter()
        .filter_map(|start| minimum(objective, layout, start))
        .min_by(|a, b| a.sum.total_cmp(&b.sum))
        .ok_or(FitError::Diverges)?;
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut drawn = |count: &usize| -> Vec<usize> { (0..*count).map(|_| rng.random_range(0..*count)).collect() };
    let picks: Vec<Vec<Vec<usize>>> = (0..samples).map(|_| objective.counts().iter().map(&mut drawn).collect()).collect();
    let again: Vec<Option<Minimum>> = picks.par_iter().map(|picks| minimum(&objective.resampled(picks), layout, &best.at)).collect();
    let ended: Vec<Vec<f64>> = again.into_iter().flatten().map(|minimum| minimum.at).collect();
    let outward = |at: usize, scaled: f64| layout.free[at].outward(scaled);
    let estimate = |(at, free): (usize, &super::free::Free)| ParameterEstimate {
        effect: free.spec.id,
        key: free.key(),
        unit: free.spec.parameters[free.at].unit,
        start: layout.model.value(free.spec.id, free.key()).unwrap_or(0.0),
        value: outward(at, best.at[at]),
        ci95: interval(ended.iter().map(|values| outward(at, values[at]))),
        at_bound: best.at_bound[at],
    };
    let model = layout.model_at(&best.at);
    Ok(Fit {
        waves: objective.waves(&model),
        model,
        estimates: layout.free.iter().enumerate().map(estimate).collect(),
        objective: [objective.value(started), objective.value(best.sum)],
        resampled: ended.len(),
    })
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

/// The middle 95 % of values.
fn interval(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    Spread::middle(values, 0.95)
}
