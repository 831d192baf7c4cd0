//! Maximum likelihood: mean waves against what a model predicts for them, in units of their own scatter.
//!
//! Records of a height scatter normally around the model's wave with the covariance that the replicates show: variances of
//! each height, correlations of all heights together, drawn towards none by as much as they are uncertain (J. Schäfer,
//! K. Strimmer, Stat. Appl. Genet. Mol. Biol. 4 (2005) 32). Then the likelihood is largest where the whitened distance of
//! the mean waves is least. *When it is wrong:* drops that are not scatter around one wave, and a model that lacks an
//! effect: its parameters then make up for that, and the distance over its degrees of freedom says so.

use nalgebra::{DMatrix, DVector};

use super::chosen::{Chosen, Unfit};
use super::expected::Expected;
use super::fitting::Objective;
use super::waves::{Drop, Waves};
use crate::effects::Model;
use crate::sim::System;

/// Smallest scatter that is believed, g: a fraction of a count of the converter.
const LEAST_G: f64 = 0.03;

/// Mean waves and their whitening.
#[derive(Clone, Debug)]
pub struct Likelihood {
    waves: Waves,
    expected: Expected,
    /// For each height what turns deviations of the mean into independent ones of variance 1.
    whitening: Vec<DMatrix<f64>>,
}

impl Likelihood {
    /// Of chosen drops.
    ///
    /// # Errors
    /// When they cannot be laid upon each other, or are too few to show their scatter.
    pub fn of(chosen: &Chosen) -> Result<Self, Unfit> {
        let drop = |drop: &crate::measured::Drop| Drop {
            trial: drop.record.trial.clone(),
            height_m: drop.record.height_m,
            t_s: drop.record.t_s.clone(),
            accel_g: chosen.series(drop.record),
        };
        let waves = Waves::of(&chosen.drops.iter().map(drop).collect::<Vec<_>>())?;
        let whitening = whitening(&waves).ok_or(Unfit::Singular)?;
        let expected = Expected { step_s: waves.step_s, samples: waves.samples, spread: 0.0 };
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
        let system = System::new(model);
        let mut all = Vec::with_capacity(self.numbers());
        for (group, whitening) in self.waves.groups.iter().zip(&self.whitening) {
            let predicted = self.expected.window(&system, group.height_m)?;
            let deviation = DVector::from_iterator(predicted.len(), group.mean.iter().zip(&predicted).map(|(mean, model)| mean - model));
            all.extend((whitening * deviation).iter());
        }
        Some(DVector::from_vec(all))
    }

    fn waves(&self, model: &Model) -> Vec<(f64, Vec<f64>)> {
        let system = System::new(model);
        let wave = |group: &super::waves::Group| Some((group.height_m, self.expected.window(&system, group.height_m)?));
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

/// For each height the inverse root of the mean's covariance.
fn whitening(waves: &Waves) -> Option<Vec<DMatrix<f64>>> {
    let samples = waves.samples;
    let mut pooled = DMatrix::zeros(samples, samples);
    let (mut sizes, mut freedom) = (Vec::new(), 0.0);
    for group in &waves.groups {
        let free = group.windows.len() as f64 - 1.0;
        let deviations = DMatrix::from_fn(samples, group.windows.len(), |i, drop| group.windows[drop][i] - group.mean[i]);
        let sum = &deviations * deviations.transpose();
        let size = sum.diagonal().map(|square| (square / free + LEAST_G * LEAST_G).sqrt());
        pooled += DMatrix::from_fn(samples, samples, |i, j| sum[(i, j)] / (size[i] * size[j]));
        freedom += free;
        sizes.push(size);
    }
    let correlation = drawn_to_none(&(pooled / freedom), freedom);
    let inverse_root = |(size, group): (&DVector<f64>, &super::waves::Group)| {
        let count = group.windows.len() as f64;
        let covariance = DMatrix::from_fn(samples, samples, |i, j| correlation[(i, j)] * size[i] * size[j] / count);
        let root = covariance.cholesky()?.unpack();
        root.solve_lower_triangular(&DMatrix::identity(samples, samples))
    };
    sizes.iter().zip(&waves.groups).map(inverse_root).collect()
}

/// Correlations drawn towards none by as much as they are uncertain; 1 with itself.
fn drawn_to_none(correlation: &DMatrix<f64>, freedom: f64) -> DMatrix<f64> {
    let (mut uncertain, mut size) = (0.0, 0.0);
    for i in 0..correlation.nrows() {
        for j in 0..i {
            let r = correlation[(i, j)];
            uncertain += (1.0 - r * r) * (1.0 - r * r) / freedom;
            size += r * r;
        }
    }
    let weight = if size > 0.0 { (uncertain / size).clamp(0.02, 1.0) } else { 1.0 };
    DMatrix::from_fn(correlation.nrows(), correlation.ncols(), |i, j| if i == j { 1.0 } else { (1.0 - weight) * correlation[(i, j)] })
}
