//! Where each joint of the first module sits: from the part's own axes to the frame's.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::closure::Closure;
use crate::params::Frame;

/// The hub joint, at the mouths of the hub's bores.
pub fn hub_joint(frame: &Frame, _: &Closure) -> Isometry3<f64> {
    along_diagonal(frame.hub.hub_mouth_mm)
}

/// The motor mount, under the motor.
pub fn motor_mount(frame: &Frame, _: &Closure) -> Isometry3<f64> {
    along_diagonal(frame.motor_mount.motor_position_mm)
}

/// The fork, at its bar.
pub fn fork(_: &Frame, closure: &Closure) -> Isometry3<f64> {
    along_diagonal(closure.bar_s_mm)
}

/// The knee, where the struts' axes cross.
pub fn knee(_: &Frame, closure: &Closure) -> Isometry3<f64> {
    along_diagonal(closure.knee_s_mm)
}

/// The top corner. Cage sockets look inward along the ring; the notch side (+z of the flat part) is where the strut goes.
pub fn top_corner(_: &Frame, closure: &Closure) -> Isometry3<f64> {
    pose(ring_node(closure, 1.0), -Vector3::y(), -Vector3::x(), -Vector3::z())
}

/// The bottom corner, as the top one.
pub fn bottom_corner(_: &Frame, closure: &Closure) -> Isometry3<f64> {
    pose(ring_node(closure, -1.0), -Vector3::x(), -Vector3::y(), Vector3::z())
}

fn along_diagonal(s: f64) -> Isometry3<f64> {
    pose(diagonal_point(s, 0.0), diagonal(), left(), Vector3::z())
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
