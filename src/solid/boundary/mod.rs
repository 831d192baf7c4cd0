//! Boundary representations: faces on planes and cylinders, bounded by edges that two faces share. What STEP files hold.
//!
//! The topology is that of the mesh. [`Boundary::faceted`] merges its coplanar facets; [`Boundary::exact`] puts its facets back
//! on the surfaces of the feature tree that they stand for, and edges and corners where those surfaces meet.

mod chains;
mod crossing;
mod curve;
mod exact;
mod half_edges;
mod homes;
mod known;
mod measure;
mod regions;
mod surface;

use nalgebra::{Isometry3, Point3};

pub use curve::Curve;
pub use exact::NotExact;
pub use surface::{Surface, square_to};

use super::mesh::Mesh;

/// How far a vertex may lie beside the plane of its merged face, mm: three times the grid of the mesh's coordinates.
pub const FLATNESS_MM: f64 = 5e-5;

/// A closed solid by its faces, mm.
#[derive(Clone, Debug)]
pub struct Boundary {
    /// Corners, mm.
    pub vertices: Vec<Point3<f64>>,
    /// Edges; each is used by two loops, in opposite directions.
    pub edges: Vec<Edge>,
    /// Faces.
    pub faces: Vec<Face>,
}

/// An edge from one vertex to another, or around to the same.
#[derive(Clone, Debug)]
pub struct Edge {
    /// Index of the first vertex.
    pub from: usize,
    /// Index of the last vertex.
    pub to: usize,
    /// What lies between.
    pub curve: Curve,
}

/// A face.
#[derive(Clone, Debug)]
pub struct Face {
    /// What it lies on.
    pub surface: Surface,
    /// Whether the surface's normal points out of the solid.
    pub outward: bool,
    /// Its boundary, counter-clockwise seen from outside; on a plane the outer loop is the first.
    pub loops: Vec<Vec<Side>>,
}

/// An edge as a loop runs along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// Index of the edge.
    pub edge: usize,
    /// Whether the loop runs from the edge's first vertex to its last.
    pub forward: bool,
}

impl Boundary {
    /// The solid with the mesh's own facets, coplanar neighbours merged; `None` when the mesh is not closed.
    ///
    /// Vertices are the mesh's; those of a merged face lie on its plane within `FLATNESS_MM`.
    pub fn faceted(mesh: &Mesh) -> Option<Self> {
        let half_edges = half_edges::HalfEdges::new(mesh)?;
        let mut regions = regions::coplanar(mesh, &half_edges);
        let vertices: Vec<Point3<f64>> = (0..mesh.vertices.len() as u32).map(|i| mesh.corners(&[i; 3])[0]).collect();
        loop {
            let chains = chains::Chains::between(mesh, &half_edges, &regions.of).straightened(mesh);
            let edges = chains.edges.iter().map(|chain| Edge { from: chain.first(), to: chain.last(), curve: Curve::Line }).collect();
            let mut boundary = Self { vertices: vertices.clone(), edges, faces: chains.faces(&regions) };
            let torn: Vec<usize> = (0..boundary.faces.len()).filter(|at| boundary.is_torn(&boundary.faces[*at])).collect();
            if !regions.split(mesh, &torn) {
                boundary.tidy();
                return Some(boundary);
            }
        }
    }

    /// Whether a face's loops do not bound one piece of its surface: they meet in a vertex, or cross.
    fn is_torn(&self, face: &Face) -> bool {
        let start = |side: &Side| if side.forward { self.edges[side.edge].from } else { self.edges[side.edge].to };
        let mut corners: Vec<usize> = face.loops.iter().flatten().map(start).collect();
        corners.sort_unstable();
        let meets_itself = corners.windows(2).any(|pair| pair[0] == pair[1]);
        let outer = face.loops.iter().filter(|sides| self.loop_area_mm2(face, sides) > 0.0).count();
        meets_itself || outer != 1 || self.touches_itself(face) || face.loops.len() > 1 && self.crosses_itself(face)
    }

    /// The same moved rigidly.
    pub fn placed(&self, pose: &Isometry3<f64>) -> Self {
        Self {
            vertices: self.vertices.iter().map(|p| pose * p).collect(),
            edges: self.edges.iter().map(|edge| Edge { curve: edge.curve.placed(pose), ..*edge }).collect(),
            faces: self.faces.iter().map(|face| Face { surface: face.surface.placed(pose), ..face.clone() }).collect(),
        }
    }

    /// Points along an edge, both ends included, mm.
    pub fn points_of(&self, edge: &Edge, pieces: u32) -> Vec<Point3<f64>> {
        edge.curve.points(&self.vertices[edge.from], &self.vertices[edge.to], pieces)
    }

    /// Drops vertices that no edge has, and puts the outer loop of each plane face first.
    fn tidy(&mut self) {
        let mut index = vec![usize::MAX; self.vertices.len()];
        for edge in &self.edges {
            (index[edge.from], index[edge.to]) = (0, 0);
        }
        let mut kept = Vec::new();
        for (at, vertex) in self.vertices.iter().enumerate() {
            if index[at] == 0 {
                index[at] = kept.len();
                kept.push(*vertex);
            }
        }
        self.vertices = kept;
        for edge in &mut self.edges {
            (edge.from, edge.to) = (index[edge.from], index[edge.to]);
        }
        for at in 0..self.faces.len() {
            let Surface::Plane { .. } = self.faces[at].surface else { continue };
            if self.faces[at].loops.len() < 2 {
                continue;
            }
            let area = |sides: &Vec<Side>| self.loop_area_mm2(&self.faces[at], sides);
            let areas: Vec<f64> = self.faces[at].loops.iter().map(area).collect();
            let outer = (0..areas.len()).max_by(|a, b| areas[*a].total_cmp(&areas[*b])).unwrap_or(0);
            self.faces[at].loops.swap(0, outer);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::{Feature, MeshSolid};

    fn exact(feature: &Feature) -> Boundary {
        let mesh = MeshSolid::build(feature).to_mesh();
        Boundary::exact(&mesh, feature, &Isometry3::identity()).expect("planes and cylinders")
    }

    #[test]
    fn analytic_cylinder_has_three_faces() {
        let cylinder = exact(&Feature::cylinder(1.5, 10.0).turned_x(crate::units::Angle::deg(33.0)).at(5.0, 6.0, 7.0));
        assert_eq!((cylinder.faces.len(), cylinder.edges.len(), cylinder.vertices.len()), (3, 2, 2));
        assert!((cylinder.volume_mm3() / (std::f64::consts::PI * 22.5) - 1.0).abs() < 1e-4, "{}", cylinder.volume_mm3());
    }
}
