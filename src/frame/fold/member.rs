//! The bodies of a module, and the solids that stand for them while a sequence is looked for.

use nalgebra::{Isometry3, Point3, Vector3};

use crate::frame::skeleton::{MODULE_NAMES, Rod, RodRole, Skeleton};
use crate::params::{Frame, PartName};
use crate::units::Angle;

/// A body that a module brings, or the hub.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Member {
    /// The joint that plugs into the hub.
    HubJoint,
    /// Arm rods, left and right.
    Arm(bool),
    /// Leg rod.
    Leg,
    /// Motor mount.
    Mount,
    /// Fork.
    Fork,
    /// Knee.
    Knee,
    /// Strut rods, upper and lower.
    Strut(bool),
    /// Top corner (true) and bottom corner.
    Corner(bool),
    /// Cage rod to the next module, of the top (true) and the bottom ring.
    Cage(bool),
    /// Motor.
    Motor,
    /// The motor's screws.
    MotorScrews,
    /// The plate in the middle.
    Hub,
}

impl Member {
    /// Every member.
    pub const ALL: [Self; 16] = [
        Self::HubJoint,
        Self::Arm(true),
        Self::Arm(false),
        Self::Leg,
        Self::Mount,
        Self::Fork,
        Self::Knee,
        Self::Strut(true),
        Self::Strut(false),
        Self::Corner(true),
        Self::Corner(false),
        Self::Cage(true),
        Self::Cage(false),
        Self::Motor,
        Self::MotorScrews,
        Self::Hub,
    ];

    /// Name of the body in a module of the design.
    pub fn body(self, module: usize) -> String {
        let m = MODULE_NAMES[module];
        let side = |up: bool| if up { "top" } else { "bottom" };
        match self {
            Self::HubJoint => format!("hub_joint_{m}"),
            Self::Arm(left) => format!("arm_{m}_{}", if left { "left" } else { "right" }),
            Self::Leg => format!("leg_{m}"),
            Self::Mount => format!("motor_mount_{m}"),
            Self::Fork => format!("fork_{m}"),
            Self::Knee => format!("knee_{m}"),
            Self::Strut(up) => format!("strut_{m}_{}", side(up)),
            Self::Corner(up) => format!("{}_corner_{m}", side(up)),
            Self::Cage(up) => format!("cage_{m}_{}", side(up)),
            Self::Motor => format!("motor_{m}"),
            Self::MotorScrews => format!("motor_screw_{m}"),
            Self::Hub => "hub".into(),
        }
    }

    /// The printed part it is, if it is one.
    pub fn part(self) -> Option<PartName> {
        Some(match self {
            Self::HubJoint => PartName::HubJoint,
            Self::Mount => PartName::MotorMount,
            Self::Fork => PartName::Fork,
            Self::Knee => PartName::Knee,
            Self::Corner(true) => PartName::TopCorner,
            Self::Corner(false) => PartName::BottomCorner,
            Self::Hub => PartName::Hub,
            Self::Arm(_) | Self::Leg | Self::Strut(_) | Self::Cage(_) | Self::Motor | Self::MotorScrews => {
                return None;
            }
        })
    }

    /// The rod it is in the first module, if it is one.
    pub fn rod(self) -> Option<RodRole> {
        Some(match self {
            Self::Arm(_) => RodRole::Arm,
            Self::Leg => RodRole::Leg,
            Self::Strut(_) => RodRole::Strut,
            Self::Cage(_) => RodRole::Cage,
            Self::HubJoint | Self::Mount | Self::Fork | Self::Knee | Self::Corner(_) | Self::Motor | Self::MotorScrews | Self::Hub => {
                return None;
            }
        })
    }
}

/// Which side of a hinge something is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// What the body's pose moves.
    Base,
    /// Beyond the first hinge: a corner's strut, the hub joint's leg.
    First,
    /// Beyond the second: the bottom corner's leg.
    Second,
}

/// A rod with round ends that lies within a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// Where.
    pub side: Side,
    /// Ends of its axis, in the body's axes, mm.
    pub ends: [Point3<f64>; 2],
    /// Radius, mm.
    pub radius_mm: f64,
}

impl Capsule {
    fn new(side: Side, a: [f64; 3], b: [f64; 3], radius_mm: f64) -> Self {
        Self { side, ends: [a.into(), b.into()], radius_mm }
    }

    /// Its axis where it stands.
    pub fn placed(&self, pose: &Isometry3<f64>) -> [Point3<f64>; 2] {
        self.ends.map(|p| pose * p)
    }
}

/// Distance of two line segments, mm (C. Ericson, Real-Time Collision Detection, 2005, section 5.1.9).
pub fn distance_mm(a: &[Point3<f64>; 2], b: &[Point3<f64>; 2]) -> f64 {
    let (d1, d2, r) = (a[1] - a[0], b[1] - b[0], a[0] - b[0]);
    let (aa, ee, f) = (d1.norm_squared().max(1e-12), d2.norm_squared().max(1e-12), d2.dot(&r));
    let (c, bb) = (d1.dot(&r), d1.dot(&d2));
    let denominator = aa * ee - bb * bb;
    let mut s = if denominator > 1e-12 { ((bb * f - c * ee) / denominator).clamp(0.0, 1.0) } else { 0.0 };
    let mut t = (bb * s + f) / ee;
    if !(0.0..=1.0).contains(&t) {
        t = t.clamp(0.0, 1.0);
        s = ((bb * t - c) / aa).clamp(0.0, 1.0);
    }
    ((a[0] + d1 * s) - (b[0] + d2 * t)).norm()
}

/// The capsules that stand for a member: they lie within it, so that what they meet is met.
pub fn capsules(member: Member, frame: &Frame, skeleton: &Skeleton) -> Vec<Capsule> {
    let half_pitch = 0.5 * frame.hub_joint.arm_pitch_mm;
    let base = |a, b, r| Capsule::new(Side::Base, a, b, r);
    if let Some(role) = member.rod() {
        let r = 0.5 * frame.rods.rod_diameter_mm;
        // Of cage rods the longest: what is free for it is free for all.
        let alike = skeleton.rods.iter().filter(|rod| rod.role == role || rod.role.is_cage() && role.is_cage());
        let length_mm = alike.map(Rod::length_mm).fold(0.0, f64::max);
        return vec![base([0.0, 0.0, r], [0.0, 0.0, length_mm - r], r)];
    }
    match member {
        Member::HubJoint => {
            let (r, joint) = (0.5 * frame.hub_joint.hub_joint_diameter_mm, &frame.hub_joint);
            let arm = |y: f64| base([r - joint.plug_length_mm, y, 0.0], [joint.hub_arm_socket_depth_mm - r, y, 0.0], r);
            vec![arm(half_pitch), arm(-half_pitch)]
        }
        Member::Mount => mount(frame),
        Member::Fork => {
            let (fork, r) = (&frame.fork, 0.4 * frame.fork.fork_bar_height_mm);
            let back = -fork.fork_reach_mm;
            let tube = |y: f64| base([back - fork.fork_socket_depth_mm + r, y, 0.0], [back, y, 0.0], r);
            let bar = 0.45 * fork.fork_bar_depth_mm;
            let across = base([fork.fork_bar_offset_mm, -half_pitch * 0.5, 0.0], [fork.fork_bar_offset_mm, half_pitch * 0.5, 0.0], bar);
            vec![tube(half_pitch), tube(-half_pitch), across]
        }
        Member::Knee => {
            let (knee, tilt) = (&frame.knee, skeleton.closure.strut_tilt);
            let r = 0.5 * frame.grip_bore_mm() + knee.knee_back_wall_mm.min(knee.knee_side_wall_mm);
            let end = knee.knee_node_to_bottom_mm + knee.knee_socket_depth_mm - r;
            let tube = |up: f64| base([0.0; 3], [end * tilt.sin(), 0.0, up * end * tilt.cos()], r);
            vec![tube(1.0), tube(-1.0)]
        }
        Member::Corner(up) => corner(up, frame, skeleton.closure.corner_radius_mm),
        // Rods are above; what stands for no capsule is met by no other while a sequence is looked for.
        Member::Arm(_) | Member::Leg | Member::Strut(_) | Member::Cage(_) | Member::Motor | Member::MotorScrews | Member::Hub => Vec::new(),
    }
}

fn mount(frame: &Frame) -> Vec<Capsule> {
    let (mount, y) = (&frame.motor_mount, 0.5 * frame.hub_joint.arm_pitch_mm);
    let (r, half) = (0.5 * mount.motor_ring_diameter_mm, 0.5 * mount.motor_ring_width_mm);
    let thick_mm = r.min(half);
    let ring = |y: f64| Capsule::new(Side::Base, [thick_mm - half, y, 0.0], [half - thick_mm, y, 0.0], thick_mm);
    let top = mount.motor_ledge_mm + mount.motor_riser_mm;
    let thick = 0.5 * mount.motor_plate_thickness_mm;
    let reach = 0.5 * mount.motor_plate_diameter_mm - thick;
    let across = Capsule::new(Side::Base, [0.0, -reach, top - thick], [0.0, reach, top - thick], thick);
    vec![ring(y), ring(-y), across]
}

fn corner(up: bool, frame: &Frame, r: f64) -> Vec<Capsule> {
    let end = frame.corner.corner_node_to_bottom_mm + frame.corner.corner_socket_depth_mm - r;
    let start = frame.corner.corner_node_to_bottom_mm.min(end - 0.1);
    let d = Angle::deg(45.0).cos();
    let mut all = vec![
        Capsule::new(Side::Base, [start, 0.0, 0.0], [end, 0.0, 0.0], r),
        Capsule::new(Side::Base, [0.0, start, 0.0], [0.0, end, 0.0], r),
        Capsule::new(Side::First, [-start * d, -start * d, 0.0], [-end * d, -end * d, 0.0], r),
    ];
    if !up {
        let end = frame.corner.corner_leg_bottom_mm + frame.corner.corner_socket_depth_mm - r;
        let start = frame.corner.corner_leg_bottom_mm.min(end - 0.1);
        all.push(Capsule::new(Side::Second, [start * d, start * d, 0.0], [end * d, end * d, 0.0], r));
    }
    all
}

/// The direction across the arms of the first module, to the left seen from above.
pub fn left() -> Vector3<f64> {
    Vector3::new(-1.0, 1.0, 0.0).normalize()
}

/// Outward along the first module's diagonal.
pub fn outward() -> Vector3<f64> {
    Vector3::new(1.0, 1.0, 0.0).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::parts::{Fold, catalogue};

    #[test]
    fn analytic_every_part_that_moves_is_a_member() {
        for part in catalogue() {
            let member = Member::ALL.into_iter().find(|member| member.part() == Some(part.name));
            let moves = matches!(part.fold, Fold::Bends(_) | Fold::Moves);
            assert!(member.is_some_and(|member| member != Member::Hub) == moves, "{}: {member:?}", part.name);
        }
    }
}
