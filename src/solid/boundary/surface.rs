//! What a face can lie on.

use nalgebra::{Isometry3, Point3, Unit, Vector3};

/// A surface, mm.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// A plane.
    Plane {
        /// A point on it.
        point: Point3<f64>,
        /// Its direction.
        normal: Unit<Vector3<f64>>,
    },
    /// A cylinder; its normal points away from the axis.
    Cylinder {
        /// A point on the axis.
        point: Point3<f64>,
        /// Direction of the axis.
        axis: Unit<Vector3<f64>>,
        /// Radius, mm.
        radius_mm: f64,
    },
}

/// How far apart surfaces may be that are taken for the same, mm.
const SAME_MM: f64 = 1e-6;

impl Surface {
    /// Distance, mm, positive on the side that the normal points to.
    pub fn distance_mm(&self, p: &Point3<f64>) -> f64 {
        match self {
            Self::Plane { point, normal } => normal.dot(&(p - point)),
            Self::Cylinder { point, axis, radius_mm } => across(axis, &(p - point)).norm() - radius_mm,
        }
    }

    /// The surface's normal beside a point.
    pub fn normal_at(&self, p: &Point3<f64>) -> Vector3<f64> {
        match self {
            Self::Plane { normal, .. } => normal.into_inner(),
            Self::Cylinder { point, axis, .. } => across(axis, &(p - point)).normalize(),
        }
    }

    /// The same moved rigidly.
    pub fn placed(&self, pose: &Isometry3<f64>) -> Self {
        let turned = |v: &Unit<Vector3<f64>>| Unit::new_normalize(pose * v.into_inner());
        match self {
            Self::Plane { point, normal } => Self::Plane { point: pose * point, normal: turned(normal) },
            Self::Cylinder { point, axis, radius_mm } => Self::Cylinder { point: pose * point, axis: turned(axis), radius_mm: *radius_mm },
        }
    }

    /// Whether both are one surface, whichever way their directions run.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Plane { normal, .. }, Self::Plane { point, normal: n }) => {
                normal.cross(n).norm() < SAME_MM && self.distance_mm(point).abs() < SAME_MM
            }
            (Self::Cylinder { point, axis, radius_mm }, Self::Cylinder { point: p, axis: a, radius_mm: r }) => {
                (radius_mm - r).abs() < SAME_MM && axis.cross(a).norm() < SAME_MM && across(axis, &(p - point)).norm() < SAME_MM
            }
            _ => false,
        }
    }
}

/// The part of a vector square to an axis.
pub(super) fn across(axis: &Unit<Vector3<f64>>, v: &Vector3<f64>) -> Vector3<f64> {
    v - axis.into_inner() * axis.dot(v)
}

/// Some direction square to another, the same for the same.
pub fn square_to(axis: &Unit<Vector3<f64>>) -> Unit<Vector3<f64>> {
    let aside = if axis.z.abs() < 0.9 { Vector3::z() } else { Vector3::x() };
    Unit::new_normalize(across(axis, &aside))
}
