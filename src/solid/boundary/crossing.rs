//! Whether the loops of a face cross each other.

use nalgebra::{Point2, Point3};

use super::chart::Chart;
use super::curve::beside_mm;
use super::surface::Surface;
use super::surface::square_to;
use super::topology::{Boundary, Edge, Face, Side};

/// Pieces of an arc that are compared.
const PIECES: u32 = 12;

/// How close pieces may come where no end is shared, as a share of their lengths' product.
const TOUCH: f64 = 1e-9;

/// A face whose border comes closer to itself than this is taken for touching itself, mm: readers could not tell inside from outside.
const TOUCH_MM: f64 = 3e-4;

impl Boundary {
    /// The vertices through which a face's loops run more than once.
    pub(super) fn meets_itself_in(&self, face: &Face) -> Vec<usize> {
        let start = |side: &Side| if side.forward { self.edges[side.edge].from } else { self.edges[side.edge].to };
        let mut corners: Vec<usize> = face.loops.iter().flatten().map(start).collect();
        corners.sort_unstable();
        let mut twice: Vec<usize> = corners.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect();
        twice.dedup();
        twice
    }

    /// Whether a vertex lies all but on an edge that does not end there, on a face with straight edges.
    pub(super) fn touches_itself(&self, face: &Face) -> bool {
        let edges: Vec<&Edge> = face.loops.iter().flatten().map(|side| &self.edges[side.edge]).collect();
        edges.len() > 3
            && edges.iter().flat_map(|edge| [edge.from, edge.to]).any(|corner| {
                let others = edges.iter().filter(|edge| edge.from != corner && edge.to != corner);
                let near = |edge: &Edge| beside_mm(&self.vertices[corner], &self.vertices[edge.from], &self.vertices[edge.to]) < TOUCH_MM;
                others.copied().any(near)
            })
    }

    /// Whether pieces of a face's loops cross, seen flat on its surface.
    pub(super) fn crosses_itself(&self, face: &Face) -> bool {
        let chart = self.chart(face);
        let flat = |p: &Point3<f64>| flat(&face.surface, chart.as_ref(), p);
        let turn_mm = chart.as_ref().map(|chart| std::f64::consts::TAU * chart.scale()[0]);
        let mut pieces: Vec<[Point2<f64>; 2]> = Vec::new();
        for side in face.loops.iter().flatten() {
            let edge = &self.edges[side.edge];
            let mut points = self.points_of(edge, PIECES);
            // Edges end in one point, not in two that are a rounding apart.
            let last = points.len() - 1;
            (points[0], points[last]) = (self.vertices[edge.from], self.vertices[edge.to]);
            let points: Vec<Point2<f64>> = points.iter().map(flat).collect();
            pieces.extend(points.windows(2).map(|pair| [pair[0], unrolled(turn_mm, pair[1], pair[0])]));
        }
        let low = |piece: &[Point2<f64>; 2]| piece[0].y.min(piece[1].y);
        pieces.sort_by(|a, b| low(a).total_cmp(&low(b)));
        (0..pieces.len()).any(|i| {
            let high = pieces[i][0].y.max(pieces[i][1].y);
            pieces[i + 1..].iter().take_while(|other| low(other) <= high).any(|other| {
                let moved = unrolled(turn_mm, other[0], pieces[i][0]);
                let other = [moved, other[1] + (moved - other[0])];
                cross(&pieces[i], &other)
            })
        })
    }
}

/// A point of a surface in the plane; a round surface by its parameters.
fn flat(surface: &Surface, chart: Option<&Chart>, p: &Point3<f64>) -> Point2<f64> {
    match (surface, chart) {
        (Surface::Plane { point, normal }, _) => {
            let x = square_to(normal);
            Point2::new((p - point).dot(&x), (p - point).dot(&normal.cross(&x)))
        }
        (_, Some(chart)) => {
            let (at, [around, along]) = (chart.at(p), chart.scale());
            Point2::new(at.x * around, at.y * along)
        }
        (_, None) => Point2::origin(),
    }
}

/// The same point of an unrolled surface next to another.
fn unrolled(turn_mm: Option<f64>, p: Point2<f64>, beside: Point2<f64>) -> Point2<f64> {
    let Some(turn_mm) = turn_mm else { return p };
    Point2::new(p.x - turn_mm * ((p.x - beside.x) / turn_mm).round(), p.y)
}

/// Whether both pieces have the other's ends on different sides.
fn cross([a, b]: &[Point2<f64>; 2], [c, d]: &[Point2<f64>; 2]) -> bool {
    let side = |p: &Point2<f64>, q: &Point2<f64>, r: &Point2<f64>| (q - p).perp(&(r - p));
    let limit = TOUCH * (b - a).norm() * (d - c).norm();
    let apart = |u: f64, v: f64| u > limit && v < -limit || u < -limit && v > limit;
    apart(side(a, b, c), side(a, b, d)) && apart(side(c, d, a), side(c, d, b))
}
