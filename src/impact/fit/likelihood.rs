//! Maximum likelihood: mean waves compared with a model's prediction, in units of their own covariance.
//!
//! The records of a height vary normally around the model's wave with the covariance that the trials show: variances of each
//! height, correlations of all heights together, shrunk towards those of the lag by as much as they are uncertain
//! ([`TrialCovariance::plain_covariances`]). The likelihood is then largest where the whitened distance of the mean waves is least.
//!
//! *When it is wrong:* for drops that do not vary around one wave, and for a model that lacks an effect. Its parameters then
//! compensate for the effect, and the distance over its degrees of freedom is large.

use nalgebra::DVector;

use super::chosen::{Chosen, FitError};
use super::expected::Expected;
use super::fitting::Objective;
use super::trial_covariance::{TrialCovariance, Whitening};
use super::waves::Waves;
use crate::impact::effects::Model;

/// Mean waves and their whitening.
#[derive(Clone, Debug)]
pub struct Likelihood {
    waves: Waves,
    expected: Expected,
    whitening: Whitening,
}

impl Likelihood {
    /// Of chosen drops.
    ///
    /// # Errors
    /// When they cannot be aligned, or are too few to estimate the trial covariance.
    pub fn of(chosen: &Chosen) -> Result<Self, FitError> {
        let waves = chosen.waves()?;
        let scatter = TrialCovariance::of(&waves);
        let whitening = Whitening::of(&scatter.plain_covariances(), scatter.counts()).ok_or(FitError::Singular)?;
        let expected = Expected::plain(waves.step_s, waves.samples);
        Ok(Self { waves, expected, whitening })
    }

    /// How many numbers are compared.
    pub fn numbers(&self) -> usize {
        self.waves.groups.len() * self.waves.samples
    }
}

impl Objective for Likelihood {
    fn counts(&self) -> Vec<usize> {
        self.waves.groups.iter().map(|group| group.windows.len()).collect()
    }

    fn residual(&self, model: &Model) -> Option<DVector<f64>> {
        let system = self.expected.system(model);
        let mut all = Vec::with_capacity(self.numbers());
        for (height, group) in self.waves.groups.iter().enumerate() {
            let predicted = self.expected.window(&system, group.height_m)?;
            let deviation = DVector::from_iterator(predicted.len(), group.mean.iter().zip(&predicted).map(|(mean, model)| mean - model));
            all.extend((self.whitening.height(height) * deviation).iter());
        }
        Some(DVector::from_vec(all))
    }

    fn waves(&self, model: &Model) -> Vec<(f64, Vec<f64>)> {
        let system = self.expected.system(model);
        let wave = |group: &super::waves::WaveGroup| Some((group.height_m, self.expected.window(&system, group.height_m)?));
        self.waves.groups.iter().filter_map(wave).collect()
    }

    fn value(&self, sum: f64) -> f64 {
        sum
    }

    fn resampled(&self, picks: &[Vec<usize>]) -> Self {
        let mut drawn = self.clone();
        for ((group, from), picks) in drawn.waves.groups.iter_mut().zip(&self.waves.groups).zip(picks) {
            group.mean = vec![0.0; self.waves.samples];
            for pick in picks {
                for (sum, reading) in group.mean.iter_mut().zip(&from.windows[*pick]) {
                    *sum += reading / picks.len() as f64;
                }
            }
        }
        drawn
    }
}
