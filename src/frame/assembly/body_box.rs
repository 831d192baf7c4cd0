//! Where bodies of a design are, for what is led between them.

use nalgebra::Point3;

use super::body::Body;
use super::design::Design;

/// The body of a name.
pub(super) fn body<'a>(design: &'a Design, name: &str) -> Option<&'a Body> {
    design.bodies.iter().find(|body| body.name == name)
}

/// Lowest and highest corner of a body's box in frame axes, mm.
pub(super) fn bounds_mm(design: &Design, name: &str) -> Option<[Point3<f64>; 2]> {
    let body = body(design, name)?;
    let [low, high] = design.shape(body).solid.bounds_in_mm(&body.pose);
    Some([low.into(), high.into()])
}

/// The board that the wires of motors and battery end at; none where an extra drives the motors.
pub(super) fn controller(design: &Design) -> Option<[Point3<f64>; 2]> {
    bounds_mm(design, "motor_controller")
}
