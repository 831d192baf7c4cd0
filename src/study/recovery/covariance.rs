//! The generator's own covariance of records, by quadrature over all that is random in them instead of by draws.

use std::sync::Arc;

use crate::impact::effects::Model;
use crate::impact::fit::{BEFORE, Expected, FitProblem, MeanWave, Whitening};
use crate::impact::sim::System;
use crate::impact::synthetic::Plan;
use nalgebra::{DMatrix, DVector};

/// What a plan's mean waves are: the mean over phases, drops that differ in k and c, and cut readings.
fn expected(plan: &Plan) -> Expected {
    let limited = plan.model.value("sensor_saturation", "limit_g").is_some();
    let samples = (0.030 * plan.rate_hz).round() as usize + BEFORE;
    Expected {
        spread: if limited { vec![plan.scatter.share; samples].into() } else { Arc::default() },
        varied: [plan.scatter.stiffness, plan.scatter.damping],
        ..Expected::plain(1.0 / plan.rate_hz, samples)
    }
}

/// A plan's mean waves without noise, whitened by their own covariance, by quadrature.
pub(super) fn exact(plan: &Plan) -> Option<FitProblem> {
    let expected = expected(plan);
    let system = expected.system(&plan.model);
    let mean = |height_m: &f64| {
        let wave = expected.window(&system, *height_m)?;
        Some(MeanWave { height_m: *height_m, wave })
    };
    let means = plan.heights_m.iter().map(mean).collect::<Option<Vec<_>>>()?;
    let whitening = Whitening::of(&covariances(plan)?, &vec![plan.drops; means.len()])?;
    Some(FitProblem { expected, chosen: (0..means.len()).collect(), means, whitening, seen_limit_g: None })
}

/// Models of single drops with their weights: Gauss and Hermite, three points for k and three for c.
fn drops(plan: &Plan) -> Vec<(f64, Model)> {
    let mut all = vec![(1.0, plan.model.clone())];
    for (at, varied) in [plan.scatter.stiffness, plan.scatter.damping].into_iter().enumerate().filter(|(_, varied)| *varied > 0.0) {
        all[0].0 -= 1.0 / 3.0;
        for side in [-1.0, 1.0] {
            let mut factors = [1.0; 2];
            factors[at] += side * 3f64.sqrt() * varied;
            all.push((1.0 / 6.0, plan.model.scaled(factors)));
        }
    }
    all
}

/// Covariance of one record, g², a height each: clock, coloured trial variation, noise and count, k and c; a cut reading keeps as much
/// of its variance as it is likely not to be cut. The tilt and records aligned a sample too late are left out: both would make it
/// larger.
pub(super) fn covariances(plan: &Plan) -> Option<Vec<DMatrix<f64>>> {
    plan.heights_m.iter().map(|height_m| covariance(plan, *height_m)).collect()
}

fn covariance(plan: &Plan, height_m: f64) -> Option<DMatrix<f64>> {
    let one = Expected { varied: [0.0; 2], spread: Arc::default(), ..expected(plan) };
    let limit_g = plan.model.value("sensor_saturation", "limit_g").unwrap_or(f64::INFINITY);
    let kept = libm::exp(-one.step_s / plan.scatter.correlation_s);
    let (mut sum, mut means, mut weights) = (DMatrix::zeros(one.samples, one.samples), Vec::new(), Vec::new());
    for (weight, mut model) in drops(plan) {
        model.effects.retain(|listed| listed.spec.id != "sensor_saturation");
        let fine = one.fine(&System::new(&model), height_m)?;
        let open = |reading: f64| {
            0.5 * libm::erfc((reading - limit_g) / (plan.scatter.share * reading.abs()).max(1e-9) / std::f64::consts::SQRT_2)
        };
        let free: Vec<f64> = fine.iter().map(|reading| reading * open(*reading)).collect();
        let cut: Vec<f64> = fine.iter().map(|reading| reading.min(limit_g)).collect();
        let free_mean = DVector::from_vec(one.mean_over_phases(&free));
        let coloured = one.over_phases(&free) + &free_mean * free_mean.transpose();
        let share = plan.scatter.share * plan.scatter.share;
        sum += (one.over_phases(&cut) + coloured.map_with_location(|i, j, square| square * share * libm::pow(kept, i.abs_diff(j) as f64)))
            * weight;
        means.push(DVector::from_vec(one.mean_over_phases(&cut)));
        weights.push(weight);
    }
    let mean: DVector<f64> = means.iter().zip(&weights).map(|(mean, weight)| mean * *weight).sum();
    for (own, weight) in means.iter().zip(&weights) {
        sum += (own - &mean) * (own - &mean).transpose() * *weight;
    }
    let count = 1.0 / plan.counts_per_g;
    let noise = plan.noise_g * plan.noise_g + count * count / 12.0;
    Some(sum + DMatrix::from_diagonal_element(one.samples, one.samples, noise))
}
