//! Cutting a mesh by a plane: the outline of what is cut, as straight pieces.

use nalgebra::{Point3, Vector3};

use super::mesh::Mesh;

/// A plane with axes of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutPlane {
    /// Its origin, mm.
    pub origin: Point3<f64>,
    /// Unit vectors in it, square to each other; their cross product is its normal.
    pub axes: [Vector3<f64>; 2],
}

/// A straight piece of an outline in the plane's axes, mm: the material lies to its left, seen against the normal.
pub type Piece = [[f64; 2]; 2];

impl CutPlane {
    /// The plane through a point, square to a direction, whose second axis is as near to `up` as can be.
    ///
    /// `None` when `up` lies along the direction.
    pub fn across(origin: Point3<f64>, along: &Vector3<f64>, up: &Vector3<f64>) -> Option<Self> {
        let normal = along.try_normalize(1e-9)?;
        let first = up.cross(&normal).try_normalize(1e-6)?;
        Some(Self { origin, axes: [first, normal.cross(&first)] })
    }

    /// The plane's normal.
    pub fn normal(&self) -> Vector3<f64> {
        self.axes[0].cross(&self.axes[1])
    }

    /// A point of the plane in space.
    pub fn point(&self, at: [f64; 2]) -> Point3<f64> {
        self.origin + self.axes[0] * at[0] + self.axes[1] * at[1]
    }

    fn flat(&self, p: &Vector3<f64>) -> [f64; 2] {
        self.axes.map(|axis| axis.dot(&(p - self.origin.coords)))
    }
}

impl Mesh {
    /// The outline of the cut, in pieces of any order. A corner that lies on the plane counts as above it, so that closed
    /// meshes give closed outlines.
    pub fn cut(&self, plane: &CutPlane) -> Vec<Piece> {
        self.cut_facets(plane).into_iter().map(|(_, piece)| piece).collect()
    }

    /// The same with the number of the facet that each piece lies in.
    pub fn cut_facets(&self, plane: &CutPlane) -> Vec<(usize, Piece)> {
        let normal = plane.normal();
        let points: Vec<Vector3<f64>> = self.vertices.iter().map(|v| Vector3::from(v.map(f64::from))).collect();
        let heights: Vec<f64> = points.iter().map(|p| normal.dot(&(p - plane.origin.coords))).collect();
        let crossed = |(_, triangle): &(usize, &[u32; 3])| {
            let above = triangle.iter().filter(|i| heights[**i as usize] >= 0.0).count();
            above == 1 || above == 2
        };
        self.triangles.iter().enumerate().filter(crossed).map(|(at, triangle)| (at, piece(triangle, &points, &heights, plane))).collect()
    }
}

/// Where a facet that is crossed meets the plane. Facets turn counter-clockwise seen from outside: going round one, the
/// outline leaves where it goes down through the plane and arrives where it comes up.
fn piece(triangle: &[u32; 3], points: &[Vector3<f64>], heights: &[f64], plane: &CutPlane) -> Piece {
    let mut ends = [[0.0; 2]; 2];
    for k in 0..3 {
        let (a, b) = (triangle[k] as usize, triangle[(k + 1) % 3] as usize);
        let (ha, hb) = (heights[a], heights[b]);
        if (ha >= 0.0) != (hb >= 0.0) {
            // The same numbers whichever way round the neighbour runs through the edge.
            let (low, high) = (a.min(b), a.max(b));
            let t = heights[low] / (heights[low] - heights[high]);
            let at = points[low] + (points[high] - points[low]) * t;
            ends[usize::from(ha < 0.0)] = plane.flat(&at);
        }
    }
    ends
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::{Feature, MeshSolid};

    fn area(pieces: &[Piece]) -> f64 {
        pieces.iter().map(|[a, b]| 0.5 * (a[0] * b[1] - a[1] * b[0])).sum()
    }

    #[test]
    fn analytic_a_cut_tube_shows_a_ring() {
        let tube = Feature::cylinder(5.0, 10.0).minus([Feature::cylinder(3.0, 20.0).at(1.0, 0.0, -5.0)]);
        let mesh = MeshSolid::build(&tube).to_mesh();
        let polygon = |r: f64| 24.0 * r * r * libm::sin(std::f64::consts::TAU / 48.0);
        let straight = CutPlane::across(Point3::new(0.3, 0.2, 4.0), &Vector3::z(), &Vector3::y()).expect("is a plane");
        assert!((area(&mesh.cut(&straight)) - polygon(5.0) + polygon(3.0)).abs() < 1e-3);
        // Against the normal the same outline runs the same way round; slanted by 60° it is twice as large.
        let slanted = Vector3::new(libm::sqrt(0.75), 0.0, 0.5) * -1.0;
        let plane = CutPlane::across(Point3::new(0.0, 0.0, 5.0), &slanted, &Vector3::y()).expect("is a plane");
        let tall = MeshSolid::build(&Feature::cylinder(1.0, 10.0)).to_mesh();
        assert!((area(&tall.cut(&plane)) - 2.0 * polygon(1.0)).abs() < 1e-3);
    }
}
