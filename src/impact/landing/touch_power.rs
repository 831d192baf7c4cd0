//! How many drops tell a slope that grows with the fall from one that does not.
//!
//! If height and session change together, a turning rate at release cannot be distinguished from steeper releases on another day.
//! Dropped in one session, the two differ: a turning rate gives the same touch times from all heights, a slope at release gives
//! times in proportion to 1/v0. Simulated experiments of either kind are judged by the ratio of the median times from two heights.

use rand::SeedableRng;
use rand::distr::Distribution;
use rand::distr::weighted::WeightedIndex;
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;

use super::legged_body::Slopes;
use super::population::Population;
use super::table::LandingTable;
use super::touches::LAST_S;
use crate::impact::diagnose::{COUNTS, SIMULATED};
use crate::impact::measured::Spread;

/// Part of the experiments of either kind that may be judged wrongly.
const WRONG: f64 = 0.05;

/// Fewest drops from each of two heights, the lower one's landings first; touch times are read with a standard deviation of `read_s`.
pub fn drops_to_tell(tables: [&LandingTable; 2], slopes: &Slopes, read_s: f64, seed: u64) -> Option<usize> {
    let fixed = Slopes { rate_rad_s: 0.0, at_release_rad: slopes.deviation_rad(tables[0].fall_s) };
    let growing = tables.map(|table| Population::of(table, slopes));
    let constant = tables.map(|table| Population::of(table, &fixed));
    let ratio = |[low, high]: &[Population; 2]| libm::log(high.opposite_delay_s(0.5) / low.opposite_delay_s(0.5));
    let [of_growing, of_constant] = [ratio(&growing), ratio(&constant)];
    let limit = 0.5 * (of_growing + of_constant);
    if of_growing.is_nan() || of_growing <= of_constant {
        return None;
    }
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut above = |populations: &[Population; 2], count: usize| {
        let over = |_: &usize| Some(read_ratio(tables, populations, read_s, count, &mut rng)? > limit);
        let mut over = over;
        (0..SIMULATED).filter(|at| over(at) == Some(true)).count() as f64 / SIMULATED as f64
    };
    COUNTS.into_iter().find(|count| above(&growing, *count) >= 1.0 - WRONG && above(&constant, *count) <= WRONG)
}

/// Logarithm of the ratio of the median times of so many drops from each height, as they would be read.
fn read_ratio(tables: [&LandingTable; 2], populations: &[Population; 2], read_s: f64, count: usize, rng: &mut Pcg64) -> Option<f64> {
    let mut medians = [0.0; 2];
    for ((median, table), population) in medians.iter_mut().zip(tables).zip(populations) {
        let law = WeightedIndex::new(population.weights().iter()).ok()?;
        let times = (0..count).filter_map(|_| {
            let noise: f64 = StandardNormal.sample(rng);
            let delay_s = table.delays_s[law.sample(rng)][0];
            (delay_s < LAST_S).then_some((delay_s + read_s * noise).max(0.0))
        });
        *median = Spread::of(times)?.median.max(1e-6);
    }
    Some(libm::log(medians[1] / medians[0]))
}
