//! The mesh's own facets as faces, coplanar neighbours merged.

use nalgebra::Point3;

use super::chains::Chains;
use super::curve::Curve;
use super::regions::{Facet, Regions};
use super::topology::{Boundary, Edge, Face};
use crate::solid::Mesh;
use crate::solid::half_edges::HalfEdges;

impl Boundary {
    /// The solid with the mesh's own facets, coplanar neighbours merged; `None` when the mesh is not closed.
    ///
    /// Vertices are the mesh's; those of a merged face lie on its plane within `FLATNESS_MM`.
    pub fn faceted(mesh: &Mesh) -> Option<Self> {
        let half_edges = HalfEdges::new(mesh)?;
        let facets = Facet::all(mesh);
        let mut regions = Regions::none(facets.len());
        regions.add_coplanar(&facets, &half_edges, &[]);
        let vertices: Vec<Point3<f64>> = (0..mesh.vertices.len() as u32).map(|i| mesh.corners(&[i; 3])[0]).collect();
        let ends = vec![false; vertices.len()];
        loop {
            let chains = Chains::between(&half_edges, &regions.of, &ends).straightened(&vertices, |_| true);
            let edges = chains.edges.iter().map(|chain| Edge { from: chain.first(), to: chain.last(), curve: Curve::Line }).collect();
            let mut boundary = Self { vertices: vertices.clone(), edges, faces: chains.faces(&regions, 0) };
            let torn: Vec<usize> = (0..boundary.faces.len()).filter(|at| boundary.is_torn(&boundary.faces[*at])).collect();
            if !regions.split(mesh, &torn) {
                boundary.tidy();
                return Some(boundary);
            }
        }
    }

    fn has_arcs(&self, face: &Face) -> bool {
        face.loops.iter().flatten().any(|side| !matches!(self.edges[side.edge].curve, Curve::Line))
    }

    /// Whether a face's loops do not bound one piece of its surface: they meet in a vertex, or cross.
    pub(super) fn is_torn(&self, face: &Face) -> bool {
        let outer = face.loops.iter().filter(|sides| self.loop_area_mm2(face, sides) > 0.0).count();
        !self.meets_itself_in(face).is_empty()
            || outer != 1
            || self.touches_itself(face)
            // A single loop of chords bounds what its facets are; an arc in it may pass over a straight side.
            || (face.loops.len() > 1 || self.has_arcs(face)) && self.crosses_itself(face)
    }
}
