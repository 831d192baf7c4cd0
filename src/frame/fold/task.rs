//! What there is to do: each task joins members or bends a hinge. Nothing here says in which order.

use std::borrow::Cow;

use nalgebra::Vector3;
use serde::Serialize;

use super::cut_rods;
use super::member::{Member, left, outward};
use super::tool::Tool;
use crate::params::Frame;

/// A task in each module.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// The fork's bar into the knee's window.
    ThreadKnee,
    /// Arm rods into the hub joint.
    PushArms,
    /// Leg rod into the hub joint.
    PushLeg,
    /// The hub joint's leg bends down.
    BendLeg,
    /// The motor mount onto both arms.
    SlideMount,
    /// The fork onto both arms.
    PushFork,
    /// Struts into the knee.
    PushStruts,
    /// The bottom corner onto the lower strut.
    PushFoot,
    /// The foot's bend closes arms, strut and leg.
    CloseTriangle,
    /// The bottom ring's rod into this module's corner.
    PushBottomCage,
    /// The top ring's rod into this module's corner.
    PushTopCage,
    /// The plugs of four modules into the hub, so far that the bottom ring's rods stand before the next corners.
    PlugHub,
    /// Four modules home, each rod of the bottom ring into the next module's corner.
    CloseRing,
    /// The top ring over the upper struts: its corners bend, and strut and cage rods slide home.
    CloseTop,
    /// Motor onto the mount.
    SeatMotor,
}

/// How a task moves things.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FoldMotion {
    /// Along a rod into a bore with a bottom, from the assembled side of the mouth.
    Push,
    /// Along rods through bores without a bottom: an end of each has to be free.
    Slide,
    /// One side of a hinge turns, with what is joined to it.
    Bend,
    /// Hinges turn and rods slide until a loop is closed.
    Close,
}

impl Task {
    /// Every task.
    pub const ALL: [Self; 15] = [
        Self::ThreadKnee,
        Self::PushArms,
        Self::PushLeg,
        Self::BendLeg,
        Self::SlideMount,
        Self::PushFork,
        Self::PushStruts,
        Self::PushFoot,
        Self::CloseTriangle,
        Self::PushBottomCage,
        Self::PushTopCage,
        Self::PlugHub,
        Self::CloseRing,
        Self::CloseTop,
        Self::SeatMotor,
    ];

    /// Every task as candidates for an order: of two that may be done at any time, the later one here is done later. A motor whose screws are out of
    /// reach above the arms comes onto its mount before that.
    pub fn candidates(frame: &Frame) -> [Self; 15] {
        let mut tasks = Self::ALL;
        if is_seated_early(frame) {
            let [mount, motor] = [Self::SlideMount, Self::SeatMotor].map(|task| tasks.iter().position(|other| *other == task).unwrap_or(0));
            tasks[mount..=motor].rotate_right(1);
        }
        tasks
    }

    /// How it moves.
    pub fn motion(self) -> FoldMotion {
        match self {
            Self::ThreadKnee | Self::SlideMount => FoldMotion::Slide,
            Self::BendLeg => FoldMotion::Bend,
            Self::CloseTriangle | Self::PlugHub | Self::CloseRing | Self::CloseTop => FoldMotion::Close,
            _ => FoldMotion::Push,
        }
    }

    /// What touches when it is done: what moves, and what it is joined to.
    pub fn contacts(self) -> Vec<(Member, Member)> {
        use Member::*;
        match self {
            Self::ThreadKnee => vec![(Knee, Fork)],
            Self::PushArms => vec![(Arm(true), HubJoint), (Arm(false), HubJoint)],
            Self::PushLeg => vec![(Leg, HubJoint)],
            Self::SlideMount => vec![(Mount, Arm(true)), (Mount, Arm(false))],
            Self::PushFork => vec![(Fork, Arm(true)), (Fork, Arm(false))],
            Self::PushStruts => vec![(Strut(true), Knee), (Strut(false), Knee)],
            Self::PushFoot => vec![(Corner(false), Strut(false))],
            Self::CloseTriangle => vec![(Corner(false), Leg)],
            Self::PushBottomCage => vec![(Cage(false), Corner(false))],
            Self::PushTopCage => vec![(Cage(true), Corner(true))],
            Self::PlugHub => vec![(HubJoint, Hub)],
            Self::CloseTop => vec![(Corner(true), Strut(true))],
            Self::SeatMotor => vec![(Motor, Mount), (MotorScrews, Mount)],
            // The bottom ring's rods enter corners of other modules.
            Self::BendLeg | Self::CloseRing => Vec::new(),
        }
    }

    /// The members that it brings to those they are joined to.
    pub fn brings(self) -> Vec<Member> {
        if self.motion() == FoldMotion::Close { Vec::new() } else { self.contacts().into_iter().map(|(moving, _)| moving).collect() }
    }

    /// The ring that it closes with the rods of each module in the next one's corner: the top one, or the bottom one.
    pub fn closes_ring(self) -> Option<bool> {
        match self {
            Self::CloseRing => Some(false),
            Self::CloseTop => Some(true),
            _ => None,
        }
    }

    /// What has to be there for a bend: the member whose hinge it is and what is held to turn it.
    pub fn lever(self) -> Option<(Member, Member)> {
        match self {
            Self::BendLeg => Some((Member::HubJoint, Member::Leg)),
            _ => None,
        }
    }

    /// For a slide: what is slid onto, and who closes each of its two ends, one pair a rail.
    pub fn rails(self) -> Vec<[(Member, Member); 2]> {
        use Member::*;
        match self {
            Self::SlideMount => [true, false].map(|l| [(Arm(l), HubJoint), (Fork, Arm(l))]).into(),
            // The fork is a rail itself: both its legs end in the arms' bores.
            Self::ThreadKnee => vec![[(Fork, Arm(true)), (Fork, Arm(false))]],
            _ => Vec::new(),
        }
    }

    /// Direction from which a member comes, in the axes of the assembled first module.
    pub fn comes_along(self, mover: Member, strut_up: impl Fn(bool) -> Vector3<f64>) -> Vector3<f64> {
        match (self, mover) {
            (Self::ThreadKnee, _) => left(),
            (Self::PushStruts, Member::Strut(up)) | (Self::PushFoot, Member::Corner(up)) => strut_up(up),
            (Self::PushBottomCage | Self::PushTopCage, _) => -Vector3::x(),
            (Self::SeatMotor, Member::MotorScrews) => -Vector3::z(),
            (Self::SeatMotor, _) => Vector3::z(),
            _ => outward(),
        }
    }

    /// A few words.
    pub fn title(self) -> &'static str {
        match self {
            Self::ThreadKnee => "Fork through knee",
            Self::PushArms => "Arm rods into hub joint",
            Self::PushLeg => "Leg rod into hub joint",
            Self::BendLeg => "Bend the leg down",
            Self::SlideMount => "Motor mount onto the arms",
            Self::PushFork => "Fork onto the arms",
            Self::PushStruts => "Struts into the knee",
            Self::PushFoot => "Bottom corner onto the lower strut",
            Self::CloseTriangle => "Bend the foot and close the triangle",
            Self::PushBottomCage => "Bottom cage rod into its corner",
            Self::PushTopCage => "Top cage rod into its corner",
            Self::PlugHub => "Plugs of four modules into the hub",
            Self::CloseRing => "Bottom ring: four modules home",
            Self::CloseTop => "Top ring onto the struts",
            Self::SeatMotor => "Motor onto its mount",
        }
    }

    /// What a person does in a frame, with the trick it takes.
    pub fn text(self, frame: &Frame) -> &'static str {
        match self {
            Self::ThreadKnee => {
                "Squeeze one leg of the fork flat with thin pliers, pull it through the knee's window and on until the bar sits in it."
            }
            Self::PushArms => {
                "Push two arm rods to the bottom of the outer bores of the hub joint, then draw each out again by the gap that is stated below."
            }
            Self::PushLeg => "Push the leg rod to the bottom of the middle bore.",
            Self::BendLeg => "Bend the leg down out of the way of what comes onto the arms; the two necks twist.",
            Self::SlideMount if is_seated_early(frame) => {
                "Slide the mount with its motor from the outer ends onto both arms, the motor up."
            }
            Self::SlideMount => "Slide the motor mount from the outer ends onto both arms, its flat face up.",
            Self::PushFork => "Push the fork with its knee onto both arm rods, and stop at the gap that is stated below.",
            Self::PushStruts => "Push a strut rod into each bore of the knee.",
            Self::PushFoot => {
                "Push the bottom corner straight onto the lower strut, by the bore opposite the long one, its notches towards the leg."
            }
            Self::CloseTriangle => {
                "Bend the foot at both its notches until the leg stands before the long bore, then go on bending and push the fork home: leg and arms slide to the bottom of their bores together."
            }
            Self::PushBottomCage => {
                "Push a cage rod into the bottom corner, towards the next module: seen from above, that is counter-clockwise, from front right to front left."
            }
            Self::PushTopCage => {
                "Push a cage rod into the top corner, by the bore that will look to the next module, counter-clockwise as at the bottom. Lay it aside, its notch down and its flat web up."
            }
            Self::PlugHub => {
                "Lay the four modules as a cross around the hub and start their plugs in it, only so far that each rod of the bottom ring stands before the next module's bottom corner."
            }
            Self::CloseRing => "Go round in small steps: plugs and the four rods of the bottom ring slide home together.",
            Self::CloseTop => {
                "Start each top rod in the next top corner, so that the four make a ring, and hold it over the upper struts. Bend the corners' free sockets down onto the struts, one after the other. Then go round in small steps: corners slide down the struts, rods into the corners."
            }
            Self::SeatMotor if is_seated_early(frame) => {
                "Put the motor onto its mount, its wires to the side that will look to the hub, and turn its screws in from below. The propellers are a step of their own, the last one."
            }
            Self::SeatMotor => {
                "Put the motor onto its mount, its wires towards the hub, and turn its screws in from below, with a long thin tool: the rod of the leg is beside it. The propellers are a step of their own, the last one."
            }
        }
    }

    /// What it takes in a frame, beside what a ring on a rod is marked with; nothing of what hands do.
    pub fn tools(self, frame: &Frame) -> &'static [Tool] {
        match self {
            Self::ThreadKnee => &[Tool::ThinPliers],
            Self::PushArms | Self::PushLeg | Self::PushStruts | Self::PushBottomCage | Self::PushTopCage => &[Tool::RodGlue],
            Self::SeatMotor if is_seated_early(frame) => &[Tool::ThinScrewdriver],
            Self::SeatMotor => &[Tool::ThinScrewdriver, Tool::Ruler, Tool::MountGlue],
            Self::CloseTriangle if is_seated_early(frame) => &[Tool::MountGlue],
            _ => &[],
        }
    }

    /// What to take care of in a frame.
    pub fn caution(self, frame: &Frame) -> Option<Cow<'static, str>> {
        match self {
            Self::PushArms | Self::PushLeg | Self::PushStruts | Self::PushBottomCage | Self::PushTopCage => {
                Some(cut_rods::when_pushed(frame).into())
            }
            Self::SeatMotor if is_seated_early(frame) => Some(
                "One of this motor's three screws lies above the leg later, where no screwdriver reaches it: turn all three in before the mount goes \
                 onto the arms."
                    .into(),
            ),
            Self::SeatMotor => Some(format!("First slide {}", mount_to_its_place(frame)).into()),
            Self::CloseTriangle if is_seated_early(frame) => Some(format!("Then slide {}", mount_to_its_place(frame)).into()),
            Self::PlugHub => Some("Never glue the plugs to the hub: they are what lets go in a crash.".into()),
            _ => None,
        }
    }

    /// Time for one module, minutes: an estimate of ours.
    pub fn minutes(self) -> f64 {
        match self {
            Self::ThreadKnee | Self::CloseTriangle | Self::SeatMotor => 3.0,
            Self::PlugHub | Self::CloseRing => 4.0,
            Self::CloseTop => 6.0,
            _ => 1.0,
        }
    }
}

/// Whether the motor is screwed onto its mount before that goes onto the arms: of three screws one lies above the leg.
pub(super) fn is_seated_early(frame: &Frame) -> bool {
    frame.bought.get("motor").is_some_and(|motor| motor.part.motor_holes() == 3)
}

/// Where the mount belongs along arms that are home, and what keeps it there.
fn mount_to_its_place(frame: &Frame) -> String {
    format!(
        "the mount along the arms until {:.1} mm of each show between its ring and the fork: that is its place in the design. Nothing \
         else holds it there: put a drop of cyanoacrylate, or a turn of tape, on each arm at the ring.",
        mount_to_fork_mm(frame)
    )
}

/// From the outer face of the motor mount's rings to the mouth of the fork's sockets, along an arm that is home, mm.
fn mount_to_fork_mm(frame: &Frame) -> f64 {
    let mount = &frame.motor_mount;
    frame.fork_bottom_mm() - frame.fork.fork_socket_depth_mm - (mount.motor_position_mm + 0.5 * mount.motor_ring_width_mm)
}
