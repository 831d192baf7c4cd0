//! A wire or cable: a way through the frame, and the tube or ribbon that is drawn along it.

use nalgebra::{Point3, Vector3};

use crate::solid::Mesh;
use crate::units::Angle;

/// What is seen where a wire is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Section {
    /// A circle of this radius, mm.
    Round(f64),
    /// A ribbon of this width along the frame's x, and this thickness, mm. Its way has to run across x.
    Ribbon([f64; 2]),
}

/// A wire, the wires of a motor, or a cable.
#[derive(Clone, Debug, PartialEq)]
pub struct Wire {
    /// Its name in files.
    pub name: String,
    /// Its line in the bill.
    pub role: &'static str,
    /// Along its middle, frame axes, mm.
    pub way: Vec<Point3<f64>>,
    /// How many of the points, from the first, move with what it begins at.
    pub begins: usize,
    /// What is seen where it is cut.
    pub section: Section,
    /// The bodies that it joins, the one where its way begins first; none of what is of several bodies.
    pub joins: Option<[&'static str; 2]>,
    /// What is done with both its ends, where it joins two bodies: sides between braces are those of a sleeve that lies along the frame,
    /// and `{end}` is the body where its way ends.
    pub plugging: &'static str,
    /// Linear red, green, blue, alpha.
    pub colour: [f32; 4],
    /// That colour in a word.
    pub colour_word: &'static str,
}

/// In what is done with a cable: the body where its way ends.
pub(super) const END: &str = "{end}";

impl Wire {
    /// What is done with both its ends, by what the body at its end is called; nothing of what is of several bodies.
    pub fn plugged(&self, called: impl Fn(&'static str) -> String) -> String {
        self.joins.map_or_else(String::new, |[_, end]| self.plugging.replace(END, &called(end)))
    }

    /// Length of its way, mm.
    pub fn length_mm(&self) -> f64 {
        self.way.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
    }

    /// A tube or ribbon along the way, mitred where it turns. Made without the kernel, whose unions of tubes took longer than all else that a small change
    /// remakes.
    pub fn mesh(&self) -> Mesh {
        let mut way = self.way.clone();
        way.dedup_by(|next, last| (*next - *last).norm() < SHORTEST_MM);
        let along: Vec<Vector3<f64>> = way.windows(2).map(|pair| (pair[1] - pair[0]).normalize()).collect();
        let (Some(first), Some(last)) = (along.first(), along.last()) else { return Mesh::default() };
        let mut rings = vec![self.section.ring(way[0], first)];
        for (at, way_mm) in along.iter().enumerate() {
            // The plane between a segment and the next one; at the end of the wire straight across.
            let across = (way_mm + along.get(at + 1).unwrap_or(last)).normalize();
            let end = way[at + 1];
            let drawn = rings[at].iter().map(|p| p + way_mm * ((end - p).dot(&across) / way_mm.dot(&across).max(LEAST_COSINE))).collect();
            rings.push(drawn);
        }
        tube(&rings)
    }
}

/// Segments that are shorter are none, mm.
const SHORTEST_MM: f64 = 1e-3;
/// Corners of a round section.
const CORNERS: u32 = 16;
/// Of half the angle of a turn: a mitre is no longer than this allows.
const LEAST_COSINE: f64 = 0.4;

impl Section {
    /// Half of what lies between two of them side by side, mm.
    pub fn radius_mm(self) -> f64 {
        match self {
            Self::Round(radius_mm) => radius_mm,
            Self::Ribbon([wide_mm, _]) => 0.5 * wide_mm,
        }
    }

    /// Its corners at the start of a segment, counter-clockwise seen against it.
    fn ring(self, at: Point3<f64>, along: &Vector3<f64>) -> Vec<Point3<f64>> {
        let aside = if along.z.abs() < 0.9 { Vector3::z() } else { Vector3::x() };
        match self {
            Self::Round(radius_mm) => {
                let u = along.cross(&aside).normalize();
                let v = along.cross(&u);
                let corner = |k: u32| {
                    let angle = Angle::deg(360.0 * f64::from(k) / f64::from(CORNERS));
                    at + (u * angle.cos() + v * angle.sin()) * radius_mm
                };
                (0..CORNERS).map(corner).collect()
            }
            Self::Ribbon([wide_mm, thick_mm]) => {
                let u = Vector3::x() * (0.5 * wide_mm);
                let v = along.cross(&Vector3::x()).normalize() * (0.5 * thick_mm);
                [u + v, v - u, -u - v, u - v].map(|corner| at + corner).into()
            }
        }
    }
}

/// Rings joined to a closed mesh.
fn tube(rings: &[Vec<Point3<f64>>]) -> Mesh {
    let vertices = rings.iter().flatten().map(|p| [p.x as f32, p.y as f32, p.z as f32]).collect();
    let mut triangles = Vec::new();
    let (segments, corners) = (rings.len() as u32 - 1, rings[0].len() as u32);
    for k in 0..corners {
        let next = (k + 1) % corners;
        for segment in 0..segments {
            let [a, b] = [segment * corners, (segment + 1) * corners];
            triangles.extend([[a + k, a + next, b + k], [a + next, b + next, b + k]]);
        }
        if k > 0 && next > 0 {
            let end = segments * corners;
            triangles.extend([[0, next, k], [end, end + k, end + next]]);
        }
    }
    Mesh { vertices, triangles }
}
