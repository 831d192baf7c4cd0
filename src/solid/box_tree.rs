//! A tree of boxes around a solid's facets: how far apart two solids are at least, without their meshes.

use nalgebra::{Isometry3, Point3};

use super::mesh_solid::MeshSolid;
use super::oriented_box::{Between, OrientedBox};

/// Facets in a leaf.
const LEAF: usize = 4;

/// Boxes that are farther apart than this are not opened, mm.
const NEAR_MM: f64 = 3.0;

/// Distances are reported up to this, mm.
const LOOKED_AT_MM: f64 = 20.0;

/// Share of a distance that is reported at least.
const ROUGH: f64 = 0.7;

/// Boxes along the solid's axes, each around two smaller ones.
pub struct BoxTree {
    /// A box and its children; the first is around everything.
    nodes: Vec<(OrientedBox, Option<[usize; 2]>)>,
}

impl BoxTree {
    /// Around a solid's facets.
    pub fn of(solid: &MeshSolid) -> Self {
        let mesh = solid.mesh();
        let mut facets: Vec<[Point3<f64>; 3]> = mesh.triangles.iter().map(|t| mesh.corners(t)).collect();
        let mut tree = Self { nodes: Vec::new() };
        if !facets.is_empty() {
            tree.add(&mut facets);
        }
        tree
    }

    fn add(&mut self, facets: &mut [[Point3<f64>; 3]]) -> usize {
        let bounds = OrientedBox::around(facets.iter().flatten());
        let at = self.nodes.len();
        self.nodes.push((bounds, None));
        if facets.len() > LEAF {
            let axis = bounds.longest();
            let middle = |f: &[Point3<f64>; 3]| f.iter().map(|p| p[axis]).sum::<f64>();
            let half = facets.len() / 2;
            facets.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
            let (low, high) = facets.split_at_mut(half);
            let children = [self.add(low), self.add(high)];
            self.nodes[at].1 = Some(children);
        }
        at
    }

    /// The box around everything; none around nothing.
    pub fn bounds(&self) -> Option<&OrientedBox> {
        self.nodes.first().map(|(bounds, _)| bounds)
    }

    /// A distance that the surfaces of the two are at least apart, mm, the other in a pose relative to this one's axes; 0 when
    /// two of the smallest boxes meet. It is reported only as well as is needed to pass by: what is farther than 3 mm is not
    /// looked at closer, and of what is near the answer may be less than the distance by 30 %.
    pub fn apart_mm(&self, other: &Self, pose: &Isometry3<f64>) -> f64 {
        let between = Between::of(pose);
        let (Some(mine), Some(its)) = (self.bounds(), other.bounds()) else { return f64::INFINITY };
        let whole = mine.apart_by_edges_mm(its, &between);
        if whole > NEAR_MM {
            return whole;
        }
        let mut least = LOOKED_AT_MM;
        let mut open = vec![(0, 0, whole)];
        while let Some((i, j, bound)) = open.pop() {
            if bound >= ROUGH * least {
                continue;
            }
            let ((a, mine), (b, its)) = (&self.nodes[i], &other.nodes[j]);
            let first = mine.is_some() && (its.is_none() || a.size_mm() >= b.size_mm());
            let mut next = match (mine, its) {
                (None, None) => {
                    let apart = a.apart_by_edges_mm(b, &between);
                    if apart <= 0.0 {
                        return 0.0;
                    }
                    least = least.min(apart);
                    continue;
                }
                (Some(mine), _) if first => mine.map(|i| (i, j, self.nodes[i].0.apart_mm(b, &between))),
                (_, Some(its)) => its.map(|j| (i, j, a.apart_mm(&other.nodes[j].0, &between))),
                (Some(mine), None) => mine.map(|i| (i, j, self.nodes[i].0.apart_mm(b, &between))),
            };
            // The nearer pair is opened first.
            next.sort_by(|a, b| b.2.total_cmp(&a.2));
            open.extend(next);
        }
        ROUGH * least
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::Feature;

    #[test]
    fn analytic_a_ball_beside_a_plate() {
        let [plate, ball] = [Feature::cuboid([20.0, 20.0, 2.0]), Feature::sphere(3.0)].map(|f| MeshSolid::build(&f));
        let top_mm = plate.bounds_mm()[1][2];
        let [plate, ball] = [plate, ball].map(|solid| BoxTree::of(&solid));
        for gap_mm in [0.5, 2.0, 9.0] {
            let told_mm = plate.apart_mm(&ball, &Isometry3::translation(0.0, 0.0, top_mm + 3.0 + gap_mm));
            assert!(told_mm <= gap_mm && told_mm >= 0.6 * gap_mm, "{told_mm} of {gap_mm}");
        }
        assert_eq!(plate.apart_mm(&ball, &Isometry3::translation(0.0, 0.0, top_mm + 2.0)), 0.0);
    }
}
