//! The mesh put back on the surfaces of its feature tree.

use std::collections::BTreeSet;

use nalgebra::{Isometry3, Point3};

use super::chains::{Chain, Chains};
use super::connected::connected;
use super::curve::{self, Curve};
use super::face_assignment;
use super::known;
use super::not_exact::NotExact;
use super::regions::{Facet, Regions};
use super::small_faces::{LEAST_FACE_MM2, absorb_small_faces};
use super::surface::Surface;
use super::topology::{Boundary, Edge, FLATNESS_MM, Face};
use super::touching::contact;
use crate::solid::half_edges::HalfEdges;
use crate::solid::{Feature, Mesh};

/// How far a corner may move from where the mesh has it, mm: a plane that sinks 0.01 mm into a cylinder ends this much elsewhere
/// on its chords.
pub(super) const MOVED_MM: f64 = 0.3;

/// How far corners and edges may lie beside the surfaces that meet there, mm.
pub(super) const MEETS_MM: f64 = FLATNESS_MM;

/// How far an edge may lie beside the chords that stood for it, mm.
pub(super) const BULGE_MM: f64 = 0.15;

/// Ends of an edge that are closer than this are one point to a reader, mm.
pub(super) const SHORTEST_MM: f64 = 2e-4;

/// How far the area of a face may be from that of its facets: a share, and a width along its border, mm.
const AREA_SHARE: f64 = 0.01;
const AREA_BORDER_MM: f64 = 0.1;

/// How far the volumes may be apart, as a share: chords take 0.3 % of a round solid.
const VOLUME_SHARE: f64 = 0.0045;
/// The same of a tube, whose bore they make narrower too: of each cylinder's area times its radius. 48 chords to a turn take 0.0014 of it.
const CHORDS_SHARE: f64 = 0.0021;

impl Boundary {
    /// The solid with the surfaces of the features that the mesh was made of, moved by the pose. The mesh's facets say which
    /// surfaces bound it and what borders on what, the features where exactly.
    ///
    /// # Errors
    /// Where a facet stands for no surface of the tree, or surfaces meet elsewhere than the mesh has it: with chords
    /// for arcs the mesh may have edges that the exact solid has not.
    pub fn exact(mesh: &Mesh, feature: &Feature, pose: &Isometry3<f64>) -> Result<Self, NotExact> {
        let half_edges = HalfEdges::new(mesh).ok_or(NotExact::Open)?;
        let facets = Facet::all(mesh);
        let known = known::surfaces(feature, pose);
        let assignment = face_assignment::of(&facets, &half_edges, &known)?;
        let mut assignment: Vec<Option<usize>> = assignment.into_iter().map(Some).collect();
        absorb_small_faces(&facets, &half_edges, &mut assignment, &known);
        let regions = connected(&facets, &half_edges, &assignment, &known);
        let positions = positions(mesh);
        let chains = Chains::between(&half_edges, &regions.of, &vec![false; positions.len()]);
        let vertices = corners(&positions, &chains, &regions)?;
        let chains = chains.collapsed(&vertices, SHORTEST_MM);
        let mut boundary = Self { vertices, edges: Vec::new(), faces: chains.faces(&regions, usize::MAX) };
        boundary.edges =
            chains.edges.iter().map(|chain| edge(&positions, chain, &regions, &boundary.vertices)).collect::<Result<_, _>>()?;
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
            if !self.is_that_of_facets(face, mesh_mm2) {
                let at = face.loops.first().and_then(|sides| sides.first()).map_or(0, |side| self.edges[side.edge].from);
                return Err(NotExact::Face { at: self.vertices[at].into(), exact_mm2: self.area_mm2(face), mesh_mm2 });
            }
        }
        self.has_volume_of(mesh)
    }

    /// Whether a face has the area of its facets, mm², but for chords, and a border that does not cross itself.
    pub(super) fn is_that_of_facets(&self, face: &Face, mesh_mm2: f64) -> bool {
        let exact_mm2 = self.area_mm2(face);
        let border_mm: f64 = face.loops.iter().flatten().map(|side| self.length_mm(&self.edges[side.edge])).sum();
        let off = (exact_mm2 - mesh_mm2).abs();
        exact_mm2 >= LEAST_FACE_MM2
            && off <= AREA_SHARE * mesh_mm2 + AREA_BORDER_MM * border_mm
            && off <= 1.5 * mesh_mm2
            && !self.crosses_itself(face)
    }

    /// Whether it encloses what the mesh encloses, but for chords.
    pub(super) fn has_volume_of(&self, mesh: &Mesh) -> Result<(), NotExact> {
        let (exact_mm3, mesh_mm3) = (self.volume_mm3(), mesh.volume_mm3());
        let of_chords = |face: &Face| match face.surface {
            Surface::Cylinder { radius_mm, .. } if face.is_exact => CHORDS_SHARE * radius_mm * self.area_mm2(face),
            _ => 0.0,
        };
        let most_mm3 = (VOLUME_SHARE * mesh_mm3).max(self.faces.iter().map(of_chords).sum());
        if (exact_mm3 - mesh_mm3).abs() < most_mm3 { Ok(()) } else { Err(NotExact::Volume { exact_mm3, mesh_mm3 }) }
    }

    fn length_mm(&self, edge: &Edge) -> f64 {
        self.points_of(edge, 16).windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
    }
}

/// The mesh's vertices, mm.
pub(super) fn positions(mesh: &Mesh) -> Vec<Point3<f64>> {
    (0..mesh.vertices.len() as u32).map(|at| mesh.corners(&[at; 3])[0]).collect()
}

/// Where the surfaces around each corner meet; vertices that are no corners stay as they are.
fn corners(positions: &[Point3<f64>], chains: &Chains, regions: &Regions) -> Result<Vec<Point3<f64>>, NotExact> {
    let mut around: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); positions.len()];
    for chain in &chains.edges {
        for end in [chain.first(), chain.last()] {
            around[end].extend(chain.regions);
        }
    }
    let meet = |at: usize| {
        let near = positions[at];
        if around[at].is_empty() {
            return Ok(near);
        }
        let surfaces: Vec<&Surface> = around[at].iter().map(|region| &regions.surfaces[*region].0).collect();
        corner(&surfaces, &near, MOVED_MM)
    };
    (0..positions.len()).map(meet).collect()
}

/// Where surfaces meet, at most so far from a point, mm; of surfaces that touch, where they do, if all meet there.
pub(super) fn corner(surfaces: &[&Surface], near: &Point3<f64>, most_mm: f64) -> Result<Point3<f64>, NotExact> {
    let pairs = (0..surfaces.len()).flat_map(|i| surfaces[i + 1..].iter().map(move |other| (surfaces[i], *other)));
    let contacts: Vec<Surface> = pairs.filter_map(|(a, b)| contact(a, b)).collect();
    let with_contacts: Vec<&Surface> = surfaces.iter().copied().chain(&contacts).collect();
    meeting(&with_contacts, near, most_mm).or_else(|_| meeting(surfaces, near, most_mm))
}

fn meeting(surfaces: &[&Surface], near: &Point3<f64>, most_mm: f64) -> Result<Point3<f64>, NotExact> {
    let found = curve::onto(surfaces, near).unwrap_or(Point3::origin());
    let off_mm = (found - near).norm();
    let beside = surfaces.iter().map(|surface| surface.distance_mm(&found).abs()).fold(0.0, f64::max);
    let meet = off_mm < most_mm && beside < MEETS_MM;
    if meet { Ok(found) } else { Err(NotExact::Corner { at: (*near).into(), off_mm: off_mm.max(beside) }) }
}

/// A chain as the curve in which its two surfaces cross.
pub(super) fn edge(positions: &[Point3<f64>], chain: &Chain, regions: &Regions, vertices: &[Point3<f64>]) -> Result<Edge, NotExact> {
    let (from, to) = (chain.first(), chain.last());
    let mut points: Vec<Point3<f64>> = chain.corners.iter().map(|at| positions[*at]).collect();
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
