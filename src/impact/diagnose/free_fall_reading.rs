//! What drops read along the axis in free fall, where a sensor without an offset, and a frame without drag, read nothing.
//!
//! The sensor's zero would stand in all of a wave, also where the frame flies and every model reads nothing, and many drops tell it well: it was taken
//! for a small effect, and refused true ones. It is taken off what is compared. The drag stays, as the frame feels it.

use serde::Serialize;

use crate::impact::fit::Chosen;
use crate::impact::measured::{Spread, mean_in_fall};

/// Readings nearer to nothing than this are not told, g: chosen, half of the 0.08 g that changed the verdict of synthetic drops while zeros stayed in.
const LEAST_G: f64 = 0.04;
/// Standard errors from which on a reading is not nothing.
const SURE: f64 = 3.0;
/// Which axis points along the fall.
const AXIAL: usize = 2;

/// The reading of a height.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FreeFallReading {
    /// The height, m.
    pub height_m: f64,
    /// Median over drops of the mean along the axis over the fall, g.
    pub along_g: f64,
    /// Its standard error, g.
    pub error_g: f64,
    /// The sensor's zero, which is taken off what is compared: median over drops, g; 0 where falls are too short to tell it. The rest is drag of
    /// the air.
    pub zero_g: f64,
}

impl FreeFallReading {
    /// Of each height that has drops with a fall, by rising height.
    pub fn all(chosen: &Chosen) -> Vec<Self> {
        let mut heights: Vec<f64> = chosen.drops.iter().map(|drop| drop.record.height_m).collect();
        heights.sort_by(f64::total_cmp);
        heights.dedup();
        let of = |height_m: f64| {
            let own = || chosen.drops.iter().filter(|drop| drop.record.height_m == height_m);
            let spread = Spread::of(own().filter_map(|drop| mean_in_fall(drop.record, drop.impact.as_ref()?, AXIAL)))?;
            let zero = Spread::of(own().map(|drop| drop.zero_g[AXIAL]))?;
            Some(Self { height_m, along_g: spread.median, error_g: spread.median_error(), zero_g: zero.median })
        };
        heights.into_iter().filter_map(of).collect()
    }

    /// Whether it is not nothing.
    pub fn is_told(&self) -> bool {
        self.along_g.abs() > LEAST_G.max(SURE * self.error_g)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_reading_is_told_beyond_its_errors_and_a_least_size() {
        let told = |along_g: f64, error_g: f64| FreeFallReading { height_m: 1.0, along_g, error_g, zero_g: along_g }.is_told();
        assert_eq!([told(-0.12, 0.01), told(0.12, 0.05), told(0.03, 0.001), told(0.05, 0.001)], [true, false, false, true]);
    }
}
