//! Facets in groups: what lies on one surface and hangs together.

use nalgebra::{Point3, Unit, Vector3};

use super::surface::Surface;
use super::topology::FLATNESS_MM;
use crate::solid::Mesh;
use crate::solid::half_edges::HalfEdges;

/// Facets lower than this have no direction worth asking, mm.
const SLIVER_MM: f64 = 2.0 * FLATNESS_MM;

/// Cosine up to which facets count as turned the same way.
const SAME_WAY: f64 = 0.99;

/// Facets by region.
pub(super) struct Regions {
    /// Region of each facet.
    pub(super) of: Vec<usize>,
    /// Surface of each region, and whether its normal points outwards.
    pub(super) surfaces: Vec<(Surface, bool)>,
}

impl Regions {
    /// No facet in any region yet.
    pub(super) fn none(facets: usize) -> Self {
        Self { of: vec![usize::MAX; facets], surfaces: Vec::new() }
    }

    /// The facets without a region in maximal groups of neighbours that lie on the plane of the highest of them; those that are alone
    /// (none where the list is empty) by themselves.
    pub(super) fn add_coplanar(&mut self, facets: &[Facet], half_edges: &HalfEdges, alone: &[bool]) {
        let is_alone = |at: usize| alone.get(at).is_some_and(|alone| *alone);
        let mut order: Vec<usize> = (0..facets.len()).filter(|at| self.of[*at] == usize::MAX).collect();
        order.sort_by(|a, b| facets[*b].height_mm.total_cmp(&facets[*a].height_mm).then(a.cmp(b)));
        for seed in order {
            if self.of[seed] != usize::MAX {
                continue;
            }
            let id = self.surfaces.len();
            let (point, normal) = (facets[seed].corners[0], facets[seed].normal);
            let flat = |facet: &Facet| {
                let near = facet.corners.iter().all(|p| normal.dot(&(p - point)).abs() <= FLATNESS_MM);
                near && (facet.height_mm < SLIVER_MM || facet.normal.dot(&normal) > SAME_WAY)
            };
            self.of[seed] = id;
            let mut open = if is_alone(seed) { Vec::new() } else { vec![seed] };
            while let Some(facet) = open.pop() {
                for h in 3 * facet..3 * facet + 3 {
                    let neighbour = half_edges.twin(h) / 3;
                    if self.of[neighbour] == usize::MAX && !is_alone(neighbour) && flat(&facets[neighbour]) {
                        self.of[neighbour] = id;
                        open.push(neighbour);
                    }
                }
            }
            self.surfaces.push((Surface::Plane { point, normal: Unit::new_normalize(normal) }, true));
        }
    }

    /// Takes regions apart into their facets; whether there was anything to take apart.
    pub(super) fn split(&mut self, mesh: &Mesh, torn: &[usize]) -> bool {
        let mut changed = false;
        let mut first = vec![true; self.surfaces.len()];
        for at in 0..self.of.len() {
            let region = self.of[at];
            if torn.binary_search(&region).is_err() {
                continue;
            }
            // The first facet keeps the region's number.
            let facet = Facet::new(mesh.corners(&mesh.triangles[at]));
            let surface = (Surface::Plane { point: facet.corners[0], normal: Unit::new_normalize(facet.normal) }, true);
            if std::mem::replace(&mut first[region], false) {
                self.surfaces[region] = surface;
            } else {
                self.of[at] = self.surfaces.len();
                self.surfaces.push(surface);
                changed = true;
            }
        }
        changed
    }
}

/// A facet in numbers.
pub(super) struct Facet {
    pub(super) corners: [Point3<f64>; 3],
    /// Unit normal; any when there is none.
    pub(super) normal: Vector3<f64>,
    /// Area, mm².
    pub(super) area_mm2: f64,
    /// Its smallest height, mm.
    pub(super) height_mm: f64,
}

impl Facet {
    pub(super) fn all(mesh: &Mesh) -> Vec<Self> {
        mesh.triangles.iter().map(|triangle| Self::new(mesh.corners(triangle))).collect()
    }

    pub(super) fn new(corners: [Point3<f64>; 3]) -> Self {
        let [a, b, c] = corners;
        let twice = (b - a).cross(&(c - a));
        let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
        let normal = twice.try_normalize(0.0).unwrap_or_else(Vector3::z);
        Self { corners, normal, area_mm2: 0.5 * twice.norm(), height_mm: twice.norm() / longest.max(f64::MIN_POSITIVE) }
    }
}
