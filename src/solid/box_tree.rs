//! A tree of boxes around a solid's facets: how far apart two solids are at least, without their meshes.

use nalgebra::{Isometry3, Point3, Vector3};

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
    /// The first is around everything.
    nodes: Vec<Node>,
}

struct Node {
    bounds: OrientedBox,
    /// Two smaller boxes.
    below: Option<[usize; 2]>,
}

impl BoxTree {
    /// Around facets.
    pub(super) fn of(mut facets: Vec<[Point3<f64>; 3]>) -> Self {
        let mut tree = Self { nodes: Vec::new() };
        if !facets.is_empty() {
            tree.add(&mut facets);
        }
        tree
    }

    fn add(&mut self, facets: &mut [[Point3<f64>; 3]]) -> usize {
        let bounds = OrientedBox::around(facets.iter().flatten());
        let at = self.nodes.len();
        self.nodes.push(Node { bounds, below: None });
        if facets.len() > LEAF {
            let axis = bounds.longest();
            let middle = |f: &[Point3<f64>; 3]| f.iter().map(|p| p[axis]).sum::<f64>();
            let half = facets.len() / 2;
            facets.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
            let (low, high) = facets.split_at_mut(half);
            self.nodes[at].below = Some([self.add(low), self.add(high)]);
        }
        at
    }

    /// The box around everything; none around nothing.
    pub fn bounds(&self) -> Option<&OrientedBox> {
        self.nodes.first().map(|node| &node.bounds)
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
            let (a, b) = (&self.nodes[i], &other.nodes[j]);
            let mut next = match opened(a, b) {
                None => {
                    let apart = a.bounds.apart_by_edges_mm(&b.bounds, &between);
                    if apart <= 0.0 {
                        return 0.0;
                    }
                    least = least.min(apart);
                    continue;
                }
                Some(Opened::First(boxes)) => boxes.map(|i| (i, j, self.nodes[i].bounds.apart_mm(&b.bounds, &between))),
                Some(Opened::Second(boxes)) => boxes.map(|j| (i, j, a.bounds.apart_mm(&other.nodes[j].bounds, &between))),
            };
            // The nearer pair is opened first.
            next.sort_by(|a, b| b.2.total_cmp(&a.2));
            open.extend(next);
        }
        ROUGH * least
    }

    /// At which places of a straight way smallest boxes of the two meet. At the place of a number the other is in the pose,
    /// relative to this one's axes, moved by that many steps, mm.
    pub fn meeting_places(&self, other: &Self, pose: &Isometry3<f64>, step: &Vector3<f64>, places: usize) -> Vec<bool> {
        let between = Between::of(pose);
        let mut meeting = vec![false; places];
        let mut open = if self.nodes.is_empty() || other.nodes.is_empty() { Vec::new() } else { vec![(0, 0)] };
        while let Some((i, j)) = open.pop() {
            let (a, b) = (&self.nodes[i], &other.nodes[j]);
            let Some([first, last]) = a.bounds.meeting(&b.bounds, &between, step, [0.0, places as f64 - 1.0]) else { continue };
            let found = first.ceil() as usize..last.floor() as usize + 1;
            if meeting[found.clone()].iter().all(|known| *known) {
                continue;
            }
            match opened(a, b) {
                None => meeting[found].fill(true),
                Some(Opened::First(boxes)) => open.extend(boxes.map(|i| (i, j))),
                Some(Opened::Second(boxes)) => open.extend(boxes.map(|j| (i, j))),
            }
        }
        meeting
    }
}

/// Which of two boxes is looked into.
enum Opened {
    First([usize; 2]),
    Second([usize; 2]),
}

/// The larger of two boxes that has smaller ones in it; none of two of the smallest.
fn opened(a: &Node, b: &Node) -> Option<Opened> {
    match (a.below, b.below) {
        (Some(_), Some(boxes)) if a.bounds.size_mm() < b.bounds.size_mm() => Some(Opened::Second(boxes)),
        (Some(boxes), _) => Some(Opened::First(boxes)),
        (None, Some(boxes)) => Some(Opened::Second(boxes)),
        (None, None) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::{Feature, MeshSolid};

    #[test]
    fn analytic_a_ball_beside_a_plate() {
        let [plate, ball] = [Feature::cuboid([20.0, 20.0, 2.0]), Feature::sphere(3.0)].map(|f| MeshSolid::build(&f));
        let top_mm = plate.bounds_mm()[1][2];
        let [plate, ball] = [plate.boxes(), ball.boxes()];
        for gap_mm in [0.5, 2.0, 9.0] {
            let told_mm = plate.apart_mm(ball, &Isometry3::translation(0.0, 0.0, top_mm + 3.0 + gap_mm));
            assert!(told_mm <= gap_mm && told_mm >= 0.6 * gap_mm, "{told_mm} of {gap_mm}");
        }
        assert_eq!(plate.apart_mm(ball, &Isometry3::translation(0.0, 0.0, top_mm + 2.0)), 0.0);
    }

    #[test]
    fn analytic_a_way_meets_where_the_places_one_by_one_do() {
        let link = Feature::cuboid([30.0, 8.0, 8.0]).minus([Feature::cylinder(3.0, 20.0).at(4.0, 0.0, -10.0)]);
        let [link, pin] = [link, Feature::cylinder(2.0, 12.0)].map(|feature| MeshSolid::build(&feature));
        let [link, pin] = [link.boxes(), pin.boxes()];
        for (deg, across_mm) in [(0.0, 0.0), (0.0, 2.0), (35.0, 0.5), (80.0, 1.0), (20.0, 30.0)] {
            let turned = Isometry3::rotation(Vector3::new(0.3, 1.0, 0.2).normalize() * f64::to_radians(deg));
            let pose = Isometry3::translation(4.0, across_mm, -40.0) * turned;
            let step = Vector3::new(0.05, 0.0, 1.0);
            let at = |k: usize| Isometry3::translation(step.x * k as f64, step.y * k as f64, step.z * k as f64) * pose;
            let one_by_one: Vec<bool> = (0..80).map(|k| link.apart_mm(pin, &at(k)) <= 0.0).collect();
            assert_eq!(link.meeting_places(pin, &pose, &step, 80), one_by_one, "{deg} {across_mm}");
        }
    }
}
