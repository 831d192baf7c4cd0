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
    /// How far.
    pub fn angle(&self) -> Angle {
        match self {
            Self::Web { angle, .. } | Self::Necks { angle, .. } => *angle,
        }
    }

    /// The rigid motion of what lies beyond the hinge, in the axes of the flat part.
    pub fn motion(&self) -> Isometry3<f64> {
        match self {
            Self::Web { pivot, outward, towards, angle, .. } => about(*pivot, Unit::new_normalize(outward.cross(towards)), *angle),
            Self::Necks { pivot, axis, angle, .. } => about(*pivot, *axis, *angle),
        }
    }

    /// What the bend leaves where it is, and what it moves: the flat solid in two, cut through web or necks.
    pub fn sides(&self, flat: &MeshSolid) -> [MeshSolid; 2] {
        match self {
            Self::Web { pivot, outward, towards, half_width_mm, .. } => {
                Hinge { pivot: *pivot, outward: *outward, towards: *towards, half_width_mm: *half_width_mm }.sides(flat)
            }
            Self::Necks { pivot, axis, inner_mm, outer_mm, .. } => {
                let (a, at, middle) = (axis.into_inner(), pivot.coords.dot(axis), 0.5 * (inner_mm + outer_mm));
                let moving = flat.half(a, at - middle).half(-a, -at - middle);
                [flat.half(a, at + middle).union(&flat.half(-a, middle - at)), moving]
            }
        }
    }

    /// The same hinge with its pivot a little farther out, mm; necks stay where they are.
    pub fn moved_out(&self, by_mm: f64) -> Self {
        let mut moved = *self;
        if let Self::Web { pivot, outward, .. } = &mut moved {
            *pivot += outward.into_inner() * by_mm;
        }
        moved
    }

    /// The same hinge, not folded.
    pub fn unfolded(&self) -> Self {
        let mut unfolded = *self;
        match &mut unfolded {
            Self::Web { angle, .. } | Self::Necks { angle, .. } => *angle = Angle::deg(0.0),
        }
        unfolded
    }

    /// The folded solid.
    pub fn apply(&self, flat: &MeshSolid) -> MeshSolid {
        self.apply_cut(flat, || self.sides(flat))
    }

    /// The folded solid, where somebody has its sides already: those of [`Bend::sides`], whatever the angle.
    pub fn apply_cut(&self, flat: &MeshSolid, sides: impl FnOnce() -> [MeshSolid; 2]) -> MeshSolid {
        match self {
            Self::Web { pivot, outward, towards, half_width_mm, angle } => {
                let hinge = Hinge { pivot: *pivot, outward: *outward, towards: *towards, half_width_mm: *half_width_mm };
                hinge.bent(sides(), *angle, &self.motion())
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
    fn bent(&self, [still, moving]: [MeshSolid; 2], angle: Angle, motion: &Isometry3<f64>) -> MeshSolid {
        let section = self.section(&moving);
        // What is small is joined first: the large side then takes part once.
        let web = self.swept(&section, angle);
        let web = self.crease(&section).map_or(web.clone(), |crease| web.union(&crease));
        still.union(&moving.placed(motion).union(&web))
    }

    /// What stays and what moves.
    fn sides(&self, flat: &MeshSolid) -> [MeshSolid; 2] {
        let region = self.moving_region();
        [flat.minus(&region).largest_body(), flat.intersection(&region).largest_body()]
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

    /// From the sweep's axes (turning about z, starting in the xz plane) to the part's: x away from the closing
    /// side, z along the hinge axis, so that the sweep turns the way the moving side does.
    fn sweep_pose(&self) -> Isometry3<f64> {
        let away = -self.towards.into_inner();
        posed(self.pivot, Matrix3::from_columns(&[away, self.outward.into_inner(), away.cross(&self.outward)]))
    }

    /// Contours of the web's cut at the pivot in (distance from the hinge axis, place along it), mm: what lies on the
    /// far side of the axis from where the joint closes.
    fn section(&self, moving: &MeshSolid) -> Vec<Vec<[f64; 2]>> {
        // The kernel slices at constant z: lay y (outward) down along -z.
        let lay = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), -std::f64::consts::FRAC_PI_2);
        let laid = moving.placed(&(Isometry3::from_parts(Translation3::identity(), lay) * self.sweep_pose().inverse()));
        laid.half(Vector3::x(), OFF_AXIS_MM).slice(-SECTION_INSET_MM).contours()
    }

    /// The section, a little smaller, turned about the hinge axis through the bend and a little into both sides: the
    /// stretched outside of the fold.
    fn swept(&self, section: &[Vec<[f64; 2]>], angle: Angle) -> MeshSolid {
        let turn_deg = angle.to_deg() + 2.0 * OVERLAP_DEG;
        let steps = (turn_deg / FACET_DEG).ceil().max(1.0);
        // The middles of the facets, not their edges, lie on the swept surface.
        let wider = 1.0 / Angle::deg(0.5 * turn_deg / steps).cos();
        let within = |p: &[f64; 2]| [(p[0] * wider - WITHIN_MM).max(OFF_AXIS_MM), p[1] * (1.0 - WITHIN_MM / self.half_width_mm)];
        let contours: Vec<Vec<[f64; 2]>> = section.iter().map(|c| c.iter().map(within).collect()).collect();
        let sector = MeshSolid::revolved(&contours, (360.0 / turn_deg * steps).round() as u32, turn_deg);
        let start = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -Angle::deg(OVERLAP_DEG).to_rad());
        sector.placed(&(self.sweep_pose() * Isometry3::from_parts(Translation3::identity(), start)))
    }

    /// A thin rod along the hinge axis where both sides and the sweep would meet in a line; none when the section
    /// stays clear of the axis.
    fn crease(&self, section: &[Vec<[f64; 2]>]) -> Option<MeshSolid> {
        let near = section.iter().flatten().filter(|p| p[0] < OFF_AXIS_MM + CREASE_MM);
        let half_mm = near.map(|p| p[1].abs()).fold(0.0, f64::max) + CREASE_MM;
        let (from, to) = (Point3::new(0.0, 0.0, -half_mm), Point3::new(0.0, 0.0, half_mm));
        let rod = Feature::cylinder_between(from, to, OFF_AXIS_MM + 2.0 * CREASE_MM);
        (half_mm > CREASE_MM).then(|| MeshSolid::build(&rod).placed(&self.sweep_pose()))
    }
}

/// The section is taken this far on the moving side of the pivot, where no other limb of the part is met, mm.
const SECTION_INSET_MM: f64 = 0.01;

/// The sweep reaches this far into both sides so that the union has no faces in common.
const OVERLAP_DEG: f64 = 3.0;

/// The swept section is this much smaller than the web's, so that the two surfaces do not graze each other, mm.
const WITHIN_MM: f64 = 0.006;

/// The section begins this far from the hinge axis, mm.
const OFF_AXIS_MM: f64 = 0.02;

/// What the crease covers around the section's inner edge, mm.
const CREASE_MM: f64 = 0.02;

/// How far the moving region reaches, mm: further than any limb.
const REACH_MM: f64 = 60.0;

/// The planes beside the moving side start this far off its edges, so that they do not graze them, mm.
pub const OFF_EDGE_MM: f64 = 0.02;

/// How fast the planes beside the moving side open: halfway to a limb at 45° to it.
pub const OPENING: f64 = 0.4;
