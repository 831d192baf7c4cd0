//! Facets in a common plane drawn stouter: where the other diagonal of two of them makes a less slender pair, it takes the place of
//! the edge between them. The surface stays the same.
//!
//! C. L. Lawson, Software for C1 surface interpolation, in: Mathematical Software III, 1977: an edge at a time is exchanged until no
//! exchange makes anything better.

use nalgebra::{Point3, Vector3};

use super::half_edges::{before_in_facet, next_in_facet, twins};

/// Corners that far beside a plane lie in it, mm; far below the grid of what is written.
const FLAT_MM: f64 = 1e-7;

/// Slenderness has to fall by this share, so that rounding does not exchange the same two edges for ever.
const BETTER: f64 = 1.0 - 1e-6;

/// Exchanges edges between facets of a closed surface, whose corners are in mm, as long as the more slender one of two becomes stouter.
/// The order depends on that of the facets alone. What is not closed stays as it is.
pub(super) fn drawn(corners: &[[f64; 3]], triangles: &mut [[u32; 3]]) {
    let Some(twins) = twins(triangles) else { return };
    let mut surface = Surface { corners, triangles, twins };
    let mut left: Vec<usize> = (0..surface.twins.len()).filter(|edge| *edge < surface.twins[*edge]).collect();
    while let Some(edge) = left.pop() {
        if surface.is_better_exchanged(edge) {
            left.extend(surface.exchange(edge));
        }
    }
}

/// Triangles and, for each of their edges, that of the neighbour which runs the other way. Edge `3 t + k` begins at corner k of triangle t.
struct Surface<'a> {
    corners: &'a [[f64; 3]],
    triangles: &'a mut [[u32; 3]],
    twins: Vec<usize>,
}

impl Surface<'_> {
    fn start(&self, edge: usize) -> u32 {
        self.triangles[edge / 3][edge % 3]
    }

    fn at(&self, corner: u32) -> Point3<f64> {
        self.corners[corner as usize].into()
    }

    /// Of the two facets at an edge the ends of the edge, and the corners across it: of its own facet, and of the other.
    fn quad(&self, edge: usize) -> [u32; 4] {
        let twin = self.twins[edge];
        [self.start(edge), self.start(twin), self.start(before_in_facet(edge)), self.start(before_in_facet(twin))]
    }

    fn is_better_exchanged(&self, edge: usize) -> bool {
        let [from, to, own, other] = self.quad(edge);
        let [a, b, c, d] = [from, to, own, other].map(|corner| self.at(corner));
        let across = (b - a).cross(&(c - a));
        let normal = across / across.norm();
        let new = [[c, a, d], [d, b, c]];
        (d - a).dot(&normal).abs() < FLAT_MM
            && new.iter().all(|facet| area_vector(facet).dot(&normal) > 0.0)
            && new.iter().map(slenderness).fold(0.0, f64::max) < BETTER * slenderness(&[a, b, c]).max(slenderness(&[b, a, d]))
            && !self.are_joined(before_in_facet(edge), other)
    }

    /// Whether an edge joins the start of an edge to a corner.
    fn are_joined(&self, first: usize, corner: u32) -> bool {
        let mut edge = first;
        loop {
            if self.start(next_in_facet(edge)) == corner {
                return true;
            }
            edge = self.twins[before_in_facet(edge)];
            if edge == first {
                return false;
            }
        }
    }

    /// Puts the other diagonal in the place of an edge: the four edges around both facets.
    fn exchange(&mut self, edge: usize) -> [usize; 4] {
        let twin = self.twins[edge];
        let [from, to, own, other] = self.quad(edge);
        let around = [before_in_facet(edge), next_in_facet(twin), before_in_facet(twin), next_in_facet(edge)].map(|side| self.twins[side]);
        let (t, u) = (edge / 3, twin / 3);
        self.triangles[t] = [own, from, other];
        self.triangles[u] = [other, to, own];
        let sides = [3 * t, 3 * t + 1, 3 * u, 3 * u + 1];
        for (side, beyond) in sides.into_iter().zip(around).chain([(3 * t + 2, 3 * u + 2)]) {
            self.twins[side] = beyond;
            self.twins[beyond] = side;
        }
        sides
    }
}

/// Twice the area, along the normal, mm².
fn area_vector([a, b, c]: &[Point3<f64>; 3]) -> Vector3<f64> {
    (b - a).cross(&(c - a))
}

/// The longest edge over the height above it.
fn slenderness(facet: &[Point3<f64>; 3]) -> f64 {
    let [a, b, c] = facet;
    let longest = (b - a).norm_squared().max((c - b).norm_squared()).max((a - c).norm_squared());
    longest / area_vector(facet).norm()
}

#[cfg(test)]
mod tests {
    use crate::solid::{Feature, Mesh, MeshSolid, gate};

    fn slender(mesh: &Mesh, limit: f64) -> usize {
        mesh.triangles.iter().filter(|triangle| super::slenderness(&mesh.corners(triangle)) > limit).count()
    }

    #[test]
    fn analytic_a_plate_with_holes_has_fewer_slender_facets_and_the_same_surface() {
        let holes = (0..5).map(|i| Feature::bore(2.5, 9.0).at(7.0 * f64::from(i) - 14.0, f64::from(i % 2), -1.0));
        let plate = Feature::cuboid_between([-20.0, -20.0, 0.0], [20.0, 20.0, 2.0]).minus(holes);
        let plate = plate.turned_x(crate::units::Angle::deg(31.0)).turned_z(crate::units::Angle::deg(17.0));
        let solid = MeshSolid::build(&plate).simplified();
        let stout = solid.stout();
        let [was, is] = [solid.mesh(), stout.mesh()];
        // Beside the holes facets stay slender: their arcs have short edges.
        assert!(3 * slender(&is, 50.0) < 2 * slender(&was, 50.0), "{} of {}", slender(&is, 50.0), slender(&was, 50.0));
        assert_eq!((is.triangles.len(), &is.vertices), (was.triangles.len(), &was.vertices));
        assert!((is.volume_mm3() / was.volume_mm3() - 1.0).abs() < 1e-6);
        assert_eq!(gate::pass(&is), gate::pass(&was));
    }

    #[test]
    fn analytic_round_surfaces_keep_their_facets() {
        let ball = MeshSolid::build(&Feature::sphere(3.0));
        assert_eq!(ball.stout().mesh(), ball.mesh());
    }
}
