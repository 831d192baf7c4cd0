//! The residual when no effect suffices, as a force over displacement and speed, without any model of it.

use serde::Serialize;

use super::residual_map::{Phase, Point};
use crate::units::GRAVITY_M_S2;

/// A cell of the surface.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ForceCell {
    /// Middle of the displacements, mm.
    pub x_mm: f64,
    /// Middle of the speeds, m/s.
    pub v_m_s: f64,
    /// Mean of measured less model, as a force on the body, N.
    pub force_n: f64,
    /// Its standard error from the variation between drops, N.
    pub error_n: f64,
    /// Samples.
    pub samples: usize,
}

/// Cells along each axis.
const CELLS: usize = 8;

/// Bins the residual of points in contact; the sensor's lag is not taken out, so a cell is late by it.
pub fn residual_force(points: &[Point], mass_kg: f64) -> Vec<ForceCell> {
    let inside: Vec<&Point> = points.iter().filter(|point| point.phase != Phase::Flight && point.t_ms > 0.0).collect();
    let range = |of: &dyn Fn(&Point) -> f64| {
        inside.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], point| [low.min(of(point)), high.max(of(point))])
    };
    let ([x0, x1], [v0, v1]) = (range(&|point| point.x_mm), range(&|point| point.v_m_s));
    let cell = |value: f64, low: f64, high: f64| (((value - low) / (high - low).max(1e-12) * CELLS as f64) as usize).min(CELLS - 1);
    let middle = |cell: usize, low: f64, high: f64| low + (high - low) * (cell as f64 + 0.5) / CELLS as f64;
    let mut patches = Vec::new();
    for i in 0..CELLS {
        for j in 0..CELLS {
            let own: Vec<&&Point> = inside.iter().filter(|point| cell(point.x_mm, x0, x1) == i && cell(point.v_m_s, v0, v1) == j).collect();
            if own.is_empty() {
                continue;
            }
            let (count, newton) = (own.len() as f64, mass_kg * GRAVITY_M_S2);
            let mean = own.iter().map(|point| point.measured_g - point.model_g).sum::<f64>() / count;
            let error = own.iter().map(|point| point.error_g * point.error_g).sum::<f64>().sqrt() / count;
            patches.push(ForceCell {
                x_mm: middle(i, x0, x1),
                v_m_s: middle(j, v0, v1),
                force_n: newton * mean,
                error_n: newton * error,
                samples: own.len(),
            });
        }
    }
    patches
}
