//! Peaks of drops beside the largest that any landing of the fitted legs reads.
//!
//! However it lands, a frame presses no leg further than its fall allows, and reads most where all legs are pressed at once. Where a quarter of the drops
//! read more, the legs lack a force, as that of a stop. *When it is wrong:* stiffness that differs from drop to drop by a tenth moves a peak by a
//! twentieth, which [`BEYOND`] allows for; a stop that drops seldom reach is not seen.

use super::observed::HeightLandings;
use super::table::LandingTable;
use crate::impact::measured::Spread;

/// Peaks up to so many times the largest of the landings are allowed.
const BEYOND: f64 = 1.1;
/// Standard errors that are allowed beside.
const ERRORS: f64 = 3.0;
/// Standard deviations between the quartiles of a normal distribution.
const QUARTILES_APART: f64 = 1.349;
/// Standard error of a quartile of a normal distribution, in standard deviations over the root of the count.
const OF_QUARTILE: f64 = 1.3626;

/// Peaks of a height.
#[derive(Clone, Copy, Debug)]
pub struct HeightPeaks {
    /// Height, m.
    pub height_m: f64,
    /// Upper quartile of the drops' peaks, g.
    pub upper_quartile_g: f64,
    /// Its standard error, g.
    pub error_g: f64,
    /// Largest reading of all landings, g.
    pub largest_g: f64,
}

impl HeightPeaks {
    /// Of the drops of a height, and its landings; `None` where there is no drop.
    pub fn of(height: &HeightLandings, table: &LandingTable) -> Option<Self> {
        let peak_g = |window: &Vec<f64>| window.iter().copied().fold(0.0, f64::max);
        let spread = Spread::of(height.drops.iter().map(|drop| peak_g(&drop.window)))?;
        let deviation_g = (spread.q3 - spread.q1) / QUARTILES_APART;
        Some(Self {
            height_m: height.height_m,
            upper_quartile_g: spread.q3,
            error_g: OF_QUARTILE * deviation_g / (height.drops.len() as f64).sqrt(),
            largest_g: table.windows().max(),
        })
    }

    /// Whether the drops read more than landings of such legs can.
    pub fn are_beyond(&self) -> bool {
        self.upper_quartile_g - ERRORS * self.error_g > BEYOND * self.largest_g
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_peaks_are_beyond_by_more_than_a_tenth_and_their_error() {
        let peaks = |upper_quartile_g, error_g| HeightPeaks { height_m: 1.0, upper_quartile_g, error_g, largest_g: 100.0 };
        assert!(peaks(112.0, 0.5).are_beyond());
        assert!(!peaks(112.0, 1.0).are_beyond() && !peaks(109.0, 0.0).are_beyond());
    }
}
