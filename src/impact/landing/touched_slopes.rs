//! How slopes spread, by the touch times of all drops.
//!
//! The late part of a mean wave says it, too: it is made of the steepest landings. Forty records hold few of those, so most sets of
//! records look less steep than they are, and their own covariance trusts them. Fits to both gave slopes a fifth too small. Each drop's touch
//! times have a likelihood at each slope of its height's table; a population weighs the slopes, and the most likely population is taken.
//!
//! *When it is wrong:* landings steeper than the table's grid, and touch times whose errors are far from those of [`likelihoods`].

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::legged_body::Slopes;
use super::observed::{FEWEST, HeightLandings};
use super::population::Population;
use super::posterior::likelihoods;
use super::table::LandingTable;
use crate::impact::fit::inverse;

/// Standard deviations of the turning rate, rad/s, and of the slope at release, rad, that a fit may end at.
pub const BOUNDS: [[f64; 2]; 2] = [[0.0, 1.5], [0.0, 0.25]];
/// Steps of difference quotients.
pub const STEPS: [f64; 2] = [0.01, 0.004];
/// Values of each number of the slopes among which a fit's begin is looked for.
const TRIED: [usize; 2] = [40, 20];
/// Most steps of the search from there, and the fall of the deviance below which a step is the last.
const MOST_STEPS: usize = 25;
const SETTLED: f64 = 1e-4;
/// Part of a step of difference quotients over which scores are taken: those over a whole one add up to nothing half of it off the maximum.
const FINE: f64 = 0.02;
/// 95 % quantile of chi squared with one degree of freedom.
const CHI_SQUARED_95: f64 = 3.84;
/// Slopes at release, beside none, whose likelihoods are compared.
const BESIDE: usize = 8;
/// Halvings of an interval that is searched, and of a step that does not lower the deviance.
const HALVINGS: usize = 8;

/// One of the two numbers of slopes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlopeNumber {
    /// Turning rate at release.
    Rate,
    /// Slope at release.
    AtRelease,
}

impl SlopeNumber {
    /// In the order of a fit.
    pub const ALL: [Self; 2] = [Self::Rate, Self::AtRelease];

    /// Slopes with this number held and the other one free.
    fn held(self, held: f64, free: f64) -> Slopes {
        match self {
            Self::Rate => Slopes { rate_rad_s: held, at_release_rad: free },
            Self::AtRelease => Slopes { rate_rad_s: free, at_release_rad: held },
        }
    }
}

/// The likelihood of each drop's touch times at each slope of its height's table.
#[derive(Clone, Debug)]
pub struct TouchLikelihood<'a> {
    heights: Vec<(&'a LandingTable, Vec<DVector<f64>>)>,
}

/// Slopes that explain touch times.
#[derive(Clone, Copy, Debug)]
pub struct TouchedSlopes {
    /// The slopes.
    pub slopes: Slopes,
    /// Twice the negative logarithm of their likelihood: differences are compared with chi squared.
    pub deviance: f64,
}

impl<'a> TouchLikelihood<'a> {
    /// Of all drops of some heights; `None` where too few feet were seen.
    pub fn of(heights: &[&HeightLandings], tables: &'a [LandingTable]) -> Option<Self> {
        Self::read_no_better(heights, tables, 0.0)
    }

    /// The same with touch times that are not read better than within so much, s.
    pub fn read_no_better(heights: &[&HeightLandings], tables: &'a [LandingTable], least_s: f64) -> Option<Self> {
        let one = |(height, table): (&&HeightLandings, &'a LandingTable)| {
            let read_s = height.read_s().max(least_s);
            let drops = height.drops.par_iter().map(|drop| likelihoods(table, &drop.touches, read_s)).collect();
            (height.seen().count() >= FEWEST).then_some((table, drops))
        };
        Some(Self { heights: heights.iter().zip(tables).map(one).collect::<Option<_>>()? })
    }

    /// Logarithm of each drop's likelihood in a population, height by height.
    pub fn of_drops(&self, slopes: &Slopes) -> DVector<f64> {
        let each = self.heights.iter().flat_map(|(table, drops)| {
            let population = Population::of(table, slopes);
            drops.iter().map(|drop| libm::log(drop.dot(population.weights()))).collect::<Vec<_>>()
        });
        DVector::from_vec(each.collect())
    }

    /// The most likely slopes: the turning rate, and the slope at release where that is asked for.
    pub fn slopes(&self, at_release: bool) -> TouchedSlopes {
        let slopes = |values: &[f64]| Slopes { rate_rad_s: values[0], at_release_rad: values.get(1).copied().unwrap_or(0.0) };
        self.most_likely(0..1 + usize::from(at_release), slopes)
    }

    /// The largest value of a number of the slopes, rad/s or rad, that the touch times allow: with it and the other number free the deviance
    /// is by 3.84, the 95 % quantile of chi squared, above that without.
    pub fn most(&self, number: SlopeNumber) -> f64 {
        let limit = self.with(number, 0.0).deviance + CHI_SQUARED_95;
        let [mut low, mut high] = BOUNDS[number as usize];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.with(number, middle).deviance > limit { high = middle } else { low = middle }
        }
        low
    }

    /// The smallest value of a number of the slopes, rad/s or rad, that the touch times allow, below one that they do: with it and the other number
    /// free the deviance is by 3.84 above the least one.
    pub fn least(&self, number: SlopeNumber, allowed: f64) -> f64 {
        let limit = self.slopes(true).deviance + CHI_SQUARED_95;
        let allows = |value: f64| self.with(number, value).deviance <= limit;
        if allows(0.0) {
            return 0.0;
        }
        let [mut low, mut high] = [0.0, allowed];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if allows(middle) { high = middle } else { low = middle }
        }
        high
    }

    /// Slopes at release that may be the true ones, none of them first, each with the turning rate that is likeliest beside it, and how likely both
    /// are: what is integrated over slopes at release in even steps.
    pub fn beside_slopes_at_release(&self) -> Vec<(Slopes, f64)> {
        let most = self.most(SlopeNumber::AtRelease);
        let place = |at: usize| self.with(SlopeNumber::AtRelease, most * at as f64 / BESIDE as f64);
        let all: Vec<TouchedSlopes> = (0..=BESIDE).map(place).collect();
        let least = all.iter().map(|one| one.deviance).fold(f64::INFINITY, f64::min);
        // The first and the last one stand for half a step.
        let step = |at: usize| if at == 0 || at == BESIDE { 0.5 } else { 1.0 };
        all.into_iter().enumerate().map(|(at, one)| (one.slopes, step(at) * libm::exp(0.5 * (least - one.deviance)))).collect()
    }

    /// The most likely slopes with one of their numbers held.
    fn with(&self, number: SlopeNumber, held: f64) -> TouchedSlopes {
        let free_at = if number == SlopeNumber::Rate { 1 } else { 0 };
        self.most_likely(free_at..free_at + 1, |values| number.held(held, values[0]))
    }

    /// How much likelier the touch times are with a turning rate for each height than with slopes for all: the fall of the deviance.
    pub fn fall_with_own_rates(&self, of_all: &Slopes) -> f64 {
        let own = |height: &(&'a LandingTable, Vec<DVector<f64>>)| Self { heights: vec![height.clone()] }.slopes(false).deviance;
        self.deviance(of_all) - self.heights.iter().map(own).sum::<f64>()
    }

    fn deviance(&self, slopes: &Slopes) -> f64 {
        -2.0 * self.of_drops(slopes).sum()
    }

    /// With some of the numbers free: the best of those tried, and from there by scoring.
    fn most_likely(&self, free: std::ops::Range<usize>, slopes: impl Fn(&[f64]) -> Slopes) -> TouchedSlopes {
        let (bounds, steps) = (&BOUNDS[free.clone()], &STEPS[free]);
        let deviance = |values: &[f64]| self.deviance(&slopes(values));
        let begins = tried(bounds).map(|values| (deviance(&values), values));
        let best = |a: (f64, Vec<f64>), b: (f64, Vec<f64>)| if b.0 < a.0 { b } else { a };
        let (mut least, mut at) = begins.fold((f64::INFINITY, Vec::new()), best);
        for _ in 0..MOST_STEPS {
            let Some(step) = self.scoring_step(&at, bounds, steps, &slopes) else { break };
            let parts = (0..HALVINGS).map(|halvings| {
                let part = 0.5_f64.powi(halvings as i32);
                at.iter()
                    .zip(step.iter())
                    .zip(bounds)
                    .map(|((value, step), [low, high])| (value + part * step).clamp(*low, *high))
                    .collect()
            });
            let better = parts.map(|values: Vec<f64>| (deviance(&values), values)).find(|(deviance, _)| *deviance < least);
            let Some((deviance, values)) = better else { break };
            let fell = least - deviance;
            (least, at) = (deviance, values);
            if fell < SETTLED {
                break;
            }
        }
        // A number so small that the touch times cannot tell it from none is none.
        for number in 0..at.len() {
            let mut without = at.clone();
            without[number] = 0.0;
            let deviance = deviance(&without);
            if at[number] < steps[number] && deviance < least + SETTLED {
                (least, at) = (deviance, without);
            }
        }
        TouchedSlopes { slopes: slopes(&at), deviance: least }
    }

    /// The step to where the drops' scores add up to nothing, by the sum of their squares as the information (E. K. Berndt, B. H. Hall, R. E. Hall, J. A.
    /// Hausman, Annals of Economic and Social Measurement 3 (1974) 653).
    fn scoring_step(&self, at: &[f64], bounds: &[[f64; 2]], steps: &[f64], slopes: impl Fn(&[f64]) -> Slopes) -> Option<DVector<f64>> {
        let here = self.of_drops(&slopes(at));
        let score = |number: usize| {
            let step = FINE * if at[number] + steps[number] > bounds[number][1] { -steps[number] } else { steps[number] };
            let mut moved = at.to_vec();
            moved[number] += step;
            (self.of_drops(&slopes(&moved)) - &here) / step
        };
        let scores = DMatrix::from_columns(&(0..at.len()).map(score).collect::<Vec<_>>());
        Some(inverse(&(scores.transpose() * &scores))? * scores.row_sum_tr())
    }
}

/// Where a fit may begin: at none, and denser towards it; of two numbers each with each.
fn tried(bounds: &[[f64; 2]]) -> impl Iterator<Item = Vec<f64>> {
    let between = TRIED[bounds.len() - 1];
    let count = between + 1;
    let places = count.pow(bounds.len() as u32);
    let share = move |step: usize| step.checked_sub(1).map_or(0.0, |step| ((step as f64 + 0.5) / between as f64).powi(2));
    let value = move |[low, high]: &[f64; 2], step: usize| low + (high - low) * share(step);
    let bounds = bounds.to_vec();
    (0..places).map(move |place| bounds.iter().enumerate().map(|(at, bound)| value(bound, place / count.pow(at as u32) % count)).collect())
}
