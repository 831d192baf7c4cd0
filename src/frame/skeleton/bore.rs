//! Bores of the sockets that rods are put into.

use crate::params::Frame;

/// Bore that holds a rod, mm.
pub fn grip_bore_mm(frame: &Frame) -> f64 {
    frame.rods.rod_diameter_mm + frame.fit.grip_clearance_mm
}

/// Bore in which a rod slides, mm.
pub fn slide_bore_mm(frame: &Frame) -> f64 {
    frame.rods.rod_diameter_mm + frame.fit.slide_clearance_mm
}
