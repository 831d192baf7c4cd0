//! Many landings with random slopes: the mean wave, and how the touch times spread.

use nalgebra::{DMatrix, DVector};

use super::legged_body::Slopes;
use super::read_delays::ReadDelays;
use super::table::LandingTable;

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

    /// The same of slopes each of which may be those of the population, as likely as they are.
    pub fn likely(table: &'a LandingTable, slopes: &[(Slopes, f64)]) -> Self {
        let all: f64 = slopes.iter().map(|(_, likely)| likely).sum();
        let none = DVector::zeros(table.points.len());
        let add = |sum: DVector<f64>, (slopes, likely): &(Slopes, f64)| sum + Self::of(table, slopes).weights * (likely / all);
        Self { table, weights: slopes.iter().fold(none, add) }
    }

    /// The landings that are weighed.
    pub fn table(&self) -> &'a LandingTable {
        self.table
    }

    /// Mean window, g.
    pub fn mean_window(&self) -> DVector<f64> {
        self.table.window(self.weights.iter().copied())
    }

    /// Covariance of windows that differ by their landing's slope, g².
    pub fn covariance(&self) -> DMatrix<f64> {
        let mean = self.mean_window();
        let mut off = self.table.windows();
        for (mut column, weight) in off.column_iter_mut().zip(self.weights.iter()) {
            column -= &mean;
            column *= weight.sqrt();
        }
        &off * off.transpose()
    }

    /// Quantile of the time from the first foot to the opposite one, s, of the landings in which it touches as soon as it is looked for.
    pub fn opposite_delay_s(&self, share: f64) -> f64 {
        let [delay_s] = ReadDelays::of(self.table, None).quantiles_s(&self.weights, [share]);
        delay_s
    }

    /// How frequent each of the table's slopes is.
    pub fn weights(&self) -> &DVector<f64> {
        &self.weights
    }
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
