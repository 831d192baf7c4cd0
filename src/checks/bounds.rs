//! Axis-parallel boxes: what cannot meet need not be measured.

use nalgebra::Point3;

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

    /// Which part of a straight line lies in the box grown by some mm to all sides: from and to, 0 to 1.
    pub fn crossed_by(&self, start: &Point3<f64>, end: &Point3<f64>, grown_mm: f64) -> Option<[f64; 2]> {
        let mut inside: [f64; 2] = [0.0, 1.0];
        for axis in 0..3 {
            let (low, high) = (self.low[axis] - grown_mm, self.high[axis] + grown_mm);
            let (at, along) = (start[axis], end[axis] - start[axis]);
            if along.abs() < 1e-9 {
                if at < low || at > high {
                    return None;
                }
                continue;
            }
            let (a, b) = ((low - at) / along, (high - at) / along);
            inside = [inside[0].max(a.min(b)), inside[1].min(a.max(b))];
        }
        (inside[0] <= inside[1]).then_some(inside)
    }

    /// Distance of two boxes, mm; 0 when they touch. No two points in them are closer.
    pub fn distance_mm(&self, other: &Self) -> f64 {
        let apart = [0, 1, 2].map(|i| (other.low[i] - self.high[i]).max(self.low[i] - other.high[i]).max(0.0));
        libm::sqrt(apart.iter().map(|d| d * d).sum())
    }
}
