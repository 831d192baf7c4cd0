//! A model's prediction for the mean of trigger-aligned records.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::fine_wave::{FINE_S, FineWave, ONSET_S};
use super::normal_law::{normal_below, normal_density};
use super::trigger_jitter::{Lags, TriggerJitter};
use super::waves::BEFORE;
use crate::impact::effects::Model;
use crate::impact::sim::{SolverOptions, Stop, System, wave};

/// Relative variation of stiffness or damping below which the change of a mean cannot be seen.
const SLIGHT: f64 = 0.04;
/// Largest relative variation of stiffness or damping: beyond it the three points leave what a frame can be.
const MOST_VARIED: f64 = 0.25;
/// Phases over which a covariance is averaged.
const PHASES: usize = 20;

/// Predicts mean windows.
///
/// The clock's phase is even over one step. The first sample beyond the trigger then lies evenly within one step behind
/// the moment at which the wave crosses it, so the mean of sample j is the wave's mean over the j-th step behind that
/// moment: (W(t + (j + 1) s) - W(t + j s)) / s, with W the wave's integral. Wrong where the wave is near the trigger for
/// long, or falls below it again at once.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// Time between samples, s.
    pub step_s: f64,
    /// Samples in a window.
    pub samples: usize,
    /// Standard deviation of single readings over their mean, a sample each, for the sensor's limit: the mean of limited readings is not the
    /// limited mean. Empty where no limit is met.
    pub spread: Arc<[f64]>,
    /// Relative variation of stiffness and damping between drops: the mean of waves is not the wave of the mean. Where a
    /// force jumps, as a preload's does when the frame leaves the ground, the mean is smeared over the moments of the jump.
    pub varied: [f64; 2],
    /// Jitter of the trigger by the variation of single readings.
    pub trigger_jitter: TriggerJitter,
}

/// Models made ready, each with its weight in the mean, the undisturbed one first; and the sensor's limit, g.
#[derive(Debug)]
pub struct Ready {
    systems: Vec<(f64, System)>,
    limit_g: f64,
    lags: Lags,
}

impl Expected {
    /// Of records that differ by the phase of the clock alone.
    pub fn plain(step_s: f64, samples: usize) -> Self {
        Self { step_s, samples, spread: Arc::default(), varied: [0.0; 2], trigger_jitter: TriggerJitter::default() }
    }

    /// A model made ready; where single readings vary, the sensor's limit is applied to their mean instead, and where
    /// stiffness or damping vary, the mean is taken over them (Gauss and Hermite, three points each).
    pub fn system(&self, model: &Model) -> Ready {
        let ready = |model: &Model| {
            let mut system = System::new(model);
            if !self.spread.is_empty() {
                system.lift_limit();
            }
            system
        };
        let limit_g = model.arrangement().sensor.limit_g;
        let mut systems = vec![(1.0, ready(model))];
        for (at, varied) in self.varied.into_iter().enumerate().filter(|(_, varied)| *varied > SLIGHT) {
            systems[0].0 -= 1.0 / 3.0;
            for side in [-1.0, 1.0] {
                let mut factors = [1.0; 2];
                factors[at] += side * 3f64.sqrt() * varied.min(MOST_VARIED);
                systems.push((1.0 / 6.0, ready(&model.scaled(factors))));
            }
        }
        Ready { systems, limit_g, lags: self.lags() }
    }

    /// The mean window from a height, g; `None` where the simulation diverges.
    pub fn window(&self, ready: &Ready, height_m: f64) -> Option<Vec<f64>> {
        let mut mean = vec![0.0; self.samples];
        for (weight, system) in &ready.systems {
            let mut fine = self.fine(system, height_m)?;
            self.limit(&mut fine, ready.limit_g);
            mean.iter_mut().zip(self.mean_of_aligned(&fine, &ready.lags)).for_each(|(sum, reading)| *sum += weight * reading);
        }
        Some(mean)
    }

    /// Takes single readings that vary around a wave to the mean of what the sensor reads of them.
    fn limit(&self, fine: &mut [f64], limit_g: f64) {
        if self.spread.is_empty() {
            return;
        }
        let crossing_s = FineWave::of(fine).crossing_s;
        for (point, reading) in fine.iter_mut().enumerate() {
            // Sample j is the wave's mean over the j-th step behind the trigger.
            let steps = (point as f64 * FINE_S - crossing_s) / self.step_s;
            let sample = (steps.floor() + BEFORE as f64).clamp(0.0, (self.spread.len() - 1) as f64);
            *reading = limited_mean(*reading, self.spread[sample as usize], limit_g);
        }
    }

    /// What the means of all waves share.
    pub fn lags(&self) -> Lags {
        self.trigger_jitter.lags(self.step_s, self.samples)
    }

    /// The mean window of records of a wave that differ by the phase of the clock and by the variation of their readings.
    pub fn mean_of_aligned(&self, fine: &[f64], lags: &Lags) -> Vec<f64> {
        let mut mean = self.mean_over_phases(fine);
        if self.trigger_jitter.moves() {
            let shift = self.trigger_jitter.shift(&FineWave::of(fine), self.step_s, lags);
            mean.iter_mut().zip(shift).for_each(|(sum, shift)| *sum += shift);
        }
        mean
    }

    /// From first touch to the trigger, s; `None` where the simulation diverges.
    pub fn onset_s(&self, ready: &Ready, height_m: f64) -> Option<f64> {
        Some(FineWave::of(&self.fine(&ready.systems.first()?.1, height_m)?).crossing_s)
    }

    /// How many points a wave needs for the window.
    pub fn fine_points(&self) -> usize {
        let end_s = ONSET_S + self.step_s * (self.samples - BEFORE + 1) as f64;
        (end_s / FINE_S) as usize + 2
    }

    /// The wave itself, at steps of 0.05 ms; `None` where the simulation diverges.
    pub fn fine(&self, system: &System, height_m: f64) -> Option<Vec<f64>> {
        let mut fine = vec![0.0; self.fine_points()];
        (wave(system, height_m, FINE_S, &SolverOptions::FIT, &mut fine) == Stop::End).then_some(fine)
    }

    /// Covariance of records of a wave that differ by the phase of the clock alone, g².
    pub fn over_phases(&self, fine: &[f64]) -> DMatrix<f64> {
        let (mean, fine) = (self.mean_over_phases(fine), FineWave::of(fine));
        let mut sum = DMatrix::zeros(self.samples, self.samples);
        for phase in 0..PHASES {
            let part = (phase as f64 + 0.5) / PHASES as f64;
            let off =
                DVector::from_fn(self.samples, |i, _| fine.at(fine.crossing_s + self.step_s * (i as f64 + part - BEFORE as f64)) - mean[i]);
            sum += &off * off.transpose() / PHASES as f64;
        }
        sum
    }

    /// The mean window of records of a wave that is given every 0.05 ms from first touch on.
    pub fn mean_over_phases(&self, fine: &[f64]) -> Vec<f64> {
        let crossing = FineWave::of(fine).crossing_s;
        let integral = integral(fine);
        let at = |t_s: f64| value(&integral, fine, t_s);
        let bound = |i: usize| crossing + self.step_s * (i as f64 - BEFORE as f64);
        (0..self.samples).map(|i| (at(bound(i + 1)) - at(bound(i))) / self.step_s).collect()
    }
}

/// Mean of readings that vary normally around `reading` by `spread` of it and are cut at the limit.
fn limited_mean(reading: f64, spread: f64, limit_g: f64) -> f64 {
    let sd = spread * reading.abs();
    let over = reading - limit_g;
    if sd <= 0.0 || over < -5.0 * sd {
        return reading.min(limit_g);
    }
    let z = over / sd;
    reading - (sd * normal_density(z) + over * normal_below(z))
}

/// The wave's integral at its points, g s: cubic between four points, straight where the wave begins or ends.
fn integral(fine: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; fine.len()];
    for i in 1..fine.len() {
        let inner = i >= 3 && i + 1 < fine.len();
        let area = if inner { (13.0 * (fine[i - 1] + fine[i]) - fine[i - 2] - fine[i + 1]) / 24.0 } else { 0.5 * (fine[i - 1] + fine[i]) };
        sums[i] = sums[i - 1] + FINE_S * area;
    }
    sums
}

/// The integral at any time, g s; zero before first touch.
fn value(integral: &[f64], fine: &[f64], t_s: f64) -> f64 {
    if t_s <= 0.0 {
        return 0.0;
    }
    let place = t_s / FINE_S;
    let at = (place as usize).min(fine.len() - 2);
    let part = place - at as f64;
    let middle = fine[at] + 0.5 * part * (fine[at + 1] - fine[at]);
    integral[at] + FINE_S * part * middle
}
