//! Whether the residual of a model is within trial variation.
//!
//! Three statistics of the whitened residual are tested: its sum of squares, the largest part of it that one effect of the
//! catalogue would remove, and the largest part that a local deviation at one time of one height would remove. Their p-values come
//! from parametric-bootstrap replicates ([`Bootstrap`]).

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::bootstrap::{Bootstrap, REPLICATES};
use crate::impact::fit::{Whitening, inverse};
use crate::impact::measured::quantile;

/// Widths of a local deviation, samples.
const WIDTHS: [f64; 3] = [0.6, 1.5, 3.5];
/// Part of a column that must be left when the part that the fit can do itself is removed.
const LEAST_LEFT: f64 = 1e-8;

/// The three statistics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// Sum of squares.
    pub sum: f64,
    /// Largest gain by an effect.
    pub effect: f64,
    /// Largest gain by a local deviation.
    pub local: f64,
}

impl Statistics {
    fn parts(self) -> [f64; 3] {
        [self.sum, self.effect, self.local]
    }
}

/// A fit, linearised: everything in g, all heights one below the other.
#[derive(Clone, Debug)]
pub struct LinearisedFit {
    /// Change with each free parameter.
    pub jacobian: DMatrix<f64>,
    /// Changes by effects that are not in the model.
    pub effects: DMatrix<f64>,
    /// Samples a height.
    pub samples: usize,
}

/// p-values, and the statistics they belong to.
#[derive(Clone, Debug)]
pub struct Adequacy {
    /// Of the data.
    pub statistics: Statistics,
    /// p-value of each statistic alone.
    pub single_p: [f64; 3],
    /// p-value of the least of the three.
    pub p: f64,
    /// For each free parameter: the ratio that 95 % of the simulated errors do not exceed, error over stated standard error.
    pub ratio95: Vec<f64>,
}

/// Judges measured mean waves less a model's.
pub fn judge(deviation: &DVector<f64>, fit: &LinearisedFit, bootstrap: &Bootstrap) -> Option<Adequacy> {
    let (statistics, _) = statistics(deviation, fit, &bootstrap.whitening)?;
    let replicates: Vec<(Statistics, Vec<f64>)> =
        bootstrap.each.par_iter().filter_map(|one| self::statistics(&one.deviation, fit, &one.whitening)).collect();
    if replicates.len() < REPLICATES / 2 {
        return None;
    }
    // The data stand among the replicates, so that all are ranked alike.
    let all = || replicates.iter().map(|(one, _)| *one).chain([statistics]);
    let columns: [Vec<f64>; 3] = std::array::from_fn(|part| sorted(all().map(|one| one.parts()[part])));
    let p_values = |found: Statistics| -> [f64; 3] { std::array::from_fn(|part| p_value(&columns[part], found.parts()[part])) };
    let least = |found: Statistics| p_values(found).into_iter().fold(1.0, f64::min);
    let single_p = p_values(statistics);
    let found = least(statistics);
    let as_rare = replicates.iter().filter(|(one, _)| least(*one) <= found).count();
    let ratio95 = |i: usize| quantile(&sorted(replicates.iter().map(|(_, ratios)| ratios[i])), 0.95).unwrap_or(f64::INFINITY);
    let ratio95 = (0..fit.jacobian.ncols()).map(ratio95).collect();
    Some(Adequacy { statistics, single_p, p: (as_rare as f64 + 1.0) / (replicates.len() as f64 + 1.0), ratio95 })
}

/// The statistics, and each free parameter's error over its stated standard error.
fn statistics(deviation: &DVector<f64>, fit: &LinearisedFit, whitening: &Whitening) -> Option<(Statistics, Vec<f64>)> {
    let jacobian = whitening.stacked(&fit.jacobian);
    let white = whitening.stacked(&DMatrix::from_column_slice(deviation.len(), 1, deviation.as_slice()));
    let normal = jacobian.transpose() * &jacobian;
    let inverse = inverse(&normal)?;
    let moved = &inverse * (jacobian.transpose() * &white);
    let ratios = (0..moved.nrows()).map(|i| moved[(i, 0)].abs() / inverse[(i, i)].max(1e-300).sqrt()).collect();
    let left = &white - &jacobian * moved;
    let effects = whitening.stacked(&fit.effects);
    let shared = jacobian.transpose() * &effects;
    let along = effects.transpose() * &left;
    let taken = &inverse * &shared;
    let mut effect = 0.0_f64;
    for i in 0..effects.ncols() {
        let whole = effects.column(i).norm_squared();
        let rest = whole - shared.column(i).dot(&taken.column(i));
        if along[(i, 0)] > 0.0 && rest > LEAST_LEFT * whole && rest > 0.0 {
            effect = effect.max(along[(i, 0)] * along[(i, 0)] / rest);
        }
    }
    Some((Statistics { sum: left.norm_squared(), effect, local: largest_local(&left, fit.samples) }, ratios))
}

/// Largest gain by a local deviation in the whitened residual; the part that the fit can do itself is small and is left in.
fn largest_local(left: &DMatrix<f64>, samples: usize) -> f64 {
    let mut largest = 0.0_f64;
    for from in (0..left.nrows()).step_by(samples) {
        for width in WIDTHS {
            let reach = (2.5 * width).ceil() as usize;
            for centre in 0..samples {
                let (mut along, mut whole) = (0.0, 0.0);
                for i in centre.saturating_sub(reach)..(centre + reach + 1).min(samples) {
                    let z = (i as f64 - centre as f64) / width;
                    let weight = libm::exp(-0.5 * z * z);
                    along += weight * left[(from + i, 0)];
                    whole += weight * weight;
                }
                largest = largest.max(along * along / whole);
            }
        }
    }
    largest
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut all: Vec<f64> = values.collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Part of the sorted values, of which this is one, that are at least as large.
fn p_value(sorted: &[f64], value: f64) -> f64 {
    let below = sorted.partition_point(|other| *other < value);
    (sorted.len() - below) as f64 / sorted.len() as f64
}
