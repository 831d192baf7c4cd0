//! Borders between two regions, from corner to corner, and the loops that they form around each region.

use std::collections::BTreeMap;

use nalgebra::Point3;

use super::curve::beside_mm;
use super::regions::Regions;
use super::surface::Surface;
use super::topology::{FLATNESS_MM, Face, Side};
use crate::solid::half_edges::HalfEdges;

/// A border of two regions: corners of the mesh in a row. The first region lies on its left.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub(super) corners: Vec<usize>,
    /// Region on the left, region on the right.
    pub(super) regions: [usize; 2],
}

impl Chain {
    pub(super) fn first(&self) -> usize {
        self.corners[0]
    }

    pub(super) fn last(&self) -> usize {
        self.corners[self.corners.len() - 1]
    }
}

/// All borders, and each region's loops of them.
pub(super) struct Chains {
    pub(super) edges: Vec<Chain>,
    /// Region and its loop.
    pub(super) loops: Vec<(usize, Vec<Side>)>,
}

impl Chains {
    /// The borders of regions; they end where more than two regions meet, and in the corners that are asked for.
    pub(super) fn between(half_edges: &HalfEdges, region: &[usize], ends: &[bool]) -> Self {
        let mut degree = vec![0_u32; ends.len()];
        let borders: Vec<usize> = (0..half_edges.count()).filter(|h| half_edges.is_border(*h, region)).collect();
        for h in &borders {
            degree[half_edges.start(*h)] += 1;
        }
        let mut chains = Self { edges: Vec::new(), loops: Vec::new() };
        let mut known: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        let mut seen = vec![false; half_edges.count()];
        for begin in borders {
            if seen[begin] {
                continue;
            }
            let mut ring = vec![begin];
            seen[begin] = true;
            let mut next = half_edges.next_border(begin, region);
            while next != begin {
                seen[next] = true;
                ring.push(next);
                next = half_edges.next_border(next, region);
            }
            let is_corner = |h: usize| degree[half_edges.start(h)] != 2 || ends[half_edges.start(h)];
            // Without a corner the loop begins at its lowest vertex, so that the other side begins there too.
            let first = match ring.iter().position(|h| is_corner(*h)) {
                Some(first) => first,
                None => (0..ring.len()).min_by_key(|at| half_edges.start(ring[*at])).unwrap_or(0),
            };
            ring.rotate_left(first);
            let runs = ring.chunk_by(|_, next| !is_corner(*next));
            let sides = runs.map(|run| chains.side(run, half_edges, region, &mut known)).collect();
            chains.loops.push((region[begin / 3], sides));
        }
        chains
    }

    /// A run along a region as a side of an edge; the edge is made when its other side has not been met.
    fn side(&mut self, run: &[usize], half_edges: &HalfEdges, region: &[usize], known: &mut BTreeMap<[usize; 2], usize>) -> Side {
        let mut corners: Vec<usize> = run.iter().map(|h| half_edges.start(*h)).collect();
        corners.push(half_edges.end(run[run.len() - 1]));
        let segment = |pair: &[usize]| [pair[0].min(pair[1]), pair[0].max(pair[1])];
        let key = corners.windows(2).map(segment).min().unwrap_or_default();
        if let Some(edge) = known.get(&key) {
            return Side { edge: *edge, forward: false };
        }
        known.insert(key, self.edges.len());
        let regions = [region[run[0] / 3], region[half_edges.twin(run[0]) / 3]];
        self.edges.push(Chain { corners, regions });
        Side { edge: self.edges.len() - 1, forward: true }
    }

    /// The same with some chains cut where they bend, and straight in between.
    pub(super) fn straightened(self, positions: &[Point3<f64>], is_straight: impl Fn(&Chain) -> bool) -> Self {
        let mut straight = Self { edges: Vec::new(), loops: Vec::new() };
        let mut pieces: Vec<std::ops::Range<usize>> = Vec::new();
        for chain in &self.edges {
            let begin = straight.edges.len();
            if !is_straight(chain) {
                straight.edges.push(chain.clone());
                pieces.push(begin..begin + 1);
                continue;
            }
            let points: Vec<Point3<f64>> = chain.corners.iter().map(|corner| positions[*corner]).collect();
            let mut kept = vec![0];
            keep_bends(&points, 0, points.len() - 1, &mut kept);
            let ends = kept.windows(2).map(|pair| vec![chain.corners[pair[0]], chain.corners[pair[1]]]);
            straight.edges.extend(ends.map(|corners| Chain { corners, regions: chain.regions }));
            pieces.push(begin..straight.edges.len());
        }
        for (region, sides) in self.loops {
            let cut = |side: Side| -> Vec<Side> {
                let edges = pieces[side.edge].clone().map(|edge| Side { edge, forward: side.forward });
                if side.forward { edges.collect() } else { edges.rev().collect() }
            };
            straight.loops.push((region, sides.into_iter().flat_map(cut).collect()));
        }
        straight
    }

    /// The same without chains whose ends have come to one place: their ends are one vertex, in which the faces beside them meet.
    pub(super) fn collapsed(self, positions: &[Point3<f64>], shortest_mm: f64) -> Self {
        let is_short =
            |chain: &Chain| chain.first() != chain.last() && (positions[chain.first()] - positions[chain.last()]).norm() < shortest_mm;
        let mut same: Vec<usize> = (0..positions.len()).collect();
        for chain in self.edges.iter().filter(|chain| is_short(chain)) {
            let [low, high] = [chain.first(), chain.last()].map(|end| same[end]);
            same.iter_mut().filter(|vertex| **vertex == high).for_each(|vertex| *vertex = low);
        }
        let mut index = vec![usize::MAX; self.edges.len()];
        let mut edges = Vec::new();
        for (at, mut chain) in self.edges.into_iter().enumerate() {
            if is_short(&chain) {
                continue;
            }
            index[at] = edges.len();
            let last = chain.corners.len() - 1;
            (chain.corners[0], chain.corners[last]) = (same[chain.corners[0]], same[chain.corners[last]]);
            edges.push(chain);
        }
        let left = |side: Side| (index[side.edge] != usize::MAX).then(|| Side { edge: index[side.edge], ..side });
        let loops = self.loops.into_iter().map(|(region, sides)| (region, sides.into_iter().filter_map(left).collect::<Vec<Side>>()));
        Self { edges, loops: loops.filter(|(_, sides)| !sides.is_empty()).collect() }
    }

    /// Each region as a face; the first so many lie on surfaces of the features.
    pub(super) fn faces(&self, regions: &Regions, exact: usize) -> Vec<Face> {
        let face = |(at, (surface, outward)): (usize, &(Surface, bool))| Face {
            surface: surface.clone(),
            outward: *outward,
            loops: Vec::new(),
            is_exact: at < exact,
        };
        let mut faces: Vec<Face> = regions.surfaces.iter().enumerate().map(face).collect();
        for (region, sides) in &self.loops {
            faces[*region].loops.push(sides.clone());
        }
        faces
    }
}

/// Keeps what lies beside the straight line between two points of a chain, and the last point (Douglas and Peucker).
fn keep_bends(points: &[Point3<f64>], first: usize, last: usize, kept: &mut Vec<usize>) {
    let beside = |p: &Point3<f64>| beside_mm(p, &points[first], &points[last]);
    let farthest = (first + 1..last).max_by(|i, j| beside(&points[*i]).total_cmp(&beside(&points[*j])));
    match farthest.filter(|at| beside(&points[*at]) > 0.5 * FLATNESS_MM) {
        Some(at) => {
            keep_bends(points, first, at, kept);
            keep_bends(points, at, last, kept);
        }
        None => kept.push(last),
    }
}
