//! Where each member of a module stands while it is put together, in the module's axes.

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};

use super::linkage::Linkage;
use super::member::{Member, Side, left, outward};
use crate::frame::parts::record;
use crate::frame::skeleton::{Centre, ModulePlaces, Rod, RodRole, Skeleton};
use crate::params::{Frame, PartName};
use crate::solid::Bend;
use crate::units::Angle;

/// The folds and ways that place a module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Posture {
    /// Fold of the hub joint's leg, degrees.
    pub hub_deg: f64,
    /// Fold of the bottom corner's strut hinge, degrees.
    pub strut_deg: f64,
    /// Fold of the bottom corner's leg hinge, degrees.
    pub foot_deg: f64,
    /// Fold of the top corner's strut hinge, degrees.
    pub top_deg: f64,
    /// How far the top corner is above its place, along the upper strut, mm.
    pub top_lift_mm: f64,
    /// Share of their hold by which the triangle's rods stand out.
    pub pulled: f64,
    /// How far the module stands off the hub, mm.
    pub off_hub_mm: f64,
}

/// The assembled places of a module, and its hinges.
pub struct Module {
    /// Where the modules stand.
    pub modules: ModulePlaces,
    /// The triangle.
    pub linkage: Linkage,
    places: Vec<(Member, Isometry3<f64>)>,
    hub_pivot: Point3<f64>,
    strut_up: [Vector3<f64>; 2],
    bends: Vec<(Member, Vec<Bend>)>,
}

/// The same bend through another angle.
pub fn bent_by(bend: &Bend, deg: f64) -> Bend {
    match *bend {
        Bend::Web { pivot, outward, towards, half_width_mm, .. } => {
            Bend::Web { pivot, outward, towards, half_width_mm, angle: Angle::deg(deg) }
        }
        Bend::Necks { pivot, axis, inner_mm, outer_mm, .. } => Bend::Necks { pivot, axis, inner_mm, outer_mm, angle: Angle::deg(deg) },
    }
}

/// A turn about an axis through a point.
pub fn about(point: Point3<f64>, axis: Vector3<f64>, deg: f64) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_scaled_axis(axis * Angle::deg(deg).to_rad());
    Translation3::from(point.coords) * turn * Translation3::from(-point.coords)
}

impl Module {
    /// The first module of a frame.
    pub fn new(frame: &Frame, skeleton: &Skeleton, linkage: Linkage) -> Self {
        let (c, centre) = (&skeleton.closure, Centre::new(frame));
        let seat = skeleton.node("M_FR").unwrap_or_else(Point3::origin);
        let place = |member: Member| {
            let rod = |name: &str| skeleton.rods.iter().find(|r| r.name == name).map(Rod::pose);
            let part = |name: PartName| record(name).poses(frame, c, &centre).first().map(|(_, pose)| *pose);
            match (member, member.part()) {
                (Member::Motor, _) => Some(Isometry3::translation(seat.x, seat.y, seat.z)),
                (Member::MotorScrews, _) => part(PartName::MotorMount),
                (_, Some(name)) => part(name),
                _ => rod(&member.body(0)),
            }
            .map_or_else(Isometry3::identity, |pose| if member == Member::Hub { pose } else { c.places.in_first(pose) })
        };
        let strut_up = [false, true].map(|up| place(Member::Strut(up)) * Vector3::z());
        let bends = |member: Member| member.part().map_or(Vec::new(), |name| record(name).bends(frame, c));
        Self {
            modules: c.places,
            linkage,
            places: Member::ALL.iter().map(|m| (*m, place(*m))).collect(),
            hub_pivot: Point3::from(outward() * c.hub_leg_pivot_s_mm),
            strut_up,
            bends: Member::ALL.into_iter().map(|member| (member, bends(member))).collect(),
        }
    }

    /// The assembled place of a member.
    pub fn place(&self, member: Member) -> Isometry3<f64> {
        self.places.iter().find(|(m, _)| *m == member).map_or_else(Isometry3::identity, |(_, pose)| *pose)
    }

    /// The hinges of a member.
    pub fn bends(&self, member: Member) -> &[Bend] {
        self.bends.iter().find(|(m, _)| *m == member).map_or(&[], |(_, bends)| bends)
    }

    /// The assembled posture.
    pub fn closed(&self) -> Posture {
        let s = self.linkage.closed();
        let [hub_deg, strut_deg, foot_deg] = [s.hub_deg, s.strut_deg, s.foot_deg];
        Posture { hub_deg, strut_deg, foot_deg, top_deg: strut_deg, top_lift_mm: 0.0, pulled: 0.0, off_hub_mm: 0.0 }
    }

    /// Folds of a member's hinges in a posture, degrees.
    pub fn folds(member: Member, posture: &Posture) -> Vec<f64> {
        match member {
            Member::HubJoint => vec![posture.hub_deg],
            Member::Corner(true) => vec![posture.top_deg],
            Member::Corner(false) => vec![posture.strut_deg, posture.foot_deg],
            _ => Vec::new(),
        }
    }

    /// Where a member stands.
    pub fn pose(&self, member: Member, posture: &Posture) -> Isometry3<f64> {
        let out = |s: f64| Translation3::from(outward() * s);
        let arm_out = posture.pulled * self.linkage.arm_holds_mm[0];
        let knee_out = self.linkage.knee_out_mm(posture.pulled);
        let [strut_out, corner_out] = self.linkage.strut_out_mm(posture.pulled);
        let place = self.place(member);
        let moved = match member {
            Member::HubJoint | Member::Mount | Member::Motor | Member::MotorScrews => place,
            Member::Hub => return place,
            Member::Arm(_) => out(arm_out) * place,
            Member::Fork | Member::Knee => out(knee_out) * place,
            Member::Leg => about(self.hub_pivot, left(), posture.hub_deg - self.closed().hub_deg) * place,
            Member::Strut(up) => out(knee_out) * Translation3::from(self.strut_up[usize::from(up)] * strut_out) * place,
            // Its ring stays level: the strut's socket is what turns.
            Member::Corner(true) => Translation3::from(self.strut_up[1] * posture.top_lift_mm) * place,
            Member::Corner(false) => {
                let off = Translation3::from(self.strut_up[0] * (strut_out + corner_out));
                out(knee_out) * off * place * self.refold(posture)
            }
            Member::Cage(up) => {
                let corner = Member::Corner(up);
                self.pose_near(corner, posture) * self.place(corner).inverse() * place
            }
        };
        out(posture.off_hub_mm) * moved
    }

    /// The corner's pose without the module's stand-off.
    fn pose_near(&self, corner: Member, posture: &Posture) -> Isometry3<f64> {
        self.pose(corner, &Posture { off_hub_mm: 0.0, ..*posture })
    }

    /// The strut's socket stays, so the bottom corner turns back by what is not yet folded.
    fn refold(&self, posture: &Posture) -> Isometry3<f64> {
        let Some(bend) = self.bends(Member::Corner(false)).first() else { return Isometry3::identity() };
        bend.motion() * bent_by(bend, posture.strut_deg).motion().inverse()
    }

    /// Where one side of a member's hinges stands.
    pub fn side_pose(&self, member: Member, side: Side, posture: &Posture) -> Isometry3<f64> {
        let base = self.pose(member, posture);
        let index = match side {
            Side::Base => return base,
            Side::First => 0,
            Side::Second => 1,
        };
        let fold = Self::folds(member, posture).get(index).copied().unwrap_or(0.0);
        self.bends(member).get(index).map_or(base, |bend| base * bent_by(bend, fold).motion())
    }

    /// How far the leg's axis is off the axis of the foot's bore: between bottom and rod's end less the way out, mm.
    pub fn loop_error_mm(&self, posture: &Posture, leg_out_mm: f64, skeleton: &Skeleton) -> f64 {
        let Some(rod) = skeleton.rods_of(RodRole::Leg).next() else { return f64::INFINITY };
        let length = rod.length_mm();
        let socket = self.modules.in_first(Isometry3::from(rod.sockets[1].bottom.coords));
        let pose = self.pose(Member::Leg, posture);
        let tip = pose * Point3::new(0.0, 0.0, length);
        let along = pose * Vector3::z();
        let foot = self.side_pose(Member::Corner(false), Side::Second, posture);
        let flat = self.side_pose(Member::Corner(false), Side::Second, &self.closed());
        let bottom = foot * flat.inverse() * Point3::from(socket.translation.vector);
        (bottom - (tip + along * leg_out_mm)).norm()
    }
}
