//! What bodies are meant to share: a rod in a bore smaller than itself, a plug in a hub bore smaller than itself.
//!
//! Both are rings between two circles over the engaged length. The polygons that stand for circles change those rings by
//! some percent, which [`ROUNDING`] allows; what is not meant is held to [`TOUCH_MM3`].

use std::f64::consts::FRAC_PI_4;

use crate::frame::skeleton::Rod;
use crate::params::{Frame, PartName};

/// Volume that faces in contact may share by rounding, mm³.
pub const TOUCH_MM3: f64 = 0.05;
/// What the polygons may add to a press fit.
pub const ROUNDING: f64 = 1.03;

/// Volume of the ring between two diameters over a length, mm³; 0 when the inner one is larger.
pub(super) fn ring_mm3(outer_mm: f64, inner_mm: f64, length_mm: f64) -> f64 {
    (FRAC_PI_4 * (outer_mm * outer_mm - inner_mm * inner_mm) * length_mm).max(0.0)
}

/// What the ends of a rod in a part are meant to share with it, mm³.
pub fn gripped_mm3(rod: &Rod, diameter_mm: f64, part: PartName, module: Option<usize>) -> f64 {
    let ends = rod.sockets.iter().zip([&rod.start, &rod.end]);
    ends.filter(|(socket, _)| socket.part == part && Some(socket.module) == module)
        .map(|(socket, end)| ring_mm3(diameter_mm, socket.bore_mm, socket.engagement_mm(end)))
        .sum()
}

/// What a hub joint's two plugs are meant to share with the hub, mm³.
pub fn plugs_mm3(frame: &Frame) -> f64 {
    let plug = frame.hub_joint.hub_joint_diameter_mm;
    2.0 * ring_mm3(plug, plug + frame.fit.plug_clearance_mm, frame.hub_joint.plug_length_mm)
}
