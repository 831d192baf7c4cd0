//! The mesh put back on the surfaces of its feature tree.

use std::collections::BTreeSet;

use nalgebra::{Isometry3, Point3};

use super::chains::{Chain, Chains};
use super::curve::{self, Curve};
use super::face_assignment;
use super::half_edges::HalfEdges;
use super::known::{self, Known};
use super::not_exact::NotExact;
use super::regions::{Facet, Regions};
use super::surface::Surface;
use super::topology::{Boundary, Edge, FLATNESS_MM};
use crate::solid::{Feature, Mesh};

/// How far a corner may move from where the mesh has it, mm: a plane that sinks 0.01 mm into a cylinder ends this much elsewhere
/// on its chords.
const MOVED_MM: f64 = 0.3;

/// How far corners and edges may lie beside the surfaces that meet there, mm.
const MEETS_MM: f64 = FLATNESS_MM;

/// How far an edge may lie beside the chords that stood for it, mm.
const BULGE_MM: f64 = 0.15;

/// How far the area of a face may be from that of its facets: a share, and a width along its border, mm.
const AREA_SHARE: f64 = 0.01;
const AREA_BORDER_MM: f64 = 0.1;

/// Least area of a face, mm². Smaller ones are what chords leave between surfaces that nearly meet: of the top corner two faces of 0.006 mm²
/// beside its notch, with which OCCT reads no valid solid.
const LEAST_FACE_MM2: f64 = 0.02;

/// How far the volumes may be apart, as a share: chords take 0.3 % of a round solid.
const VOLUME_SHARE: f64 = 0.0045;

impl Boundary {
    /// The solid with the surfaces of the features that the mesh was made of, moved by the pose. The mesh's facets say which
    /// surfaces bound it and what borders on what, the features where exactly.
    ///
    /// # Errors
    /// Where a facet stands for no plane or cylinder of the tree, or surfaces meet elsewhere than the mesh has it: with chords
    /// for arcs the mesh may have edges that the exact solid has not.
    pub fn exact(mesh: &Mesh, feature: &Feature, pose: &Isometry3<f64>) -> Result<Self, NotExact> {
        let half_edges = HalfEdges::new(mesh).ok_or(NotExact::Open)?;
        let facets = Facet::all(mesh);
        let known = known::surfaces(feature, pose);
        let assignment = face_assignment::of(&facets, &half_edges, &known)?;
        let regions = connected(&facets, &half_edges, &assignment, &known);
        let chains = Chains::between(mesh, &half_edges, &regions.of);
        let mut boundary = Self { vertices: corners(mesh, &chains, &regions)?, edges: Vec::new(), faces: chains.faces(&regions) };
        boundary.edges = chains.edges.iter().map(|chain| edge(mesh, chain, &regions, &boundary.vertices)).collect::<Result<_, _>>()?;
        boundary.agrees(mesh, &facets, &regions)?;
        boundary.tidy();
        Ok(boundary)
    }

    /// Lets a boundary pass whose faces and volume are those of the mesh, but for chords.
    fn agrees(&self, mesh: &Mesh, facets: &[Facet], regions: &Regions) -> Result<(), NotExact> {
        let mut areas = vec![0.0; self.faces.len()];
        for (facet, region) in facets.iter().zip(&regions.of) {
            areas[*region] += facet.area_mm2;
        }
        for (face, mesh_mm2) in self.faces.iter().zip(areas) {
            let exact_mm2 = self.area_mm2(face);
            let border_mm: f64 = face.loops.iter().flatten().map(|side| self.length_mm(&self.edges[side.edge])).sum();
            let off = (exact_mm2 - mesh_mm2).abs();
            if exact_mm2 < LEAST_FACE_MM2
                || off > AREA_SHARE * mesh_mm2 + AREA_BORDER_MM * border_mm
                || off > 1.5 * mesh_mm2
                || self.crosses_itself(face)
            {
                let at = face.loops.first().and_then(|sides| sides.first()).map_or(0, |side| self.edges[side.edge].from);
                return Err(NotExact::Face { at: self.vertices[at].into(), exact_mm2, mesh_mm2 });
            }
        }
        let (exact_mm3, mesh_mm3) = (self.volume_mm3(), mesh.volume_mm3());
        if (exact_mm3 / mesh_mm3 - 1.0).abs() < VOLUME_SHARE { Ok(()) } else { Err(NotExact::Volume { exact_mm3, mesh_mm3 }) }
    }

    fn length_mm(&self, edge: &Edge) -> f64 {
        self.points_of(edge, 16).windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
    }
}

/// Neighbouring facets of one surface as regions.
fn connected(facets: &[Facet], half_edges: &HalfEdges, assignment: &[usize], known: &[Known]) -> Regions {
    // Arcs of one cylinder that are cut differently are one surface.
    let first = |surface: usize| known.iter().position(|other| other.surface.is_same(&known[surface].surface)).unwrap_or(surface);
    let first: Vec<usize> = (0..known.len()).map(first).collect();
    let mut regions = Regions { of: vec![usize::MAX; facets.len()], surfaces: Vec::new() };
    for seed in 0..facets.len() {
        if regions.of[seed] != usize::MAX {
            continue;
        }
        let (id, own) = (regions.surfaces.len(), first[assignment[seed]]);
        let surface = &known[own].surface;
        let mut outwards = 0.0;
        regions.of[seed] = id;
        let mut open = vec![seed];
        while let Some(at) = open.pop() {
            let middle = Point3::from(facets[at].corners.iter().map(|p| p.coords).sum::<nalgebra::Vector3<f64>>() / 3.0);
            outwards += facets[at].area_mm2 * facets[at].normal.dot(&surface.normal_at(&middle));
            for h in 3 * at..3 * at + 3 {
                let neighbour = half_edges.twin(h) / 3;
                if regions.of[neighbour] == usize::MAX && first[assignment[neighbour]] == own {
                    regions.of[neighbour] = id;
                    open.push(neighbour);
                }
            }
        }
        regions.surfaces.push((surface.clone(), outwards > 0.0));
    }
    regions
}

/// Where the surfaces around each corner meet; vertices that are no corners stay as they are.
fn corners(mesh: &Mesh, chains: &Chains, regions: &Regions) -> Result<Vec<Point3<f64>>, NotExact> {
    let mut around: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); mesh.vertices.len()];
    for chain in &chains.edges {
        for end in [chain.first(), chain.last()] {
            around[end].extend(chain.regions);
        }
    }
    let position = |at: usize| mesh.corners(&[at as u32; 3])[0];
    let meet = |at: usize| {
        let near = position(at);
        if around[at].is_empty() {
            return Ok(near);
        }
        let surfaces: Vec<&Surface> = around[at].iter().map(|region| &regions.surfaces[*region].0).collect();
        let found = curve::onto(&surfaces, &near).unwrap_or(Point3::origin());
        let off_mm = (found - near).norm();
        let beside = surfaces.iter().map(|surface| surface.distance_mm(&found).abs()).fold(0.0, f64::max);
        if off_mm < MOVED_MM && beside < MEETS_MM {
            Ok(found)
        } else {
            Err(NotExact::Corner { at: near.into(), off_mm: off_mm.max(beside) })
        }
    };
    (0..mesh.vertices.len()).map(meet).collect()
}

/// A chain as the curve in which its two surfaces cross.
fn edge(mesh: &Mesh, chain: &Chain, regions: &Regions, vertices: &[Point3<f64>]) -> Result<Edge, NotExact> {
    let (from, to) = (chain.first(), chain.last());
    let mut points: Vec<Point3<f64>> = chain.corners.iter().map(|at| mesh.corners(&[*at as u32; 3])[0]).collect();
    let last = points.len() - 1;
    (points[0], points[last]) = (vertices[from], vertices[to]);
    let refused = NotExact::Edge { at: points[last / 2].into() };
    let [a, b] = chain.regions.map(|region| &regions.surfaces[region].0);
    let curve = Curve::between(a, b, &points).ok_or(refused.clone())?;
    let along = curve.points(&points[0], &points[last], 24);
    let on_both = along.iter().all(|p| [a, b].iter().all(|surface| surface.distance_mm(p).abs() < MEETS_MM));
    let arrives = (along[along.len() - 1] - points[last]).norm() < MEETS_MM;
    let moved = |p: &Point3<f64>| points.windows(2).map(|pair| curve::beside_mm(p, &pair[0], &pair[1])).fold(f64::INFINITY, f64::min);
    let stays = along.iter().all(|p| moved(p) < BULGE_MM);
    if on_both && arrives && stays { Ok(Edge { from, to, curve }) } else { Err(refused) }
}
