//! How touch times are read where spikes overlap.
//!
//! Each slope's landing is given the spikes and the rest of a measured drop ([`TouchPattern`]), and its touch times are read as those of
//! the measured drops were. Short times come out longer than they are, and a tenth of all are off by milliseconds: without this, slopes of 0.15
//! rad/s came out a sixth too large.
//!
//! *When it is wrong:* where sizes of spikes depend on the slope.

use nalgebra::DVector;
use rand::{Rng, RngExt};

use super::table::{LandingTable, NEVER_S};
use super::touch_pattern::TouchPattern;

/// Readings of each slope's landing.
const READINGS: usize = 2;
/// Slopes less frequent than this are read as they are.
const RARE: f64 = 1e-7;
/// Standard deviations of a normal law to its median deviation.
const DEVIATIONS: f64 = 1.4826;

/// Errors of the touch times of one height's landings.
#[derive(Clone, Debug)]
pub struct TouchErrors {
    /// Of the opposite foot's delay, s, by the table's points; none of a reading in which a foot is not seen.
    opposite_s: Vec<[Option<f64>; READINGS]>,
    /// Standard deviation of a delay that was read, by the median deviation, s.
    pub deviation_s: f64,
}

impl TouchErrors {
    /// Reads the landings of a table, as frequent as `weights` says, like the drops of a height, whose patterns these are.
    pub fn of(patterns: &[&TouchPattern], table: &LandingTable, weights: &DVector<f64>, rng: &mut impl Rng) -> Option<Self> {
        let mut sizes: Vec<(f64, f64)> = Vec::new();
        let mut read = |delays_s: &[f64; 3], weight: f64| -> Option<f64> {
            let pattern = patterns[rng.random_range(0..patterns.len())];
            let touches = pattern.read(*delays_s, rng.random_bool(0.5))?;
            if !touches.all_seen() {
                return None;
            }
            let read_s = touches.delays_s();
            sizes.extend(read_s.iter().zip(delays_s).map(|(read_s, true_s)| ((read_s - true_s).abs(), weight)));
            Some(read_s[0] - delays_s[0])
        };
        let mut opposite_s = Vec::with_capacity(weights.len());
        for (delays_s, weight) in table.delays_s.iter().zip(weights.iter()) {
            let known = *weight >= RARE && delays_s.iter().all(|delay_s| *delay_s < NEVER_S);
            opposite_s.push(if known { std::array::from_fn(|_| read(delays_s, *weight)) } else { [Some(0.0); READINGS] });
        }
        sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let half = 0.5 * sizes.iter().map(|(_, weight)| weight).sum::<f64>();
        let mut before = 0.0;
        let median = sizes.iter().find(|(_, weight)| {
            before += weight;
            before >= half
        })?;
        Some(Self { opposite_s, deviation_s: DEVIATIONS * median.0 })
    }

    /// Delays of the opposite foot as they would be read of a table's point, s.
    pub fn read_s(&self, point: usize, opposite_s: f64) -> impl Iterator<Item = f64> {
        self.opposite_s[point].iter().flatten().map(move |error_s| (opposite_s + error_s).max(0.0))
    }
}
