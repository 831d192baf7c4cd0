//! Closing the frame: strut tilt, heights and the leg from the rods and joints, in the plane of one diagonal.
//!
//! In that plane s is the distance from the hub's axis and z the height. The arm fixes the knee's node; the strut leaves
//! it towards the ring and must end on the corner's strut pivot, whose s the cage rods fix: the tilt follows from the
//! strut's length. The leg joins the corner's leg pivot and the hub joint's.

use std::f64::consts::SQRT_2;

use super::corner_pivots::CornerPivots;
use super::module::ModulePlaces;
use crate::figures::told_apart;
use crate::params::Frame;
use crate::units::Angle;

/// The dimensions that close the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closure {
    /// Half the distance of the ring nodes across the frame, mm; in a module's axes they lie this far out along x and along y.
    pub ring_half_side_mm: f64,
    /// Where the modules stand.
    pub places: ModulePlaces,
    /// Height of the ring nodes above and below the arms, mm.
    pub ring_half_height_mm: f64,
    /// Radius of the corners' sockets, mm.
    pub corner_radius_mm: f64,
    /// From a ring node outward along the diagonal to the strut's pivot, mm.
    pub strut_pivot_mm: f64,
    /// From a ring node inward along the diagonal to the leg's pivot, mm.
    pub leg_pivot_mm: f64,
    /// Bottom of the arm rods' bores in the fork, where the rods end, s in mm.
    pub fork_bottom_s_mm: f64,
    /// Nominal centre of the fork's bar, s in mm.
    pub bar_s_mm: f64,
    /// Crossing of the strut axes, s in mm.
    pub knee_s_mm: f64,
    /// Axis about which the hub joint's leg folds, s in mm.
    pub hub_leg_pivot_s_mm: f64,
    /// Tilt of the struts against the vertical.
    pub strut_tilt: Angle,
    /// Slope of the legs against the horizontal, and fold of both their ends.
    pub leg_tilt: Angle,
    /// Length of the leg rods, mm.
    pub leg_rod_length_mm: f64,
}

/// What to do where the knees are too far out for the ring, and no one length closes the frame.
const INWARDS: &str = "shorten arm_rod_length_mm or lengthen cage_rod_length_mm";
/// The same where they are too far in.
const OUTWARDS: &str = "lengthen strut_rod_length_mm or arm_rod_length_mm, or shorten cage_rod_length_mm";

/// Why no frame closes.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ClosureError {
    /// The ring lies further out than the strut reaches, or further in.
    #[error(
        "the frame cannot close: the strut's pivot lies {:.2} mm {} the knee, but knee, strut rod and corner together are only {reach_mm:.2} mm long",
        .offset_mm.abs(), if *.offset_mm < 0.0 { "inside" } else { "outside" }
    )]
    StrutTooShort {
        /// Horizontal distance to bridge, mm; negative inward.
        offset_mm: f64,
        /// What there is, mm.
        reach_mm: f64,
    },
    /// The strut leaves the tilt that a knee can be made for.
    #[error("the struts would tilt by {}°, a knee can be made for {min_deg:.0}° to {max_deg:.0}°", in_degrees(*.tilt_deg, *.min_deg, *.max_deg))]
    Tilt {
        /// Tilt, degrees; negative leans inward.
        tilt_deg: f64,
        /// Least.
        min_deg: f64,
        /// Most.
        max_deg: f64,
    },
    /// The leg would be no rod.
    #[error("no room for the leg rod: {length_mm:.2} mm between the bottoms of its two sockets, at least {least_mm:.0} mm are needed")]
    LegTooShort {
        /// What is left, mm.
        length_mm: f64,
        /// Least length of a leg rod, mm.
        least_mm: f64,
    },
}

/// A tilt with as many decimals as it takes to see that it lies outside its bounds.
fn in_degrees(tilt_deg: f64, min_deg: f64, max_deg: f64) -> String {
    let bound = if tilt_deg < min_deg { min_deg } else { max_deg };
    told_apart(tilt_deg, bound, 1)[0].clone()
}

impl ClosureError {
    /// The parameter to change.
    pub fn key(&self) -> &'static str {
        match self {
            Self::StrutTooShort { .. } | Self::Tilt { .. } => "rods.strut_rod_length_mm",
            Self::LegTooShort { .. } => "rods.arm_rod_length_mm",
        }
    }

    /// What to change.
    pub fn remedy(&self) -> String {
        match self {
            Self::StrutTooShort { offset_mm, .. } if *offset_mm < 0.0 => INWARDS.into(),
            Self::StrutTooShort { .. } => OUTWARDS.into(),
            Self::Tilt { tilt_deg, max_deg, .. } if tilt_deg > max_deg => OUTWARDS.into(),
            Self::Tilt { .. } => INWARDS.into(),
            Self::LegTooShort { .. } => "lengthen cage_rod_length_mm and arm_rod_length_mm together".into(),
        }
    }
}

/// Tilts a knee can be made for: below, its bores meet the window; above, the plate no longer covers them.
pub(super) const TILT_DEG: (f64, f64) = (10.0, 35.0);

/// By how many degrees the corners' strut sockets are folded, from how they are printed to struts of a tilt.
pub fn strut_fold_deg(strut_tilt_deg: f64) -> f64 {
    90.0 + strut_tilt_deg
}

/// What solving rod lengths for a tilt and back may change of it, degrees.
const ROUNDING_DEG: f64 = 1e-9;

/// Shortest leg rod that is a rod, mm.
const SHORTEST_LEG_MM: f64 = 20.0;

impl Closure {
    /// Closes a frame.
    ///
    /// # Errors
    /// When its rods cannot close, see [`ClosureError`].
    pub fn solve(frame: &Frame) -> Result<Self, ClosureError> {
        let strut_way = StrutWay::of(frame);
        let StrutWay { pivots, ring_half_side_mm, fork_bottom_s_mm, bar_s_mm, knee_s_mm, reach_mm } = strut_way;
        let offset_mm = strut_way.offset_mm();
        if offset_mm.abs() >= reach_mm {
            return Err(ClosureError::StrutTooShort { offset_mm, reach_mm });
        }
        let strut_tilt = Angle::rad(libm::asin(offset_mm / reach_mm));
        let (min_deg, max_deg) = TILT_DEG;
        if !(min_deg - ROUNDING_DEG..=max_deg + ROUNDING_DEG).contains(&strut_tilt.to_deg()) {
            return Err(ClosureError::Tilt { tilt_deg: strut_tilt.to_deg(), min_deg, max_deg });
        }
        let ring_half_height_mm = reach_mm * strut_tilt.cos();
        let joint = &frame.hub_joint;
        let hub_leg_bottom_s = frame.hub.hub_mouth_mm + joint.hub_leg_mouth_mm - joint.hub_leg_socket_depth_mm;
        let hub_leg_pivot_s_mm = hub_leg_bottom_s - joint.hub_leg_pivot_mm;
        let run = ring_half_side_mm * SQRT_2 - pivots.leg_mm - hub_leg_pivot_s_mm;
        let corner_leg = frame.corner.corner_leg_bottom_mm - pivots.leg_mm;
        let leg_rod_length_mm = libm::hypot(run, ring_half_height_mm) - joint.hub_leg_pivot_mm - corner_leg;
        if leg_rod_length_mm < SHORTEST_LEG_MM {
            return Err(ClosureError::LegTooShort { length_mm: leg_rod_length_mm, least_mm: SHORTEST_LEG_MM });
        }
        Ok(Self {
            ring_half_side_mm,
            places: ModulePlaces::of(&frame.rods),
            ring_half_height_mm,
            corner_radius_mm: pivots.radius_mm,
            strut_pivot_mm: pivots.strut_mm,
            leg_pivot_mm: pivots.leg_mm,
            fork_bottom_s_mm,
            bar_s_mm,
            knee_s_mm,
            hub_leg_pivot_s_mm,
            strut_tilt,
            leg_tilt: Angle::rad(libm::atan2(ring_half_height_mm, run)),
            leg_rod_length_mm,
        })
    }
}

/// Where both ends of a strut are, as the rods place them before anything tilts. Distances `_s` lie along the diagonal, from the hub's axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct StrutWay {
    /// Of the ring's corners.
    pivots: CornerPivots,
    /// Half of a ring's side, between the nodes of its corners, mm.
    ring_half_side_mm: f64,
    fork_bottom_s_mm: f64,
    bar_s_mm: f64,
    knee_s_mm: f64,
    /// From the knee's node to the strut's pivot, mm.
    pub(super) reach_mm: f64,
}

impl StrutWay {
    /// That of a frame, whether it closes or not.
    pub(super) fn of(frame: &Frame) -> Self {
        let rods = &frame.rods;
        let pivots = CornerPivots::of(frame);
        let fork_bottom_s_mm = frame.fork_bottom_mm();
        let bar_s_mm = fork_bottom_s_mm + frame.fork.fork_reach_mm;
        Self {
            pivots,
            ring_half_side_mm: 0.5 * rods.cage_rod_length_mm + frame.corner.corner_node_to_bottom_mm,
            fork_bottom_s_mm,
            bar_s_mm,
            knee_s_mm: bar_s_mm - frame.knee.knee_node_offset_mm,
            reach_mm: frame.knee.knee_node_to_bottom_mm + rods.strut_rod_length_mm + frame.corner.corner_node_to_bottom_mm
                - pivots.strut_mm,
        }
    }

    /// How far the strut's pivot lies beyond the knee's node, along the diagonal, mm: the sine of the strut's tilt times its reach.
    pub(super) fn offset_mm(&self) -> f64 {
        self.ring_half_side_mm * SQRT_2 + self.pivots.strut_mm - self.knee_s_mm
    }
}

/// A wanted size of the whole frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Envelope {
    /// Width and depth, mm.
    pub width_mm: f64,
    /// Height, mm.
    pub height_mm: f64,
    /// Tilt of the struts.
    pub strut_tilt: Angle,
}

/// A frame is made smaller than wanted by this, mm: its meshes have rounded corners, and the size is a limit.
pub const BELOW_MM: f64 = 0.002;

/// Cage, arm and strut rod lengths (mm) that give a frame of this size and tilt: the inverse of [`Closure::solve`]. The
/// ring's corners are taken to be outermost.
pub fn lengths_for(envelope: &Envelope, frame: &Frame) -> [f64; 3] {
    let (own, rods) = (StrutWay::of(frame), &frame.rods);
    let ring_half_side_mm = 0.5 * envelope.width_mm - own.pivots.radius_mm - own.pivots.strut_mm / SQRT_2;
    let half_height_mm = 0.5 * (envelope.height_mm - BELOW_MM) - own.pivots.radius_mm;
    let reach_mm = half_height_mm / envelope.strut_tilt.cos();
    let beyond_mm = StrutWay { ring_half_side_mm, ..own }.offset_mm() - half_height_mm * envelope.strut_tilt.tan();
    let cage = rods.cage_rod_length_mm + 2.0 * (ring_half_side_mm - own.ring_half_side_mm);
    [cage, rods.arm_rod_length_mm + beyond_mm, rods.strut_rod_length_mm + reach_mm - own.reach_mm]
}
