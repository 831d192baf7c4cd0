//! Corners, edges and faces of a closed solid.

use std::collections::BTreeSet;

use nalgebra::{Isometry3, Point3};

use super::curve::Curve;
use super::surface::Surface;

/// How far a vertex may lie beside the plane of its merged face, mm: three times the grid of the mesh's coordinates.
pub const FLATNESS_MM: f64 = 5e-5;

/// A closed solid by its faces, mm.
#[derive(Clone, Debug)]
pub struct Boundary {
    /// Corners, mm.
    pub vertices: Vec<Point3<f64>>,
    /// Edges; each is used twice, in opposite directions: by two loops, or as the seam of one.
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
    /// Whether it lies on a surface of the features; else it is a facet of the mesh, or several.
    pub is_exact: bool,
}

/// An edge as a loop runs along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// Index of the edge.
    pub edge: usize,
    /// Whether the loop runs from the edge's first vertex to its last.
    pub forward: bool,
}

impl Face {
    /// The edge that its border has twice, once in each direction.
    pub fn seam(&self) -> Option<usize> {
        let sides = self.loops.first()?;
        let (forward, back): (Vec<&Side>, Vec<&Side>) = sides.iter().partition(|side| side.forward);
        forward.iter().find(|side| back.iter().any(|other| other.edge == side.edge)).map(|side| side.edge)
    }
}

impl Boundary {
    /// The same moved rigidly.
    pub fn placed(&self, pose: &Isometry3<f64>) -> Self {
        Self {
            vertices: self.vertices.iter().map(|p| pose * p).collect(),
            edges: self.edges.iter().map(|edge| Edge { curve: edge.curve.placed(pose), ..*edge }).collect(),
            faces: self.faces.iter().map(|face| Face { surface: face.surface.placed(pose), ..face.clone() }).collect(),
        }
    }

    /// Its faces by the pieces that they enclose: faces that share an edge are of one piece. Indices of faces, ascending; pieces in
    /// the order of their first faces. A cavity would be a piece of its own; no part has one.
    pub fn pieces(&self) -> Vec<Vec<usize>> {
        let mut edge_piece: Vec<Option<usize>> = vec![None; self.edges.len()];
        let mut pieces: Vec<Vec<usize>> = Vec::new();
        for (at, face) in self.faces.iter().enumerate() {
            let edges = || face.loops.iter().flatten().map(|side| side.edge);
            let met: BTreeSet<usize> = edges().filter_map(|edge| edge_piece[edge]).collect();
            let into = met.first().copied().unwrap_or_else(|| {
                pieces.push(Vec::new());
                pieces.len() - 1
            });
            for other in met.into_iter().skip(1) {
                let joined = std::mem::take(&mut pieces[other]);
                pieces[into].extend(joined);
                edge_piece.iter_mut().filter(|piece| **piece == Some(other)).for_each(|piece| *piece = Some(into));
            }
            pieces[into].push(at);
            edges().for_each(|edge| edge_piece[edge] = Some(into));
        }
        pieces.retain(|piece| !piece.is_empty());
        pieces.iter_mut().for_each(|piece| piece.sort_unstable());
        pieces
    }

    /// Points along an edge, both ends included, mm.
    pub fn points_of(&self, edge: &Edge, pieces: u32) -> Vec<Point3<f64>> {
        edge.curve.points(&self.vertices[edge.from], &self.vertices[edge.to], pieces)
    }

    /// Drops vertices that no edge has, and puts the outer loop of each plane face first.
    pub(super) fn tidy(&mut self) {
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
