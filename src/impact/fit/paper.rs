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
    /// Time between samples, s.
    step_s: f64,
    /// Height, m, and the readings of each drop, g, from the trigger up to the peak.
    heights: Vec<(f64, Vec<Vec<f64>>)>,
}

impl PaperObjective {
    /// Of chosen drops.
    pub fn of(chosen: &Chosen) -> Self {
        let mut heights: Vec<(f64, Vec<Vec<f64>>)> = Vec::new();
        let mut step_s = 1e-3;
        for drop in &chosen.drops {
            let Some(impact) = &drop.impact else { continue };
            step_s = drop.record.step_s().unwrap_or(step_s);
            let series = chosen.series(drop.record);
            let from = impact.trigger;
            let peak = (from..series.len()).fold(from, |best, at| if series[at] > series[best] { at } else { best });
            if peak == from {
                continue;
            }
            let window = series[from..peak].to_vec();
            match heights.iter_mut().find(|(height_m, _)| *height_m == drop.record.height_m) {
                Some((_, windows)) => windows.push(window),
                None => heights.push((drop.record.height_m, vec![window])),
            }
        }
        Self { step_s, heights }
    }

    /// The objective of a model; `None` where the simulation diverges.
    pub fn at(&self, model: &Model) -> Option<f64> {
        Some(self.value(self.residual(model)?.norm_squared()))
    }
}

impl Objective for PaperObjective {
    fn counts(&self) -> Vec<usize> {
        self.heights.iter().map(|(_, windows)| windows.len()).collect()
    }

    fn residual(&self, model: &Model) -> Option<DVector<f64>> {
        let system = System::new(model);
        let mut all = Vec::new();
        for (height_m, windows) in &self.heights {
            let longest = windows.iter().map(Vec::len).max().unwrap_or(0);
            let mut predicted = vec![0.0; longest + 1];
            let settings = SolverOptions { duration_s: self.step_s * longest as f64, ..SolverOptions::FIT };
            if wave(&system, *height_m, self.step_s, &settings, &mut predicted) != Stop::End {
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
        let one = |height_m: f64| {
            let mut readings = vec![0.0; SHOWN];
            wave(&system, height_m, self.step_s, &SolverOptions::FIT, &mut readings);
            (height_m, readings)
        };
        self.heights.iter().map(|(height_m, _)| one(*height_m)).collect()
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
        let mut drawn = |(height_m, windows): &(f64, Vec<Vec<f64>>)| {
            (*height_m, windows.iter().map(|_| windows[rng.random_range(0..windows.len())].clone()).collect())
        };
        Some(Self { step_s: self.step_s, heights: self.heights.iter().map(&mut drawn).collect() })
    }
}
