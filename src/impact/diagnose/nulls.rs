//! Mean waves and scatters that could have been measured if nothing were missing.

use nalgebra::{DMatrix, DVector};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::impact::fit::{Family, Scatter, Whitening};

/// Simulated data sets.
pub const NULLS: usize = 400;

/// One simulated data set.
#[derive(Clone, Debug)]
pub struct Null {
    /// Mean waves less their expectation, g, all heights one below the other.
    pub deviation: DVector<f64>,
    /// From the scatter of its own records.
    pub whitening: Whitening,
}

/// Simulated data sets of one measured scatter. They hold for every model, as a model moves only the expectation: one
/// diagnosis draws them once.
#[derive(Clone, Debug)]
pub struct Nulls {
    /// From the measured scatter.
    pub whitening: Whitening,
    /// The data sets.
    pub each: Vec<Null>,
}

impl Nulls {
    /// Draws mean waves with the measured scatter, and that scatter drawn and estimated anew each time, since a covariance
    /// of as many numbers as there are samples is itself uncertain. `None` where the scatter is degenerate.
    pub fn of(scatter: &Scatter, family: &Family, seed: u64) -> Option<Self> {
        let covariances = scatter.covariances(family)?;
        let of_mean = |(covariance, count): (&DMatrix<f64>, &usize)| Some((covariance / *count as f64).cholesky()?.unpack());
        let roots: Vec<DMatrix<f64>> = covariances.iter().zip(scatter.counts()).map(of_mean).collect::<Option<_>>()?;
        let drawn = |null: usize| {
            let mut rng = Pcg64::new(u128::from(seed), 2 * null as u128 + 1);
            let drawn = Scatter::drawn(&covariances, scatter.counts(), &mut rng)?;
            let parts: Vec<DVector<f64>> =
                roots.iter().map(|root| root * DVector::from_fn(root.nrows(), |_, _| StandardNormal.sample(&mut rng))).collect();
            let deviation =
                DVector::from_iterator(parts.iter().map(DVector::len).sum(), parts.iter().flat_map(|part| part.iter().copied()));
            Some(Null { deviation, whitening: Whitening::of(&drawn.covariances(family)?, scatter.counts())? })
        };
        let each: Vec<Null> = (0..NULLS).into_par_iter().filter_map(drawn).collect();
        (each.len() >= NULLS / 2).then_some(Self { whitening: Whitening::of(&covariances, scatter.counts())?, each })
    }
}
