//! Axis-parallel boxes: what cannot meet need not be measured.

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

    /// Moved along y.
    pub fn shifted_y(&self, by_mm: f64) -> Self {
        let mut moved = *self;
        moved.low[1] += by_mm;
        moved.high[1] += by_mm;
        moved
    }

    /// Distance of two boxes, mm; 0 when they touch. No two points in them are closer.
    pub fn distance_mm(&self, other: &Self) -> f64 {
        let apart = [0, 1, 2].map(|i| (other.low[i] - self.high[i]).max(self.low[i] - other.high[i]).max(0.0));
        libm::sqrt(apart.iter().map(|d| d * d).sum())
    }
}
