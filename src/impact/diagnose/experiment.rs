//! The experiment that would distinguish the remaining candidates best.

use serde::Serialize;

use super::candidate::Candidate;
use crate::impact::effects::Model;
use crate::impact::fit::{FitProblem, TrialCovariance};
use crate::impact::sim::{SlowWay, SolverOptions, System, wave};
use crate::units::GRAVITY_M_S2;

/// An experiment with what it promises.
#[derive(Clone, Debug, Serialize)]
pub struct Experiment {
    /// What to do, in plain words.
    pub what: String,
    /// Kind: `drop`, `static_test` or `fast_sensor`.
    pub kind: &'static str,
    /// Its height, m, where it is a drop.
    pub height_m: Option<f64>,
    /// Squared distance between the two best candidates as they are fitted, in units of the errors that the drops at hand show. A fit to the new
    /// drops, too, lets both come nearer: it is an upper bound, by which experiments are put in order.
    pub discrimination: f64,
    /// The two that it would distinguish.
    pub between: [String; 2],
}

/// Heights that could be added, m.
const HEIGHTS_M: [f64; 9] = [0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0];
/// Least error of a reading, g: the noise of the paper's logger at rest, 0.17 to 0.18 g in its records.
const NOISE_G: f64 = 0.17;
/// Most that a static test presses with, N: a stop's force in a model has no end, a press has.
const MOST_FORCE_N: f64 = 1e3 * GRAVITY_M_S2;
/// Drops of an added height.
const DROPS: f64 = 20.0;
/// A static test's error, N: what the paper's ten points leave about their straight line is 4.8 N.
const STATIC_ERROR_N: f64 = 5.0;
/// Compressions of a static test, m.
const STATIC_M: [f64; 8] = [0.002, 0.004, 0.006, 0.008, 0.010, 0.012, 0.014, 0.016];
/// A faster logger: samples every, s, over the first, s.
const FAST: (f64, f64) = (1e-4, 0.02);
/// Cutoff of a faster sensor, Hz.
const FAST_CUTOFF_HZ: f64 = 5000.0;

/// Every experiment, most decisive first.
pub fn experiments(problem: &FitProblem, trial_covariance: &TrialCovariance, first: &Candidate, second: &Candidate) -> Vec<Experiment> {
    let between =
        [first.ids().join(" + "), second.ids().join(" + ")].map(|ids| if ids.is_empty() { "nothing missing".into() } else { ids });
    let (a, b) = (first.model(), second.model());
    let relative = relative_error(problem, trial_covariance);
    let mut all = Vec::new();
    for height_m in HEIGHTS_M {
        let known = problem.means.iter().any(|mean| (mean.height_m - height_m).abs() < 0.05 * height_m);
        if let (false, Some(discrimination)) = (known, squared_distance(a, b, height_m, problem.expected.step_s, None, relative)) {
            all.push(Experiment {
                what: format!("drop the frame {DROPS} times from {height_m} m with the same sensor"),
                kind: "drop",
                height_m: Some(height_m),
                discrimination,
                between: between.clone(),
            });
        }
    }
    let tallest = problem.means.iter().map(|mean| mean.height_m).fold(0.0, f64::max);
    if let Some(discrimination) = squared_distance(a, b, tallest, FAST.0, Some(FAST_CUTOFF_HZ), relative) {
        all.push(Experiment {
            what: format!("drop it {DROPS} times from {tallest} m with a sensor of {FAST_CUTOFF_HZ} Hz read 10,000 times a second"),
            kind: "fast_sensor",
            height_m: Some(tallest),
            discrimination,
            between: between.clone(),
        });
    }
    all.push(Experiment {
        what: "measure a static load test with a dynamometer, 2 to 16 mm in steps of 2 mm, up and down".into(),
        kind: "static_test",
        height_m: None,
        discrimination: static_distance(a, b),
        between,
    });
    all.sort_by(|a, b| b.discrimination.total_cmp(&a.discrimination));
    all
}

fn squared(value: f64) -> f64 {
    value * value
}

/// Standard error of one drop's reading over the peak, in mean over what was measured.
fn relative_error(problem: &FitProblem, trial_covariance: &TrialCovariance) -> f64 {
    let counts = trial_covariance.counts();
    let of = |(at, errors): (usize, Vec<f64>)| {
        let peak = problem.means[at].wave.iter().fold(0.0_f64, |peak, reading| peak.max(reading.abs()));
        let square = errors.iter().map(|error| error * error * counts[at] as f64).sum::<f64>() / errors.len() as f64;
        square.sqrt() / peak.max(1e-9)
    };
    let each: Vec<f64> = trial_covariance.standard_errors().into_iter().enumerate().map(of).collect();
    each.iter().sum::<f64>() / each.len() as f64
}

/// Squared distance of two models' waves, with the same relative standard error as in the drops at hand.
fn squared_distance(a: &Model, b: &Model, height_m: f64, step_s: f64, cutoff_hz: Option<f64>, relative: f64) -> Option<f64> {
    let points = (FAST.1 / step_s) as usize;
    let run = |model: &Model| {
        let mut system = System::new(model);
        if let Some(cutoff_hz) = cutoff_hz {
            system.set_cutoff(cutoff_hz);
        }
        let mut out = vec![0.0; points];
        (wave(&system, height_m, step_s, &SolverOptions::FIT, &mut out) == crate::impact::sim::Stop::End).then_some(out)
    };
    let (a, b) = (run(a)?, run(b)?);
    let peak = a.iter().fold(0.0_f64, |peak, reading| peak.max(reading.abs()));
    let error = (relative * peak).max(NOISE_G) / DROPS.sqrt();
    // Neighbouring readings of a fast logger are correlated: as many count as a slow one gives.
    let independent = (step_s / 1e-3).min(1.0);
    Some(independent * a.iter().zip(&b).map(|(a, b)| squared((a - b) / error)).sum::<f64>())
}

/// Squared distance of two models' forces in a static test, down and up.
fn static_distance(a: &Model, b: &Model) -> f64 {
    let force_n = |model: &Model, x_m: f64, way| System::new(model).slow_force_n(x_m, way).min(MOST_FORCE_N);
    let one_way = |way| STATIC_M.iter().map(|x_m| squared((force_n(a, *x_m, way) - force_n(b, *x_m, way)) / STATIC_ERROR_N)).sum::<f64>();
    one_way(SlowWay::Loading) + one_way(SlowWay::Unloading)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::effects::by_id;

    /// Friction shows as half of the loop between loading and unloading, wherever the spring force is larger.
    #[test]
    fn analytic_a_static_test_tells_dry_friction_by_its_loop() {
        let base = Model::load("paper-corrected").expect("comes with the program");
        let rubbing = base.clone().with(by_id("coulomb_friction").expect("an effect"), &[10.0], 0);
        let expected = 2.0 * STATIC_M.len() as f64 * squared(10.0 / STATIC_ERROR_N);
        assert!((static_distance(&base, &rubbing) - expected).abs() < 1e-9, "{}", static_distance(&base, &rubbing));
        let slow = |way| System::new(&rubbing).slow_force_n(0.01, way);
        assert!((slow(SlowWay::Loading) - slow(SlowWay::Unloading) - 20.0).abs() < 1e-9);
        // A frame that sticks pushes with nothing.
        assert_eq!(System::new(&rubbing).slow_force_n(0.0, SlowWay::Unloading), 0.0);
    }
}
