//! Parametric-bootstrap replicates: mean waves and trial covariances as they could have been measured if nothing were missing.

use nalgebra::{DMatrix, DVector};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::impact::fit::{CovarianceModel, TrialCovariance, Whitening};

/// Number of replicates.
pub const REPLICATES: usize = 400;

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
    /// Draws mean waves with the measured trial covariance. The covariance is drawn and estimated anew each time, since a covariance
    /// of as many numbers as there are samples is itself uncertain. `None` where it is degenerate.
    pub fn of(trial_covariance: &TrialCovariance, covariance_model: &CovarianceModel, seed: u64) -> Option<Self> {
        let covariances = trial_covariance.covariances(covariance_model)?;
        let of_mean = |(covariance, count): (&DMatrix<f64>, &usize)| Some((covariance / *count as f64).cholesky()?.unpack());
        let roots: Vec<DMatrix<f64>> = covariances.iter().zip(trial_covariance.counts()).map(of_mean).collect::<Option<_>>()?;
        let drawn = |number: usize| {
            let mut rng = Pcg64::new(u128::from(seed), 2 * number as u128 + 1);
            let drawn = TrialCovariance::drawn(&covariances, trial_covariance.counts(), &mut rng)?;
            let parts: Vec<DVector<f64>> =
                roots.iter().map(|root| root * DVector::from_fn(root.nrows(), |_, _| StandardNormal.sample(&mut rng))).collect();
            let deviation =
                DVector::from_iterator(parts.iter().map(DVector::len).sum(), parts.iter().flat_map(|part| part.iter().copied()));
            Some(Replicate { deviation, whitening: Whitening::of(&drawn.covariances(covariance_model)?, trial_covariance.counts())? })
        };
        let each: Vec<Replicate> = (0..REPLICATES).into_par_iter().filter_map(drawn).collect();
        (each.len() >= REPLICATES / 2).then_some(Self { whitening: Whitening::of(&covariances, trial_covariance.counts())?, each })
    }
}
