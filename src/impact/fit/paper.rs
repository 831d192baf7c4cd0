//! The objective of arXiv 2103.04423's notebook: log(1 + sum over the heights of the mean, over the drops, of the mean
//! squared difference in (m/s²)²), from each drop's trigger up to its peak.
//!
//! The model begins at the trigger; the peak's own sample is not compared. *When it is wrong:* first touch lies up to one
//! sample after the trigger, what follows the peak is not used, and a drop with a late second hit weighs as much as one
//! without.

use nalgebra::DVector;
use rand::RngExt;
use rand_pcg::Pcg64;

use super::chosen::Chosen;
use super::fit_error::FitError;
use super::fitting::{Intervals, Objective};
use super::free::Layout;
use crate::impact::effects::Model;
use crate::impact::sim::{SolverOptions, Stop, System, wave};
use crate::units::GRAVITY_M_S2;

/// Samples of a wave that is shown.
const SHOWN: usize = 31;

/// Drops up to their peaks.
#[derive(Clone, Debug)]
pub struct PaperObjective {
    heights: Vec<HeightWindows>,
}

/// Drops of one height.
#[derive(Clone, Debug)]
struct HeightWindows {
    height_m: f64,
    /// Time between samples, s: drops of one height have one rate, heights may have different ones.
    step_s: f64,
    /// The readings of each drop, g, from the trigger up to the peak.
    windows: Vec<Vec<f64>>,
}

impl PaperObjective {
    /// Of chosen drops.
    ///
    /// # Errors
    /// When no drop has a sample between its trigger and its peak.
    pub fn of(chosen: &Chosen) -> Result<Self, FitError> {
        let mut heights: Vec<HeightWindows> = Vec::new();
        for drop in &chosen.drops {
            let (Some(impact), Some(step_s)) = (&drop.impact, drop.record.mean_step_s()) else { continue };
            let series = chosen.series_as_read(drop.record);
            let from = impact.trigger;
            let peak = (from..series.len()).fold(from, |best, at| if series[at] > series[best] { at } else { best });
            if peak == from {
                continue;
            }
            let (window, height_m) = (series[from..peak].to_vec(), drop.record.height_m);
            match heights.iter_mut().find(|height| height.height_m == height_m) {
                Some(height) => height.windows.push(window),
                None => heights.push(HeightWindows { height_m, step_s, windows: vec![window] }),
            }
        }
        if heights.is_empty() { Err(FitError::NothingBeforePeaks) } else { Ok(Self { heights }) }
    }

    /// The objective of a model; `None` where the simulation diverges.
    pub fn at(&self, model: &Model) -> Option<f64> {
        Some(self.value(self.residual(model)?.norm_squared()))
    }
}

impl Objective for PaperObjective {
    fn counts(&self) -> Vec<usize> {
        self.heights.iter().map(|height| height.windows.len()).collect()
    }

    fn residual(&self, model: &Model) -> Option<DVector<f64>> {
        let system = System::new(model);
        let mut all = Vec::new();
        for HeightWindows { height_m, step_s, windows } in &self.heights {
            let longest = windows.iter().map(Vec::len).max().unwrap_or(0);
            let mut predicted = vec![0.0; longest + 1];
            let settings = SolverOptions { duration_s: step_s * longest as f64, ..SolverOptions::FIT };
            if wave(&system, *height_m, *step_s, &settings, &mut predicted) != Stop::End {
                return None;
            }
            for window in windows {
                let weight = GRAVITY_M_S2 / (windows.len() as f64 * window.len() as f64).sqrt();
                all.extend(window.iter().zip(&predicted).map(|(measured, predicted)| weight * (measured - predicted)));
            }
        }
        Some(DVector::from_vec(all))
    }

    fn waves(&self, model: &Model) -> Vec<(f64, Vec<f64>)> {
        let system = System::new(model);
        let one = |height: &HeightWindows| {
            let mut readings = vec![0.0; SHOWN];
            wave(&system, height.height_m, height.step_s, &SolverOptions::FIT, &mut readings);
            (height.height_m, readings)
        };
        self.heights.iter().map(one).collect()
    }

    fn value(&self, sum: f64) -> f64 {
        libm::log1p(sum)
    }

    const INTERVALS: Intervals = Intervals::Middle;

    fn around(&self, _: &Layout, _: &[f64]) -> Self {
        self.clone()
    }

    /// The drops of each height, drawn with replacement.
    fn another(&self, _: &[(f64, Vec<f64>)], rng: &mut Pcg64) -> Option<Self> {
        let mut drawn = |height: &HeightWindows| {
            let windows = &height.windows;
            let windows = windows.iter().map(|_| windows[rng.random_range(0..windows.len())].clone()).collect();
            HeightWindows { windows, ..*height }
        };
        Some(Self { heights: self.heights.iter().map(&mut drawn).collect() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What heights of different rates leave together is what each leaves alone.
    #[test]
    fn analytic_each_height_is_compared_at_its_own_rate() {
        let model = Model::load("paper").expect("is a model");
        let of = |heights: &[HeightWindows]| {
            let all = PaperObjective { heights: heights.to_vec() };
            all.residual(&model).expect("does not diverge").norm_squared()
        };
        let height = |height_m: f64, step_s: f64| HeightWindows { height_m, step_s, windows: vec![vec![0.0, 10.0, 20.0, 30.0]] };
        let (slow, fast) = (height(0.5, 1e-3), height(1.5, 2.5e-4));
        let both = of(&[slow.clone(), fast.clone()]);
        assert!((both - of(&[slow]) - of(&[fast])).abs() < 1e-9 * both, "{both}");
        assert!((of(&[height(1.5, 1e-3)]) - of(&[height(1.5, 2.5e-4)])).abs() > 0.01 * both, "rates tell");
    }
}
