//! Whether touch times are those of four feet in one plane, asked without a model of the impact.
//!
//! Two questions. Does the first spike point along a diagonal, where the feet are? And is the time to the opposite foot what the two
//! between say, drop by drop? Feet in one plane that come down evenly give T(opposite) = T(beside, early) + T(beside, late); where the
//! first foot's push turns the frame the sum is a little too long, by the same factor in every drop. Drops whose times are permuted
//! show what chance gives.

use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;
use statrs::distribution::{Binomial, DiscreteCDF};

use super::observed::{HeightLandings, ObservedLanding, ObservedLandings};
use crate::impact::diagnose::RARE;

/// A direction counts as a diagonal within so much, rad.
const NEAR_RAD: f64 = 15.0 * std::f64::consts::PI / 180.0;
/// Part of all directions within it.
const NULL_SHARE: f64 = 1.0 / 3.0;
/// Permutations.
const PERMUTED: usize = 999;
/// Significance level of directions alone: a frame that rings along one of its sides has some like these.
const VERY_RARE: f64 = 1e-4;

/// What the touch times show.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct TouchEvidence {
    /// Drops with lateral axes.
    pub drops: usize,
    /// Those whose feet were all seen.
    pub seen: usize,
    /// Those whose first spike was seen, whatever the others are: all that a slow logger shows.
    pub first_seen: usize,
    /// p-value of so many of these along a diagonal under even directions.
    pub first_along_diagonals_p: f64,
    /// Fraction of the first spikes along a diagonal, where all feet were seen; a third under the null hypothesis.
    pub along_diagonals: f64,
    /// p-value of that under even directions.
    pub along_diagonals_p: f64,
    /// p-value of so few along a diagonal under even directions: small where the sensor's x and y point along the legs.
    pub along_axes_p: f64,
    /// Time to the opposite foot over the sum of the times to those beside.
    pub ratio: f64,
    /// Median deviation from that, s.
    pub deviation_s: f64,
    /// The same of permuted drops, their median, s.
    pub permuted_deviation_s: f64,
    /// p-value of the deviation under permutation within each height.
    pub plane_p: f64,
}

impl TouchEvidence {
    /// Of some drops; the same seed gives the same permutations.
    pub fn of(observed: &ObservedLandings, seed: u64) -> Self {
        let all = || observed.heights.iter().flat_map(|height| &height.drops);
        let seen = || observed.heights.iter().flat_map(HeightLandings::seen);
        let drops = all().count();
        let is_along = |drop: &&ObservedLanding| is_along_a_diagonal(drop.touches.direction_rad);
        let (along, count) = (seen().filter(is_along).count(), seen().count());
        let along_axes_p = even(count).map_or(1.0, |binomial| binomial.cdf(along as u64));
        let first_seen = || all().filter(|drop| drop.touches.first_seen());
        let first_count = first_seen().count();
        let heights: Vec<Vec<[f64; 2]>> = observed
            .heights
            .iter()
            .map(|height| height.seen().map(|drop| drop.touches.delays_s()).map(|[opposite, a, b]| [opposite, a + b]).collect())
            .collect();
        let (ratio, deviation_s) = deviation(&heights);
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut permuted: Vec<f64> = (0..PERMUTED).map(|_| deviation(&shuffled(&heights, &mut rng)).1).collect();
        permuted.sort_by(f64::total_cmp);
        let as_small = permuted.partition_point(|other| *other <= deviation_s);
        Self {
            drops,
            seen: count,
            first_seen: first_count,
            first_along_diagonals_p: so_many_p(first_seen().filter(is_along).count(), first_count),
            along_diagonals: along as f64 / count.max(1) as f64,
            along_diagonals_p: so_many_p(along, count),
            along_axes_p,
            ratio,
            deviation_s,
            permuted_deviation_s: permuted[PERMUTED / 2],
            plane_p: (as_small + 1) as f64 / (PERMUTED + 1) as f64,
        }
    }

    /// Whether both tests are significant.
    pub fn feet_in_one_plane(&self) -> bool {
        self.along_diagonals_p < RARE && self.plane_p < RARE
    }

    /// Whether first touches point along the diagonals, where the feet are: landings are not level then, also where the other touches cannot be
    /// read.
    pub fn shows_one_foot_first(&self) -> bool {
        self.first_along_diagonals_p < VERY_RARE
    }

    /// Whether the feet seem to lie along the sensor's x and y. Times that are read along diagonals say nothing of a plane then.
    pub fn is_turned(&self) -> bool {
        self.along_axes_p < VERY_RARE
    }
}

/// How many of these directions lie along a diagonal where all are as frequent.
fn even(count: usize) -> Option<Binomial> {
    Binomial::new(NULL_SHARE, count as u64).ok()
}

/// p-value of so many or more of these along a diagonal.
fn so_many_p(along: usize, count: usize) -> f64 {
    match (along as u64).checked_sub(1).zip(even(count)) {
        Some((below, binomial)) => binomial.sf(below),
        None => 1.0,
    }
}

/// Whether a direction counts as one along a diagonal.
pub(super) fn is_along_a_diagonal(direction_rad: f64) -> bool {
    off_diagonal_rad(direction_rad) <= NEAR_RAD
}

/// Angle to the nearest diagonal.
fn off_diagonal_rad(direction_rad: f64) -> f64 {
    let quarter = std::f64::consts::FRAC_PI_2;
    let turned = direction_rad.rem_euclid(quarter);
    (turned - 0.5 * quarter).abs()
}

/// Slope of a line through the origin by least squares, and the median deviation from it.
fn deviation(heights: &[Vec<[f64; 2]>]) -> (f64, f64) {
    let all = || heights.iter().flatten();
    let ratio = all().map(|[opposite, sum]| opposite * sum).sum::<f64>() / all().map(|[_, sum]| sum * sum).sum::<f64>().max(1e-30);
    let mut off: Vec<f64> = all().map(|[opposite, sum]| (opposite - ratio * sum).abs()).collect();
    off.sort_by(f64::total_cmp);
    (ratio, off.get(off.len() / 2).copied().unwrap_or(0.0))
}

/// The sums dealt to other drops of the same height.
fn shuffled(heights: &[Vec<[f64; 2]>], rng: &mut Pcg64) -> Vec<Vec<[f64; 2]>> {
    let deal = |height: &Vec<[f64; 2]>| {
        let mut sums: Vec<f64> = height.iter().map(|[_, sum]| *sum).collect();
        sums.shuffle(rng);
        height.iter().zip(sums).map(|([opposite, _], sum)| [*opposite, sum]).collect()
    };
    heights.iter().map(deal).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_angles_to_the_nearest_diagonal() {
        for (degrees, off) in [(45.0, 0.0), (-45.0, 0.0), (135.0, 0.0), (0.0, 45.0), (60.0, 15.0), (-150.0, 15.0_f64)] {
            let found = off_diagonal_rad(f64::to_radians(degrees)).to_degrees();
            assert!((found - off).abs() < 1e-9, "{degrees}: {found}");
        }
    }

    #[test]
    fn analytic_times_of_a_plane_deviate_less_than_permuted_ones() {
        let plane: Vec<[f64; 2]> = (1..40).map(|i| [0.9 * f64::from(i) * 1e-4, f64::from(i) * 1e-4]).collect();
        let (ratio, off) = deviation(&[plane]);
        assert!((ratio - 0.9).abs() < 1e-12 && off < 1e-12);
    }
}
