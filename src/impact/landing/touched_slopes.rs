//! How slopes spread, by the times at which the opposite feet touch.
//!
//! The late part of a mean wave says it, too: it is made of the steepest landings. Forty records hold few of those, so most sets of
//! records look less steep than they are, and their own covariance trusts them. Fits to both gave slopes a fifth too small. Quartiles of
//! touch times do not depend on the steepest landings.

use nalgebra::DVector;

use super::legged_body::Slopes;
use super::observed::{HeightLandings, QUARTILES};
use super::population::Population;
use super::read_delays::ReadDelays;
use super::table::LandingTable;
use crate::impact::fit::minimise;

/// Standard deviations of the turning rate, rad/s, and of the slope at release, rad, that a fit may end at.
pub const BOUNDS: [[f64; 2]; 2] = [[0.0, 1.5], [0.0, 0.25]];
/// Steps of difference quotients.
pub const STEPS: [f64; 2] = [0.01, 0.004];
/// Values of each number of the slopes among which a fit's begin is looked for: times that were read leave several minima.
const TRIED: [usize; 2] = [40, 20];
/// Most steps of a fit.
const MOST_STEPS: usize = 25;
/// 95 % quantile of chi squared with one degree of freedom.
const CHI_SQUARED_95: f64 = 3.84;
/// Halvings of an interval that is searched.
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

/// Slopes that explain touch times.
#[derive(Clone, Debug)]
pub struct TouchedSlopes {
    /// The slopes.
    pub slopes: Slopes,
    /// Quartiles of the opposite foot's delay, measured less predicted, in independent standard errors, height by height.
    pub residual: DVector<f64>,
}

impl TouchedSlopes {
    /// Fits the turning rate, and the slope at release where that is asked for; `None` where too few feet were seen.
    pub fn of(heights: &[&HeightLandings], tables: &[LandingTable], at_release: bool) -> Option<Self> {
        let slopes = |values: &[f64]| Slopes { rate_rad_s: values[0], at_release_rad: values.get(1).copied().unwrap_or(0.0) };
        Self::with(heights, tables, 0..1 + usize::from(at_release), slopes)
    }

    /// With some of the numbers free.
    fn with(
        heights: &[&HeightLandings],
        tables: &[LandingTable],
        free: std::ops::Range<usize>,
        slopes: impl Fn(&[f64]) -> Slopes,
    ) -> Option<Self> {
        let read: Vec<ReadDelays> =
            heights.iter().zip(tables).map(|(height, table)| ReadDelays::of(table, height.errors.as_ref())).collect();
        let left = |values: &[f64]| left_of_read(heights, tables, &read, &slopes(values));
        let (bounds, steps) = (&BOUNDS[free.clone()], &STEPS[free]);
        let begin = tried(bounds).filter_map(|values| Some((left(&values)?.norm_squared(), values)));
        let (_, begin) = begin.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let found = minimise(left, &begin, bounds, steps, MOST_STEPS)?;
        Some(Self { slopes: slopes(&found.at), residual: found.residual })
    }

    /// The largest value of a number of the slopes, rad/s or rad, that the touch times allow: with it and the other number free the sum of
    /// squares is by 3.84, the 95 % quantile of chi squared, above that without.
    pub fn most(number: SlopeNumber, heights: &[&HeightLandings], tables: &[LandingTable]) -> Option<f64> {
        let (held_at, free_at) = if number == SlopeNumber::Rate { (0, 1) } else { (1, 0) };
        let sum = |held: f64| {
            let slopes = |values: &[f64]| number.held(held, values[0]);
            Some(Self::with(heights, tables, free_at..free_at + 1, slopes)?.residual.norm_squared())
        };
        let limit = sum(0.0)? + CHI_SQUARED_95;
        let [mut low, mut high] = BOUNDS[held_at];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if sum(middle)? > limit { high = middle } else { low = middle }
        }
        Some(low)
    }
}

/// Deviations of three quartiles of one sample, each over its standard error, as independent ones.
///
/// Quantiles of a sample are correlated by √(p (1 - q) / (q (1 - p))), p < q: each depends on the one before alone (the Brownian bridge).
pub fn decorrelated([low, middle, high]: [f64; 3]) -> [f64; 3] {
    let correlation = 1.0 / 3.0_f64.sqrt();
    let own = |value: f64, before: f64| (value - correlation * before) / (1.0 - correlation * correlation).sqrt();
    [low, own(middle, low), own(high, middle)]
}

/// Where a fit may begin: denser towards zero; of two numbers each with each.
fn tried(bounds: &[[f64; 2]]) -> impl Iterator<Item = Vec<f64>> {
    let count = TRIED[bounds.len() - 1];
    let places = count.pow(bounds.len() as u32);
    let value = move |[low, high]: &[f64; 2], step: usize| low + (high - low) * ((step as f64 + 0.5) / count as f64).powi(2);
    let bounds = bounds.to_vec();
    (0..places).map(move |place| bounds.iter().enumerate().map(|(at, bound)| value(bound, place / count.pow(at as u32) % count)).collect())
}

/// Quartiles, measured less predicted, over their standard errors and without their correlation.
pub fn left_of_quartiles(heights: &[&HeightLandings], tables: &[LandingTable], slopes: &Slopes) -> Option<DVector<f64>> {
    let read: Vec<ReadDelays> = heights.iter().zip(tables).map(|(height, table)| ReadDelays::of(table, height.errors.as_ref())).collect();
    left_of_read(heights, tables, &read, slopes)
}

/// The same of times that are in order.
fn left_of_read(heights: &[&HeightLandings], tables: &[LandingTable], read: &[ReadDelays], slopes: &Slopes) -> Option<DVector<f64>> {
    let mut all = Vec::with_capacity(QUARTILES.len() * heights.len());
    for ((height, table), read) in heights.iter().zip(tables).zip(read) {
        let predicted_s = read.quantiles_s(Population::of(table, slopes).weights(), QUARTILES);
        let measured = height.opposite_quartiles_s()?;
        all.extend(decorrelated(std::array::from_fn(|at| (measured[at].0 - predicted_s[at]) / measured[at].1)));
    }
    Some(DVector::from_vec(all))
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    use super::*;

    /// Of 4000 samples of 401 numbers.
    #[test]
    fn analytic_quartiles_are_independent_of_each_other_afterwards() {
        let mut rng = Pcg64::seed_from_u64(4);
        let error = |share: f64| (share * (1.0 - share) / 401.0_f64).sqrt();
        let samples: Vec<[f64; 3]> = (0..4000)
            .map(|_| {
                let mut sample: Vec<f64> = (0..401).map(|_| rng.random::<f64>()).collect();
                sample.sort_by(f64::total_cmp);
                decorrelated(std::array::from_fn(|at| (sample[100 * (at + 1)] - QUARTILES[at]) / error(QUARTILES[at])))
            })
            .collect();
        for a in 0..3 {
            for b in 0..3 {
                let product = samples.iter().map(|sample| sample[a] * sample[b]).sum::<f64>() / 4000.0;
                assert!((product - f64::from(u8::from(a == b))).abs() < 0.07, "{a} {b}: {product}");
            }
        }
    }
}
