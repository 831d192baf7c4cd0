//! Whether facets of a written mesh meet elsewhere than in what they share, told exactly.
//!
//! Corners lie on the grid of [`GRID_PER_MM`], so that planes, sides and cuts are whole numbers. What is told apart here is apart; of
//! what is not (facets that touch in a point that is no corner of both, corners off the grid) the mesh kernel has the say.

use super::mesh::{GRID_PER_MM, Mesh};

/// A corner in parts of the grid.
type Corner = [i64; 3];

/// Largest coordinate in parts of the grid, 1 m: with it no product below leaves 128 bits.
const FARTHEST: f32 = 67_108_864.0;

/// Facets in a leaf.
const LEAF: usize = 4;

/// Whether it is certain that no two facets meet elsewhere than in corners and edges that they share.
pub(super) fn surely_apart(mesh: &Mesh) -> bool {
    let Some(corners) = mesh.vertices.iter().map(on_grid).collect::<Option<Vec<Corner>>>() else { return false };
    let facets: Vec<Facet> = mesh.triangles.iter().map(|triangle| Facet::of(&corners, *triangle)).collect();
    let tree = Tree::of(&facets);
    tree.all_pairs(&|a, b| apart(&facets[a], &facets[b]))
}

fn on_grid(corner: &[f32; 3]) -> Option<Corner> {
    let parts = corner.map(|mm| mm * GRID_PER_MM as f32);
    parts.iter().all(|part| part.abs() < FARTHEST && part.fract() == 0.0).then(|| parts.map(|part| part as i64))
}

/// A facet: numbers of its corners, and where they are.
struct Facet {
    corners: [u32; 3],
    at: [Corner; 3],
    /// Twice its area, along its normal.
    normal: Corner,
}

impl Facet {
    fn of(all: &[Corner], corners: [u32; 3]) -> Self {
        let at = corners.map(|corner| all[corner as usize]);
        Self { corners, at, normal: cross(&less(&at[1], &at[0]), &less(&at[2], &at[0])) }
    }

    /// Twice its area times the height of a point above its plane.
    fn height(&self, point: &Corner) -> i128 {
        let ([x, y, z], [way_x, way_y, way_z]) = (self.normal, less(point, &self.at[0]));
        let product = |normal: i64, way: i64| i128::from(normal) * i128::from(way);
        product(x, way_x) + product(y, way_y) + product(z, way_z)
    }

    /// The axis along which its plane is looked at from the front.
    fn facing(&self) -> usize {
        (0..3).max_by_key(|axis| self.normal[*axis].abs()).unwrap_or(0)
    }
}

fn less(a: &Corner, b: &Corner) -> Corner {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: &Corner, b: &Corner) -> Corner {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Whether all are above a plane, or all below; none in it.
fn one_sided(heights: &[i128]) -> bool {
    heights.iter().all(|height| *height > 0) || heights.iter().all(|height| *height < 0)
}

/// Whether two facets certainly meet in no more than what they share.
fn apart(a: &Facet, b: &Facet) -> bool {
    let shared = a.corners.map(|corner| b.corners.contains(&corner));
    match shared.iter().filter(|is| **is).count() {
        0 => strangers_apart(a, b),
        1 => fan_apart(a, b),
        2 => hinge_apart(a, b),
        _ => false,
    }
}

/// The corners of a facet that another has not.
fn own<'a>(of: &'a Facet, other: &Facet) -> impl Iterator<Item = &'a Corner> {
    let theirs = other.corners;
    (0..3).filter(move |i| !theirs.contains(&of.corners[*i])).map(|i| &of.at[i])
}

/// On which side of the line from one point to another a third lies, seen along an axis.
fn side(from: &Corner, to: &Corner, point: &Corner, along: usize) -> i64 {
    let (u, v) = ((along + 1) % 3, (along + 2) % 3);
    let (way, off) = (less(to, from), less(point, from));
    (way[u] * off[v] - way[v] * off[u]).signum()
}

/// Two facets with an edge in common: not folded onto each other.
fn hinge_apart(a: &Facet, b: &Facet) -> bool {
    let (Some(mine), Some(its)) = (own(a, b).next(), own(b, a).next()) else { return false };
    if a.height(its) != 0 {
        return true;
    }
    let edge: Vec<&Corner> = (0..3).filter(|i| b.corners.contains(&a.corners[*i])).map(|i| &a.at[i]).collect();
    let facing = a.facing();
    side(edge[0], edge[1], mine, facing) * side(edge[0], edge[1], its, facing) < 0
}

/// Two facets with a corner in common.
fn fan_apart(a: &Facet, b: &Facet) -> bool {
    let (mut mine, mut its) = (own(a, b), own(b, a));
    let (Some(a1), Some(a2), Some(b1), Some(b2)) = (mine.next(), mine.next(), its.next(), its.next()) else { return false };
    let of_b = [a.height(b1), a.height(b2)];
    if one_sided(&of_b) {
        return true;
    }
    let of_a = [b.height(a1), b.height(a2)];
    if one_sided(&of_a) {
        return true;
    }
    let Some(tip) = (0..3).find(|i| b.corners.contains(&a.corners[*i])).map(|i| &a.at[i]) else { return false };
    if of_a == [0; 2] && of_b == [0; 2] {
        let facing = a.facing();
        let separates = |edge: &Corner, third: &Corner, others: [&Corner; 2]| {
            let inside = side(tip, edge, third, facing);
            inside != 0 && others.iter().all(|other| side(tip, edge, other, facing) == -inside)
        };
        return separates(a1, a2, [b1, b2]) || separates(a2, a1, [b1, b2]) || separates(b1, b2, [a1, a2]) || separates(b2, b1, [a1, a2]);
    }
    // Each reaches along the line in which the planes meet to one side of the tip: apart where these are two sides.
    let reach = |[p, q]: [&Corner; 2], heights: [i128; 2]| {
        let (p, q) = (less(p, tip), less(q, tip));
        [0, 1, 2].map(|axis| i128::from(p[axis]) * heights[1].abs() + i128::from(q[axis]) * heights[0].abs())
    };
    let (along_a, along_b) = (reach([a1, a2], of_a), reach([b1, b2], of_b));
    (0..3).any(|axis| along_a[axis].signum() * along_b[axis].signum() < 0)
}

/// Two facets with nothing in common.
fn strangers_apart(a: &Facet, b: &Facet) -> bool {
    let of_b = [a.height(&b.at[0]), a.height(&b.at[1]), a.height(&b.at[2])];
    if one_sided(&of_b) {
        return true;
    }
    let of_a = [b.height(&a.at[0]), b.height(&a.at[1]), b.height(&a.at[2])];
    if one_sided(&of_a) {
        return true;
    }
    if of_a == [0; 3] && of_b == [0; 3] {
        let facing = a.facing();
        return beside(a, b, facing) || beside(b, a, facing);
    }
    separated(a, b)
}

/// Whether an edge of the first has all of the second, which lies in its plane, on its outer side.
fn beside(a: &Facet, b: &Facet, facing: usize) -> bool {
    (0..3).any(|i| {
        let [from, to, third] = [0, 1, 2].map(|k| &a.at[(i + k) % 3]);
        let inside = side(from, to, third, facing);
        inside != 0 && b.at.iter().all(|corner| side(from, to, corner, facing) == -inside)
    })
}

/// Share of a direction's length times the size of the facets by which rounding may be off, and much more.
const DOUBT: f64 = 1e-11;

/// Whether a gap shows between the two along one of the directions in which two triangles that are apart show one.
fn separated(a: &Facet, b: &Facet) -> bool {
    let real = |corner: &Corner| corner.map(|part| part as f64);
    let local = |of: &Facet| of.at.map(|corner| real(&less(&corner, &a.at[0])));
    let (mine, its) = (local(a), local(b));
    let edges = |of: &[[f64; 3]; 3]| [0, 1, 2].map(|i| [0, 1, 2].map(|axis| of[(i + 1) % 3][axis] - of[i][axis]));
    let cross = |a: &[f64; 3], b: &[f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let size = mine.iter().chain(&its).flatten().fold(0.0_f64, |most, part| most.max(part.abs()));
    let gap = |direction: [f64; 3]| {
        let places = |of: &[[f64; 3]; 3]| of.map(|p| direction[0] * p[0] + direction[1] * p[1] + direction[2] * p[2]);
        let ends = |p: [f64; 3]| [p[0].min(p[1]).min(p[2]), p[0].max(p[1]).max(p[2])];
        let ([low_a, high_a], [low_b, high_b]) = (ends(places(&mine)), ends(places(&its)));
        let length = direction.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
        (low_a - high_b).max(low_b - high_a) > DOUBT * length * size
    };
    let (of_a, of_b) = (edges(&mine), edges(&its));
    let normal = cross(&of_a[0], &of_a[1]);
    of_a.iter().chain(&of_b).any(|edge| gap(cross(&normal, edge))) || of_a.iter().any(|p| of_b.iter().any(|q| gap(cross(p, q))))
}

/// A box along the axes: its lowest corner and its highest, in parts of the grid.
#[derive(Clone, Copy)]
struct Bounds([i32; 3], [i32; 3]);

impl Bounds {
    const NOTHING: Self = Self([i32::MAX; 3], [i32::MIN; 3]);

    /// Around corners, which lie on the grid within [`FARTHEST`].
    fn of(corners: &[Corner; 3]) -> Self {
        corners.iter().map(|corner| corner.map(|part| part as i32)).fold(Self::NOTHING, |all, corner| all.with(&Self(corner, corner)))
    }

    fn with(&self, other: &Self) -> Self {
        let axes = [0, 1, 2];
        Self(axes.map(|axis| self.0[axis].min(other.0[axis])), axes.map(|axis| self.1[axis].max(other.1[axis])))
    }

    fn meets(&self, other: &Self) -> bool {
        // Without branches: which axis tells two boxes apart is anybody's guess.
        let along = |axis: usize| (self.0[axis] <= other.1[axis]) & (other.0[axis] <= self.1[axis]);
        along(0) & along(1) & along(2)
    }
}

/// Boxes around facets, each around two smaller ones.
struct Tree {
    nodes: Vec<Node>,
    /// The facets, those of a leaf side by side, and the box around each.
    order: Vec<(Bounds, u32)>,
}

struct Node {
    bounds: Bounds,
    /// Two smaller boxes; none in a leaf.
    below: Option<[usize; 2]>,
    /// Its facets in the order.
    range: [usize; 2],
}

impl Tree {
    fn of(facets: &[Facet]) -> Self {
        let order = facets.iter().enumerate().map(|(at, facet)| (Bounds::of(&facet.at), at as u32)).collect();
        let mut tree = Self { nodes: Vec::new(), order };
        tree.add([0, facets.len()]);
        tree
    }

    fn add(&mut self, range: [usize; 2]) -> usize {
        let facets = &mut self.order[range[0]..range[1]];
        let bounds = facets.iter().fold(Bounds::NOTHING, |all, (bounds, _)| all.with(bounds));
        let at = self.nodes.len();
        self.nodes.push(Node { bounds, below: None, range });
        if facets.len() > LEAF {
            let axis = (0..3).max_by_key(|axis| bounds.1[*axis] - bounds.0[*axis]).unwrap_or(0);
            let half = facets.len() / 2;
            facets.select_nth_unstable_by_key(half, |(bounds, _)| bounds.0[axis] + bounds.1[axis]);
            let middle = range[0] + half;
            self.nodes[at].below = Some([self.add([range[0], middle]), self.add([middle, range[1]])]);
        }
        at
    }

    /// Whether something holds of all pairs of facets whose boxes meet.
    fn all_pairs(&self, holds: &impl Fn(usize, usize) -> bool) -> bool {
        let mut open = vec![[0, 0]];
        while let Some([i, j]) = open.pop() {
            let (a, b) = (&self.nodes[i], &self.nodes[j]);
            match (a.below, b.below) {
                (Some([l, r]), _) if i == j => open.extend([[l, l], [r, r], [l, r]]),
                _ if !a.bounds.meets(&b.bounds) => {}
                (Some([l, r]), below) if below.is_none() || a.range[1] - a.range[0] >= b.range[1] - b.range[0] => {
                    open.extend([[l, j], [r, j]]);
                }
                (_, Some([l, r])) => open.extend([[i, l], [i, r]]),
                _ => {
                    for at in a.range[0]..a.range[1] {
                        let (bounds, facet) = &self.order[at];
                        let others = if i == j { at + 1 } else { b.range[0] }..b.range[1];
                        let near = self.order[others].iter().filter(|(other, _)| bounds.meets(other));
                        if !near.map(|(_, other)| *other).all(|other| holds(*facet as usize, other as usize)) {
                            return false;
                        }
                    }
                }
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::{Feature, MeshSolid};

    fn solids() -> [MeshSolid; 3] {
        let ring = Feature::cylinder(6.0, 4.0).minus([Feature::cylinder(4.0, 6.0).at(0.3, 0.0, -1.0)]);
        let tilted = Feature::cuboid([9.0, 5.0, 3.0]).minus([Feature::bore(1.1, 12.0).at(1.0, 0.4, -6.0)]);
        let turn = nalgebra::Vector3::new(0.3, 0.5, 1.0);
        [ring, Feature::sphere(3.0), tilted.turned(turn, crate::units::Angle::deg(23.0))].map(|feature| MeshSolid::build(&feature))
    }

    #[test]
    fn analytic_solids_without_fault_are_told_apart() {
        for solid in solids() {
            assert!(surely_apart(&solid.mesh()));
        }
    }

    #[test]
    fn planted_what_is_told_apart_does_not_cross_by_the_kernel() {
        let mut crossing = 0;
        for mesh in solids().map(|solid| solid.mesh()) {
            for (at, way) in (0..mesh.vertices.len()).step_by(3).zip([0.25_f32, -0.5, 1.5, -4.0, 8.0].into_iter().cycle()) {
                let mut moved = mesh.clone();
                let other = moved.vertices[(at * 7 + 5) % mesh.vertices.len()];
                for (part, towards) in moved.vertices[at].iter_mut().zip(other) {
                    *part += ((towards - *part) * way / 8.0 * 1024.0).round() / 1024.0;
                }
                let crosses = MeshSolid::from_mesh(&moved).is_none_or(|solid| solid.has_self_intersections());
                assert!(!(crosses && surely_apart(&moved)), "corner {at} moved by {way} eighths of the way to another");
                crossing += usize::from(crosses);
            }
        }
        assert!(crossing > 20, "{crossing}");
    }

    #[test]
    fn planted_facets_that_are_folded_onto_each_other_are_not_told_apart() {
        let folded = |corners: &[[f32; 3]], triangles: &[[u32; 3]]| Mesh { vertices: corners.to_vec(), triangles: triangles.to_vec() };
        let flat = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [3.0, 3.0, 0.0], [1.0, 1.0, 0.0]];
        assert!(surely_apart(&folded(&flat, &[[0, 1, 2], [3, 2, 1]])));
        assert!(!surely_apart(&folded(&flat, &[[0, 1, 2], [4, 2, 1]])));
        assert!(!surely_apart(&folded(&flat, &[[0, 1, 2], [0, 3, 1]])));
        let through = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [-2.0, -2.0, 0.5]];
        assert!(!surely_apart(&folded(&through, &[[0, 1, 2], [3, 4, 5]])));
        assert!(!surely_apart(&folded(&through, &[[0, 1, 2], [0, 3, 4]])));
        assert!(surely_apart(&folded(&through, &[[0, 1, 2], [0, 5, 4]])));
    }
}
