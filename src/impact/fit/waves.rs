//! Trigger-aligned records, gathered by height.

use super::decimation::Decimation;
use crate::impact::measured::TRIGGER_G;

/// One drop as it was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedDrop {
    /// Its name.
    pub trial: String,
    /// Height of the drop, m.
    pub height_m: f64,
    /// Times of the samples, s.
    pub t_s: Vec<f64>,
    /// Readings, g: positive while the ground pushes.
    pub accel_g: Vec<f64>,
}

/// Drops from one height.
#[derive(Clone, Debug)]
pub struct WaveGroup {
    /// Height, m.
    pub height_m: f64,
    /// How its readings were averaged and thinned out.
    pub decimation: Decimation,
    /// Names of the drops in the order of the windows.
    pub trials: Vec<String>,
    /// A window a drop: `BEFORE` samples, then those from the trigger on.
    pub windows: Vec<Vec<f64>>,
    /// Mean of the windows, g.
    pub mean: Vec<f64>,
}

/// All drops, height by height.
#[derive(Clone, Debug)]
pub struct Waves {
    /// Rising height.
    pub groups: Vec<WaveGroup>,
    /// Time between the samples of a window, s.
    pub step_s: f64,
    /// Samples in a window.
    pub samples: usize,
    /// Standard deviation of the readings before first touch, g.
    pub noise_g: f64,
}

/// Why drops cannot be fitted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unusable {
    /// No reading beyond the trigger.
    #[error("drop `{trial}` from {height_m} m has no impact: no reading is beyond {TRIGGER_G} g")]
    NoImpact {
        /// Its name.
        trial: String,
        /// Its height, m.
        height_m: f64,
    },
    /// The record ends too soon.
    #[error("drop `{trial}` from {height_m} m has {samples} samples from first touch on; {LEAST} are needed")]
    TooShort {
        /// Its name.
        trial: String,
        /// Its height, m.
        height_m: f64,
        /// Samples from the trigger on.
        samples: usize,
    },
    /// Samples are not equally spaced, or not like the others'.
    #[error("drop `{trial}` from {height_m} m is sampled every {step_ms:.4} ms, the first drop of this height every {first_ms:.4} ms")]
    Rate {
        /// Its name.
        trial: String,
        /// Its height, m.
        height_m: f64,
        /// Its time between samples, ms.
        step_ms: f64,
        /// That of the height's first drop, ms.
        first_ms: f64,
    },
    /// The trial covariance, in whose units a gap is judged, cannot be estimated.
    #[error("{height_m} m has {count} usable drops{left_out}; at least {FEWEST} a height are needed to estimate the trial covariance")]
    TooFew {
        /// Height, m.
        height_m: f64,
        /// How many.
        count: usize,
        /// How many were left out and why most of them were, in words; empty where none were.
        left_out: String,
    },
    /// Nothing to fit.
    #[error("there is no drop")]
    Empty,
}

/// Samples kept before the trigger.
pub const BEFORE: usize = 1;
/// Time kept from the trigger on, s.
pub(super) const AFTER_S: f64 = 0.030;
/// Least samples from the trigger on.
pub(super) const LEAST: usize = 10;
/// Least drops a height.
const FEWEST: usize = 4;
/// Samples before the trigger that are not yet used for the noise: the ground may touch there.
const GUARD: usize = 2;

impl Waves {
    /// Aligns drops at their trigger.
    ///
    /// # Errors
    /// [`Unusable`] with the drop that cannot be used.
    pub fn of(drops: &[FittedDrop]) -> Result<Self, Unusable> {
        if drops.is_empty() {
            return Err(Unusable::Empty);
        }
        let native_s = same_rate_by_height(drops)?;
        let step_s = Decimation::common_step_s(native_s.iter().map(|(_, native_s)| *native_s));
        let decimation = |height_m: f64| {
            let native_s = native_s.iter().find(|(of, _)| *of == height_m).map_or(step_s, |(_, native_s)| *native_s);
            Decimation { native_s, kept_s: step_s }
        };
        let mut samples = (AFTER_S / step_s).round() as usize + BEFORE;
        for drop in drops {
            let (trial, height_m) = (drop.trial.clone(), drop.height_m);
            let left = samples_from_trigger(&drop.accel_g, &decimation(height_m));
            let left = left.ok_or(Unusable::NoImpact { trial: trial.clone(), height_m })?;
            if left < LEAST {
                return Err(Unusable::TooShort { trial, height_m, samples: left });
            }
            samples = samples.min(left + BEFORE);
        }
        let mut heights: Vec<f64> = drops.iter().map(|drop| drop.height_m).collect();
        heights.sort_by(f64::total_cmp);
        heights.dedup();
        let groups: Vec<WaveGroup> =
            heights.iter().map(|height_m| WaveGroup::of(*height_m, decimation(*height_m), drops, samples)).collect();
        if let Some(few) = groups.iter().find(|group| group.windows.len() < FEWEST) {
            return Err(Unusable::TooFew { height_m: few.height_m, count: few.windows.len(), left_out: String::new() });
        }
        Ok(Self { groups, step_s, samples, noise_g: noise_g(drops) })
    }

    /// Those heights alone for which the answer is yes.
    #[must_use]
    pub fn only(&self, keep: impl Fn(f64) -> bool) -> Self {
        Self { groups: self.groups.iter().filter(|group| keep(group.height_m)).cloned().collect(), ..*self }
    }

    /// Some drops of every height, chosen by their number.
    #[must_use]
    pub fn half(&self, keep: impl Fn(usize) -> bool) -> Self {
        let some = |group: &WaveGroup| {
            let kept: Vec<usize> = (0..group.windows.len()).filter(|drop| keep(*drop)).collect();
            let windows: Vec<Vec<f64>> = kept.iter().map(|drop| group.windows[*drop].clone()).collect();
            let trials = kept.iter().map(|drop| group.trials[*drop].clone()).collect();
            WaveGroup { trials, mean: mean(&windows, self.samples), windows, ..*group }
        };
        Self { groups: self.groups.iter().map(some).collect(), ..*self }
    }

    /// Drops in all.
    pub fn count(&self) -> usize {
        self.groups.iter().map(|group| group.windows.len()).sum()
    }
}

impl WaveGroup {
    fn of(height_m: f64, decimation: Decimation, drops: &[FittedDrop], samples: usize) -> Self {
        let of_height = || drops.iter().filter(|drop| drop.height_m == height_m);
        let windows: Vec<Vec<f64>> = of_height().map(|drop| window(drop, &decimation, samples)).collect();
        let trials = of_height().map(|drop| drop.trial.clone()).collect();
        Self { height_m, decimation, trials, mean: mean(&windows, samples), windows }
    }

    /// The same drops with other windows.
    #[must_use]
    pub fn with_windows(&self, windows: Vec<Vec<f64>>) -> Self {
        Self { trials: self.trials.clone(), mean: mean(&windows, self.mean.len()), windows, ..*self }
    }
}

fn mean(windows: &[Vec<f64>], samples: usize) -> Vec<f64> {
    (0..samples).map(|i| windows.iter().map(|window| window[i]).sum::<f64>() / windows.len() as f64).collect()
}

/// First sample beyond the trigger.
fn trigger(accel_g: &[f64]) -> Option<usize> {
    accel_g.iter().position(|reading| reading.abs() > TRIGGER_G)
}

/// How many samples a drop has from its trigger on, as they are kept; `None` without a trigger.
pub(super) fn samples_from_trigger(accel_g: &[f64], decimation: &Decimation) -> Option<usize> {
    Some(((accel_g.len() - trigger(accel_g)?) as f64 / decimation.readings()) as usize)
}

/// The drop's window; readings before a record's begin are those of free fall.
fn window(drop: &FittedDrop, decimation: &Decimation, samples: usize) -> Vec<f64> {
    cut(decimation, trigger(&drop.accel_g).unwrap_or(0), &drop.accel_g, samples)
}

fn cut(decimation: &Decimation, trigger: usize, readings: &[f64], samples: usize) -> Vec<f64> {
    let mut window = decimation.kept(readings, trigger, BEFORE);
    window.truncate(samples);
    window
}

/// Windows of a drop's three axes, all aligned where the last one triggers, of so many samples, g; `None` where it does not trigger, or ends
/// too soon.
pub fn aligned_windows(decimation: &Decimation, samples: usize, axes_g: [&[f64]; 3]) -> Option<[Vec<f64>; 3]> {
    let trigger = trigger(axes_g[2])?;
    let windows = axes_g.map(|readings| cut(decimation, trigger, readings, samples));
    windows.iter().all(|window| window.len() == samples).then_some(windows)
}

/// Each height with the time between the samples of its drops, s.
fn same_rate_by_height(drops: &[FittedDrop]) -> Result<Vec<(f64, f64)>, Unusable> {
    let mut by_height: Vec<(f64, f64)> = Vec::new();
    for drop in drops {
        let (height_m, own_s) = (drop.height_m, step_s(drop));
        let first_s = by_height.iter().find(|(of, _)| *of == height_m).map_or(own_s, |(_, first_s)| *first_s);
        if (own_s / first_s - 1.0).abs() > 1e-2 || own_s.is_nan() {
            return Err(Unusable::Rate { trial: drop.trial.clone(), height_m, step_ms: own_s * 1e3, first_ms: first_s * 1e3 });
        }
        by_height.push((height_m, first_s));
    }
    by_height.dedup();
    Ok(by_height)
}

/// Mean time between samples, s.
fn step_s(drop: &FittedDrop) -> f64 {
    let (Some(first), Some(last)) = (drop.t_s.first(), drop.t_s.last()) else { return f64::NAN };
    (last - first) / (drop.t_s.len() - 1) as f64
}

/// Root mean square of the readings in the fall.
fn noise_g(drops: &[FittedDrop]) -> f64 {
    let (mut sum, mut count) = (0.0, 0);
    for drop in drops {
        let end = trigger(&drop.accel_g).unwrap_or(0).saturating_sub(GUARD);
        for reading in &drop.accel_g[end.saturating_sub(8)..end] {
            sum += reading * reading;
            count += 1;
        }
    }
    if count == 0 { 0.0 } else { (sum / f64::from(count)).sqrt() }
}
