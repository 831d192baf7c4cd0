//! The four modules: one, turned about the vertical.

use nalgebra::{UnitQuaternion, Vector3};

/// The four modules, counter-clockwise from front right.
pub const MODULE_NAMES: [&str; 4] = ["FR", "FL", "BL", "BR"];

/// The same in words.
pub const MODULE_WORDS: [&str; 4] = ["front right", "front left", "rear left", "rear right"];

/// A module's turn from the first one.
pub fn module_turn(module: usize) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2 * module as f64)
}
