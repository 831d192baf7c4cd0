//! The length of a rod that something can reach.

use crate::solid::{Feature, MeshSolid};

/// Kept of the rod beyond what can be reached, mm: an end of the piece is then no end of the rod that something could touch.
const BEYOND_MM: f64 = 0.5;

/// The piece of a rod between two heights along its axis, in the rod's axes and without a tube's bore, into which nothing goes; `None` where the rod
/// does not reach there. A rod has long facets, and its piece few that lie far from the other body.
pub fn piece_between(rod: &MeshSolid, [low_mm, high_mm]: [f64; 2]) -> Option<MeshSolid> {
    let [_, [radius, _, length]] = rod.bounds_mm();
    let (from, to) = ((low_mm - BEYOND_MM).max(0.0), (high_mm + BEYOND_MM).min(length));
    (from < to).then(|| MeshSolid::build(&Feature::cylinder(radius, to - from).at(0.0, 0.0, from)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_piece_ends_where_the_rod_does_or_half_a_millimetre_beyond_what_reaches() {
        let rod = MeshSolid::build(&Feature::cylinder(1.5, 80.0));
        let ends = |heights: [f64; 2]| piece_between(&rod, heights).map(|piece| piece.bounds_mm().map(|corner| corner[2]));
        assert_eq!(ends([10.0, 20.0]), Some([9.5, 20.5]));
        assert_eq!(ends([-5.0, 200.0]), Some([0.0, 80.0]));
        assert_eq!(ends([90.0, 95.0]), None);
    }
}
