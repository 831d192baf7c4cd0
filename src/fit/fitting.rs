//! A fit: the minimum of an objective, and how far resampled drops move it.

use nalgebra::DVector;
use rayon::prelude::*;

use super::chosen::Unfit;
use super::free::Layout;
use super::least_squares::{Minimum, minimise};
use crate::effects::Model;
use crate::measured::Spread;

/// Steps of a fit at the most.
const MOST_STEPS: usize = 60;
/// Factors on each starting value, one after the other, for further starts.
const STARTS: [f64; 2] = [0.4, 2.5];

/// Something to be made small by a model.
pub trait Objective: Sync + Sized {
    /// Drops a height.
    fn counts(&self) -> Vec<usize>;
    /// Numbers whose squares are summed; `None` where the model does not hold the body.
    fn residual(&self, model: &Model) -> Option<DVector<f64>>;
    /// Height, m, and what a model reads from it at each sample from the trigger on, g.
    fn waves(&self, model: &Model) -> Vec<(f64, Vec<f64>)>;
    /// What the sum of squares is reported as.
    fn value(&self, sum: f64) -> f64;
    /// The same of other drops: for each height which ones, each as often as it is named.
    fn resampled(&self, picks: &[Vec<usize>]) -> Self;
}

/// A parameter that was free.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Its effect.
    pub effect: &'static str,
    /// Its key.
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
    pub estimates: Vec<Estimate>,
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
/// When the model does not hold the body at the starting values.
pub fn fit(objective: &impl Objective, layout: &Layout, samples: usize, seed: u64) -> Result<Fit, Unfit> {
    let started = objective.residual(&layout.model).ok_or(Unfit::RunsAway)?.norm_squared();
    let best = starts(layout)
        .iter()
        .filter_map(|start| minimum(objective, layout, start))
        .min_by(|a, b| a.sum.total_cmp(&b.sum))
        .ok_or(Unfit::RunsAway)?;
    let mut draws = Draws(seed);
    let picks: Vec<Vec<Vec<usize>>> = (0..samples).map(|_| objective.counts().iter().map(|count| draws.picks(*count)).collect()).collect();
    let again: Vec<Option<Minimum>> = picks.par_iter().map(|picks| minimum(&objective.resampled(picks), layout, &best.at)).collect();
    let ended: Vec<Vec<f64>> = again.into_iter().flatten().map(|minimum| minimum.at).collect();
    let outward = |at: usize, scaled: f64| layout.free[at].outward(scaled);
    let estimate = |(at, free): (usize, &super::free::Free)| Estimate {
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

/// Random numbers that are the same for the same seed on every machine: SplitMix64 (G. Steele, D. Lea, C. Flood, *Fast
/// Splittable Pseudorandom Number Generators*, OOPSLA 2014).
struct Draws(u64);

impl Draws {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// As many places below `count` as there are, drawn with replacement.
    fn picks(&mut self, count: usize) -> Vec<usize> {
        (0..count).map(|_| ((u128::from(self.next()) * count as u128) >> 64) as usize).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_draws_are_those_of_the_published_generator() {
        // The reference implementation's first outputs for the seed 1234567.
        let mut draws = Draws(1_234_567);
        assert_eq!([draws.next(), draws.next()], [6_457_827_717_110_365_317, 3_203_168_211_198_807_973]);
    }

    #[test]
    fn analytic_picks_are_even() {
        let mut draws = Draws(7);
        let mut counts = [0; 4];
        for _ in 0..1000 {
            draws.picks(4).into_iter().for_each(|pick| counts[pick] += 1);
        }
        assert!(counts.iter().all(|count| (900..1100).contains(count)), "{counts:?}");
    }
}
