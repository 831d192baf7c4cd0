//! Where each printed part of the frame proper sits: from the part's own axes to the frame's.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::closure::Closure;
use super::graph::Skeleton;
use crate::params::{Frame, PartName};

/// The four modules, counter-clockwise from front right.
pub const MODULE_NAMES: [&str; 4] = ["FR", "FL", "BL", "BR"];

/// Poses of a joint in the four modules; empty for parts of the rigid centre, which place themselves on the hub.
pub fn placements(part: PartName, frame: &Frame, skeleton: &Skeleton) -> Vec<Isometry3<f64>> {
    let c = &skeleton.closure;
    let along_diagonal = |s: f64| pose(diagonal_point(s, 0.0), diagonal(), left(), Vector3::z());
    let first = match part {
        PartName::HubJoint => along_diagonal(frame.hub.hub_mouth_mm),
        PartName::Fork => along_diagonal(c.bar_s_mm),
        PartName::Knee => along_diagonal(c.knee_s_mm),
        PartName::MotorMount => along_diagonal(frame.motor_mount.motor_position_mm),
        // Cage sockets look inward along the ring; the notch side (+z of the flat part) is where the strut goes.
        PartName::TopCorner => pose(ring_node(c, 1.0), -Vector3::y(), -Vector3::x(), -Vector3::z()),
        PartName::BottomCorner => pose(ring_node(c, -1.0), -Vector3::x(), -Vector3::y(), Vector3::z()),
        _ => return Vec::new(),
    };
    (0..4).map(|module| module_turn(module) * first).collect()
}

fn module_turn(module: usize) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2 * module as f64)
}

fn ring_node(c: &Closure, side: f64) -> Point3<f64> {
    Point3::new(c.ring_half_side_mm, c.ring_half_side_mm, side * c.ring_half_height_mm)
}

fn diagonal() -> Vector3<f64> {
    Vector3::new(1.0, 1.0, 0.0).normalize()
}

fn left() -> Vector3<f64> {
    Vector3::new(-1.0, 1.0, 0.0).normalize()
}

fn diagonal_point(s: f64, z: f64) -> Point3<f64> {
    Point3::from(diagonal() * s + Vector3::z() * z)
}

fn pose(origin: Point3<f64>, x: Vector3<f64>, y: Vector3<f64>, z: Vector3<f64>) -> Isometry3<f64> {
    let turn = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, z]));
    Isometry3::from_parts(Translation3::from(origin.coords), UnitQuaternion::from_rotation_matrix(&turn))
}
