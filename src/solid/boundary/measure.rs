//! Area and volume by the faces' own surfaces and edges.

use nalgebra::{Point3, Vector3};

use super::surface::Surface;
use super::surface::square_to;
use super::topology::{Boundary, Face, Side};

/// Pieces of an arc over which is summed: half a turn is right to 1e-5 of its area.
const PIECES: u32 = 180;

impl Boundary {
    /// Enclosed volume, mm³: by the divergence theorem over the faces.
    pub fn volume_mm3(&self) -> f64 {
        self.faces.iter().flat_map(|face| face.loops.iter().map(|sides| self.loop_sums(face, sides)[1])).sum()
    }

    /// Area of a face, mm².
    pub fn area_mm2(&self, face: &Face) -> f64 {
        face.loops.iter().map(|sides| self.loop_area_mm2(face, sides)).sum()
    }

    /// What a loop adds to the area of its face, mm²: negative around a hole.
    pub(super) fn loop_area_mm2(&self, face: &Face, sides: &[Side]) -> f64 {
        self.loop_sums(face, sides)[0]
    }

    /// Points around a loop, mm; the first stands only once.
    fn ring(&self, sides: &[Side]) -> Vec<Point3<f64>> {
        let mut ring = Vec::new();
        for side in sides {
            let mut points = self.points_of(&self.edges[side.edge], PIECES);
            if !side.forward {
                points.reverse();
            }
            points.pop();
            ring.extend(points);
        }
        ring
    }

    /// Area and volume that a loop encloses on its face, mm² and mm³.
    fn loop_sums(&self, face: &Face, sides: &[Side]) -> [f64; 2] {
        let ring = self.ring(sides);
        let pairs = (0..ring.len()).map(|i| (ring[i], ring[(i + 1) % ring.len()]));
        let sign = if face.outward { 1.0 } else { -1.0 };
        match &face.surface {
            Surface::Plane { point, normal } => {
                let twice: Vector3<f64> = pairs.map(|(a, b)| (a - point).cross(&(b - point))).sum();
                let area = 0.5 * sign * normal.dot(&twice);
                [area, sign * area * normal.dot(&point.coords) / 3.0]
            }
            Surface::Cylinder { point, axis, radius_mm } => {
                // By Green's theorem in (angle, height) the loop sums up minus height times what an angle's strip weighs.
                let x = square_to(axis);
                let y = axis.cross(&x);
                let mut sums = [0.0; 2];
                for (a, b) in pairs {
                    let [(u, v), (w, z)] = [a, b].map(|p| {
                        let arm = p - point;
                        (libm::atan2(arm.dot(&y), arm.dot(&x)), arm.dot(axis))
                    });
                    let turn = w - u;
                    let turn = turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
                    let (sin, cos) = libm::sincos(u + 0.5 * turn);
                    let out = x.into_inner() * cos + y * sin;
                    let strip = -0.5 * (v + z) * turn * radius_mm;
                    sums[0] += sign * strip;
                    sums[1] += sign * strip * (radius_mm + out.dot(&point.coords)) / 3.0;
                }
                // Inwards both the loop and the normal are turned.
                [sums[0], sign * sums[1]]
            }
        }
    }
}
