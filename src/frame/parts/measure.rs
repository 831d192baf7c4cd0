//! Measuring a part's mesh along rays: what a calliper and a pin would find. Tests only.

use nalgebra::{Point3, Vector3};

use crate::params::Frame;
use crate::solid::{Feature, Mesh, MeshSolid, gate};

/// Dimensions are held to this, mm.
pub const CLOSE_MM: f64 = 0.05;
/// Largest difference of a side of a part's box from the measured one, mm: chosen; the fork's is the largest, 0.08 mm.
const LIKE_MM: f64 = 0.1;

/// The frame that the parts were measured on.
pub fn v8() -> Frame {
    Frame::load("cognifly-v8").expect("the preset is valid").0
}

/// The mesh of a feature; it must pass the export gate with this many tunnels.
pub fn printed(feature: &Feature, tunnels: i64) -> Mesh {
    let mesh = MeshSolid::build(feature).to_mesh();
    let topology = gate::pass(&mesh).expect("the part passes the gate");
    assert_eq!(topology.euler, 2 - 2 * tunnels);
    mesh
}

/// Distances from a point at which a ray passes the surface, mm, in order.
pub fn hits(mesh: &Mesh, from: [f64; 3], direction: Vector3<f64>) -> Vec<f64> {
    let (from, d) = (Point3::from(from), direction.normalize());
    let mut distances: Vec<f64> = mesh.triangles.iter().filter_map(|t| crossing(mesh.corners(t), from, d)).collect();
    distances.sort_by(f64::total_cmp);
    distances.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    distances
}

/// Distance from a point to the surface ahead of it, mm.
pub fn ahead(mesh: &Mesh, from: [f64; 3], direction: Vector3<f64>) -> f64 {
    hits(mesh, from, direction).first().copied().unwrap_or(f64::INFINITY)
}

/// Diameter of the largest pin around a point of a bore's axis, mm.
pub fn pin_mm(mesh: &Mesh, at: [f64; 3], axis: Vector3<f64>) -> f64 {
    let u = axis.cross(&Vector3::new(0.3, 0.5, 0.8)).normalize();
    let v = axis.normalize().cross(&u);
    let around = |i: u32| {
        let angle = std::f64::consts::TAU * f64::from(i) / 40.0;
        ahead(mesh, at, u * libm::cos(angle) + v * libm::sin(angle))
    };
    2.0 * (0..40).map(around).fold(f64::INFINITY, f64::min)
}

/// Asserts that a dimension is the nominal one within [`CLOSE_MM`].
#[track_caller]
pub fn assert_close(what: &str, measured_mm: f64, nominal_mm: f64) {
    assert!((measured_mm - nominal_mm).abs() < CLOSE_MM, "{what}: {measured_mm:.3} mm, nominal {nominal_mm:.3} mm");
}

/// Asserts that a part is like the one it was measured from: box within [`LIKE_MM`] a side, volume within a part.
#[track_caller]
pub fn assert_like(mesh: &Mesh, mut size_mm: [f64; 3], volume_mm3: f64, part: f64) {
    let mut size = mesh.size_mm();
    size.sort_by(f64::total_cmp);
    size_mm.sort_by(f64::total_cmp);
    assert!((0..3).all(|i| (size[i] - size_mm[i]).abs() < LIKE_MM), "{size:?} mm, measured part {size_mm:?} mm");
    let off = mesh.volume_mm3() / volume_mm3 - 1.0;
    assert!(off.abs() < part, "volume off by {:.1} %", 100.0 * off);
}

/// Where a ray meets a triangle (Möller and Trumbore 1997), if it does.
fn crossing([a, b, c]: [Point3<f64>; 3], from: Point3<f64>, d: Vector3<f64>) -> Option<f64> {
    let (e1, e2) = (b - a, c - a);
    let p = d.cross(&e2);
    let det = e1.dot(&p);
    if det.abs() < 1e-12 {
        return None;
    }
    let s = from - a;
    let u = s.dot(&p) / det;
    let q = s.cross(&e1);
    let v = d.dot(&q) / det;
    let t = e2.dot(&q) / det;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 1e-9).then_some(t)
}
