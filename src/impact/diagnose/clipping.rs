//! Clipping: readings that pile up at one level, a limit that can be seen without a fit.

use crate::impact::fit::Waves;
use crate::impact::measured::Spread;

/// A limit, and the variation of single readings below it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Clipping {
    /// The level, g.
    pub level_g: f64,
    /// Readings at it.
    pub readings: usize,
    /// Standard deviation of single readings over their mean, where nothing is clipped.
    #[serde(skip)]
    pub spread: f64,
}

/// Half width of the level in units of the noise.
const HALF_WIDTH: f64 = 3.0;
/// Noise that is believed at least, g.
const LEAST_NOISE_G: f64 = 0.06;
/// Readings at the level at least.
const FEWEST: usize = 8;
/// How many times denser the level is than the readings just below it.
const DENSER: f64 = 4.0;

/// Finds the level at which readings pile up, when there is one: nothing lies above it, and it is far denser than what
/// lies below. Wrong where a wave itself is flat at its top and the drops do not vary.
pub fn clipping(waves: &Waves) -> Option<Clipping> {
    let mut all: Vec<f64> = waves.groups.iter().flat_map(|group| group.windows.iter().flatten().copied()).collect();
    all.sort_by(f64::total_cmp);
    let half = HALF_WIDTH * waves.noise_g.max(LEAST_NOISE_G);
    let top = *all.last()?;
    let within = |low: f64, high: f64| all.partition_point(|reading| *reading <= high) - all.partition_point(|reading| *reading < low);
    let readings = within(top - 2.0 * half, top);
    let below = within(top - 6.0 * half, top - 2.0 * half) as f64 / 2.0;
    if readings < FEWEST || (readings as f64) < DENSER * (below + 1.0) {
        return None;
    }
    let level_g = Spread::of(all[all.len() - readings..].iter().copied())?.median;
    Some(Clipping { level_g, readings, spread: spread(waves, top) })
}

/// Median over samples in the middle of the range of standard deviation over mean.
fn spread(waves: &Waves, top: f64) -> f64 {
    let mut ratios = Vec::new();
    for group in &waves.groups {
        let count = group.windows.len() as f64;
        for (i, mean) in group.mean.iter().enumerate().filter(|(_, mean)| (0.15 * top..0.6 * top).contains(*mean)) {
            let square: f64 = group.windows.iter().map(|window| (window[i] - mean) * (window[i] - mean)).sum();
            ratios.push((square / (count - 1.0)).sqrt() / mean);
        }
    }
    Spread::of(ratios).map_or(0.0, |ratios| ratios.median)
}
