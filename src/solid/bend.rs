//! Folding a part that was printed flat: the solid after its web has bent.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};

use super::feature::Feature;
use super::mesh_solid::MeshSolid;
use super::profile::{Contour, Profile};
use crate::units::Angle;

/// How a printed joint bends, in the axes of the flat part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bend {
    /// A web that is bent about an axis across it: what lies beyond the pivot turns rigidly and the web's
    /// section at the pivot is swept in between.
    Web {
        /// A point of the axis, mm.
        pivot: Point3<f64>,
        /// From the pivot towards the side that moves.
        outward: Unit<Vector3<f64>>,
        /// Where the moving side turns to.
        towards: Unit<Vector3<f64>>,
        /// Half of the moving side's width along the axis at the pivot, mm: what is wider stays where it is.
        half_width_mm: f64,
        /// How far.
        angle: Angle,
    },
    /// Two necks along the axis that twist: the middle turns rigidly, the necks share the angle over their length.
    Necks {
        /// A point of the axis, midway between the necks, mm.
        pivot: Point3<f64>,
        /// Direction of the axis.
        axis: Unit<Vector3<f64>>,
        /// Distance along the axis within which everything turns fully, mm.
        inner_mm: f64,
        /// Distance along the axis beyond which nothing turns, mm.
        outer_mm: f64,
        /// How far, right-handed about `axis`.
        angle: Angle,
    },
}

/// Longest edge of the surface that follows the twist of a neck, mm.
const TWIST_EDGE_MM: f64 = 1.2;

/// Angle of one facet of a swept web.
const FACET_DEG: f64 = 7.5;

impl Bend {
    /// The rigid motion of what lies beyond the hinge, in the axes of the flat part.
    pub fn motion(&self) -> Isometry3<f64> {
        match self {
            Self::Web { pivot, outward, towards, angle, .. } => about(*pivot, Unit::new_normalize(outward.cross(towards)), *angle),
            Self::Necks { pivot, axis, angle, .. } => about(*pivot, *axis, *angle),
        }
    }

    /// The folded solid.
    pub fn apply(&self, flat: &MeshSolid) -> MeshSolid {
        match self {
            Self::Web { pivot, outward, towards, half_width_mm, angle } => {
                let hinge = Hinge { pivot: *pivot, outward: *outward, towards: *towards, half_width_mm: *half_width_mm };
                hinge.bent(flat, *angle, &self.motion())
            }
            Self::Necks { pivot, axis, inner_mm, outer_mm, angle } => flat.refined(TWIST_EDGE_MM).warped(|p| {
                let along = (p - pivot).dot(axis).abs();
                let share = ((outer_mm - along) / (outer_mm - inner_mm)).clamp(0.0, 1.0);
                about(*pivot, *axis, Angle::rad(angle.to_rad() * share)) * p
            }),
        }
    }
}

fn about(pivot: Point3<f64>, axis: Unit<Vector3<f64>>, angle: Angle) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_axis_angle(&axis, angle.to_rad());
    Translation3::from(pivot.coords) * turn * Translation3::from(-pivot.coords)
}

/// From axes given by their directions, at a point.
fn posed(at: Point3<f64>, axes: Matrix3<f64>) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
    Isometry3::from_parts(Translation3::from(at.coords), turn)
}

/// Where a web bends.
struct Hinge {
    pivot: Point3<f64>,
    outward: Unit<Vector3<f64>>,
    towards: Unit<Vector3<f64>>,
    half_width_mm: f64,
}

impl Hinge {
    fn bent(&self, flat: &MeshSolid, angle: Angle, motion: &Isometry3<f64>) -> MeshSolid {
        let region = self.moving_region();
        let (moving, still) = (flat.intersection(&region).largest_body(), flat.minus(&region).largest_body());
        still.union(&moving.placed(motion)).union(&self.swept_web(&moving, angle))
    }

    /// What lies beyond the pivot, between two planes that open outwards from the moving side's edges at the pivot:
    /// other limbs of the part may reach beyond the pivot too, but not between these.
    fn moving_region(&self) -> MeshSolid {
        let half = self.half_width_mm + OFF_EDGE_MM;
        let far = half + OPENING * REACH_MM;
        let outline = Contour::polygon(&[[0.0, -half], [REACH_MM, -far], [REACH_MM, far], [0.0, half]]);
        let prism = Feature::extrude(Profile::new(outline), 2.0 * REACH_MM).at(0.0, 0.0, -REACH_MM);
        let axes = Matrix3::from_columns(&[self.outward.into_inner(), self.towards.cross(&self.outward), self.towards.into_inner()]);
        MeshSolid::build(&prism).placed(&posed(self.pivot, axes))
    }

    /// The web's section at the pivot (what lies on the far side of the axis from where the joint closes), turned
    /// about the hinge axis through the bend: the stretched outside of the fold.
    fn swept_web(&self, moving: &MeshSolid, angle: Angle) -> MeshSolid {
        // Section axes: x away from the closing side, z along the hinge axis, so that a revolve about z by the
        // bend starts in the section's plane and turns the way the moving side does.
        let away = -self.towards.into_inner();
        let axes = Matrix3::from_columns(&[away, self.outward.into_inner(), away.cross(&self.outward)]);
        let section_pose = posed(self.pivot + self.towards.into_inner() * LIFT_MM, axes);
        // The kernel slices at constant z: lay y (outward) down along -z; then (x, y) are (r, z) of the revolve.
        let lay = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), -std::f64::consts::FRAC_PI_2);
        let laid = moving.placed(&(Isometry3::from_parts(Translation3::identity(), lay) * section_pose.inverse()));
        let within = |p: &[f64; 2]| {
            let r = if p[0] < LIFT_MM + WITHIN_MM { 0.0 } else { p[0] - WITHIN_MM };
            [r, p[1] * (1.0 - WITHIN_MM / self.half_width_mm)]
        };
        let contours: Vec<Vec<[f64; 2]>> = laid.slice(-SECTION_INSET_MM).iter().map(|c| c.iter().map(within).collect()).collect();
        let steps = (angle.to_deg() / FACET_DEG).ceil().max(1.0);
        let segments = (360.0 / angle.to_deg() * steps).round() as u32;
        let sector = MeshSolid::revolved(&contours, segments, angle.to_deg() + 2.0 * OVERLAP_DEG);
        let start = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -Angle::deg(OVERLAP_DEG).to_rad());
        sector.placed(&(section_pose * Isometry3::from_parts(Translation3::identity(), start)))
    }
}

/// The section is taken this far on the moving side of the pivot, where no other limb of the part is met, mm.
const SECTION_INSET_MM: f64 = 0.01;

/// The sweep reaches this far into both sides so that the union has no faces in common.
const OVERLAP_DEG: f64 = 0.5;

/// The swept section is this much smaller than the web's, so that the two surfaces do not graze each other, mm.
const WITHIN_MM: f64 = 0.003;

/// The sweep turns about an axis this far on the closing side, so that its inner edge is not the one in which both
/// sides of the hinge meet, mm.
const LIFT_MM: f64 = 0.01;

/// How far the moving region reaches, mm: further than any limb.
const REACH_MM: f64 = 60.0;

/// The planes beside the moving side start this far off its edges, so that they do not graze them, mm.
const OFF_EDGE_MM: f64 = 0.02;

/// How fast the planes beside the moving side open: halfway to a limb at 45° to it.
const OPENING: f64 = 0.4;
