//! How much of the variation between drops of one height a quantity explains.
//!
//! Windows less their height's mean are regressed on the quantity, on four fifths of the drops, and predicted on the last fifth, in
//! turn. What is explained is one minus the sum of squares left over that of the mean alone. Values dealt to other drops of the same
//! height show what chance explains.

use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

use crate::impact::fit::inverse;

/// Parts of the drops that are left out in turn.
const PARTS: usize = 5;
/// Permutations.
const PERMUTED: usize = 199;
/// Variance, in units of the quantity's own, that stands against chance.
const RIDGE: f64 = 0.5;

/// A quantity of each drop, height by height.
#[derive(Clone, Debug)]
pub struct Covariate {
    /// Its name.
    pub id: String,
    /// A height each, a drop each: one number or several.
    pub values: Vec<Vec<Vec<f64>>>,
}

/// What a quantity explains.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct CovariateEffect {
    /// Its name.
    pub id: String,
    /// Part of the variance between drops of one height, out of sample; below 0 where it predicts worse than the mean.
    pub explained: f64,
    /// p-value under permutation within each height.
    pub p: f64,
}

impl Covariate {
    /// What it explains of windows, g, a height each, a drop each.
    pub fn explains(&self, windows: &[Vec<&[f64]>], seed: u64) -> CovariateEffect {
        let explained = explained(&self.values, windows);
        let mut rng = Pcg64::seed_from_u64(seed);
        let as_much = (0..PERMUTED)
            .filter(|_| {
                let mut dealt = self.values.clone();
                dealt.iter_mut().for_each(|height| height.shuffle(&mut rng));
                self::explained(&dealt, windows) >= explained
            })
            .count();
        CovariateEffect { id: self.id.clone(), explained, p: (as_much + 1) as f64 / (PERMUTED + 1) as f64 }
    }
}

fn explained(values: &[Vec<Vec<f64>>], windows: &[Vec<&[f64]>]) -> f64 {
    let (mut left, mut whole) = (0.0, 0.0);
    for (values, windows) in values.iter().zip(windows) {
        for part in 0..PARTS {
            let is_out = |drop: usize| drop % PARTS == part;
            let (mine, rest): (Vec<usize>, Vec<usize>) = (0..windows.len()).partition(|drop| is_out(*drop));
            let Some((a, b)) = sums_left(values, windows, &rest, &mine) else { continue };
            left += a;
            whole += b;
        }
    }
    if whole > 0.0 { 1.0 - left / whole } else { 0.0 }
}

/// Sums of squares that the regression on some drops, and their mean alone, leave of others.
fn sums_left(values: &[Vec<f64>], windows: &[&[f64]], known: &[usize], others: &[usize]) -> Option<(f64, f64)> {
    let columns = values.first()?.len();
    let samples = windows.first()?.len();
    if known.len() < columns + 2 {
        return None;
    }
    let mean = |at: usize| known.iter().map(|drop| values[*drop][at]).sum::<f64>() / known.len() as f64;
    let means: Vec<f64> = (0..columns).map(mean).collect();
    let spread =
        |at: usize| (known.iter().map(|drop| (values[*drop][at] - means[at]).powi(2)).sum::<f64>() / known.len() as f64).sqrt().max(1e-30);
    let spreads: Vec<f64> = (0..columns).map(spread).collect();
    let row = |drop: usize, at: usize| (values[drop][at] - means[at]) / spreads[at];
    let design = DMatrix::from_fn(known.len(), columns, |i, at| row(known[i], at));
    let average = DVector::from_fn(samples, |i, _| known.iter().map(|drop| windows[*drop][i]).sum::<f64>() / known.len() as f64);
    let measured = DMatrix::from_fn(known.len(), samples, |i, sample| windows[known[i]][sample] - average[sample]);
    let normal = design.transpose() * &design + DMatrix::identity(columns, columns) * RIDGE;
    let slopes = inverse(&normal)? * design.transpose() * measured;
    let (mut left, mut whole) = (0.0, 0.0);
    for drop in others {
        let own = DVector::from_fn(columns, |at, _| row(*drop, at));
        let predicted = slopes.transpose() * own;
        for i in 0..samples {
            let off = windows[*drop][i] - average[i];
            left += (off - predicted[i]).powi(2);
            whole += off * off;
        }
    }
    Some((left, whole))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Windows that grow with a value, and a little noise.
    fn windows(count: usize) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
        let value = |drop: usize| ((drop * 7919) % 101) as f64 / 101.0;
        let noise = |drop: usize, i: usize| ((drop * 31 + i * 17) % 13) as f64 / 13.0 - 0.5;
        let all = (0..count).map(|drop| (0..20).map(|i| value(drop) * i as f64 + 0.5 * noise(drop, i)).collect()).collect();
        ((0..count).map(|drop| vec![value(drop)]).collect(), all)
    }

    #[test]
    fn analytic_what_drives_the_windows_is_found_and_what_does_not_is_not() {
        let (values, all) = windows(60);
        let slices = vec![all.iter().map(Vec::as_slice).collect::<Vec<_>>()];
        let driven = Covariate { id: "driver".into(), values: vec![values] }.explains(&slices, 1);
        assert!(driven.explained > 0.9 && driven.p < 0.01, "{driven:?}");
        let order = (0..60).map(|drop| vec![f64::from(drop)]).collect();
        let idle = Covariate { id: "order".into(), values: vec![order] }.explains(&slices, 1);
        assert!(idle.explained < 0.2 && idle.p > 0.02, "{idle:?}");
    }
}
