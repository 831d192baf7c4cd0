//! Whether the drops show a trend over trials: wear, heating, a sensor that comes loose.

use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

use crate::impact::fit::{Waves, inverse};

/// Orders drawn.
const DRAWN: usize = 1999;

/// p-value of a trend: how often drops in random order follow their number as much as these do, along the changes that the model's own
/// parameters would make (a height each, in g) and along the wave itself.
pub fn trend_p(waves: &Waves, changes: &DMatrix<f64>, seed: u64) -> Option<f64> {
    let scores: Vec<DMatrix<f64>> = waves
        .groups
        .iter()
        .enumerate()
        .map(|(height, group)| {
            let mut columns: Vec<DVector<f64>> =
                (0..changes.ncols()).map(|i| changes.column(i).rows(height * waves.samples, waves.samples).into_owned()).collect();
            columns.push(DVector::from_vec(group.mean.clone()));
            let directions = DMatrix::from_columns(&columns);
            let records = DMatrix::from_fn(waves.samples, group.windows.len(), |i, drop| group.windows[drop][i] - group.mean[i]);
            let solved = inverse(&(directions.transpose() * &directions))? * directions.transpose() * records;
            Some(whitened(&solved))
        })
        .collect::<Option<_>>()?;
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut orders: Vec<Vec<usize>> = scores.iter().map(|scores| (0..scores.ncols()).collect()).collect();
    let found = strength(&scores, &orders);
    let mut as_strong = 0;
    for _ in 0..DRAWN {
        orders.iter_mut().for_each(|order| order.shuffle(&mut rng));
        as_strong += usize::from(strength(&scores, &orders) >= found);
    }
    Some((as_strong + 1) as f64 / (DRAWN + 1) as f64)
}

/// Scores with independent rows of variance 1.
fn whitened(scores: &DMatrix<f64>) -> DMatrix<f64> {
    let covariance = scores * scores.transpose() / scores.ncols() as f64;
    match crate::impact::fit::inverse_root(&covariance) {
        Some(root) => root * scores,
        None => scores.clone(),
    }
}

/// Sum over directions of the squared sum over heights of the scores' product with the drops' numbers: a trend goes the
/// same way at every height.
fn strength(scores: &[DMatrix<f64>], orders: &[Vec<usize>]) -> f64 {
    let mut sums = DVector::zeros(scores[0].nrows());
    for (scores, order) in scores.iter().zip(orders) {
        let middle = 0.5 * (order.len() - 1) as f64;
        for (drop, number) in order.iter().enumerate() {
            sums += scores.column(drop) * ((*number as f64 - middle) / order.len() as f64);
        }
    }
    sums.norm_squared()
}
