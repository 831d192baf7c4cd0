//! The sensor's output alone, at equal steps: what fits compare.

use super::integrate::{Run, SolverOptions, Stop};
use super::system::{CORE, System};
use crate::impact::wide_registers::{Loops, with_wide_registers};

/// Fills `out` with the sensor's reading in g, before sampling, at 0, `step_s`, 2 `step_s` … from first touch.
///
/// A run that ends early repeats its last reading; the answer says so.
pub fn wave(system: &System, height_m: f64, step_s: f64, settings: &SolverOptions, out: &mut [f64]) -> Stop {
    match system.core {
        0..=4 => with_wide_registers(Reading::<4> { system, height_m, step_s, settings, out }),
        5..=6 => with_wide_registers(Reading::<6> { system, height_m, step_s, settings, out }),
        7..=8 => with_wide_registers(Reading::<8> { system, height_m, step_s, settings, out }),
        _ => with_wide_registers(Reading::<CORE> { system, height_m, step_s, settings, out }),
    }
}

/// A run with so many states whose sensor is read at equal steps.
struct Reading<'a, const N: usize> {
    system: &'a System,
    height_m: f64,
    step_s: f64,
    settings: &'a SolverOptions,
    out: &'a mut [f64],
}

impl<const N: usize> Loops for Reading<'_, N> {
    type Output = Stop;

    #[inline(always)]
    fn run(self) -> Stop {
        let Self { system, height_m, step_s, settings, out } = self;
        let (sensed, sensor) = (system.sensed(), system.arrangement().sensor);
        let mut filled = 0;
        let mut last = 0.0;
        // A little more, so that rounding does not lose the last point.
        let longest = SolverOptions { duration_s: step_s * (out.len() as f64 - 0.999), ..*settings };
        let mut run = Run::<N>::from_touch(system, height_m, longest, false);
        let stop = loop {
            let dense = match run.step() {
                Ok((dense, _)) => dense,
                Err(stop) => break stop,
            };
            let (end_s, per_s) = (dense.time_s(1.0), 1.0 / dense.h_s);
            let first = filled;
            while filled < out.len() && filled as f64 * step_s <= end_s {
                filled += 1;
            }
            for (at, reading) in out[first..filled].iter_mut().enumerate() {
                let theta = ((first + at) as f64 * step_s - dense.start_s) * per_s;
                *reading = sensor.reading_g(dense.one(sensed, theta));
            }
            last = out[..filled].last().copied().unwrap_or(last);
        };
        out[filled..].fill(last);
        stop
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::body::{DropBody, Origin};
    use crate::impact::effects::{Channel, Model, Sensor, by_id};

    #[test]
    fn analytic_wide_registers_give_the_bits_of_narrow_ones() {
        let body = DropBody { mass_kg: 0.241, gap_m: 0.02, travel_m: None, feet: None, origin: Origin::Model("test".into()) };
        let base = Model::base(body, Sensor::new(500.0, 1, 1e5, Channel::Axial), 7040.0, 46.0);
        let sets: [&[(&str, &[f64])]; 4] = [
            &[],
            &[("coulomb_friction", &[20.0]), ("payload_mode", &[0.3, 120.0, 0.05])],
            &[("bottoming", &[9.0, 1e6, 0.3]), ("foot_stagger", &[5.0])],
            &[("maxwell_branch", &[1e4, 3.0]), ("unilateral_contact", &[0.0]), ("preload", &[40.0])],
        ];
        for effects in sets {
            let model = effects.iter().fold(base.clone(), |model, (id, values)| model.with(by_id(id).expect("is known"), values, 0));
            let system = System::new(&model);
            let [mut wide, mut narrow] = [(); 2].map(|()| vec![0.0; 700]);
            let reading = |out| Reading::<CORE> { system: &system, height_m: 1.2, step_s: 5e-5, settings: &SolverOptions::FIT, out };
            assert_eq!([with_wide_registers(reading(&mut wide)), reading(&mut narrow).run()], [Stop::End; 2]);
            assert!(wide.iter().any(|reading_g| *reading_g > 30.0) && wide == narrow, "{effects:?}");
            // However many states have room.
            assert_eq!(wave(&system, 1.2, 5e-5, &SolverOptions::FIT, &mut narrow), Stop::End);
            assert!(wide == narrow, "{effects:?}");
        }
    }
}
