//! Neighbouring facets of one surface.

use nalgebra::Point3;

use super::known::Known;
use super::regions::{Facet, Regions};
use crate::solid::half_edges::HalfEdges;

/// Neighbouring facets of one surface as regions; facets without a surface get none.
pub(super) fn connected(facets: &[Facet], half_edges: &HalfEdges, assignment: &[Option<usize>], known: &[Known]) -> Regions {
    // Arcs of one cylinder that are cut differently are one surface.
    let first = |surface: usize| known.iter().position(|other| other.surface.is_same(&known[surface].surface)).unwrap_or(surface);
    let first: Vec<usize> = (0..known.len()).map(first).collect();
    let own = |facet: usize| assignment[facet].map(|surface| first[surface]);
    let mut regions = Regions::none(facets.len());
    for seed in 0..facets.len() {
        let Some(surface) = own(seed).filter(|_| regions.of[seed] == usize::MAX) else { continue };
        let id = regions.surfaces.len();
        let (own_of_seed, surface) = (Some(surface), &known[surface].surface);
        let (mut outwards, mut towards) = (0.0, nalgebra::Vector3::zeros());
        regions.of[seed] = id;
        let mut open = vec![seed];
        while let Some(at) = open.pop() {
            let middle = Point3::from(facets[at].corners.iter().map(|p| p.coords).sum::<nalgebra::Vector3<f64>>() / 3.0);
            outwards += facets[at].area_mm2 * facets[at].normal.dot(&surface.normal_at(&middle));
            towards += facets[at].normal * facets[at].area_mm2;
            for h in 3 * at..3 * at + 3 {
                let neighbour = half_edges.twin(h) / 3;
                if regions.of[neighbour] == usize::MAX && own(neighbour) == own_of_seed {
                    regions.of[neighbour] = id;
                    open.push(neighbour);
                }
            }
        }
        regions.surfaces.push((surface.with_poles_beside(&towards), outwards > 0.0));
    }
    regions
}
