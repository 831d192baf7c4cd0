//! What a hull spans between two round surfaces that are alike: the planes that touch both, and the cylinders that rounded edges sweep.

use nalgebra::{Unit, Vector3};

use super::surface::{Surface, across};

/// How far lengths and directions may differ that are the same, mm or as a sine.
const SAME: f64 = 1e-9;

/// Both planes that touch two cylinders, the cylinder around two spheres, or the two that a torus sweeps on its way to another; none where
/// the surfaces are not alike.
pub(super) fn between(one: &Surface, other: &Surface) -> Vec<Surface> {
    match (one, other) {
        (Surface::Cylinder { point, axis, radius_mm }, Surface::Cylinder { point: p, axis: a, radius_mm: r })
            if axis.cross(a).norm() < SAME && (radius_mm - r).abs() < SAME =>
        {
            let Some(along) = Unit::try_new(across(axis, &(p - point)), SAME) else { return Vec::new() };
            let aside = Unit::new_normalize(axis.cross(&along));
            [aside, -aside].map(|normal| Surface::Plane { point: point + normal.into_inner() * *radius_mm, normal }).into()
        }
        (Surface::Sphere { centre, radius_mm, .. }, Surface::Sphere { centre: c, radius_mm: r, .. }) if (radius_mm - r).abs() < SAME => {
            let along = Unit::try_new(c - centre, SAME);
            along.map(|axis| Surface::Cylinder { point: *centre, axis, radius_mm: *radius_mm }).into_iter().collect()
        }
        (
            Surface::Torus { centre, axis, radius_mm, minor_radius_mm },
            Surface::Torus { centre: c, axis: a, radius_mm: r, minor_radius_mm: m },
        ) if axis.cross(a).norm() < SAME && (radius_mm - r).abs() < SAME && (minor_radius_mm - m).abs() < SAME => {
            let square = |along: &Unit<Vector3<f64>>| along.dot(axis).abs() < SAME;
            let Some(along) = Unit::try_new(c - centre, SAME).filter(square) else { return Vec::new() };
            let aside = axis.cross(&along) * *radius_mm;
            [aside, -aside].map(|aside| Surface::Cylinder { point: centre + aside, axis: along, radius_mm: *minor_radius_mm }).into()
        }
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use crate::solid::{Boundary, Contour, Feature, MeshSolid, Profile};

    #[test]
    fn analytic_a_hull_of_two_rounded_discs_is_exact() {
        let (radius, half, round, apart) = (6.0, 2.0, 1.5, 9.0);
        let corners = [([0.0, -half], 0.0), ([radius, -half], round), ([radius, half], round), ([0.0, half], 0.0)];
        let disc = Feature::revolve(Profile::new(Contour::rounded_polygon(&corners)));
        let bar = Feature::hull([disc.clone(), disc.at(0.0, apart, 0.0)]);
        let exact = Boundary::exact(&MeshSolid::build(&bar).mesh(), &bar, &Isometry3::identity()).expect("no facet is left");
        assert_eq!(exact.faces.len(), 4 + 2 + 4 + 4, "tori, their outer cylinders, swept edges, planes");
        let pi = std::f64::consts::PI;
        let (square, quarter) = (round * round, 0.25 * pi * round * round);
        let about = square * (radius - 0.5 * round) - quarter * (radius - round + 4.0 * round / (3.0 * pi));
        let disc_mm3 = pi * radius * radius * 2.0 * half - 4.0 * pi * about;
        let between_mm3 = apart * (4.0 * radius * half - (4.0 - pi) * square);
        assert!((exact.volume_mm3() / (disc_mm3 + between_mm3) - 1.0).abs() < 2e-5, "{}", exact.volume_mm3());
    }
}
