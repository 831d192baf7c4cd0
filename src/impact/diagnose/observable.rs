//! Observations without a model.

use serde::Serialize;

use crate::impact::effects::Model;
use crate::impact::fit::Waves;
use crate::impact::measured::{LEAST_OVER_V0, Spread};
use crate::units::GRAVITY_M_S2;

/// One height.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Observable {
    /// Height, m.
    pub height_m: f64,
    /// Drops.
    pub drops: usize,
    /// Impulse of the mean wave over its window, over the impact speed of the stated height: 1 + restitution for a vertical impact.
    pub impulse_over_v0: f64,
    /// Its standard error, samples taken as dependent.
    pub error: f64,
    /// What a vertical impact cannot exceed: all speed given back, and gravity over the window.
    pub most: f64,
    /// Whether it does, by more than two standard errors.
    pub impossible: bool,
    /// Whether it is less, by more than two standard errors, than what stops a body that fell from there.
    pub too_small: bool,
    /// Median over drops of the largest reading, g.
    pub median_peak_g: f64,
}

/// Observables of every height.
pub fn observables(waves: &Waves, model: &Model) -> Vec<Observable> {
    let fall = model.arrangement().fall;
    let of = |group: &crate::impact::fit::WaveGroup| {
        let v0 = fall.impact_speed_m_s(group.height_m);
        let impulse = |window: &[f64]| GRAVITY_M_S2 * waves.step_s * window.iter().sum::<f64>() / v0;
        let each: Vec<f64> = group.windows.iter().map(|window| impulse(window)).collect();
        let (count, impulse_over_v0) = (each.len() as f64, impulse(&group.mean));
        let square: f64 = each.iter().map(|one| (one - impulse_over_v0) * (one - impulse_over_v0)).sum();
        let error = (square / (count * (count - 1.0))).sqrt();
        let most = 2.0 + GRAVITY_M_S2 * waves.step_s * waves.samples as f64 / v0;
        let peaks = group.windows.iter().map(|window| window.iter().fold(0.0, |peak: f64, reading| peak.max(*reading)));
        Observable {
            height_m: group.height_m,
            drops: group.windows.len(),
            impulse_over_v0,
            error,
            most,
            impossible: impulse_over_v0 - 2.0 * error > most,
            too_small: impulse_over_v0 + 2.0 * error < LEAST_OVER_V0,
            median_peak_g: Spread::of(peaks).map_or(0.0, |peaks| peaks.median),
        }
    };
    waves.groups.iter().map(of).collect()
}
