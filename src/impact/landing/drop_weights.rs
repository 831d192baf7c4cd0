//! How much each reading of a drop tells a fit.
//!
//! What the touches of a drop leave of its readings varies more at some readings than at others, and what neighbouring readings are off is alike.
//! The legs are fitted in units of that covariance (generalised least squares; A. C. Aitken, Proc. R. Soc. Edinb. 55 (1935) 42). It is taken from
//! what a first fit leaves, of all heights together: each height's readings in units of its mean wave. Only what is each drop's own counts; a mean
//! that the model misses would otherwise be given for variation.
//!
//! *When it is wrong:* where what varies from drop to drop has another course in time at one height than at another; where a first fit is so far off
//! that what it leaves varies as its own error does.

use nalgebra::{DMatrix, DVector};

use crate::impact::fit::{FitProblem, TrialCovariance, inverse_root};

/// Standard deviation of what the method itself is off, as a part of the largest reading of the mean wave. A reading that hardly varies does not
/// tell more than the model knows of it.
pub const METHOD: f64 = 0.015;

/// Turns what is left of drops into numbers of one variance, a height each.
#[derive(Clone, Debug)]
pub struct DropWeights {
    by_height: Vec<DMatrix<f64>>,
}

impl DropWeights {
    /// Each reading alike, in units of its height's mean wave: before anything is known of what varies.
    pub fn alike(waves: &FitProblem) -> Self {
        Self {
            by_height: waves.means.iter().map(|mean| DMatrix::identity(mean.wave.len(), mean.wave.len()) / unit_g(&mean.wave)).collect(),
        }
    }

    /// By what a fit leaves of drops, g, with the place of their height among the mean waves of the problem; `None` where nothing is left of any.
    pub fn of(waves: &FitProblem, left: &[(usize, Vec<DVector<f64>>)]) -> Option<Self> {
        Self::of_left(&waves.means.iter().map(|mean| &mean.wave[..]).collect::<Vec<_>>(), left)
    }

    fn of_left(waves: &[&[f64]], left: &[(usize, Vec<DVector<f64>>)]) -> Option<Self> {
        // Of the height with the largest readings, g, of which the others are a part.
        let unit_of_all_g = left.iter().map(|(height, _)| unit_g(waves[*height])).fold(0.0, f64::max);
        let (mut own, mut method_g) = (Vec::new(), 0.0_f64);
        for (height, left) in left {
            let wave = waves[*height];
            let scale = unit_of_all_g / unit_g(wave);
            let mean = left.iter().fold(DVector::zeros(wave.len()), |sum, left| sum + left) / left.len() as f64;
            own.extend(left.iter().map(|left| (left - &mean) * scale));
            method_g = method_g.max(METHOD * wave.iter().copied().fold(0.0, f64::max) * scale);
        }
        if own.is_empty() {
            return None;
        }
        let mut covariance = TrialCovariance::of_deviations(&[DMatrix::from_columns(&own)]).plain_covariances().pop()?;
        covariance += DMatrix::from_diagonal_element(covariance.nrows(), covariance.nrows(), method_g * method_g);
        let root = inverse_root(&covariance)?;
        Some(Self { by_height: waves.iter().map(|wave| &root * (unit_of_all_g / unit_g(wave))).collect() })
    }

    /// What is left of a drop from a height, weighed.
    pub fn weighed(&self, height: usize, left: &DVector<f64>) -> DVector<f64> {
        &self.by_height[height] * left
    }
}

/// Root mean square of a mean wave, g: readings vary in proportion to it.
fn unit_g(wave: &[f64]) -> f64 {
    (wave.iter().map(|reading| reading * reading).sum::<f64>() / wave.len() as f64).sqrt().max(1.0)
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::Pcg64;

    use super::*;

    const READINGS: usize = 20;

    /// What is left of drops: coloured noise in proportion to the wave beside a mean that the model misses, and readings that hardly vary at the end.
    fn left(wave: &[f64], count: usize, seed: u64) -> Vec<DVector<f64>> {
        let mut rng = Pcg64::seed_from_u64(seed);
        let drop = |_| {
            let mut noise: f64 = StandardNormal.sample(&mut rng);
            let reading = |at: usize| {
                noise = 0.8 * noise + 0.6 * Distribution::<f64>::sample(&StandardNormal, &mut rng);
                0.3 * wave[at] * noise + 5.0
            };
            DVector::from_iterator(READINGS, (0..READINGS).map(reading))
        };
        (0..count).map(drop).collect()
    }

    fn wave(peak_g: f64) -> Vec<f64> {
        (0..READINGS).map(|at| if at < 15 { peak_g * libm::sin((at as f64 + 1.0) / 16.0 * std::f64::consts::PI) } else { 0.01 }).collect()
    }

    #[test]
    fn analytic_weighed_readings_have_one_variance_and_are_not_alike_at_every_height() {
        let waves = [wave(60.0), wave(120.0)];
        let waves = [&waves[0][..], &waves[1][..]];
        let all = [(0, left(waves[0], 60, 1)), (1, left(waves[1], 60, 2))];
        let weights = DropWeights::of_left(&waves, &all).expect("is determined");
        for (height, wave) in waves.iter().enumerate() {
            let fresh = left(wave, 400, 3);
            let mean = fresh.iter().fold(DVector::zeros(READINGS), |sum, one| sum + one) / 400.0;
            let weighed: Vec<DVector<f64>> = fresh.iter().map(|one| weights.weighed(height, &(one - &mean))).collect();
            let product = |i: usize, j: usize| weighed.iter().map(|one| one[i] * one[j]).sum::<f64>() / 400.0;
            for at in 0..14 {
                assert!((0.6..1.6).contains(&product(at, at)), "{at}: {}", product(at, at));
                assert!(product(at, at + 1).abs() < 0.35, "{at}: {}", product(at, at + 1));
            }
            // What hardly varies is not known better than what the method itself is off.
            assert!((15..READINGS).all(|at| product(at, at) < 0.05));
        }
    }

    #[test]
    fn analytic_a_mean_that_is_missed_is_no_variation() {
        let waves = [wave(80.0)];
        let waves = [&waves[0][..]];
        let own = left(waves[0], 40, 5);
        let moved = own.iter().map(|one| one.add_scalar(30.0)).collect();
        let [weights, of_moved] = [own, moved].map(|left| DropWeights::of_left(&waves, &[(0, left)]).expect("is determined"));
        let one = DVector::from_element(READINGS, 1.0);
        assert!((weights.weighed(0, &one) - of_moved.weighed(0, &one)).norm() < 1e-6 * weights.weighed(0, &one).norm());
    }
}
