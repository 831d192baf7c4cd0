//! What a drop's own touch times say of its slope, and of its wave.

use nalgebra::DVector;

use super::bell::Bell;
use super::population::Population;
use super::table::LandingTable;
use super::touches::LegTouches;

/// Times that belong to no touch lie evenly within this, s.
const STRAY_S: f64 = 15e-3;
/// A spike of this size is as often a stray as not, g.
const STRAY_G: f64 = 15.0;
/// Part of the largest spikes that are strays.
const LEAST_STRAY: f64 = 0.05;

/// A drop's landing by its touches.
#[derive(Clone, Debug)]
pub struct SlopeEstimate {
    /// Expected slope, rad.
    pub slope_rad: f64,
    /// Its standard deviation, rad.
    pub deviation_rad: f64,
    /// Expected angle of the slope to the nearest diagonal, rad.
    pub direction_rad: f64,
    /// Expected window, g.
    pub window: DVector<f64>,
}

/// The expected landing of a drop from its touch times, which were read with a standard deviation of `read_s`, slopes being distributed as
/// in a population.
pub fn given_touches(table: &LandingTable, population: &Population, touches: &LegTouches, read_s: f64) -> SlopeEstimate {
    let seen = [touches.opposite, touches.beside[0], touches.beside[1]];
    let stray = seen.map(|touch| libm::exp(-touch.size_g / STRAY_G).clamp(LEAST_STRAY, 1.0));
    let (bell, per_s) = (Bell::new(), 1.0 / read_s);
    let height = per_s / (2.0 * std::f64::consts::PI).sqrt();
    let at =
        |foot: usize, delay_s: f64| stray[foot] / STRAY_S + (1.0 - stray[foot]) * height * bell.at((seen[foot].delay_s - delay_s) * per_s);
    let likelihood = |delays_s: &[f64; 3]| at(0, delays_s[0]) * at(1, delays_s[1]) * at(2, delays_s[2]);
    let weighed = |(delays_s, weight): (&[f64; 3], &f64)| weight * likelihood(delays_s);
    let weights = DVector::from_iterator(table.points.len(), table.delays_s.iter().zip(population.weights().iter()).map(weighed));
    let sum = weights.sum();
    let weights = if sum > 0.0 { weights / sum } else { population.weights().clone() };
    let (mut slope_rad, mut square, mut direction_rad) = (0.0, 0.0, 0.0);
    for (point, weight) in table.points.iter().zip(weights.iter()) {
        slope_rad += weight * point.slope_rad;
        square += weight * point.slope_rad * point.slope_rad;
        direction_rad += weight * point.direction_rad;
    }
    let window = table.window(weights.iter().copied());
    SlopeEstimate { slope_rad, deviation_rad: (square - slope_rad * slope_rad).max(0.0).sqrt(), direction_rad, window }
}
