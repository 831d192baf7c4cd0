//! The parameters of a round surface around a face: the angle about its axis, and what lies along its meridian.

use nalgebra::{Point2, Point3, Unit, Vector3};

use super::surface::{Surface, across, square_to};

/// A round surface with the direction in which its angle is zero.
pub(super) struct Chart<'a> {
    surface: &'a Surface,
    pub(super) point: Point3<f64>,
    axis: Unit<Vector3<f64>>,
    x: Vector3<f64>,
    y: Vector3<f64>,
    /// Of a torus: the angle around its tube in the middle of the face, rad.
    middle_rad: f64,
}

impl<'a> Chart<'a> {
    /// Of the surface around some points of a face; `None` of a plane.
    pub(super) fn new(surface: &'a Surface, of_face: impl Iterator<Item = Point3<f64>>) -> Option<Self> {
        let (point, axis) = surface.axis()?;
        let x = square_to(&axis);
        let y = axis.cross(&x);
        let mut chart = Self { surface, point, axis, x: x.into_inner(), y, middle_rad: 0.0 };
        let (sin, cos) =
            of_face.map(|p| libm::sincos(chart.angle_around_tube(&p))).fold((0.0, 0.0), |sum, of| (sum.0 + of.0, sum.1 + of.1));
        chart.middle_rad = libm::atan2(sin, cos);
        Some(chart)
    }

    /// The angle about the axis, rad, and along the meridian: a length in mm of cylinder and cone, an angle of sphere and torus.
    pub(super) fn at(&self, p: &Point3<f64>) -> Point2<f64> {
        let arm = p - self.point;
        let (across_mm, along_mm) = (across(&self.axis, &arm).norm(), arm.dot(&self.axis));
        let meridian = match self.surface {
            Surface::Cone { radius_mm, half_angle_rad, .. } => {
                let (sin, cos) = libm::sincos(*half_angle_rad);
                along_mm * cos + (across_mm - radius_mm) * sin
            }
            Surface::Sphere { .. } => libm::atan2(along_mm, across_mm),
            Surface::Torus { .. } => {
                let angle = self.angle_around_tube(p) - self.middle_rad;
                self.middle_rad + angle - std::f64::consts::TAU * (angle / std::f64::consts::TAU).round()
            }
            _ => along_mm,
        };
        Point2::new(libm::atan2(arm.dot(&self.y), arm.dot(&self.x)), meridian)
    }

    fn angle_around_tube(&self, p: &Point3<f64>) -> f64 {
        let Surface::Torus { radius_mm, .. } = self.surface else { return 0.0 };
        let arm = p - self.point;
        libm::atan2(arm.dot(&self.axis), across(&self.axis, &arm).norm() - radius_mm)
    }

    /// The direction from the axis at an angle.
    pub(super) fn direction(&self, angle_rad: f64) -> Vector3<f64> {
        let (sin, cos) = libm::sincos(angle_rad);
        self.x * cos + self.y * sin
    }

    /// The axis about which the meridian at an angle turns, from the equator to the pole.
    pub(super) fn along_meridian(&self, angle_rad: f64) -> Unit<Vector3<f64>> {
        Unit::new_normalize(self.direction(angle_rad).cross(&self.axis))
    }

    /// Millimetres that a unit of each parameter is long, somewhere on the surface.
    pub(super) fn scale(&self) -> [f64; 2] {
        match self.surface {
            Surface::Plane { .. } => [1.0; 2],
            Surface::Cylinder { radius_mm, .. } | Surface::Cone { radius_mm, .. } => [*radius_mm, 1.0],
            Surface::Sphere { radius_mm, .. } => [*radius_mm; 2],
            Surface::Torus { radius_mm, minor_radius_mm, .. } => [*radius_mm, *minor_radius_mm],
        }
    }

    /// What a strip of unit angle holds up to a place on the meridian: its area, mm²; three times its volume seen from the chart's point moved
    /// to the origin, along the axis, mm³; and the part of its area whose normal points away from the axis, mm². All by integrals of the
    /// surface element of a turned curve; the place where they begin cancels around a loop.
    pub(super) fn strip(&self, meridian: f64) -> [f64; 3] {
        let lift_mm = self.axis.dot(&self.point.coords);
        let v = meridian;
        match self.surface {
            Surface::Plane { .. } => [0.0; 3],
            Surface::Cylinder { radius_mm: r, .. } => [r * v, r * r * v, r * v],
            Surface::Cone { radius_mm: r, half_angle_rad, .. } => {
                let (sin, cos) = libm::sincos(*half_angle_rad);
                let area = r * v + 0.5 * v * v * sin;
                [area, (r * cos - sin * lift_mm) * area, cos * area]
            }
            Surface::Sphere { radius_mm: r, .. } => {
                let (sin, r2) = (libm::sin(v), r * r);
                [r2 * sin, r2 * (r * sin + 0.5 * lift_mm * sin * sin), r2 * (0.5 * v + 0.25 * libm::sin(2.0 * v))]
            }
            Surface::Torus { radius_mm: big, minor_radius_mm: r, .. } => {
                let (sin, cos) = libm::sincos(v);
                let square = 0.5 * v + 0.25 * libm::sin(2.0 * v);
                let about = r * ((big * big + r * r) * sin + big * r * (v + square));
                let lifted = r * (0.5 * r * sin * sin - big * cos);
                [r * (big * v + r * sin), about + lift_mm * lifted, r * (big * sin + r * square)]
            }
        }
    }
}
