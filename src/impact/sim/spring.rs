//! The base's spring: straight, or with a frame's own curve in it, on all feet or on those that have touched.

use super::system::System;
use crate::impact::effects::{Effect, Feet, Motion};

impl System {
    /// The spring's force on all feet, N.
    pub(super) fn spring_n(&self, at: &Motion) -> f64 {
        match &self.arrangement.softening {
            None => self.spring.force_n(at),
            Some(softening) => self.spring.stiffness_n_m * softening.compression_m(at.x_m),
        }
    }

    /// What the feet that have touched leave of the compression, in mean over four, m.
    pub(super) fn mean_compression_m(&self, feet: &Feet, x_m: f64, touched: usize) -> f64 {
        match &self.arrangement.softening {
            None => feet.mean_compression_m(x_m, touched),
            Some(softening) => feet.at_m[..touched].iter().map(|at| 0.25 * softening.compression_m(x_m - at)).sum(),
        }
    }

    /// What the spring stores, J.
    pub(super) fn spring_j(&self, at: &Motion, touched: usize) -> f64 {
        let square_m2 = match (&self.arrangement.feet, &self.arrangement.softening) {
            (None, None) => return self.spring.stored_j(at),
            (None, Some(softening)) => softening.square_m2(at.x_m),
            (Some(feet), None) => feet.mean_square_m2(at.x_m, touched),
            (Some(feet), Some(softening)) => feet.at_m[..touched].iter().map(|from| 0.25 * softening.square_m2(at.x_m - from)).sum(),
        };
        0.5 * self.spring.stiffness_n_m * square_m2
    }
}
