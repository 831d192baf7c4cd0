//! The sensor's output alone, at equal steps: what fits compare.

use super::integrate::{Flow, SolverOptions, Stop, integrate};
use super::system::{CORE, System};

/// Fills `out` with the sensor's reading in g, before sampling, at 0, `step_s`, 2 `step_s` … from first touch.
///
/// A run that ends early repeats its last reading; the answer says so.
pub fn wave(system: &System, height_m: f64, step_s: f64, settings: &SolverOptions, out: &mut [f64]) -> Stop {
    match system.core {
        0..=4 => run::<4>(system, height_m, step_s, settings, out),
        5..=6 => run::<6>(system, height_m, step_s, settings, out),
        7..=8 => run::<8>(system, height_m, step_s, settings, out),
        _ => run::<CORE>(system, height_m, step_s, settings, out),
    }
}

fn run<const N: usize>(system: &System, height_m: f64, step_s: f64, settings: &SolverOptions, out: &mut [f64]) -> Stop {
    let (sensed, sensor) = (system.sensed(), system.arrangement().sensor);
    let mut filled = 0;
    let mut last = 0.0;
    // A little more, so that rounding does not lose the last point.
    let longest = SolverOptions { duration_s: step_s * (out.len() as f64 - 0.999), ..*settings };
    let stop = integrate::<N>(system, height_m, &longest, false, |dense, _| {
        let end_s = dense.time_s(1.0);
        let first = filled;
        while filled < out.len() && filled as f64 * step_s <= end_s {
            filled += 1;
        }
        for (at, reading) in out[first..filled].iter_mut().enumerate() {
            let theta = ((first + at) as f64 * step_s - dense.start_s) / dense.h_s;
            *reading = sensor.reading_g(dense.one(sensed, theta));
        }
        last = out[..filled].last().copied().unwrap_or(last);
        Flow::On
    });
    out[filled..].fill(last);
    stop
}
