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
    /// A cone; its normal points away from the axis.
    Cone {
        /// A point on the axis.
        point: Point3<f64>,
        /// Direction of the axis, in which the radius grows.
        axis: Unit<Vector3<f64>>,
        /// Radius at the point, mm.
        radius_mm: f64,
        /// Angle between axis and surface, rad.
        half_angle_rad: f64,
    },
    /// A sphere; its normal points away from the centre.
    Sphere {
        /// Centre.
        centre: Point3<f64>,
        /// From pole to pole; any, as its parameters have poles and a face may have none.
        axis: Unit<Vector3<f64>>,
        /// Radius, mm.
        radius_mm: f64,
    },
    /// A torus, of one that meets itself the outer sheet; its normal points away from the circle in its middle.
    Torus {
        /// Centre.
        centre: Point3<f64>,
        /// Direction of the axis.
        axis: Unit<Vector3<f64>>,
        /// Radius of the circle in its middle, mm.
        radius_mm: f64,
        /// Radius around that circle, mm.
        minor_radius_mm: f64,
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
            Self::Cone { point, axis, radius_mm, half_angle_rad } => {
                let (sin, cos) = libm::sincos(*half_angle_rad);
                (across(axis, &(p - point)).norm() - radius_mm) * cos - axis.dot(&(p - point)) * sin
            }
            Self::Sphere { centre, radius_mm, .. } => (p - centre).norm() - radius_mm,
            Self::Torus { centre, axis, radius_mm, minor_radius_mm } => {
                let arm = p - centre;
                libm::hypot(across(axis, &arm).norm() - radius_mm, axis.dot(&arm)) - minor_radius_mm
            }
        }
    }

    /// The surface's normal beside a point.
    pub fn normal_at(&self, p: &Point3<f64>) -> Vector3<f64> {
        match self {
            Self::Plane { normal, .. } => normal.into_inner(),
            Self::Cylinder { point, axis, .. } => across(axis, &(p - point)).normalize(),
            Self::Cone { point, axis, half_angle_rad, .. } => {
                let (sin, cos) = libm::sincos(*half_angle_rad);
                across(axis, &(p - point)).normalize() * cos - axis.into_inner() * sin
            }
            Self::Sphere { centre, .. } => (p - centre).normalize(),
            Self::Torus { centre, axis, radius_mm, .. } => {
                let arm = p - centre;
                (arm - across(axis, &arm).normalize() * *radius_mm).normalize()
            }
        }
    }

    /// A point on the axis about which it is round, and that axis; none of a plane.
    pub fn axis(&self) -> Option<(Point3<f64>, Unit<Vector3<f64>>)> {
        match self {
            Self::Plane { .. } => None,
            Self::Cylinder { point, axis, .. } | Self::Cone { point, axis, .. } => Some((*point, *axis)),
            Self::Sphere { centre, axis, .. } | Self::Torus { centre, axis, .. } => Some((*centre, *axis)),
        }
    }

    /// The same moved rigidly.
    pub fn placed(&self, pose: &Isometry3<f64>) -> Self {
        let turned = |v: &Unit<Vector3<f64>>| Unit::new_normalize(pose * v.into_inner());
        match self {
            Self::Plane { point, normal } => Self::Plane { point: pose * point, normal: turned(normal) },
            Self::Cylinder { point, axis, radius_mm } => Self::Cylinder { point: pose * point, axis: turned(axis), radius_mm: *radius_mm },
            Self::Cone { point, axis, radius_mm, half_angle_rad } => {
                Self::Cone { point: pose * point, axis: turned(axis), radius_mm: *radius_mm, half_angle_rad: *half_angle_rad }
            }
            Self::Sphere { centre, axis, radius_mm } => Self::Sphere { centre: pose * centre, axis: turned(axis), radius_mm: *radius_mm },
            Self::Torus { centre, axis, radius_mm, minor_radius_mm } => {
                Self::Torus { centre: pose * centre, axis: turned(axis), radius_mm: *radius_mm, minor_radius_mm: *minor_radius_mm }
            }
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
            (Self::Cone { point, axis, radius_mm, half_angle_rad }, Self::Cone { point: p, axis: a, radius_mm: r, half_angle_rad: h }) => {
                let rise = axis.dot(&(p - point));
                let along = axis.dot(a) > 0.0 && axis.cross(a).norm() < SAME_MM && across(axis, &(p - point)).norm() < SAME_MM;
                along && (half_angle_rad - h).abs() < SAME_MM && (radius_mm + rise * libm::tan(*half_angle_rad) - r).abs() < SAME_MM
            }
            (Self::Sphere { centre, radius_mm, .. }, Self::Sphere { centre: c, radius_mm: r, .. }) => {
                (radius_mm - r).abs() < SAME_MM && (centre - c).norm() < SAME_MM
            }
            (
                Self::Torus { centre, axis, radius_mm, minor_radius_mm },
                Self::Torus { centre: c, axis: a, radius_mm: r, minor_radius_mm: m },
            ) => {
                let radii = (radius_mm - r).abs() < SAME_MM && (minor_radius_mm - m).abs() < SAME_MM;
                radii && (centre - c).norm() < SAME_MM && axis.cross(a).norm() < SAME_MM
            }
            _ => false,
        }
    }

    /// The same with a sphere's poles away from a direction in which a face lies.
    pub(super) fn with_poles_beside(&self, direction: &Vector3<f64>) -> Self {
        match (self, Unit::try_new(*direction, f64::MIN_POSITIVE)) {
            (Self::Sphere { centre, radius_mm, .. }, Some(middle)) => {
                Self::Sphere { centre: *centre, axis: square_to(&middle), radius_mm: *radius_mm }
            }
            _ => self.clone(),
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
