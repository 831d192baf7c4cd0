//! Faces that are too small to be faces.

use std::collections::BTreeMap;

use super::connected::connected;
use super::known::Known;
use super::regions::Facet;
use crate::solid::half_edges::HalfEdges;

/// Least area of a face, mm². Smaller ones are what chords leave between surfaces that nearly meet: of the top corner two faces of 0.006 mm²
/// beside its notch, with which OCCT reads no valid solid.
pub(super) const LEAST_FACE_MM2: f64 = 0.02;

/// How far the corners of a small face may lie beside the surface that takes it over, mm: twice what surfaces of the parts sink into each other.
const BESIDE_MM: f64 = 0.02;

/// Rounds: what is taken over may border on other small faces.
const ROUNDS: usize = 8;

/// Gives facets of faces below the least area to the surface beside them along which they are longest. Where surfaces sink a little into each
/// other, the mesh has steps that a CAD user would not want to see, and with which OCCT read no valid solid. What becomes of it is looked at as
/// any face is: corners and edges are computed anew, and area and volume have to be those of the mesh.
pub(super) fn absorb_small_faces(facets: &[Facet], half_edges: &HalfEdges, assignment: &mut [Option<usize>], known: &[Known]) {
    for _ in 0..ROUNDS {
        let found: Vec<(Vec<usize>, usize)> = small_faces(facets, half_edges, assignment, known)
            .into_iter()
            .filter_map(|members| {
                let surface = beside_longest(facets, half_edges, assignment, known, &members)?;
                Some((members, surface))
            })
            .collect();
        if found.is_empty() {
            return;
        }
        for (members, surface) in found {
            members.iter().for_each(|at| assignment[*at] = Some(surface));
        }
    }
}

/// The facets of each face below the least area.
fn small_faces(facets: &[Facet], half_edges: &HalfEdges, assignment: &[Option<usize>], known: &[Known]) -> Vec<Vec<usize>> {
    let regions = connected(facets, half_edges, assignment, known);
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); regions.surfaces.len()];
    for (at, region) in regions.of.iter().enumerate().filter(|(_, region)| **region != usize::MAX) {
        members[*region].push(at);
    }
    let area_mm2 = |members: &[usize]| members.iter().map(|at| facets[*at].area_mm2).sum::<f64>();
    members.retain(|members| area_mm2(members) < LEAST_FACE_MM2);
    members
}

/// The other surface along which facets have the longest border, of those that they lie beside.
fn beside_longest(
    facets: &[Facet],
    half_edges: &HalfEdges,
    assignment: &[Option<usize>],
    known: &[Known],
    members: &[usize],
) -> Option<usize> {
    let mut borders: BTreeMap<usize, f64> = BTreeMap::new();
    for h in members.iter().flat_map(|at| 3 * at..3 * at + 3) {
        let Some(surface) = assignment[half_edges.twin(h) / 3].filter(|_| !members.contains(&(half_edges.twin(h) / 3))) else { continue };
        let corners = &facets[h / 3].corners;
        *borders.entry(surface).or_default() += (corners[(h + 1) % 3] - corners[h % 3]).norm();
    }
    let fits = |surface: usize| members.iter().all(|at| facets[*at].corners.iter().all(|p| known[surface].is_near(p, BESIDE_MM)));
    borders.into_iter().filter(|(surface, _)| fits(*surface)).max_by(|a, b| a.1.total_cmp(&b.1)).map(|(surface, _)| surface)
}
