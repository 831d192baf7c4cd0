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
        let start: Vec<u32> = mesh.triangles.iter().flatten().copied().collect();
        let count = start.len();
        let end = |h: usize| start[next_in_facet(h)];
        let mut sorted: Vec<(u32, u32, usize)> = (0..count).map(|h| (start[h], end(h), h)).collect();
        sorted.sort_unstable();
        if sorted.windows(2).any(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1)) {
            return None;
        }
        let find = |from: u32, to: u32| {
            let at = sorted.partition_point(|(a, b, _)| (*a, *b) < (from, to));
            sorted.get(at).filter(|(a, b, _)| (*a, *b) == (from, to)).map(|(_, _, h)| *h)
        };
        let twin = (0..count).map(|h| find(end(h), start[h])).collect::<Option<Vec<_>>>()?;
        Some(Self { start, twin })
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

fn next_in_facet(h: usize) -> usize {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}
