//! Axis-parallel boxes: what cannot meet need not be measured.

use nalgebra::Vector3;

/// A box, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub low: [f64; 3],
    pub high: [f64; 3],
}

impl Bounds {
    /// Around what two boxes hold.
    pub fn around(&self, other: &Self) -> Self {
        let each = |pick: fn(f64, f64) -> f64, a: &[f64; 3], b: &[f64; 3]| [0, 1, 2].map(|i| pick(a[i], b[i]));
        Self { low: each(f64::min, &self.low, &other.low), high: each(f64::max, &self.high, &other.high) }
    }

    /// Moved.
    pub fn shifted(&self, by_mm: &Vector3<f64>) -> Self {
        let each = |at: &[f64; 3]| [0, 1, 2].map(|i| at[i] + by_mm[i]);
        Self { low: each(&self.low), high: each(&self.high) }
    }

    /// Least and farthest that it reaches along one of the axes or against it, mm.
    pub fn reach_mm(&self, along: &Vector3<f64>) -> [f64; 2] {
        let [low, high] = [self.low, self.high].map(|corner| along.dot(&Vector3::from(corner)));
        [low.min(high), low.max(high)]
    }

    /// Distance of two boxes, mm; 0 when they touch. No two points in them are closer.
    pub fn distance_mm(&self, other: &Self) -> f64 {
        let apart = [0, 1, 2].map(|i| (other.low[i] - self.high[i]).max(self.low[i] - other.high[i]).max(0.0));
        libm::sqrt(apart.iter().map(|d| d * d).sum())
    }
}
