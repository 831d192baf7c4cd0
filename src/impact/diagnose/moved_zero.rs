//! Whether the sensor's zero moved from height to height.
//!
//! Each drop says where zero is by its mean in free fall. The medians of the heights are compared with the scatter of drops within heights, in the
//! way of an analysis of variance, by medians because some falls are none. As many normal drops from a zero that stays show what chance gives:
//! the errors of medians of few drops are known too badly for a distribution of many. *When it is wrong:* the scatter of drops is taken to be the
//! same from all heights.

use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use crate::impact::measured::Spread;

/// Simulated sets.
const SIMULATED: usize = 999;
/// Seed of these.
const SEED: u64 = 17;
/// Least scatter, g: a hundredth of the converter's step, for sensors without noise.
const LEAST_SCATTER_G: f64 = 1e-3;
/// Mean distance of a standard normal value from its mean, √(2/π). The median distance would find much less: of the zeros of five drops a height that
/// are five deviations apart, a half in place of nearly all.
const NORMAL_DISTANCE: f64 = 0.797_885;

/// A height with the zeros of its drops.
pub(super) struct HeightZeros {
    /// The height, m.
    pub height_m: f64,
    /// Mean of each drop in free fall, g.
    pub zeros_g: Vec<f64>,
}

impl HeightZeros {
    /// The middle one, g.
    pub fn median_g(&self) -> Option<f64> {
        Spread::of(self.zeros_g.iter().copied()).map(|spread| spread.median)
    }

    /// Distance of each drop from the middle one, g.
    fn distances_g(&self) -> impl Iterator<Item = f64> {
        let middle_g = self.median_g().unwrap_or(0.0);
        self.zeros_g.iter().map(move |zero_g| (zero_g - middle_g).abs())
    }
}

/// p-value of zeros so far apart, where the true one is a line over the height whose slope is 0 to `most_slope`, g/m. `None` where there are fewer
/// than two heights, or no height has two drops.
pub(super) fn moved_zero_p(heights: &[HeightZeros], most_slope: f64) -> Option<f64> {
    let (squares, scatter_g) = apart(heights, most_slope, LEAST_SCATTER_G)?;
    // In units of the scatter, as the simulated sets are.
    let slope = most_slope / scatter_g;
    let mut rng = Pcg64::seed_from_u64(SEED);
    let mut simulated = || {
        let set: Vec<HeightZeros> = heights.iter().map(|height| like(height, &mut rng)).collect();
        apart(&set, slope, 0.0).map(|(squares, _)| squares)
    };
    let as_far = (0..SIMULATED).filter_map(|_| simulated()).filter(|other| *other >= squares).count();
    Some((as_far + 1) as f64 / (SIMULATED + 1) as f64)
}

/// As many normal values with a deviation of one.
fn like(height: &HeightZeros, rng: &mut Pcg64) -> HeightZeros {
    HeightZeros { height_m: height.height_m, zeros_g: height.zeros_g.iter().map(|_| StandardNormal.sample(rng)).collect() }
}

/// Squares of the heights' medians about the line that is nearest to them, in units of the scatter of a drop; and that scatter.
fn apart(heights: &[HeightZeros], most_slope: f64, least_scatter: f64) -> Option<(f64, f64)> {
    let medians: Vec<(f64, f64, f64)> =
        heights.iter().filter_map(|height| Some((height.height_m, height.median_g()?, height.zeros_g.len() as f64))).collect();
    let distances: Vec<f64> = heights.iter().filter(|height| height.zeros_g.len() > 1).flat_map(HeightZeros::distances_g).collect();
    let mean = distances.iter().sum::<f64>() / distances.len().max(1) as f64;
    let scatter = (mean / NORMAL_DISTANCE).max(least_scatter);
    (medians.len() > 1 && !distances.is_empty() && scatter > 0.0).then(|| (squares(&medians, most_slope) / (scatter * scatter), scatter))
}

/// Squares of values about a line whose slope is 0 to `most_slope`: place, value and weight come in.
fn squares(values: &[(f64, f64, f64)], most_slope: f64) -> f64 {
    let sum: f64 = values.iter().map(|(_, _, weight)| weight).sum();
    let mean = |of: &dyn Fn(f64, f64) -> f64| values.iter().map(|(place, value, weight)| weight * of(*place, *value)).sum::<f64>() / sum;
    let [place, value] = [mean(&|place, _| place), mean(&|_, value| value)];
    let along = mean(&|p, v| (p - place) * (v - value));
    let square = mean(&|p, _| (p - place) * (p - place));
    let slope = if square > 0.0 { (along / square).clamp(0.0, most_slope) } else { 0.0 };
    sum * mean(&|p, v| (v - value - slope * (p - place)).powi(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    const DRAG_G_M: f64 = 0.165;

    fn drops(zeros: &[(f64, f64)], count: usize, scatter_g: f64, seed: u64) -> Vec<HeightZeros> {
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut rng) };
        let each = |(height_m, zero_g): &(f64, f64)| HeightZeros {
            height_m: *height_m,
            zeros_g: (0..count).map(|_| zero_g + scatter_g * normal()).collect(),
        };
        zeros.iter().map(each).collect()
    }

    /// A sensor with one zero that reads the drag of a fall: 0.827 β h over its last four fifths.
    #[test]
    fn analytic_drag_along_the_axis_is_no_change_of_zero() {
        let p = |zeros: [f64; 3], slope: f64| {
            let [low, middle, high] = zeros;
            moved_zero_p(&drops(&[(0.5, low), (1.0, middle), (1.5, high)], 20, 0.005, 3), slope).expect("there are three heights")
        };
        let drag = [0.5, 1.0, 1.5].map(|height_m| 0.1 + 0.827 * 0.038 * height_m);
        assert!(p(drag, DRAG_G_M) > 0.1 && p(drag, 0.0) < 2e-3);
        // More than any frame's drag, and falling with the height.
        assert!(p([0.25, 0.5, 0.75], DRAG_G_M) < 2e-3 && p([-0.015, -0.03, -0.045], DRAG_G_M) < 2e-3);
    }

    /// By the errors of medians of five drops, a third of such sets would be called moved.
    #[test]
    fn planted_few_drops_of_a_zero_that_stays_are_rarely_called_moved() {
        for count in [3, 5, 20] {
            let heights = [(0.5, 0.1), (1.0, 0.1), (1.5, 0.1)];
            let p: Vec<f64> = (0..100).filter_map(|seed| moved_zero_p(&drops(&heights, count, 0.02, seed), 0.0)).collect();
            let below = |level: f64| p.iter().filter(|p| **p < level).count();
            assert!(p.len() == 100 && below(0.01) <= 5 && (1..=20).contains(&below(0.1)), "{count}: {} {}", below(0.01), below(0.1));
        }
    }

    #[test]
    fn planted_a_zero_that_moved_is_found_with_five_drops_a_height_and_two_heights() {
        let found = |seed: &u64| moved_zero_p(&drops(&[(0.5, 0.1), (1.5, 0.3)], 5, 0.02, *seed), 0.0).is_some_and(|p| p < 3e-3);
        assert!((0..40).filter(found).count() >= 38);
    }

    #[test]
    fn analytic_one_height_and_single_drops_say_nothing() {
        assert_eq!(moved_zero_p(&drops(&[(0.5, 0.1)], 5, 0.02, 1), 0.0), None);
        assert_eq!(moved_zero_p(&drops(&[(0.5, 0.1), (1.0, 0.9)], 1, 0.02, 1), 0.0), None);
        assert_eq!(moved_zero_p(&[], 0.0), None);
    }

    /// A sensor without noise, whose zero stays or moves by more than a hundredth of a step.
    #[test]
    fn analytic_without_noise_a_zero_moves_or_stays() {
        let p = |zero_g: f64| moved_zero_p(&drops(&[(0.5, 0.0), (1.0, zero_g)], 6, 0.0, 1), 0.0);
        assert!(p(0.0) == Some(1.0) && p(0.1).is_some_and(|p| p < 2e-3));
    }
}
