//! Many landings with random slopes: the mean wave, and how the touch times spread.

use nalgebra::{DMatrix, DVector};

use super::legged_body::Slopes;
use super::table::LandingTable;
use super::touch_errors::TouchErrors;
use super::touches::LAST_S;

/// Landings from one height whose slopes are random.
#[derive(Clone, Debug)]
pub struct Population<'a> {
    table: &'a LandingTable,
    weights: DVector<f64>,
}

impl<'a> Population<'a> {
    /// Weighs a table's landings by how frequent their slopes are.
    pub fn of(table: &'a LandingTable, slopes: &Slopes) -> Self {
        Self { table, weights: weights(table, slopes.deviation_rad(table.fall_s)) }
    }

    /// Mean window, g.
    pub fn mean_window(&self) -> DVector<f64> {
        &self.table.windows * &self.weights
    }

    /// Covariance of windows that differ by their landing's slope, g².
    pub fn covariance(&self) -> DMatrix<f64> {
        let mean = self.mean_window();
        let mut off = self.table.windows.clone();
        for (mut column, weight) in off.column_iter_mut().zip(self.weights.iter()) {
            column -= &mean;
            column *= weight.sqrt();
        }
        &off * off.transpose()
    }

    /// Quantile of the time from the first foot to the opposite one, s, of the landings in which it touches as soon as it is looked for.
    pub fn opposite_delay_s(&self, share: f64) -> f64 {
        let times = self.table.delays_s.iter().zip(self.weights.iter()).map(|(delays, weight)| (delays[0], *weight));
        let [delay_s] = quantiles_s(times.collect(), [share]);
        delay_s
    }

    /// The same quantiles of the times as they are read.
    pub fn read_delays_s<const N: usize>(&self, errors: Option<&TouchErrors>, shares: [f64; N]) -> [f64; N] {
        let times = self.table.delays_s.iter().zip(self.weights.iter()).enumerate();
        let read = |(point, (delays, weight)): (usize, (&[f64; 3], &f64))| match errors {
            Some(errors) => errors.read_s(point, delays[0]).map(|read_s| (read_s, *weight)).collect::<Vec<_>>(),
            None => vec![(delays[0], *weight)],
        };
        quantiles_s(times.flat_map(read).collect(), shares)
    }

    /// How frequent each of the table's slopes is.
    pub fn weights(&self) -> &DVector<f64> {
        &self.weights
    }
}

/// Quantiles of times with weights, of those before [`LAST_S`].
fn quantiles_s<const N: usize>(mut times: Vec<(f64, f64)>, shares: [f64; N]) -> [f64; N] {
    times.retain(|(time_s, _)| *time_s < LAST_S);
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    let all: f64 = times.iter().map(|(_, weight)| weight).sum();
    shares.map(|share| {
        // Half of a time's weight lies before it.
        let (mut before, mut last) = (0.0, (0.0, 0.0));
        for (time_s, weight) in &times {
            let middle = (before + 0.5 * weight) / all;
            if middle >= share {
                let (left, left_s) = last;
                return if middle > left { left_s + (time_s - left_s) * (share - left) / (middle - left) } else { *time_s };
            }
            before += weight;
            last = (middle, *time_s);
        }
        last.1
    })
}

/// Rayleigh's density times the slopes that each point stands for; the steepest one takes what lies beyond.
fn weights(table: &LandingTable, deviation_rad: f64) -> DVector<f64> {
    let sigma = deviation_rad.max(1e-6);
    let density = |slope: f64| slope / (sigma * sigma) * libm::exp(-0.5 * (slope / sigma).powi(2));
    let raw: Vec<f64> = table.points.iter().map(|point| point.cell * density(point.slope_rad)).collect();
    let sum: f64 = raw.iter().sum();
    let level: f64 = table.points.iter().filter(|point| point.slope_rad == 0.0).map(|_| 1.0).sum();
    // Slopes far below the first step: all landings are level.
    if sum < 1e-3 {
        return DVector::from_iterator(raw.len(), table.points.iter().map(|p| if p.slope_rad == 0.0 { 1.0 / level } else { 0.0 }));
    }
    let steepest = table.points.iter().map(|point| point.slope_rad).fold(0.0, f64::max);
    let lost = if sum < 1.0 && sigma > 0.2 * steepest { libm::exp(-0.5 * (steepest / sigma).powi(2)) } else { 0.0 };
    let ends: f64 = table.points.iter().filter(|point| point.slope_rad == steepest).map(|point| point.cell).sum();
    let share = |point: &super::slope_grid::GridPoint, raw: f64| {
        let beyond = if point.slope_rad == steepest { lost * point.cell / ends } else { 0.0 };
        raw / sum * (1.0 - lost) + beyond
    };
    DVector::from_iterator(raw.len(), table.points.iter().zip(raw).map(|(point, raw)| share(point, raw)))
}
