//! Where strut and leg fold in a corner.

use crate::params::Frame;
use crate::units::Angle;

/// The sockets of a corner and the axes about which its strut and its leg fold: where the outlines of the cage sockets meet those of strut and
/// leg. In the flat part they enclose 135° and 45°, so that the meeting lies r / tan 67.5° and r / tan 22.5° from the node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CornerPivots {
    /// Outer radius of the sockets, mm.
    pub radius_mm: f64,
    /// From the node out to the strut's axis, along the strut, mm.
    pub strut_mm: f64,
    /// From the node in to the leg's axis, along the leg, mm.
    pub leg_mm: f64,
}

impl CornerPivots {
    /// Those of a frame.
    pub fn of(frame: &Frame) -> Self {
        let radius_mm = 0.5 * frame.grip_bore_mm() + frame.corner.corner_wall_mm;
        Self { radius_mm, strut_mm: radius_mm * Angle::deg(22.5).tan(), leg_mm: radius_mm * Angle::deg(67.5).tan() }
    }
}
