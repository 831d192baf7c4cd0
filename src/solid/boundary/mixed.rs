//! The mesh put back on the surfaces of its feature tree where it lies on them, and left in facets elsewhere.
//!
//! Facets that lie on no surface of the tree, as those of a hull between round bodies, are free. So are those where surfaces do not meet as the mesh has it:
//! what fails in one attempt is free in the next, so the last attempt is at worst the faceted solid. Vertices that a free facet shares
//! with a surface move onto it; a round surface meets a free facet in the arc in which the facet's plane cuts it.

use std::collections::BTreeSet;

use nalgebra::{Isometry3, Point3, Unit};

use super::chains::{Chain, Chains};
use super::connected::connected;
use super::curve::{Curve, beside_mm};
use super::exact::{BULGE_MM, MEETS_MM, MOVED_MM, SHORTEST_MM, corner, edge, positions};
use super::face_assignment;
use super::known::{self, Known};
use super::regions::{Facet, Regions};
use super::small_faces::{LEAST_FACE_MM2, absorb_small_faces};
use super::surface::Surface;
use super::topology::{Boundary, Edge};
use crate::solid::half_edges::HalfEdges;
use crate::solid::{Feature, Mesh};

/// Ways to go about it; the one that leaves the least area in facets counts.
const WAYS: [Way; 2] = [Way { moved_mm: 0.05, patience: 30 }, Way { moved_mm: 0.2, patience: 0 }];

/// How far vertices of free facets move, and when faces are given up.
#[derive(Clone, Copy)]
struct Way {
    /// How far at most, mm. Where surfaces touch, a vertex on a chord lies a tenth of a millimetre beside the line in which they do.
    moved_mm: f64,
    /// Attempts in which a face on a cone, a sphere or a torus loses single facets; after them it is free as a whole.
    patience: usize,
}

/// How far an arc may lie beside the straight side of a free facet, as a share of the facet's height.
const BULGE_SHARE: f64 = 0.3;

/// Cosine of the angle by which a free facet may turn when its vertices move.
const LEAST_TURNED: f64 = 0.8;

/// Free facets lower than this have no direction that could turn, mm.
const SLIVER_MM: f64 = 1e-4;

/// Attempts after which the solid is left faceted.
const ATTEMPTS: usize = 100;

impl Boundary {
    /// The solid with as many faces as possible on the surfaces of the features, moved by the pose; the rest are facets of the mesh.
    /// `None` when the mesh is not closed, or no face would be exact.
    pub fn mixed(mesh: &Mesh, feature: &Feature, pose: &Isometry3<f64>) -> Option<Self> {
        let half_edges = HalfEdges::new(mesh)?;
        let facets = Facet::all(mesh);
        let known = known::surfaces(feature, pose);
        let mut surfaces = face_assignment::where_found(&facets, &half_edges, &known);
        absorb_small_faces(&facets, &half_edges, &mut surfaces, &known);
        let found = WAYS.iter().filter_map(|way| by_attempts(mesh, (&half_edges, &facets, &known), surfaces.clone(), *way));
        let in_facets_mm2 = |of: &Self| -> f64 { of.faces.iter().filter(|face| !face.is_exact).map(|face| of.area_mm2(face)).sum() };
        let mut best = found.min_by(|a, b| in_facets_mm2(a).total_cmp(&in_facets_mm2(b)))?;
        best.tidy();
        Some(best)
    }
}

/// Attempts until one succeeds.
fn by_attempts(
    mesh: &Mesh,
    (half_edges, facets, known): (&HalfEdges, &[Facet], &[Known]),
    mut surfaces: Vec<Option<usize>>,
    way: Way,
) -> Option<Boundary> {
    let mut alone = vec![false; facets.len()];
    for round in 0..ATTEMPTS {
        let regions = connected(facets, half_edges, &surfaces, known);
        if regions.surfaces.is_empty() {
            return None;
        }
        let mut attempt = Attempt::new(mesh, half_edges, facets, regions, &alone, way.moved_mm);
        if let Some(boundary) = attempt.boundary(mesh) {
            return boundary.has_volume_of(mesh).is_ok().then_some(boundary);
        }
        if round >= way.patience {
            attempt.free_doubly_round();
        }
        attempt.loose.iter().for_each(|facet| surfaces[*facet] = None);
        attempt.apart.iter().for_each(|facet| alone[*facet] = true);
    }
    None
}

/// One attempt, with what is to be free, and what is not to be merged, in the next.
struct Attempt<'a> {
    half_edges: &'a HalfEdges,
    facets: &'a [Facet],
    alone: &'a [bool],
    moved_mm: f64,
    /// The regions of surfaces first, then those of free facets.
    regions: Regions,
    exact: usize,
    /// The facets around each vertex.
    around: Vec<Vec<usize>>,
    /// Where the vertices are, mm: on the surfaces of their facets, where they are on a free facet.
    positions: Vec<Point3<f64>>,
    loose: BTreeSet<usize>,
    apart: BTreeSet<usize>,
}

impl<'a> Attempt<'a> {
    fn new(mesh: &Mesh, half_edges: &'a HalfEdges, facets: &'a [Facet], regions: Regions, alone: &'a [bool], moved_mm: f64) -> Self {
        let mut around = vec![Vec::new(); mesh.vertices.len()];
        for (at, triangle) in mesh.triangles.iter().enumerate() {
            triangle.iter().for_each(|corner| around[*corner as usize].push(at));
        }
        let (exact, positions) = (regions.surfaces.len(), positions(mesh));
        let (loose, apart) = (BTreeSet::new(), BTreeSet::new());
        Self { half_edges, facets, alone, moved_mm, regions, exact, around, positions, loose, apart }
    }

    /// The solid; `None` where something is loose or apart.
    fn boundary(&mut self, mesh: &Mesh) -> Option<Boundary> {
        self.free_small_regions();
        self.move_vertices();
        self.go_on()?;
        let free = self.free_facets(mesh);
        self.go_on()?;
        self.regions.add_coplanar(&free, self.half_edges, self.alone);
        let chains = self.chains();
        self.free_short_chains(&chains);
        let edges: Vec<Option<Edge>> = chains.edges.iter().map(|chain| self.edge(chain)).collect();
        let edges = edges.into_iter().collect::<Option<Vec<Edge>>>()?;
        let boundary = Boundary { vertices: self.positions.clone(), edges, faces: chains.faces(&self.regions, self.exact) };
        self.judge(&boundary);
        self.go_on()?;
        Some(boundary)
    }

    /// Frees a face on a cone, a sphere or a torus as a whole: facet by facet its neighbours would follow.
    fn free_doubly_round(&mut self) {
        let regions: BTreeSet<usize> =
            self.loose.iter().map(|facet| self.regions.of[*facet]).filter(|region| self.is_doubly_round(*region)).collect();
        let facets: Vec<usize> = (0..self.facets.len()).filter(|facet| regions.contains(&self.regions.of[*facet])).collect();
        self.loose.extend(facets);
    }

    fn is_doubly_round(&self, region: usize) -> bool {
        !matches!(self.regions.surfaces[region].0, Surface::Plane { .. } | Surface::Cylinder { .. })
    }

    fn go_on(&self) -> Option<()> {
        (self.loose.is_empty() && self.apart.is_empty()).then_some(())
    }

    fn is_exact(&self, facet: usize) -> bool {
        self.regions.of[facet] < self.exact
    }

    /// Frees the facets of surfaces around a vertex.
    fn loosen_around(&mut self, vertex: usize) {
        let loose: Vec<usize> = self.around[vertex].iter().copied().filter(|facet| self.is_exact(*facet)).collect();
        self.loose.extend(loose);
    }

    fn free_small_regions(&mut self) {
        let mut areas = vec![0.0; self.exact];
        for (at, facet) in self.facets.iter().enumerate().filter(|(at, _)| self.is_exact(*at)) {
            areas[self.regions.of[at]] += facet.area_mm2;
        }
        let small = |facet: &usize| self.is_exact(*facet) && areas[self.regions.of[*facet]] < LEAST_FACE_MM2;
        let small: Vec<usize> = (0..self.facets.len()).filter(small).collect();
        self.loose.extend(small);
    }

    /// Regions of surfaces around a vertex, and whether a free facet is there.
    fn regions_around(&self, vertex: usize) -> (BTreeSet<usize>, bool) {
        let regions = self.around[vertex].iter().map(|facet| self.regions.of[*facet]);
        let exact: BTreeSet<usize> = regions.filter(|region| *region < self.exact).collect();
        (exact, self.around[vertex].iter().any(|facet| !self.is_exact(*facet)))
    }

    /// Puts vertices where the surfaces around them meet.
    fn move_vertices(&mut self) {
        for vertex in 0..self.positions.len() {
            let (regions, is_free) = self.regions_around(vertex);
            if regions.is_empty() || regions.len() == 1 && !is_free {
                continue;
            }
            let surfaces: Vec<&Surface> = regions.iter().map(|region| &self.regions.surfaces[*region].0).collect();
            match corner(&surfaces, &self.positions[vertex], if is_free { self.moved_mm } else { MOVED_MM }) {
                Ok(found) => self.positions[vertex] = found,
                // On the border of only two surfaces no corner need be.
                Err(_) if regions.len() == 2 && !is_free => {}
                Err(_) => self.loosen_around(vertex),
            }
        }
    }

    /// The facets with their vertices moved. Frees what would turn a free facet over.
    fn free_facets(&mut self, mesh: &Mesh) -> Vec<Facet> {
        let corners = |triangle: &[u32; 3]| triangle.map(|corner| self.positions[corner as usize]);
        let moved: Vec<Facet> = mesh.triangles.iter().map(|triangle| Facet::new(corners(triangle))).collect();
        for (at, triangle) in mesh.triangles.iter().enumerate() {
            let has_direction = self.facets[at].height_mm > SLIVER_MM;
            if !self.is_exact(at) && has_direction && moved[at].normal.dot(&self.facets[at].normal) < LEAST_TURNED {
                triangle.iter().for_each(|corner| self.loosen_around(*corner as usize));
            }
        }
        moved
    }

    fn is_curved(&self, region: usize) -> bool {
        !matches!(self.regions.surfaces[region].0, Surface::Plane { .. })
    }

    /// Borders; those of free facets on round surfaces end in every vertex, others of free facets where they bend.
    fn chains(&self) -> Chains {
        let ends: Vec<bool> = (0..self.positions.len())
            .map(|vertex| {
                let (regions, is_free) = self.regions_around(vertex);
                is_free && regions.iter().any(|region| self.is_curved(*region))
            })
            .collect();
        let is_straight =
            |chain: &Chain| chain.regions.iter().any(|region| *region >= self.exact) && !chain.regions.iter().any(|r| self.is_curved(*r));
        Chains::between(self.half_edges, &self.regions.of, &ends).straightened(&self.positions, is_straight)
    }

    /// Frees what moved two vertices to one place: the edge between them would be taken for one all around.
    fn free_short_chains(&mut self, chains: &Chains) {
        for chain in &chains.edges {
            let (first, last) = (chain.first(), chain.last());
            if first != last && (self.positions[first] - self.positions[last]).norm() < SHORTEST_MM {
                [first, last].into_iter().for_each(|end| self.loosen_around(end));
            }
        }
    }

    fn edge(&mut self, chain: &Chain) -> Option<Edge> {
        let found = match chain.regions.map(|region| (region < self.exact, self.is_curved(region))) {
            [(true, _), (true, _)] => edge(&self.positions, chain, &self.regions, &self.positions).ok(),
            [(_, false), (_, false)] => Some(Edge { from: chain.first(), to: chain.last(), curve: Curve::Line }),
            [(_, first_is_curved), _] => self.arc(chain, chain.regions[usize::from(!first_is_curved)]),
        };
        if found.is_none() {
            let along: Vec<usize> = chain.corners.windows(2).flat_map(|pair| self.beside(pair[0], pair[1])).collect();
            self.loose.extend(along.into_iter().filter(|facet| self.is_exact(*facet)).collect::<Vec<_>>());
        }
        found
    }

    /// The two facets beside the side between two vertices.
    fn beside(&self, from: usize, to: usize) -> Vec<usize> {
        self.around[from].iter().copied().filter(|facet| self.around[to].contains(facet)).collect()
    }

    /// The arc of a round surface beside a free facet: where the facet's plane cuts it.
    fn arc(&self, chain: &Chain, region: usize) -> Option<Edge> {
        let (from, to) = (chain.first(), chain.last());
        let (a, b) = (self.positions[from], self.positions[to]);
        let round = &self.regions.surfaces[region].0;
        let is_on = |share: f64| round.distance_mm(&(a + (b - a) * share)).abs() < 0.5 * MEETS_MM;
        if [0.25, 0.5, 0.75].into_iter().all(is_on) {
            return Some(Edge { from, to, curve: Curve::Line });
        }
        let free = self.beside(from, to).into_iter().find(|facet| !self.is_exact(*facet))?;
        let third = self.facets[free].corners.iter().map(|p| beside_mm(p, &a, &b)).fold(0.0, f64::max);
        // A merged face's plane passes its vertices within the flatness only; this one passes through both.
        let along = Unit::try_new(b - a, 0.0)?;
        let normal = self.regions.surfaces[self.regions.of[free]].0.normal_at(&a);
        let normal = Unit::try_new(normal - along.into_inner() * along.dot(&normal), 0.5)?;
        let curve = Curve::between(&Surface::Plane { point: a, normal }, round, &[a, b])?;
        let points = curve.points(&a, &b, 24);
        let holds = points.iter().all(|p| {
            let bulge = beside_mm(p, &a, &b);
            round.distance_mm(p).abs() < MEETS_MM && bulge < BULGE_MM && bulge < BULGE_SHARE * third
        });
        let arrives = (points[points.len() - 1] - b).norm() < MEETS_MM;
        (holds && arrives).then_some(Edge { from, to, curve })
    }

    /// Frees the facets of faces that are not what their facets are; takes merged faces apart that are torn.
    fn judge(&mut self, boundary: &Boundary) {
        let mut facets_of: Vec<Vec<usize>> = vec![Vec::new(); boundary.faces.len()];
        for (facet, region) in self.regions.of.iter().enumerate() {
            facets_of[*region].push(facet);
        }
        for (at, face) in boundary.faces.iter().enumerate() {
            let facets = &facets_of[at];
            let mesh_mm2 = facets.iter().map(|facet| self.facets[*facet].area_mm2).sum();
            if face.is_exact {
                if !boundary.is_that_of_facets(face, mesh_mm2) {
                    self.loose.extend(facets);
                }
                let meets: Vec<usize> = boundary.meets_itself_in(face).into_iter().flat_map(|vertex| self.around[vertex].clone()).collect();
                self.loose.extend(meets.into_iter().filter(|facet| self.regions.of[*facet] == at));
            } else if facets.len() > 1 {
                if boundary.is_torn(face) {
                    self.apart.extend(facets);
                }
            } else if boundary.crosses_itself(face) {
                let neighbours = (3 * facets[0]..3 * facets[0] + 3).map(|h| self.half_edges.twin(h) / 3);
                let exact: Vec<usize> = neighbours.filter(|facet| self.is_exact(*facet)).collect();
                self.loose.extend(exact);
            }
        }
    }
}
