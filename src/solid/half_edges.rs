//! The mesh as half edges: who lies on the other side, what comes next around a corner.

use crate::solid::Mesh;

/// Half edge `3 t + k` runs from corner k of triangle t to the next.
pub(super) struct HalfEdges {
    start: Vec<u32>,
    twin: Vec<usize>,
}

impl HalfEdges {
    /// `None` when some edge is not shared by two facets in opposite directions.
    pub(super) fn new(mesh: &Mesh) -> Option<Self> {
        Some(Self { start: mesh.triangles.iter().flatten().copied().collect(), twin: twins(&mesh.triangles)? })
    }

    /// How many.
    pub(super) fn count(&self) -> usize {
        self.start.len()
    }

    /// The corner it begins at.
    pub(super) fn start(&self, h: usize) -> usize {
        self.start[h] as usize
    }

    /// The corner it ends at.
    pub(super) fn end(&self, h: usize) -> usize {
        self.start[next_in_facet(h)] as usize
    }

    /// The one of the neighbouring facet, running back.
    pub(super) fn twin(&self, h: usize) -> usize {
        self.twin[h]
    }

    /// Whether the facets on both sides belong to different regions.
    pub(super) fn is_border(&self, h: usize, region: &[usize]) -> bool {
        region[h / 3] != region[self.twin[h] / 3]
    }

    /// The border of the same region that follows a border; where a region meets itself in a corner, the one of its own fan.
    pub(super) fn next_border(&self, h: usize, region: &[usize]) -> usize {
        let mut next = next_in_facet(h);
        while !self.is_border(next, region) {
            next = next_in_facet(self.twin[next]);
        }
        next
    }
}

/// Of each half edge the one that runs the other way; `None` where one has none, or several.
pub(super) fn twins(triangles: &[[u32; 3]]) -> Option<Vec<usize>> {
    let ends = |h: usize| (triangles[h / 3][h % 3], triangles[h / 3][(h + 1) % 3]);
    let mut sorted: Vec<(u32, u32, usize)> = (0..3 * triangles.len()).map(|h| (ends(h).0, ends(h).1, h)).collect();
    sorted.sort_unstable();
    if sorted.windows(2).any(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1)) {
        return None;
    }
    let twin = |h: usize| {
        let (from, to) = ends(h);
        sorted.binary_search_by_key(&(to, from), |(a, b, _)| (*a, *b)).ok().map(|at| sorted[at].2)
    };
    (0..3 * triangles.len()).map(twin).collect()
}

/// The half edge that follows in the same facet.
pub(super) fn next_in_facet(h: usize) -> usize {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

/// The half edge before it in the same facet.
pub(super) fn before_in_facet(h: usize) -> usize {
    next_in_facet(next_in_facet(h))
}
