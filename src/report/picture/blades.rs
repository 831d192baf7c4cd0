//! Blades of a propeller for pictures: two, twisted as those of their direction are, the edge that goes first marked.
//!
//! No shape of a real one: a chord that narrows to the tip, and the twist of a screw of constant pitch. The design itself knows only the
//! disc that the blades sweep.

use nalgebra::{Point3, Vector3};

use crate::frame::skeleton::Spin;
use crate::solid::Mesh;

/// Blades of a propeller: those of the catalogue have two.
const BLADES: u32 = 2;
/// Way of the screw in one turn over the diameter, as of a 3025 or 5040.
const PITCH: f64 = 0.8;
/// Thickness over the diameter: thicker than a real one, to be seen from the side.
const THICK: f64 = 0.012;
/// Radius of hub over that of the propeller, and its height over the diameter.
const HUB: [f64; 2] = [0.09, 0.06];
/// Sections along a blade.
const SECTIONS: u32 = 24;
/// Share of the chord that is marked along the edge that goes first.
const MARKED: f64 = 0.22;
/// Corners of the hub.
const CORNERS: u32 = 24;

/// A propeller about z in pieces, its middle in the origin: hub and blades, and the marked edges.
pub(super) fn propeller(diameter_mm: f64, spin: Spin) -> [Mesh; 2] {
    let blade = Blade { radius_mm: 0.5 * diameter_mm, spin };
    let mut pieces = [hub(diameter_mm), Mesh::default()];
    for number in 0..BLADES {
        let at_rad = std::f64::consts::TAU * f64::from(number) / f64::from(BLADES);
        append(&mut pieces[0], &blade.strip([MARKED, 1.0], at_rad));
        append(&mut pieces[1], &blade.strip([0.0, MARKED], at_rad));
    }
    pieces
}

struct Blade {
    radius_mm: f64,
    spin: Spin,
}

impl Blade {
    /// A part of its chord, from 0 at the edge that goes first to 1 at the other, drawn along the blade; a closed mesh.
    fn strip(&self, chord: [f64; 2], at_rad: f64) -> Mesh {
        let mut rings = Vec::new();
        for section in 0..=SECTIONS {
            let share = HUB[0] * 0.6 + (1.0 - HUB[0] * 0.6) * f64::from(section) / f64::from(SECTIONS);
            let half = 0.5 * THICK * 2.0 * self.radius_mm * (1.2 - share);
            let [front, rear] = chord.map(|place| self.point(share, place));
            let up = Vector3::z() * half;
            rings.push([front + up, rear + up, rear - up, front - up].map(|point| turned(&point, at_rad)));
        }
        // Of the other direction the mirror image, whose facets run the other way.
        prism(&rings, self.spin.sign() < 0.0)
    }

    /// A point of its middle surface. The edge that goes first is raised: that is what presses air down.
    fn point(&self, share: f64, place: f64) -> Point3<f64> {
        let (radius, outward) = (share * self.radius_mm, (share - HUB[0]).max(0.0));
        // Wide at a third, narrow at the tip, which is round.
        let tip = (1.0 - (share.max(0.9) - 0.9).powi(2) / 0.01).max(0.04).sqrt();
        let chord = self.radius_mm * (0.14 + 0.5 * outward * (1.0 - outward)) * tip;
        let along = chord * (0.42 - place);
        let pitch = libm::atan2(PITCH * 2.0 * self.radius_mm, std::f64::consts::TAU * radius.max(0.2 * self.radius_mm));
        Point3::new(radius, self.spin.sign() * along * libm::cos(pitch), along * libm::sin(pitch))
    }
}

fn turned(point: &Point3<f64>, by_rad: f64) -> Point3<f64> {
    let (sin, cos) = libm::sincos(by_rad);
    Point3::new(point.x * cos - point.y * sin, point.x * sin + point.y * cos, point.z)
}

fn hub(diameter_mm: f64) -> Mesh {
    let (radius, half) = (0.5 * HUB[0] * diameter_mm, 0.5 * HUB[1] * diameter_mm);
    let ring = |z: f64| {
        let corner = |k: u32| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(k) / f64::from(CORNERS));
            Point3::new(radius * cos, radius * sin, z)
        };
        (0..CORNERS).map(corner).collect::<Vec<_>>()
    };
    prism(&[ring(-half), ring(half)], false)
}

/// Rings of corners joined to a closed mesh: counter-clockwise seen from its end, or clockwise.
fn prism<Ring: AsRef<[Point3<f64>]>>(rings: &[Ring], clockwise: bool) -> Mesh {
    let corners = rings[0].as_ref().len() as u32;
    let vertices = rings.iter().flat_map(AsRef::as_ref).map(|p| [p.x as f32, p.y as f32, p.z as f32]).collect();
    let end = (rings.len() as u32 - 1) * corners;
    let mut triangles = Vec::new();
    for k in 0..corners {
        let next = (k + 1) % corners;
        for a in (0..end).step_by(corners as usize) {
            let b = a + corners;
            triangles.extend([[a + k, a + next, b + k], [a + next, b + next, b + k]]);
        }
        if k > 0 && next > 0 {
            triangles.extend([[0, next, k], [end, end + k, end + next]]);
        }
    }
    if clockwise {
        triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    Mesh { vertices, triangles }
}

fn append(mesh: &mut Mesh, other: &Mesh) {
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend(&other.vertices);
    mesh.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|corner| corner + first)));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The highest corner of the marked edge on the blade along x, and whether it is before the middle in the sense of rotation.
    #[test]
    fn analytic_the_edge_that_goes_first_is_raised() {
        for spin in [Spin::Clockwise, Spin::CounterClockwise] {
            let [blades, edges] = propeller(76.2, spin);
            assert!(blades.volume_mm3() > 0.0 && edges.volume_mm3() > 0.0);
            let on_x = |mesh: &Mesh| mesh.vertices.iter().copied().filter(|v| v[0] > 15.0 && v[0] < 30.0).collect::<Vec<_>>();
            let mean = |points: &[[f32; 3]], axis: usize| points.iter().map(|v| f64::from(v[axis])).sum::<f64>() / points.len() as f64;
            let [rest, first] = [on_x(&blades), on_x(&edges)];
            assert!(mean(&first, 2) > mean(&rest, 2) + 1.0);
            // Counter-clockwise the blade along x goes towards y.
            assert!(spin.sign() * (mean(&first, 1) - mean(&rest, 1)) > 1.0);
        }
    }

    #[test]
    fn analytic_both_directions_are_mirror_images() {
        let [one, other] = [Spin::Clockwise, Spin::CounterClockwise].map(|spin| propeller(60.0, spin));
        for (a, b) in one.iter().zip(&other) {
            assert!((a.volume_mm3() / b.volume_mm3() - 1.0).abs() < 1e-4, "{} {}", a.volume_mm3(), b.volume_mm3());
        }
    }
}
