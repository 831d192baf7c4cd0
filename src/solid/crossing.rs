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
    tree.all_pairs(&mut |a, b| facets[a].is_off(&facets[b]) || apart(&facets[a], &facets[b]))
}

fn on_grid(corner: &[f32; 3]) -> Option<Corner> {
    let parts = corner.map(|mm| mm * GRID_PER_MM as f32);
    parts.iter().all(|part| part.abs() < FARTHEST && part.fract() == 0.0).then(|| parts.map(|part| part as i64))
}

/// A facet: numbers of its corners, and where they are.
struct Facet {
    corners: [u32; 3],
    at: [Corner; 3],
    low: Corner,
    high: Corner,
    /// Twice its area, along its normal.
    normal: Corner,
}

impl Facet {
    fn of(all: &[Corner], corners: [u32; 3]) -> Self {
        let at = corners.map(|corner| all[corner as usize]);
        let ends = |pick: fn(i64, i64) -> i64| [0, 1, 2].map(|axis| pick(pick(at[0][axis], at[1][axis]), at[2][axis]));
        Self { corners, at, low: ends(i64::min), high: ends(i64::max), normal: cross(&less(&at[1], &at[0]), &less(&at[2], &at[0])) }
    }

    /// Whether the boxes around the two are apart.
    fn is_off(&self, other: &Self) -> bool {
        (0..3).any(|axis| self.low[axis] > other.high[axis] || other.low[axis] > self.high[axis])
    }

    /// Twice its area times the height of a point above its plane.
    fn height(&self, point: &Corner) -> i128 {
        let way = less(point, &self.at[0]);
        (0..3).map(|axis| i128::from(self.normal[axis]) * i128::from(way[axis])).sum()
    }

    fn heights<const N: usize>(&self, points: [&Corner; N]) -> [i128; N] {
        points.map(|point| self.height(point))
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
    let of_b = a.heights([b1, b2]);
    if one_sided(&of_b) {
        return true;
    }
    let of_a = b.heights([a1, a2]);
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
    let of_b = a.heights([&b.at[0], &b.at[1], &b.at[2]]);
    if one_sided(&of_b) {
        return true;
    }
    let of_a = b.heights([&a.at[0], &a.at[1], &a.at[2]]);
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

/// Boxes around facets, each around two smaller ones.
struct Tree {
    order: Vec<u32>,
    nodes: Vec<Node>,
}

struct Node {
    low: Corner,
    high: Corner,
    /// Two smaller boxes; none in a leaf.
    below: Option<[usize; 2]>,
    /// Its facets in the order.
    range: [usize; 2],
}

impl Tree {
    fn of(facets: &[Facet]) -> Self {
        let mut tree = Self { order: (0..facets.len() as u32).collect(), nodes: Vec::new() };
        tree.add(facets, [0, facets.len()]);
        tree
    }

    fn add(&mut self, facets: &[Facet], range: [usize; 2]) -> usize {
        let (mut low, mut high) = ([i64::MAX; 3], [i64::MIN; 3]);
        for facet in self.order[range[0]..range[1]].iter().map(|at| &facets[*at as usize]) {
            for axis in 0..3 {
                low[axis] = low[axis].min(facet.low[axis]);
                high[axis] = high[axis].max(facet.high[axis]);
            }
        }
        let at = self.nodes.len();
        self.nodes.push(Node { low, high, below: None, range });
        let count = range[1] - range[0];
        if count > LEAF {
            let axis = (0..3).max_by_key(|axis| high[*axis] - low[*axis]).unwrap_or(0);
            let middle = |at: &u32| facets[*at as usize].low[axis] + facets[*at as usize].high[axis];
            self.order[range[0]..range[1]].select_nth_unstable_by_key(count / 2, middle);
            let half = range[0] + count / 2;
            self.nodes[at].below = Some([self.add(facets, [range[0], half]), self.add(facets, [half, range[1]])]);
        }
        at
    }

    /// Whether something holds of all pairs of facets whose smallest boxes meet.
    fn all_pairs(&self, holds: &mut impl FnMut(usize, usize) -> bool) -> bool {
        let mut open = vec![[0, 0]];
        while let Some([i, j]) = open.pop() {
            let (a, b) = (&self.nodes[i], &self.nodes[j]);
            if i != j && (0..3).any(|axis| a.low[axis] > b.high[axis] || b.low[axis] > a.high[axis]) {
                continue;
            }
            match (a.below, b.below) {
                (Some([l, r]), Some(_)) if i == j => open.extend([[l, l], [r, r], [l, r]]),
                (Some([l, r]), its) if its.is_none() || a.range[1] - a.range[0] >= b.range[1] - b.range[0] => open.extend([[l, j], [r, j]]),
                (_, Some([l, r])) => open.extend([[i, l], [i, r]]),
                _ => {
                    let same = i == j;
                    for (k, p) in self.order[a.range[0]..a.range[1]].iter().enumerate() {
                        let from = if same { b.range[0] + k + 1 } else { b.range[0] };
                        if !self.order[from..b.range[1]].iter().all(|q| holds(*p as usize, *q as usize)) {
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
                for axis in 0..3 {
                    moved.vertices[at][axis] += ((other[axis] - moved.vertices[at][axis]) * way / 8.0 * 1024.0).round() / 1024.0;
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
