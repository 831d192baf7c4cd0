//! Landings at one speed over all slopes: mean windows and touch times.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::legged_body::{LeggedBody, Legs, fall};
use super::simulation::{FEET, Landing, STEP_S, SensorAxis, simulate_each};
use super::slope_grid::{GridPoint, points, simulated};
use crate::impact::effects::{Model, Sensor};
use crate::impact::fit::Expected;
use crate::impact::wide_registers::{Loops, with_wide_registers};

/// Touch time of a foot that does not touch, s.
pub const NEVER_S: f64 = 0.03;

/// Landings from one height.
#[derive(Clone, Debug)]
pub struct LandingTable {
    /// The slopes.
    pub points: &'static [GridPoint],
    /// A column for each slope that was simulated: readings of a trigger-aligned record, averaged over the clock's phase, g.
    simulated: DMatrix<f64>,
    /// Touch times of each point, s: the foot opposite to the first, the two beside it, the earlier one first.
    pub delays_s: Vec<[f64; 3]>,
    /// How long the fall took, s.
    pub fall_s: f64,
}

impl LandingTable {
    /// Simulates; `None` where a landing is lost. The model gives fall and sensor.
    pub fn of(body: &LeggedBody, legs: &Legs, model: &Model, expected: &Expected, height_m: f64) -> Option<Self> {
        Self::along(SensorAxis::Body, body, legs, model, expected, height_m)
    }

    /// The same as a sensor would read them whose axis keeps to the body or to the vertical.
    pub fn along(axis: SensorAxis, body: &LeggedBody, legs: &Legs, model: &Model, expected: &Expected, height_m: f64) -> Option<Self> {
        let [_, fall_s] = fall(model, height_m);
        let lags = expected.lags();
        let read = |landing: ReadLanding| {
            let [_, opposite, beside, far] = landing.touch_s.map(|touch| touch.unwrap_or(NEVER_S));
            (expected.mean_of_aligned(&landing.wave_g, &lags), [opposite, beside.min(far), beside.max(far)])
        };
        let landings: Vec<_> = landed_everywhere(axis, body, legs, model, expected, height_m)?.into_par_iter().map(read).collect();
        let points = points();
        let mut delays_s = Vec::with_capacity(points.len());
        for point in points {
            let mut delays = [0.0; 3];
            for (node, weight) in point.around {
                delays.iter_mut().zip(landings[node].1).for_each(|(sum, delay)| *sum += weight * delay);
            }
            delays_s.push(delays);
        }
        let simulated = DMatrix::from_fn(expected.samples, landings.len(), |sample, node| landings[node].0[sample]);
        Some(Self { points, simulated, delays_s, fall_s })
    }

    /// Sum of the points' windows, each times its weight, g. Windows between the simulated slopes are straight between theirs, so the weights are
    /// first summed at these.
    pub fn window(&self, weights: impl Iterator<Item = f64>) -> DVector<f64> {
        let weights = at_simulated(self.simulated.ncols(), weights);
        with_wide_registers(Weighed { columns: &self.simulated, weights: &weights })
    }

    /// A column for each point: its window, g.
    pub fn windows(&self) -> DMatrix<f64> {
        let mut windows = DMatrix::zeros(self.simulated.nrows(), self.points.len());
        for (point, mut window) in self.points.iter().zip(windows.column_iter_mut()) {
            point.around.iter().for_each(|(node, share)| window.axpy(*share, &self.simulated.column(*node), 1.0));
        }
        windows
    }
}

/// Columns, each times its weight.
struct Weighed<'a> {
    columns: &'a DMatrix<f64>,
    weights: &'a DVector<f64>,
}

impl Loops for Weighed<'_> {
    type Output = DVector<f64>;

    #[inline(always)]
    fn run(self) -> DVector<f64> {
        let mut sum = DVector::zeros(self.columns.nrows());
        for (column, weight) in self.columns.column_iter().zip(self.weights.as_slice()) {
            for (sum, value) in sum.as_mut_slice().iter_mut().zip(column.as_slice()) {
                *sum += weight * value;
            }
        }
        sum
    }
}

/// Weights of the points, summed at the so many simulated slopes around them.
fn at_simulated(count: usize, weights: impl Iterator<Item = f64>) -> DVector<f64> {
    let mut sums = DVector::zeros(count);
    for (point, weight) in points().iter().zip(weights) {
        point.around.iter().for_each(|(node, share)| sums[*node] += weight * share);
    }
    sums
}

/// Covariance of records of landings that differ by the phase of the clock alone, g², the points being as frequent as weighed.
pub fn phase_covariance(
    body: &LeggedBody,
    legs: &Legs,
    model: &Model,
    expected: &Expected,
    height_m: f64,
    weights: &DVector<f64>,
) -> Option<DMatrix<f64>> {
    let landings = landed_everywhere(SensorAxis::Body, body, legs, model, expected, height_m)?;
    let shares = at_simulated(landings.len(), weights.iter().copied());
    let covariances: Vec<_> =
        landings.iter().zip(shares.iter()).map(|(landing, share)| expected.over_phases(&landing.wave_g) * *share).collect();
    covariances.into_iter().reduce(|sum, part| sum + part)
}

/// Landings that are simulated side by side.
const TOGETHER: usize = 4;

/// What the sensor reads of a landing.
struct ReadLanding {
    /// From first touch on, g.
    wave_g: Vec<f64>,
    /// When each foot touched, s.
    touch_s: [Option<f64>; FEET],
}

/// The landing at each simulated slope.
fn landed_everywhere(
    axis: SensorAxis,
    body: &LeggedBody,
    legs: &Legs,
    model: &Model,
    expected: &Expected,
    height_m: f64,
) -> Option<Vec<ReadLanding>> {
    let [speed_m_s, _] = fall(model, height_m);
    let read = |landing: Landing| {
        let mut wave = landing.accel_g;
        legs.mount.iter().for_each(|mount| mount.carry(&mut wave, STEP_S));
        ReadLanding { wave_g: filtered(wave, &model.arrangement().sensor), touch_s: landing.touch_s }
    };
    let slopes = simulated();
    let (together, alone) = slopes.as_chunks::<TOGETHER>();
    let points = expected.fine_points();
    let mut landings: Vec<Option<Landing>> =
        together.par_iter().flat_map_iter(|slopes| simulate_each(body, legs, speed_m_s, slopes, points, axis)).collect();
    landings.extend(alone.iter().flat_map(|slopes| simulate_each(body, legs, speed_m_s, &[*slopes], points, axis)));
    landings.into_par_iter().map(|landing| Some(read(landing?))).collect()
}

/// What the sensor reads: its stages one after the other, gain and limit.
fn filtered(mut wave: Vec<f64>, sensor: &Sensor) -> Vec<f64> {
    let kept = libm::exp(-sensor.rate_1_s() * STEP_S);
    for _ in 0..sensor.order {
        let mut state = 0.0;
        for reading in &mut wave {
            state = kept * state + (1.0 - kept) * *reading;
            *reading = state;
        }
    }
    wave.iter().map(|reading| (sensor.gain * reading).clamp(-sensor.limit_g, sensor.limit_g)).collect()
}
