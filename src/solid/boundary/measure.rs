//! Area and volume by the faces' own surfaces and edges.

use nalgebra::{Point3, Vector3};

use super::chart::Chart;
use super::curve::Curve;
use super::surface::Surface;
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
        let sign = if face.outward { 1.0 } else { -1.0 };
        if let Surface::Plane { point, normal } = &face.surface {
            let twice: Vector3<f64> = sides.iter().map(|side| self.swept(side, point)).sum();
            let area = 0.5 * sign * normal.dot(&twice);
            return [area, sign * area * normal.dot(&point.coords) / 3.0];
        }
        let Some(chart) = self.chart(face) else { return [0.0; 2] };
        let ring = self.ring(sides);
        let pairs = (0..ring.len()).map(|i| (ring[i], ring[(i + 1) % ring.len()]));
        // By Green's theorem the loop sums up minus what a strip of each angle holds.
        let mut sums = [0.0; 2];
        for (a, b) in pairs {
            let (from, to) = (chart.at(&a), chart.at(&b));
            let turn = to.x - from.x;
            let turn = turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
            let [area, about, out] = [0, 1, 2].map(|i| -0.5 * turn * (chart.strip(from.y)[i] + chart.strip(to.y)[i]));
            sums[0] += sign * area;
            // Inwards both the loop and the normal are turned.
            sums[1] += (about + out * chart.direction(from.x + 0.5 * turn).dot(&chart.point.coords)) / 3.0;
        }
        sums
    }

    /// Twice the area that the arm from a point sweeps along a side, mm², as a vector: of an ellipse by its own formula.
    fn swept(&self, side: &Side, point: &Point3<f64>) -> Vector3<f64> {
        let edge = &self.edges[side.edge];
        let (from, to) = (self.vertices[edge.from], self.vertices[edge.to]);
        let forward = match &edge.curve {
            Curve::Ellipse { centre, axis, radii_mm: [a, b], sweep_rad, .. } => {
                (centre - point).cross(&(to - from)) + axis.into_inner() * (a * b * sweep_rad)
            }
            _ => self.points_of(edge, PIECES).windows(2).map(|pair| (pair[0] - point).cross(&(pair[1] - point))).sum(),
        };
        if side.forward { forward } else { -forward }
    }

    /// The chart of a face on a round surface.
    pub(super) fn chart<'a>(&self, face: &'a Face) -> Option<Chart<'a>> {
        let ends = face.loops.iter().flatten().flat_map(|side| [self.edges[side.edge].from, self.edges[side.edge].to]);
        Chart::new(&face.surface, ends.map(|vertex| self.vertices[vertex]))
    }
}
