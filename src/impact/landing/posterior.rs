//! What a drop's own touch times say of its slope, and of its wave.

use nalgebra::DVector;

use super::population::Population;
use super::table::LandingTable;
use super::touches::LegTouches;

/// Times that belong to no touch lie evenly within this, s.
const STRAY_S: f64 = 15e-3;
/// A time that is off by more of its standard deviations is none of a touch.
const FAR: f64 = 8.0;
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
    let likelihood = |delays_s: &[f64; 3]| {
        let each = seen.iter().zip(stray).zip(delays_s).map(|((touch, stray), delay_s)| {
            let off = (touch.delay_s - delay_s) / read_s;
            let read = if off.abs() < FAR { libm::exp(-0.5 * off * off) / (read_s * (2.0 * std::f64::consts::PI).sqrt()) } else { 0.0 };
            stray / STRAY_S + (1.0 - stray) * read
        });
        each.product::<f64>()
    };
    let weighed = |(delays_s, weight): (&[f64; 3], &f64)| if *weight > 0.0 { weight * likelihood(delays_s) } else { 0.0 };
    let weights = DVector::from_iterator(table.points.len(), table.delays_s.iter().zip(population.weights().iter()).map(weighed));
    let sum = weights.sum();
    let weights = if sum > 0.0 { weights / sum } else { population.weights().clone() };
    let moment = |power: i32| table.points.iter().zip(weights.iter()).map(|(point, w)| w * point.slope_rad.powi(power)).sum::<f64>();
    let slope_rad = moment(1);
    let direction_rad = table.points.iter().zip(weights.iter()).map(|(point, weight)| weight * point.direction_rad).sum();
    SlopeEstimate {
        slope_rad,
        deviation_rad: (moment(2) - slope_rad * slope_rad).max(0.0).sqrt(),
        direction_rad,
        window: &table.windows * weights,
    }
}
