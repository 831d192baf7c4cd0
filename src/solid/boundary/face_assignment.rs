//! Which surface of the features each facet of a mesh stands for.

use super::known::Known;
use super::not_exact::NotExact;
use super::regions::Facet;
use crate::solid::half_edges::HalfEdges;

/// Facets lower than this have no direction that could be asked, mm.
const SLIVER_MM: f64 = 0.004;

/// Facets lower than this may be there only because arcs are cut into chords, mm.
const CHORD_MM: f64 = 0.06;

/// How far a sliver lies beside the surface that it is surely a piece of, mm.
const SURE_MM: f64 = 3e-5;

/// The surface of each facet, as an index of the known ones. Slivers go with a neighbour.
pub(super) fn of(facets: &[Facet], half_edges: &HalfEdges, known: &[Known]) -> Result<Vec<usize>, NotExact> {
    let assignment = where_found(facets, half_edges, known);
    astray(facets, &assignment, &|at| facets[at].height_mm >= SLIVER_MM)?;
    astray(facets, &assignment, &|_| true)?;
    Ok(assignment.into_iter().flatten().collect())
}

/// The surface of each facet, as an index of the known ones; none of those that lie on none.
pub(super) fn where_found(facets: &[Facet], half_edges: &HalfEdges, known: &[Known]) -> Vec<Option<usize>> {
    let best = |facet: &Facet| {
        let near = known.iter().enumerate().filter_map(|(at, known)| Some((at, known.beside_mm(facet)?)));
        // Where rounded edges touch, a facet may pass for one of each; its corners lie on the surface that it is of.
        let corners_mm = |at: usize| known[at].corners_beside_mm(facet);
        near.min_by(|a, b| a.1.total_cmp(&b.1).then_with(|| corners_mm(a.0).total_cmp(&corners_mm(b.0)))).map(|(at, _)| at)
    };
    let wide = |facet: &&Facet| facet.height_mm >= SLIVER_MM;
    let mut assignment: Vec<Option<usize>> = facets.iter().map(|facet| Some(facet).filter(wide).and_then(best)).collect();
    for within_mm in [SURE_MM, super::known::BESIDE_MM] {
        while let Some((at, surface)) = next_sliver(facets, half_edges, known, &assignment, within_mm) {
            assignment[at] = Some(surface);
        }
    }
    absorb(facets, half_edges, known, &mut assignment);
    assignment
}

fn astray(facets: &[Facet], assignment: &[Option<usize>], counts: &dyn Fn(usize) -> bool) -> Result<(), NotExact> {
    let lost: Vec<usize> = (0..facets.len()).filter(|at| assignment[*at].is_none() && counts(*at)).collect();
    match lost.first() {
        Some(first) => Err(NotExact::Surface { count: lost.len(), at: facets[*first].corners[0].into() }),
        None => Ok(()),
    }
}

/// The sliver with the longest side along a surface that it fits, and that surface: a sliver lies along its longest side.
fn next_sliver(
    facets: &[Facet],
    half_edges: &HalfEdges,
    known: &[Known],
    assignment: &[Option<usize>],
    within_mm: f64,
) -> Option<(usize, usize)> {
    let mut joined: Option<(f64, usize, usize)> = None;
    for at in (0..facets.len()).filter(|at| assignment[*at].is_none() && facets[*at].height_mm < SLIVER_MM) {
        for h in 3 * at..3 * at + 3 {
            let Some(surface) = assignment[half_edges.twin(h) / 3] else { continue };
            let corners = &facets[at].corners;
            let length = (corners[(h + 1) % 3] - corners[h % 3]).norm();
            let fits = corners.iter().all(|p| known[surface].is_near(p, within_mm));
            if fits && joined.is_none_or(|(longest, _, _)| length > longest) {
                joined = Some((length, at, surface));
            }
        }
    }
    joined.map(|(_, at, surface)| (at, surface))
}

/// A plane that shows itself only between a cylinder and its chords is part of the cylinder.
fn absorb(facets: &[Facet], half_edges: &HalfEdges, known: &[Known], assignment: &mut [Option<usize>]) {
    let mut seen = vec![false; facets.len()];
    for seed in 0..facets.len() {
        let Some(surface) = assignment[seed].filter(|surface| !seen[seed] && !known[*surface].is_cylinder()) else { continue };
        let (mut group, mut beside) = (vec![seed], Vec::new());
        seen[seed] = true;
        let mut at = 0;
        while at < group.len() {
            for h in 3 * group[at]..3 * group[at] + 3 {
                let neighbour = half_edges.twin(h) / 3;
                if assignment[neighbour] != Some(surface) {
                    beside.extend(assignment[neighbour]);
                } else if !seen[neighbour] {
                    seen[neighbour] = true;
                    group.push(neighbour);
                }
            }
            at += 1;
        }
        if group.iter().any(|facet| facets[*facet].height_mm > CHORD_MM) {
            continue;
        }
        beside.sort_unstable();
        beside.dedup();
        let corners = || group.iter().flat_map(|facet| &facets[*facet].corners);
        let holds = |surface: &&usize| known[**surface].is_cylinder() && corners().all(|p| known[**surface].is_near(p, SURE_MM));
        if let Some(cylinder) = beside.iter().find(holds) {
            for facet in group {
                assignment[facet] = Some(*cylinder);
            }
        }
    }
}
