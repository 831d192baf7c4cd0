//! Rays through a mesh.

use flexframe::solid::Mesh;
use nalgebra::{Point3, Unit, Vector3};

/// Where a ray passes a facet.
#[derive(Clone, Copy)]
pub struct Hit {
    /// From the ray's origin, mm.
    pub distance: f64,
    /// The facet's outward direction.
    pub normal: Unit<Vector3<f64>>,
}

/// Passes closer than this are one: the ray went through an edge, mm.
const SAME_MM: f64 = 1e-5;

/// Where a ray passes the surface, nearest first.
pub fn hits(mesh: &Mesh, from: Point3<f64>, along: Unit<Vector3<f64>>) -> Vec<Hit> {
    let mut hits: Vec<Hit> = mesh.triangles.iter().filter_map(|t| pass(mesh.corners(t), from, along)).collect();
    hits.sort_by(|a, b| a.distance.total_cmp(&b.distance));
    hits.dedup_by(|a, b| (a.distance - b.distance).abs() < SAME_MM);
    hits
}

/// Where a ray meets a triangle (T. Möller, B. Trumbore, Fast, minimum storage ray/triangle intersection, 1997).
fn pass([a, b, c]: [Point3<f64>; 3], from: Point3<f64>, along: Unit<Vector3<f64>>) -> Option<Hit> {
    let (e1, e2) = (b - a, c - a);
    let p = along.cross(&e2);
    let det = e1.dot(&p);
    if det.abs() < 1e-12 {
        return None;
    }
    let s = from - a;
    let q = s.cross(&e1);
    let (u, v, distance) = (s.dot(&p) / det, along.dot(&q) / det, e2.dot(&q) / det);
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 1e-9;
    inside.then(|| Hit { distance, normal: Unit::new_normalize(e1.cross(&e2)) })
}

/// Directions across an axis: `count` of them over a sweep that starts at `first` (any when `None`).
pub fn fan(axis: Unit<Vector3<f64>>, first: Option<Vector3<f64>>, sweep_deg: f64, count: u32) -> Vec<Unit<Vector3<f64>>> {
    let any = axis.cross(&Vector3::new(0.31, 0.52, 0.83));
    let u = first.map_or(any, |f| f - axis.into_inner() * axis.dot(&f)).normalize();
    let v = axis.cross(&u);
    // Half a step aside at both ends, so that an arc's ends are not met.
    let angle = |i: u32| sweep_deg.to_radians() * (f64::from(i) + 0.5) / f64::from(count);
    (0..count).map(|i| Unit::new_normalize(u * libm::cos(angle(i)) + v * libm::sin(angle(i)))).collect()
}
