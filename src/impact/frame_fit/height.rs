//! What the drops from one height say together.

use crate::impact::measured::{Spread, Summary};

/// A median and its standard error.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Known {
    /// The median.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
}

/// Least standard error over the median: what scale and height of a drop are known to.
const LEAST_ERROR: f64 = 0.01;

impl Known {
    /// Of values that lie around their median about normally: √(π/2) σ/√n, σ the quartiles' distance over 1.349.
    fn of(spread: &Spread) -> Self {
        let sigma = (spread.q3 - spread.q1) / 1.349;
        let error = (std::f64::consts::FRAC_PI_2 / spread.count as f64).sqrt() * sigma;
        Self { value: spread.median, error: error.max(LEAST_ERROR * spread.median.abs()) }
    }
}

/// A height.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Height {
    /// From where, m.
    pub height_m: f64,
    /// Peaks along the axis of all drops with an impact, g, behind the logger's 500 Hz.
    pub peak_g: Known,
    /// Impulse along the axis within 25 ms over the speed before, of the drops without a flag; restitution is that less one.
    pub impulse: Known,
}

impl Height {
    /// Of a summary; `None` when no drop has an impact, or none is without a flag.
    pub fn of(summary: &Summary) -> Option<Self> {
        let (peak, impulse) = (summary.peak_axial_g.as_ref()?, summary.impulse_over_v0.as_ref()?);
        Some(Self { height_m: summary.height_m, peak_g: Known::of(peak), impulse: Known::of(impulse) })
    }
}
