//! Triangle meshes as they are written: indexed, closed, in a canonical order.

use nalgebra::{Isometry3, Matrix3, Point3, Vector3};
use serde::{Deserialize, Serialize};

/// An indexed triangle mesh; coordinates in mm on the f32 grid that STL and glTF store.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// Corner positions, mm.
    pub vertices: Vec<[f32; 3]>,
    /// Corner indices, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Rounds positions to f32, joins corners that become one, drops triangles that lose their area, and puts
    /// corners and triangles in an order that depends on the shape only.
    pub fn canonical(positions: &[Point3<f64>], triangles: &[[u32; 3]]) -> Self {
        let rounded: Vec<[f32; 3]> = positions.iter().map(|p| [clean(p.x), clean(p.y), clean(p.z)]).collect();
        let key = |p: &[f32; 3]| p.map(ordered_bits);
        let mut used = vec![false; positions.len()];
        triangles.iter().flatten().for_each(|&corner| used[corner as usize] = true);
        let mut order: Vec<usize> = (0..positions.len()).filter(|&corner| used[corner]).collect();
        order.sort_unstable_by_key(|&corner| key(&rounded[corner]));
        let (mut vertices, mut index) = (Vec::<[f32; 3]>::new(), vec![0; positions.len()]);
        for corner in order {
            if vertices.last().map(key) != Some(key(&rounded[corner])) {
                vertices.push(rounded[corner]);
            }
            index[corner] = vertices.len() as u32 - 1;
        }
        let mut sorted: Vec<[u32; 3]> = triangles
            .iter()
            .map(|t| rotated_to_smallest(t.map(|corner| index[corner as usize])))
            .filter(|t| t[0] != t[1] && t[1] != t[2] && t[0] != t[2])
            .collect();
        sorted.sort_unstable();
        Self { vertices, triangles: sorted }
    }

    /// Corners of a triangle, mm.
    pub fn corners(&self, triangle: &[u32; 3]) -> [Point3<f64>; 3] {
        triangle.map(|i| {
            let v = self.vertices[i as usize];
            Point3::new(f64::from(v[0]), f64::from(v[1]), f64::from(v[2]))
        })
    }

    /// Enclosed volume, mm³; negative when the mesh is inside out.
    pub fn volume_mm3(&self) -> f64 {
        self.triangles.iter().map(|t| signed_volume(&self.corners(t))).sum()
    }

    /// Lowest and highest corner of the bounding box, mm.
    pub fn bounds_mm(&self) -> [[f64; 3]; 2] {
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for v in &self.vertices {
            for axis in 0..3 {
                bounds[0][axis] = bounds[0][axis].min(f64::from(v[axis]));
                bounds[1][axis] = bounds[1][axis].max(f64::from(v[axis]));
            }
        }
        bounds
    }

    /// Edge lengths of the bounding box, mm.
    pub fn size_mm(&self) -> [f64; 3] {
        let [low, high] = self.bounds_mm();
        [high[0] - low[0], high[1] - low[1], high[2] - low[2]]
    }

    /// The mesh moved rigidly.
    pub fn placed(&self, pose: &Isometry3<f64>) -> Self {
        let move_corner = |v: &[f32; 3]| {
            let p = pose * Point3::new(f64::from(v[0]), f64::from(v[1]), f64::from(v[2]));
            [p.x as f32, p.y as f32, p.z as f32]
        };
        Self { vertices: self.vertices.iter().map(move_corner).collect(), triangles: self.triangles.clone() }
    }

    /// Centre of volume (mm) and inertia of the solid about it for unit density (mm⁵).
    ///
    /// Sum over the tetrahedra between the origin and each facet (F. Tonon, Explicit exact formulas for the 3-D
    /// tetrahedron inertia tensor in terms of its vertex coordinates, J. Math. Stat. 1(1), 2005).
    pub fn moments(&self) -> (Point3<f64>, Matrix3<f64>) {
        let mut volume = 0.0;
        let mut first = Vector3::zeros();
        let mut second = Matrix3::zeros();
        for triangle in &self.triangles {
            let corners = self.corners(triangle);
            let v = signed_volume(&corners);
            let sum: Vector3<f64> = corners.iter().map(|c| c.coords).sum();
            volume += v;
            first += sum * (v / 4.0);
            let squares: Matrix3<f64> = corners.iter().map(|c| c.coords * c.coords.transpose()).sum();
            second += (squares + sum * sum.transpose()) * (v / 20.0);
        }
        let centre = first / volume;
        let about_centre = second - centre * centre.transpose() * volume;
        (centre.into(), Matrix3::identity() * about_centre.trace() - about_centre)
    }
}

/// Volume of the tetrahedron between the origin and a facet, mm³.
fn signed_volume(corners: &[Point3<f64>; 3]) -> f64 {
    corners[0].coords.dot(&corners[1].coords.cross(&corners[2].coords)) / 6.0
}

/// Parts of a millimetre on whose grid written corners lie: 15 nm.
pub(super) const GRID_PER_MM: f64 = 65536.0;

/// To f32, on the grid so that a coordinate means the same wherever it was computed; no negative zero.
fn clean(value: f64) -> f32 {
    let rounded = (value * GRID_PER_MM).round() / GRID_PER_MM;
    if rounded == 0.0 { 0.0 } else { rounded as f32 }
}

/// Bits that sort as the numbers do.
fn ordered_bits(value: f32) -> u32 {
    let bits = value.to_bits();
    if bits >> 31 == 1 { !bits } else { bits | 0x8000_0000 }
}

fn rotated_to_smallest(t: [u32; 3]) -> [u32; 3] {
    if t[0] <= t[1] && t[0] <= t[2] {
        t
    } else if t[1] <= t[2] {
        [t[1], t[2], t[0]]
    } else {
        [t[2], t[0], t[1]]
    }
}
