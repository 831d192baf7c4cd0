//! Boundary representations: faces on planes and round surfaces, bounded by edges that two faces share. STEP files contain them.
//!
//! The topology is that of the mesh. [`Boundary::faceted`] merges its coplanar facets; [`Boundary::exact`] puts its facets back
//! on the surfaces of the feature tree that they stand for, and edges and corners where those surfaces meet.

mod chains;
mod chart;
mod connected;
mod crossing;
mod curve;
mod divided_curve;
mod exact;
mod face_assignment;
mod faceted;
mod known;
mod measure;
mod mixed;
mod not_exact;
mod regions;
mod seams;
mod small_faces;
mod spanned;
mod surface;
mod topology;
mod touching;

pub use curve::Curve;
pub use not_exact::NotExact;
pub use surface::{Surface, square_to};
pub use topology::{Boundary, Edge, FLATNESS_MM, Face, Side};

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use super::*;
    use crate::solid::{Feature, MeshSolid};

    fn exact(feature: &Feature) -> Boundary {
        let mesh = MeshSolid::build(feature).to_mesh();
        Boundary::exact(&mesh, feature, &Isometry3::identity()).expect("planes and cylinders")
    }

    #[test]
    fn analytic_cylinder_has_three_faces() {
        let cylinder = exact(&Feature::cylinder(1.5, 10.0).turned_x(crate::units::Angle::deg(33.0)).at(5.0, 6.0, 7.0));
        assert_eq!((cylinder.faces.len(), cylinder.edges.len(), cylinder.vertices.len()), (3, 2, 2));
        assert!((cylinder.volume_mm3() / (std::f64::consts::PI * 22.5) - 1.0).abs() < 1e-4, "{}", cylinder.volume_mm3());
    }
}
