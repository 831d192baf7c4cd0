//! Bootstrap replicates: mean waves and trial covariances as they could have been measured if nothing were missing.
//!
//! A replicate's records have the measured trial covariance, and sizes drawn from those of the measured records, whole records at a time:
//! where a few records are far off, they are so in the replicates, too. For normal records these are normal replicates.

use nalgebra::{DMatrix, DVector};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::impact::fit::{CovarianceModel, TrialCovariance, Waves, Whitening, inverse_root};

/// Number of replicates.
pub const REPLICATES: usize = 400;
/// Of more records a height than this, means and covariances are normal whatever the records are, and drawn as such.
const MOST_RECORDS: usize = 400;

/// One replicate.
#[derive(Clone, Debug)]
pub struct Replicate {
    /// Mean waves less their expectation, g, all heights one below the other.
    pub deviation: DVector<f64>,
    /// From the trial covariance of its own records.
    pub whitening: Whitening,
}

/// Replicates of one measured trial covariance. They hold for every model, as a model moves only the expectation: one
/// diagnosis draws them once.
#[derive(Clone, Debug)]
pub struct Bootstrap {
    /// From the measured trial covariance.
    pub whitening: Whitening,
    /// The replicates.
    pub each: Vec<Replicate>,
}

impl Bootstrap {
    /// Draws mean waves with the trial covariance of measured ones. The covariance is estimated anew from each replicate's records, since
    /// a covariance of as many numbers as there are samples is itself uncertain. `None` where it is degenerate.
    pub fn of(waves: &Waves, trial_covariance: &TrialCovariance, covariance_model: &CovarianceModel, seed: u64) -> Option<Self> {
        let covariances = trial_covariance.covariances(covariance_model)?;
        let counts = trial_covariance.counts();
        let roots: Vec<DMatrix<f64>> =
            covariances.iter().map(|covariance| Some(covariance.clone().cholesky()?.unpack())).collect::<Option<_>>()?;
        let sizes = sizes(waves, &covariances)?;
        let many = counts.iter().any(|count| *count > MOST_RECORDS);
        let drawn = |number: usize| {
            let mut rng = Pcg64::new(u128::from(seed), 2 * number as u128 + 1);
            let (parts, drawn) = if many {
                let drawn = TrialCovariance::drawn(&covariances, counts, &mut rng)?;
                let mean = |(root, count): (&DMatrix<f64>, &usize)| root * normal(root.nrows(), &mut rng) / (*count as f64).sqrt();
                (roots.iter().zip(counts).map(mean).collect::<Vec<DVector<f64>>>(), drawn)
            } else {
                let (mut parts, mut deviations) = (Vec::new(), Vec::new());
                for (root, count) in roots.iter().zip(counts) {
                    let mut records = DMatrix::zeros(root.nrows(), *count);
                    for mut record in records.column_iter_mut() {
                        let direction = normal(root.nrows(), &mut rng);
                        let size = sizes[rng.random_range(0..sizes.len())] / direction.norm().max(1e-300);
                        record.copy_from(&(root * direction * size));
                    }
                    let mean = records.column_mean();
                    records.column_iter_mut().for_each(|mut record| record -= &mean);
                    parts.push(mean);
                    deviations.push(records);
                }
                (parts, TrialCovariance::of_deviations(&deviations))
            };
            let deviation =
                DVector::from_iterator(parts.iter().map(DVector::len).sum(), parts.iter().flat_map(|part| part.iter().copied()));
            Some(Replicate { deviation, whitening: Whitening::of(&drawn.covariances(covariance_model)?, counts)? })
        };
        let each: Vec<Replicate> = (0..REPLICATES).into_par_iter().filter_map(drawn).collect();
        (each.len() >= REPLICATES / 2).then_some(Self { whitening: Whitening::of(&covariances, counts)?, each })
    }
}

fn normal(count: usize, rng: &mut Pcg64) -> DVector<f64> {
    DVector::from_fn(count, |_, _| StandardNormal.sample(rng))
}

/// Lengths of the whitened records of all heights, with a mean square of as many as there are samples.
fn sizes(waves: &Waves, covariances: &[DMatrix<f64>]) -> Option<Vec<f64>> {
    let mut sizes = Vec::new();
    for (group, covariance) in waves.groups.iter().zip(covariances) {
        let inverse = inverse_root(covariance)?;
        let size = |window: &Vec<f64>| (&inverse * DVector::from_fn(waves.samples, |i, _| window[i] - group.mean[i])).norm();
        sizes.extend(group.windows.iter().map(size));
    }
    let square = sizes.iter().map(|size| size * size).sum::<f64>() / sizes.len().max(1) as f64;
    let factor = (waves.samples as f64 / square.max(1e-300)).sqrt();
    sizes.iter_mut().for_each(|size| *size *= factor);
    (!sizes.is_empty()).then_some(sizes)
}
