//! The triangle of arms, strut and leg as a linkage in the plane of a module's diagonal.
//!
//! In that plane s is the distance from the hub's axis, z the height; all angles are folds from flat, degrees. The knee
//! is rigid, so with every rod at the bottom of its bores the triangle has no freedom: no bend alone can close it. It is
//! closed while its rods still stand out of their bores: the arms (and, where those are too short, the struts) by one
//! share of what their bores hold, so that the leg reaches the foot's mouth. From there on the foot turns, and at each
//! angle the share, the leg's way and the fold at the hub follow from the closure. The web at the leg keeps its final
//! fold on that way: it is the one hinge with no room to bend further.

use nalgebra::{Matrix2, Vector2};

use crate::frame::skeleton::{RodRole, Skeleton, strut_fold_deg};
use crate::params::Frame;
use crate::units::Angle;

/// Largest share of a bore's hold that a rod may stand out by while a loop is closed; the rest keeps it in line.
pub const MOST_PULLED: f64 = 0.85;

/// The leg waits this far before the foot's mouth, mm.
const BEFORE_MOUTH_MM: f64 = 0.5;

/// Residual at which a closure is solved, mm.
const SOLVED_MM: f64 = 1e-10;

/// How a module stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stance {
    /// Fold of the foot's strut hinge, degrees.
    pub strut_deg: f64,
    /// Fold of the foot's leg hinge, degrees.
    pub foot_deg: f64,
    /// Fold of the hub joint's leg, degrees.
    pub hub_deg: f64,
    /// Share of their hold by which the loop's rods stand out of their bores.
    pub pulled: f64,
    /// How far the leg stands out of the foot's bore, mm.
    pub leg_out_mm: f64,
}

/// Why a triangle cannot be closed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LinkageError {
    /// The rods' holds are too short for the leg's way into the foot.
    #[error(
        "the leg needs {way_mm:.1} mm to enter the foot: arms and struts would stand {:.0} % out of their bores, {:.0} % are allowed",
        100.0 * pulled,
        100.0 * MOST_PULLED
    )]
    LegTooLong {
        /// The leg's way, mm.
        way_mm: f64,
        /// Share that the rods would stand out by.
        pulled: f64,
    },
    /// The equations have no solution near the last angle.
    #[error("the triangle of arms, strut and leg cannot be followed at a fold of {strut_deg:.1} deg")]
    Lost {
        /// Fold of the foot's strut hinge, degrees.
        strut_deg: f64,
    },
}

/// The triangle's lengths.
#[derive(Clone, Debug, PartialEq)]
pub struct Linkage {
    tilt_deg: f64,
    leg_tilt_deg: f64,
    hub_pivot: Vector2<f64>,
    knee_s_mm: f64,
    strut_mm: f64,
    foot_mm: f64,
    leg_mm: f64,
    leg_hold_mm: f64,
    /// Hold of the arms in hub joint and fork, mm.
    pub arm_holds_mm: [f64; 2],
    /// Hold of the strut in knee and corner, mm.
    pub strut_holds_mm: [f64; 2],
    /// Whether the struts are pulled too.
    pub struts_slide: bool,
}

impl Linkage {
    /// The linkage of a frame; arms slide, and struts too where the arms' bores are too short.
    ///
    /// # Errors
    /// When neither is enough.
    pub fn new(frame: &Frame, skeleton: &Skeleton) -> Result<Self, LinkageError> {
        let mut linkage = Self::of(frame, skeleton);
        let Err(first) = linkage.entry() else { return Ok(linkage) };
        linkage.struts_slide = true;
        // That the struts do not help says less than what the arms lack.
        let reported = |error| if matches!(error, LinkageError::Lost { .. }) { first } else { error };
        linkage.entry().map_err(reported).map(|_| linkage)
    }

    fn of(frame: &Frame, skeleton: &Skeleton) -> Self {
        let c = &skeleton.closure;
        let held = |role: RodRole| {
            let rod = skeleton.rods_of(role).next();
            rod.map_or([0.0; 2], |r| [r.sockets[0].engagement_mm(&r.start), r.sockets[1].engagement_mm(&r.end)])
        };
        let reach = frame.knee.knee_node_to_bottom_mm + frame.rods.strut_rod_length_mm + frame.corner.corner_node_to_bottom_mm;
        let beyond_leg = frame.hub_joint.hub_leg_pivot_mm + frame.corner.corner_leg_bottom_mm - c.leg_pivot_mm;
        Self {
            tilt_deg: c.strut_tilt.to_deg(),
            leg_tilt_deg: c.leg_tilt.to_deg(),
            hub_pivot: Vector2::new(c.hub_leg_pivot_s_mm, 0.0),
            knee_s_mm: c.knee_s_mm,
            strut_mm: reach - c.strut_pivot_mm,
            foot_mm: c.strut_pivot_mm + c.leg_pivot_mm,
            leg_mm: c.leg_rod_length_mm + beyond_leg,
            leg_hold_mm: held(RodRole::Leg)[1],
            arm_holds_mm: held(RodRole::Arm),
            strut_holds_mm: held(RodRole::Strut),
            struts_slide: false,
        }
    }

    /// How far fork and knee stand out at a share, mm.
    pub fn knee_out_mm(&self, pulled: f64) -> f64 {
        pulled * (self.arm_holds_mm[0] + self.arm_holds_mm[1])
    }

    /// How far the strut stands out of the knee, and the corner off the strut, at a share, mm.
    pub fn strut_out_mm(&self, pulled: f64) -> [f64; 2] {
        let share = if self.struts_slide { pulled } else { 0.0 };
        self.strut_holds_mm.map(|hold| hold * share)
    }

    /// Way of the leg into the foot, mm.
    pub fn leg_way_mm(&self) -> f64 {
        self.leg_hold_mm
    }

    /// The assembled module.
    pub fn closed(&self) -> Stance {
        Stance {
            strut_deg: strut_fold_deg(self.tilt_deg),
            foot_deg: self.leg_tilt_deg,
            hub_deg: self.leg_tilt_deg,
            pulled: 0.0,
            leg_out_mm: 0.0,
        }
    }

    /// The foot's strut pivot, at a share.
    fn strut_pivot(&self, pulled: f64) -> Vector2<f64> {
        let down = Angle::deg(self.tilt_deg - 90.0);
        let length = self.strut_mm + self.strut_out_mm(pulled).iter().sum::<f64>();
        Vector2::new(self.knee_s_mm + self.knee_out_mm(pulled), 0.0) + Vector2::new(down.cos(), down.sin()) * length
    }

    /// What is missing between the leg's end and the foot's leg pivot, mm.
    pub fn gap(&self, stance: &Stance) -> Vector2<f64> {
        let along = Angle::deg(self.tilt_deg - 90.0 - stance.strut_deg);
        let foot = self.strut_pivot(stance.pulled) + Vector2::new(along.cos(), along.sin()) * self.foot_mm;
        let leg = Angle::deg(-stance.hub_deg);
        foot - self.hub_pivot - Vector2::new(leg.cos(), leg.sin()) * (self.leg_mm + stance.leg_out_mm)
    }

    /// The only stance at a fold of the foot's strut hinge at which the leg lies in both its bores: share and leg's way by
    /// Newton's method, from a stance nearby.
    ///
    /// # Errors
    /// When there is none.
    pub fn at(&self, strut_deg: f64, near: &Stance) -> Result<Stance, LinkageError> {
        let foot_deg = self.leg_tilt_deg;
        let mut s = Stance { strut_deg, foot_deg, hub_deg: strut_deg + foot_deg - 90.0 - self.tilt_deg, ..*near };
        for _ in 0..20 {
            let gap = self.gap(&s);
            if gap.norm() < SOLVED_MM {
                return Ok(s);
            }
            let step = 1e-6;
            let by_pull = (self.gap(&Stance { pulled: s.pulled + step, ..s }) - gap) / step;
            let by_leg = (self.gap(&Stance { leg_out_mm: s.leg_out_mm + step, ..s }) - gap) / step;
            let Some(inverse) = Matrix2::from_columns(&[by_pull, by_leg]).try_inverse() else { break };
            let change = inverse * gap;
            s.pulled -= change.x;
            s.leg_out_mm -= change.y;
        }
        Err(LinkageError::Lost { strut_deg })
    }

    /// The stance in which the leg stands before the foot's mouth: where the bend has to take it in.
    ///
    /// # Errors
    /// When the rods' bores are too short for it.
    pub fn entry(&self) -> Result<Stance, LinkageError> {
        let closed = self.closed();
        let wanted = self.leg_hold_mm + BEFORE_MOUTH_MM;
        let at = |back_deg: f64| self.at(closed.strut_deg - back_deg, &closed);
        let mut far_deg = 0.25;
        loop {
            let stance = at(far_deg)?;
            if stance.leg_out_mm >= wanted {
                break;
            }
            // Both only grow on the way back.
            if stance.pulled > MOST_PULLED {
                return Err(LinkageError::LegTooLong { way_mm: self.leg_hold_mm, pulled: stance.pulled });
            }
            far_deg *= 2.0;
            if far_deg > 90.0 {
                return Err(LinkageError::Lost { strut_deg: closed.strut_deg - far_deg });
            }
        }
        let mut near_deg = 0.0;
        for _ in 0..60 {
            let middle = 0.5 * (near_deg + far_deg);
            if at(middle)?.leg_out_mm < wanted { near_deg = middle } else { far_deg = middle }
        }
        let entry = at(far_deg)?;
        if entry.pulled > MOST_PULLED {
            return Err(LinkageError::LegTooLong { way_mm: self.leg_hold_mm, pulled: entry.pulled });
        }
        Ok(entry)
    }

    /// The bend that closes the triangle, at a share of its way from 0 to 1: first the foot turns freely until the leg
    /// stands before its mouth, then the closure is followed.
    ///
    /// # Errors
    /// When the closure is lost.
    pub fn closing(&self, entry: &Stance, way: f64) -> Result<Stance, LinkageError> {
        if way < FREE_WAY {
            let share = way / FREE_WAY;
            return Ok(Stance { strut_deg: entry.strut_deg * share, foot_deg: entry.foot_deg * share, ..*entry });
        }
        let closed = self.closed();
        let share = (way - FREE_WAY) / (1.0 - FREE_WAY);
        if share >= 1.0 {
            return Ok(closed);
        }
        let near = Stance { pulled: entry.pulled * (1.0 - share), leg_out_mm: entry.leg_out_mm * (1.0 - share), ..closed };
        self.at(entry.strut_deg + (closed.strut_deg - entry.strut_deg) * share, &near)
    }
}

/// Share of the closing bend in which the foot is still free.
pub const FREE_WAY: f64 = 0.6;

#[cfg(test)]
mod tests {
    use super::*;

    fn linkage() -> Linkage {
        let frame = Frame::load("cognifly-v8").expect("a preset").0;
        let skeleton = Skeleton::new(&frame).expect("closes");
        Linkage::new(&frame, &skeleton).expect("can be closed")
    }

    #[test]
    fn measured_the_closed_triangle_folds_as_the_real_one() {
        let linkage = linkage();
        let closed = linkage.closed();
        assert!((closed.strut_deg - 115.0).abs() < 0.1 && (closed.hub_deg - 28.1).abs() < 0.1, "{closed:?}");
        assert!(linkage.gap(&closed).norm() < 1e-9, "{}", linkage.gap(&closed).norm());
    }

    #[test]
    fn analytic_every_stance_of_the_closing_closes() {
        let linkage = linkage();
        let entry = linkage.entry().expect("the leg can enter");
        assert!(entry.pulled > 0.0 && entry.pulled < MOST_PULLED && !linkage.struts_slide, "{entry:?}");
        let mut last = entry.leg_out_mm + 1e-9;
        for step in 0..=50 {
            let stance = linkage.closing(&entry, FREE_WAY + (1.0 - FREE_WAY) * f64::from(step) / 50.0).expect("is followed");
            assert!(linkage.gap(&stance).norm() < 1e-8, "{stance:?}");
            assert!(stance.leg_out_mm < last && stance.pulled >= -1e-9, "{stance:?}");
            last = stance.leg_out_mm;
        }
    }

    #[test]
    fn analytic_without_pulling_the_triangle_is_rigid() {
        let linkage = linkage();
        let closed = linkage.closed();
        let other = linkage.at(closed.strut_deg - 1.0, &closed).expect("is followed");
        assert!(other.pulled > 0.01, "{other:?}");
    }
}
