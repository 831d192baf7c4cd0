//! Whether predictions from their touches explain single drops, but for what varies from drop to drop.
//!
//! What touches leave of the drops of a height has a mean. It is compared with its standard error, reading by reading, and the largest ratio
//! with those of the same drops, each of which keeps or changes the sign of what is its own (the wild bootstrap; C. F. J. Wu, Ann. Statist. 14
//! (1986) 1261). What the method itself is off is part of both. Slopes that happened to be drawn do not count, as they do in the mean waves, so this test is the sharper one.
//!
//! *When it is wrong:* legs are fitted to the same drops, which makes deviations smaller, so true models are rejected less often than stated.

use nalgebra::DVector;
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::drop_weights::METHOD;
use super::fitting::{LandingFit, LandingProblem};
use super::population::Population;

/// Sets of signs.
const SIGNED: usize = 999;
/// Readings of a mean wave below as many times what the method is off are left out: damping alone, which gives the first ones, is off by 7 %.
const FAINT: f64 = 6.0;

/// The reading at which what touches leave is largest, in standard errors.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct TouchAdequacy {
    /// p-value of it.
    pub p: f64,
    /// Of drops from this height, m.
    pub height_m: f64,
    /// Behind the trigger, s.
    pub at_s: f64,
    /// Measured less predicted, g.
    pub left_g: f64,
    /// Its standard error, g.
    pub error_g: f64,
}

impl TouchAdequacy {
    /// Of a fit; `None` where a landing is lost.
    pub fn of(problem: &LandingProblem, fit: &LandingFit, step_s: f64, seed: u64) -> Option<Self> {
        let tables = problem.tables(&fit.legs, &fit.slopes)?;
        let heights: Vec<Left> = problem
            .waves
            .chosen
            .iter()
            .zip(tables.iter())
            .map(|(height, table)| {
                Left::of(problem.left_by_drops(*height, &Population::of(table, &fit.slopes)), &problem.waves.means[*height].wave)
            })
            .collect();
        let largest = |of: &Left| of.ratios(&of.mean).enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        let each = heights.iter().zip(&problem.waves.chosen).filter_map(|(of, height)| Some((of, height, largest(of)?)));
        let (of, height, (reading, ratio)) = each.max_by(|a, b| a.2.1.total_cmp(&b.2.1))?;
        let mut rng = Pcg64::new(u128::from(seed), 5);
        let as_large = (0..SIGNED).filter(|_| heights.iter().map(|of| of.largest_signed(&mut rng)).fold(0.0, f64::max) >= ratio).count();
        // The window begins one reading before the trigger.
        let at_s = (reading as f64 - 1.0) * step_s;
        let (left_g, error_g) = (of.mean[reading], of.errors[reading]);
        let p = (as_large + 1) as f64 / (SIGNED + 1) as f64;
        Some(Self { p, height_m: problem.waves.means[*height].height_m, at_s, left_g, error_g })
    }
}

/// What touches leave of the drops of a height.
struct Left {
    /// Of each drop beside the mean, g.
    own: Vec<DVector<f64>>,
    mean: DVector<f64>,
    /// Standard errors of the mean, g; infinite where readings are left out.
    errors: DVector<f64>,
    /// Standard deviation of what the method is off, g.
    method_g: f64,
}

impl Left {
    fn of(mut drops: Vec<DVector<f64>>, wave: &[f64]) -> Self {
        let count = drops.len() as f64;
        let mean = drops.iter().fold(DVector::zeros(wave.len()), |sum, drop| sum + drop) / count;
        drops.iter_mut().for_each(|drop| *drop -= &mean);
        let method_g = METHOD * wave.iter().copied().fold(0.0, f64::max);
        let error = |reading: usize| {
            let squares: f64 = drops.iter().map(|drop| drop[reading] * drop[reading]).sum();
            let seen = wave[reading].abs() >= FAINT * method_g;
            if seen { libm::hypot((squares / (count * (count - 1.0))).sqrt(), method_g) } else { f64::INFINITY }
        };
        let errors = DVector::from_iterator(wave.len(), (0..wave.len()).map(error));
        Self { own: drops, mean, errors, method_g }
    }

    /// A mean over its standard errors.
    fn ratios<'a>(&'a self, mean: &'a DVector<f64>) -> impl Iterator<Item = f64> + 'a {
        mean.iter().zip(self.errors.iter()).map(|(mean, error)| (mean / error).abs())
    }

    /// The largest ratio of the drops with random signs.
    fn largest_signed(&self, rng: &mut Pcg64) -> f64 {
        let mut sum = DVector::zeros(self.mean.len());
        for own in &self.own {
            if rng.random() { sum += own } else { sum -= own }
        }
        let off = |_| self.method_g * Distribution::<f64>::sample(&StandardNormal, rng);
        let mean = sum / self.own.len() as f64 + DVector::from_iterator(self.mean.len(), (0..self.mean.len()).map(off));
        self.ratios(&mean).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;

    /// p-values of the largest ratio, for drops with a mean of zero and for ones with a deviation at one reading.
    fn p(deviation_g: f64, seed: u64) -> f64 {
        let mut rng = Pcg64::seed_from_u64(seed);
        let wave: Vec<f64> = (0..31).map(|i| 60.0 * libm::sin(f64::from(i) / 10.0).max(0.0)).collect();
        let drops = (0..40).map(|_| {
            let common: f64 = StandardNormal.sample(&mut rng);
            let mut drop =
                DVector::from_iterator(31, (0..31).map(|_| 8.0 * common + 10.0 * Distribution::<f64>::sample(&StandardNormal, &mut rng)));
            drop[8] += deviation_g;
            drop
        });
        let left = Left::of(drops.collect(), &wave);
        let ratio = left.ratios(&left.mean).fold(0.0, f64::max);
        let as_large = (0..SIGNED).filter(|_| left.largest_signed(&mut rng) >= ratio).count();
        (as_large + 1) as f64 / (SIGNED + 1) as f64
    }

    #[test]
    fn analytic_drops_without_a_mean_are_rarely_rejected_and_a_deviation_is_found() {
        let rejected = |deviation_g: f64| (0..60).filter(|seed| p(deviation_g, *seed) < 0.05).count();
        assert!((0..=6).contains(&rejected(0.0)), "{}", rejected(0.0));
        assert!(rejected(14.0) >= 55, "{}", rejected(14.0));
    }

    #[test]
    fn analytic_readings_without_a_wave_are_left_out() {
        let drops = vec![DVector::from_vec(vec![1.0, 5.0]), DVector::from_vec(vec![1.2, 4.0])];
        assert_eq!(Left::of(drops, &[0.1, 40.0]).errors[0], f64::INFINITY);
    }
}
