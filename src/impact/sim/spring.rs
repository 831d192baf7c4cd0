//! The base's spring: straight, or with a frame's own curve in it, on all feet or on those that have touched.

use super::system::System;
use crate::impact::effects::{Effect, Feet, MotionState};

impl System {
    /// The spring's force on all feet, N.
    pub(super) fn spring_n(&self, at: &MotionState) -> f64 {
        match &self.arrangement.spring_curve {
            None => self.spring.force_n(at),
            Some(curve) => self.spring.stiffness_n_m * curve.compression_m(at.x_m),
        }
    }

    /// What the feet that have touched leave of the compression, in mean over four, m.
    pub(super) fn mean_compression_m(&self, feet: &Feet, x_m: f64, touched: usize) -> f64 {
        match &self.arrangement.spring_curve {
            None => feet.mean_compression_m(x_m, touched),
            Some(curve) => feet.at_m[..touched].iter().map(|at| 0.25 * curve.compression_m(x_m - at)).sum(),
        }
    }

    /// What the spring stores, J.
    pub(super) fn spring_j(&self, at: &MotionState, touched: usize) -> f64 {
        let square_m2 = match (&self.arrangement.feet, &self.arrangement.spring_curve) {
            (None, None) => return self.spring.stored_j(at),
            (None, Some(curve)) => curve.square_m2(at.x_m),
            (Some(feet), None) => feet.mean_square_m2(at.x_m, touched),
            (Some(feet), Some(curve)) => feet.at_m[..touched].iter().map(|from| 0.25 * curve.square_m2(at.x_m - from)).sum(),
        };
        0.5 * self.spring.stiffness_n_m * square_m2
    }
}
