//! Landings at one speed over all slopes: mean windows and touch times.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::descent::Descent;
use super::legged_body::{LeggedBody, Legs, Slopes};
use super::sensor_mount::SensorMount;
use super::simulation::{FEET, Landing, Landings, STEP_S, SensorAxis, simulate_each};
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
    /// Simulates; `None` where a landing is lost. The model gives fall and sensor, the slopes' spread how fast sloped landings turn.
    pub fn of(body: &LeggedBody, legs: &Legs, slopes: &Slopes, model: &Model, expected: &Expected, height_m: f64) -> Option<Self> {
        Self::along(SensorAxis::Body, body, legs, slopes, model, expected, height_m)
    }

    /// The same as a sensor would read them whose axis keeps to the body or to the vertical.
    pub fn along(
        axis: SensorAxis,
        body: &LeggedBody,
        legs: &Legs,
        slopes: &Slopes,
        model: &Model,
        expected: &Expected,
        height_m: f64,
    ) -> Option<Self> {
        let descent = Descent::of(model, slopes, height_m);
        let lags = expected.lags();
        let read = |landing: ReadLanding| {
            let [_, opposite, beside, far] = landing.touch_s.map(|touch| touch.unwrap_or(NEVER_S));
            (expected.mean_of_aligned(&landing.wave_g, &lags), [opposite, beside.min(far), beside.max(far)])
        };
        let landings: Vec<_> = landed_everywhere(axis, body, legs, descent, model, expected)?.into_par_iter().map(read).collect();
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
        Some(Self { points, simulated, delays_s, fall_s: model.arrangement().fall.duration_s(height_m) })
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
    descent: Descent,
    model: &Model,
    expected: &Expected,
    weights: &DVector<f64>,
) -> Option<DMatrix<f64>> {
    let landings = landed_everywhere(SensorAxis::Body, body, legs, descent, model, expected)?;
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
    descent: Descent,
    model: &Model,
    expected: &Expected,
) -> Option<Vec<ReadLanding>> {
    let slopes = simulated();
    let (together, alone) = slopes.as_chunks::<TOGETHER>();
    let points = expected.fine_points();
    let simulate = |slopes: &[f64; 2]| read(simulate_each(body, legs, descent, &[*slopes], points, axis), legs.mount, model);
    let simulate_together =
        |slopes: &[[f64; 2]; TOGETHER]| read(simulate_each(body, legs, descent, slopes, points, axis), legs.mount, model);
    let mut landings: Vec<Option<ReadLanding>> = together.par_iter().flat_map_iter(simulate_together).collect();
    landings.extend(alone.iter().flat_map(simulate));
    landings.into_iter().collect()
}

/// What the sensor reads of each landing; `None` where the body is lost.
fn read<const N: usize>(mut landings: Landings<N>, mount: Option<SensorMount>, model: &Model) -> [Option<ReadLanding>; N] {
    with_wide_registers(Sensing { waves_g: &mut landings.accel_g, mount, sensor: model.arrangement().sensor });
    landings.each().map(|landing| landing.map(|Landing { accel_g: wave_g, touch_s }| ReadLanding { wave_g, touch_s }))
}

/// Proper acceleration of bodies, g, that becomes what their sensors read: the mount, the sensor's stages one after the other, gain and limit.
struct Sensing<'a, const N: usize> {
    waves_g: &'a mut [[f64; N]],
    mount: Option<SensorMount>,
    sensor: Sensor,
}

impl<const N: usize> Loops for Sensing<'_, N> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { waves_g, mount, sensor } = self;
        if let Some(mount) = mount {
            mount.carry(waves_g, STEP_S);
        }
        let kept = libm::exp(-sensor.rate_1_s() * STEP_S);
        for _ in 0..sensor.order {
            let mut state = [0.0; N];
            for readings in waves_g.iter_mut() {
                for at in 0..N {
                    state[at] = kept * state[at] + (1.0 - kept) * readings[at];
                }
                *readings = state;
            }
        }
        for reading in waves_g.as_flattened_mut() {
            *reading = (sensor.gain * *reading).clamp(-sensor.limit_g, sensor.limit_g);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::effects::Channel;

    #[test]
    fn analytic_wide_registers_give_the_bits_of_narrow_ones() {
        let begin: Vec<[f64; 4]> =
            (0..600).map(|point| [20.0, 90.0, 150.0, 400.0].map(|peak_g| peak_g * libm::sin(f64::from(point) * 5e-3))).collect();
        let sensing = |waves_g| Sensing {
            waves_g,
            mount: Some(SensorMount { f_hz: 180.0, zeta: 0.2 }),
            sensor: Sensor { gain: 0.97, ..Sensor::new(500.0, 2, 230.0, Channel::Axial) },
        };
        let [mut wide, mut narrow] = [begin.clone(), begin.clone()];
        with_wide_registers(sensing(&mut wide));
        sensing(&mut narrow).run();
        assert!(wide == narrow && wide != begin);
        assert!(wide.as_flattened().contains(&230.0), "one reaches the limit");
    }
}
