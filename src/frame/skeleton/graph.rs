//! The frame as a graph: nodes, rods, and the sockets that hold the rods' ends.

use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};
use serde::Serialize;

use super::closure::{Closure, ClosureError};
use super::module::{MODULE_NAMES, ModulePlaces, turn_matrix};
use crate::params::{Frame, PartName};

/// What a rod is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RodRole {
    /// A side of the top or bottom ring: each of them in a square frame, front and back in one that is longer than wide.
    Cage,
    /// The left or right side of a ring, where it is longer than front and back.
    #[serde(rename = "cage_side")]
    CageSide,
    /// From the hub joint to the fork; two a module.
    Arm,
    /// From the hub joint down to the bottom corner.
    Leg,
    /// From the knee to a ring corner.
    Strut,
}

impl RodRole {
    /// Every role.
    pub const ALL: [Self; 5] = [Self::Cage, Self::CageSide, Self::Arm, Self::Leg, Self::Strut];

    /// Whether it is a side of a ring.
    pub fn is_cage(self) -> bool {
        matches!(self, Self::Cage | Self::CageSide)
    }

    /// The name in files.
    pub fn slug(self) -> &'static str {
        match self {
            Self::Cage => "cage",
            Self::CageSide => "cage_side",
            Self::Arm => "arm",
            Self::Leg => "leg",
            Self::Strut => "strut",
        }
    }
}

/// A named point of the skeleton.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// A letter and the module: `T_FR`.
    pub name: String,
    /// Position in frame axes, mm.
    pub position: Point3<f64>,
}

/// A rod, end to end.
#[derive(Clone, Debug, PartialEq)]
pub struct Rod {
    /// Name: role, module, and which of them.
    pub name: String,
    /// Role.
    pub role: RodRole,
    /// One end, mm.
    pub start: Point3<f64>,
    /// The other end, mm.
    pub end: Point3<f64>,
    /// The bores that take the ends: at `start`, at `end`.
    pub sockets: [Socket; 2],
}

/// What rods are sawn to, mm.
pub const SAWN_MM: f64 = 0.5;

impl Rod {
    /// Length, mm.
    pub fn length_mm(&self) -> f64 {
        (self.end - self.start).norm()
    }

    /// Length that it is sawn to, mm: rounded down to half a millimetre, the precision of sawing. The bores take up the rest.
    pub fn sawn_mm(&self) -> f64 {
        (self.length_mm() / SAWN_MM + 1e-6).floor() * SAWN_MM
    }

    /// From its own axes, z along it from its start, to the frame's.
    pub fn pose(&self) -> Isometry3<f64> {
        laid_along(self.start, self.end - self.start)
    }
}

/// The pose of what is modelled along z from the origin, and lies from a point along a direction.
pub fn laid_along(from: Point3<f64>, direction: Vector3<f64>) -> Isometry3<f64> {
    let turn = UnitQuaternion::rotation_between(&Vector3::z(), &direction)
        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
    Isometry3::from_parts(Translation3::from(from.coords), turn)
}

/// A bore that takes a rod's end, as assembled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Socket {
    /// The part it is in.
    pub part: PartName,
    /// Which of the four modules the part belongs to.
    pub module: usize,
    /// Centre of the bore's bottom in frame axes, mm.
    pub bottom: Point3<f64>,
    /// From the bottom out of the mouth.
    pub axis: Unit<Vector3<f64>>,
    /// Depth of the bore, mm.
    pub depth_mm: f64,
    /// Diameter of the bore, mm.
    pub bore_mm: f64,
}

impl Socket {
    /// Name of the body that it is in, as the assembly names it.
    pub fn body_name(&self) -> String {
        format!("{}_{}", self.part.slug(), MODULE_NAMES[self.module % MODULE_NAMES.len()])
    }

    /// Length of the rod inside the bore when its end lies here, mm.
    pub fn engagement_mm(&self, rod_end: &Point3<f64>) -> f64 {
        self.depth_mm - self.axis.dot(&(rod_end - self.bottom))
    }
}

/// The assembled frame as nodes and rods.
#[derive(Clone, Debug, PartialEq)]
pub struct Skeleton {
    /// The dimensions that close it.
    pub closure: Closure,
    /// Named points.
    pub nodes: Vec<Node>,
    /// 28 rods: 8 cage, 8 arm, 4 leg, 8 strut.
    pub rods: Vec<Rod>,
}

/// A point in the plane of the first module's diagonal: out along it, to the left of it, up, mm.
fn on_diagonal(s: f64, left: f64, z: f64) -> Point3<f64> {
    let c = std::f64::consts::FRAC_1_SQRT_2;
    Point3::new(c * (s - left), c * (s + left), z)
}

impl Skeleton {
    /// Between the axes about which the ends of a rod turn when it buckles, mm: of a leg between both hinges, of a strut from the knee's node
    /// to the corner's hinge. `None` of a rod whose ends are held in parts that do not fold there.
    pub fn between_hinges_mm(&self, role: RodRole) -> Option<f64> {
        let c = &self.closure;
        let out = c.ring_half_side_mm * std::f64::consts::SQRT_2;
        match role {
            RodRole::Leg => Some(libm::hypot(out - c.leg_pivot_mm - c.hub_leg_pivot_s_mm, c.ring_half_height_mm)),
            RodRole::Strut => Some(libm::hypot(out + c.strut_pivot_mm - c.knee_s_mm, c.ring_half_height_mm)),
            RodRole::Arm | RodRole::Cage | RodRole::CageSide => None,
        }
    }

    /// Builds and closes the skeleton of a frame.
    ///
    /// # Errors
    /// When the rods cannot close.
    pub fn new(frame: &Frame) -> Result<Self, ClosureError> {
        let closure = Closure::solve(frame)?;
        let (mut nodes, mut rods) = (Vec::new(), Vec::new());
        for (module, name) in MODULE_NAMES.iter().enumerate() {
            let places = &closure.places;
            nodes.extend(
                module_nodes(frame, &closure)
                    .map(|(letter, p)| Node { name: format!("{letter}_{name}"), position: places.point(module, p) }),
            );
            rods.extend(module_rods(frame, &closure).into_iter().map(|rod| rod.placed(places, module)));
        }
        nodes.push(Node { name: "H".into(), position: Point3::origin() });
        Ok(Self { closure, nodes, rods })
    }

    /// The roles that it has rods of.
    pub fn roles(&self) -> Vec<RodRole> {
        RodRole::ALL.into_iter().filter(|role| self.rods_of(*role).next().is_some()).collect()
    }

    /// The rods of a role; they are all as long.
    pub fn rods_of(&self, role: RodRole) -> impl Iterator<Item = &Rod> {
        self.rods.iter().filter(move |rod| rod.role == role)
    }

    /// Length of the rods of a role, mm.
    pub fn length_mm(&self, role: RodRole) -> f64 {
        self.rods_of(role).next().map_or(0.0, Rod::length_mm)
    }

    /// Length that the rods of a role are sawn to, mm.
    pub fn sawn_mm(&self, role: RodRole) -> f64 {
        self.rods_of(role).next().map_or(0.0, Rod::sawn_mm)
    }

    /// A node by name.
    pub fn node(&self, name: &str) -> Option<Point3<f64>> {
        self.nodes.iter().find(|node| node.name == name).map(|node| node.position)
    }
}

fn module_nodes(frame: &Frame, c: &Closure) -> [(&'static str, Point3<f64>); 6] {
    let (a, h) = (c.ring_half_side_mm, c.ring_half_height_mm);
    let joint = &frame.hub_joint;
    let leg_root_s = frame.hub.hub_mouth_mm + joint.hub_leg_mouth_mm - joint.hub_leg_socket_depth_mm - joint.hub_leg_root_mm;
    [
        ("T", Point3::new(a, a, h)),
        ("B", Point3::new(a, a, -h)),
        ("K", on_diagonal(c.knee_s_mm, 0.0, 0.0)),
        ("F", on_diagonal(c.bar_s_mm, 0.0, 0.0)),
        ("C", on_diagonal(leg_root_s, 0.0, 0.0)),
        ("M", on_diagonal(frame.motor_mount.motor_position_mm, 0.0, motor_top_mm(frame))),
    ]
}

/// Height of the motor's seat above the arms, mm.
fn motor_top_mm(frame: &Frame) -> f64 {
    frame.motor_mount.motor_ledge_mm + frame.motor_mount.motor_riser_mm
}

/// A rod of the first module with the socket parts at its ends, before it is turned into its module.
struct ModuleRod {
    role: RodRole,
    suffix: &'static str,
    ends: [ModuleEnd; 2],
}

/// A rod's end and the socket that takes it.
struct ModuleEnd {
    part: PartName,
    /// How many modules further the part belongs to.
    ahead: usize,
    bottom: Point3<f64>,
    axis: Vector3<f64>,
    depth_mm: f64,
    bore_mm: f64,
    /// Free length between the bore's bottom and the rod's end, mm.
    slack_mm: f64,
}

impl ModuleRod {
    fn placed(self, places: &ModulePlaces, module: usize) -> Rod {
        let turn = turn_matrix(module);
        let sockets = self.ends.each_ref().map(|end| {
            let owner = (module + end.ahead) % MODULE_NAMES.len();
            Socket {
                part: end.part,
                module: owner,
                bottom: Point3::from(places.moved(owner, (turn * end.bottom).coords)),
                axis: Unit::new_normalize(turn * end.axis),
                depth_mm: end.depth_mm,
                bore_mm: end.bore_mm,
            }
        });
        let tip = |i: usize| sockets[i].bottom + sockets[i].axis.into_inner() * self.ends[i].slack_mm;
        let name = format!("{}_{}{}", self.role.slug(), MODULE_NAMES[module], self.suffix);
        let is_side = self.role == RodRole::Cage && ModulePlaces::carries_side_rods(module) && places.are_apart();
        Rod { name, role: if is_side { RodRole::CageSide } else { self.role }, start: tip(0), end: tip(1), sockets }
    }
}

fn module_rods(frame: &Frame, c: &Closure) -> Vec<ModuleRod> {
    let mut rods = Vec::with_capacity(7);
    for (suffix, z, part) in
        [("_top", c.ring_half_height_mm, PartName::TopCorner), ("_bottom", -c.ring_half_height_mm, PartName::BottomCorner)]
    {
        rods.push(cage_rod(frame, c, suffix, z, part));
        rods.push(strut_rod(frame, c, suffix, z, part));
    }
    for (suffix, side) in [("_left", 1.0), ("_right", -1.0)] {
        rods.push(arm_rod(frame, c, suffix, side));
    }
    rods.push(leg_rod(frame, c));
    rods
}

/// From this module's ring corner to that of the next module, counter-clockwise seen from above.
fn cage_rod(frame: &Frame, c: &Closure, suffix: &'static str, z: f64, part: PartName) -> ModuleRod {
    let a = c.ring_half_side_mm;
    let from_node = frame.corner.corner_node_to_bottom_mm;
    let end = |x: f64, ahead: usize| ModuleEnd {
        part,
        ahead,
        bottom: Point3::new(x - x.signum() * from_node, a, z),
        axis: Vector3::new(-x.signum(), 0.0, 0.0),
        depth_mm: frame.corner.corner_socket_depth_mm,
        bore_mm: frame.grip_bore_mm(),
        slack_mm: 0.0,
    };
    ModuleRod { role: RodRole::Cage, suffix, ends: [end(a, 0), end(-a, 1)] }
}

fn strut_rod(frame: &Frame, c: &Closure, suffix: &'static str, z: f64, part: PartName) -> ModuleRod {
    let pivot = on_diagonal(c.ring_half_side_mm * std::f64::consts::SQRT_2 + c.strut_pivot_mm, 0.0, z);
    let knee = on_diagonal(c.knee_s_mm, 0.0, 0.0);
    let up = (pivot - knee).normalize();
    let at_knee = ModuleEnd {
        part: PartName::Knee,
        ahead: 0,
        bottom: knee + up * frame.knee.knee_node_to_bottom_mm,
        axis: up,
        depth_mm: frame.knee.knee_socket_depth_mm,
        bore_mm: frame.grip_bore_mm(),
        slack_mm: 0.0,
    };
    let at_corner = ModuleEnd {
        part,
        ahead: 0,
        bottom: pivot - up * (frame.corner.corner_node_to_bottom_mm - c.strut_pivot_mm),
        axis: -up,
        depth_mm: frame.corner.corner_socket_depth_mm,
        bore_mm: frame.grip_bore_mm(),
        slack_mm: 0.0,
    };
    ModuleRod { role: RodRole::Strut, suffix, ends: [at_knee, at_corner] }
}

fn arm_rod(frame: &Frame, c: &Closure, suffix: &'static str, side: f64) -> ModuleRod {
    let lateral = 0.5 * side * frame.hub_joint.arm_pitch_mm;
    let out = on_diagonal(1.0, 0.0, 0.0).coords;
    let at_hub = ModuleEnd {
        part: PartName::HubJoint,
        ahead: 0,
        bottom: on_diagonal(frame.hub.hub_mouth_mm, lateral, 0.0),
        axis: out,
        depth_mm: frame.hub_joint.hub_arm_socket_depth_mm,
        bore_mm: frame.slide_bore_mm(),
        slack_mm: 0.0,
    };
    let at_fork = ModuleEnd {
        part: PartName::Fork,
        ahead: 0,
        bottom: on_diagonal(c.fork_bottom_s_mm, lateral, 0.0),
        axis: -out,
        depth_mm: frame.fork.fork_socket_depth_mm,
        bore_mm: frame.grip_bore_mm(),
        slack_mm: frame.rods.arm_rod_slack_mm,
    };
    ModuleRod { role: RodRole::Arm, suffix, ends: [at_hub, at_fork] }
}

fn leg_rod(frame: &Frame, c: &Closure) -> ModuleRod {
    let hub_pivot = on_diagonal(c.hub_leg_pivot_s_mm, 0.0, 0.0);
    let corner_pivot = on_diagonal(c.ring_half_side_mm * std::f64::consts::SQRT_2 - c.leg_pivot_mm, 0.0, -c.ring_half_height_mm);
    let down = (corner_pivot - hub_pivot).normalize();
    let at_hub = ModuleEnd {
        part: PartName::HubJoint,
        ahead: 0,
        bottom: hub_pivot + down * frame.hub_joint.hub_leg_pivot_mm,
        axis: down,
        depth_mm: frame.hub_joint.hub_leg_socket_depth_mm,
        bore_mm: frame.slide_bore_mm(),
        slack_mm: 0.0,
    };
    let at_corner = ModuleEnd {
        part: PartName::BottomCorner,
        ahead: 0,
        bottom: corner_pivot - down * (frame.corner.corner_leg_bottom_mm - c.leg_pivot_mm),
        axis: -down,
        depth_mm: frame.corner.corner_socket_depth_mm,
        bore_mm: frame.grip_bore_mm(),
        slack_mm: 0.0,
    };
    ModuleRod { role: RodRole::Leg, suffix: "", ends: [at_hub, at_corner] }
}
