//! The model of a frame for simulators: one record, SI, x front, y left, z up, origin at the hub.

use nalgebra::{Matrix4, Point3, Vector4};
use serde::Serialize;

use super::axes::{inertia_kg_m2, point_m};
use super::convex_shape::{ConvexShape, shapes};
use super::figures::rounded;
use super::propeller::torque_over_thrust_m;
use crate::frame::assembly::mass::{Lump, MassTable, lump_of};
use crate::frame::assembly::{Body, BodyKind, Design};
use crate::frame::skeleton::{MODULE_NAMES, ROTORS, Rod, Spin, Stack};
use crate::params::frame::Extra;
use crate::units::GRAVITY_M_S2;

/// A rigid body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RigidBody {
    /// `frame`, or the propeller's motor.
    pub name: String,
    /// Mass, kg.
    pub mass_kg: f64,
    /// Centre of mass, m.
    pub centre_m: [f64; 3],
    /// Inertia about the centre of mass, kg m², row by row.
    pub inertia_kg_m2: [[f64; 3]; 3],
}

impl RigidBody {
    fn of(name: impl Into<String>, lump: &Lump) -> Self {
        Self {
            name: name.into(),
            mass_kg: rounded(lump.mass_g * 1e-3),
            centre_m: point_m(lump.centre_mm),
            inertia_kg_m2: inertia_kg_m2(&lump.inertia_g_mm2),
        }
    }

    /// Its six numbers: xx, yy, zz, xy, xz, yz, kg m².
    pub(super) fn inertia_terms(&self) -> [f64; 6] {
        let i = &self.inertia_kg_m2;
        [i[0][0], i[1][1], i[2][2], i[0][1], i[0][2], i[1][2]]
    }
}

/// A motor with its propeller.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Motor {
    /// `motor_FR`, `motor_FL`, `motor_BL`, `motor_BR`.
    pub name: String,
    /// Number in Betaflight's order.
    pub number: u32,
    /// Direction of rotation seen from above, Betaflight's "props in".
    pub spin: Spin,
    /// Where the thrust acts: on the motor's axis in the middle of the propeller, m.
    pub position_m: [f64; 3],
    /// Direction of the thrust and of the axis.
    pub axis: [f64; 3],
    /// Catalogue name of the motor.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motor: Option<String>,
    /// Catalogue name of the propeller.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub propeller: Option<String>,
    /// Diameter of the disc that it sweeps, m.
    pub propeller_diameter_m: f64,
    /// Torque over thrust, m: an estimate from the diameter.
    pub torque_over_thrust_m: f64,
    /// The propeller as a body of its own; none where its mass is in another line of the mass table.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body: Option<RigidBody>,
    /// Thrust in a hover with level attitude, N: the four balance weight, roll, pitch and yaw.
    pub hover_thrust_n: f64,
}

/// Where the inertial sensor is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Imu {
    /// What carries it: `flight_controller`, `motor_controller` where that board is both, the extra that stands for it and has a place of its own, or
    /// `hub` where the frame has none of them.
    pub on: String,
    /// Middle of the circuit board, m. Its axes are those of the frame.
    pub position_m: [f64; 3],
}

/// The four legs as one spring under the centre.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LegSpring {
    /// Which numbers these are: an impact model's name, or `frame` for the frame's own geometry.
    pub from: String,
    /// Stiffness of the frame on its four feet, N/m.
    pub stiffness_n_m: f64,
    /// Damping, N s/m.
    pub damping_n_s_m: f64,
    /// What has to be said of the numbers: that nobody states the modulus of the frame's material.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doubt: Option<String>,
}

/// A sphere about a node of the lower ring that touches the ground.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Foot {
    /// `foot_FR` and so on.
    pub name: String,
    /// Its middle, m.
    pub position_m: [f64; 3],
    /// Its radius, m.
    pub radius_m: f64,
}

/// A rod, to be seen.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeenRod {
    /// Its name.
    pub name: String,
    /// One end, m.
    pub from_m: [f64; 3],
    /// The other end, m.
    pub to_m: [f64; 3],
    /// Its radius, m.
    pub radius_m: f64,
}

/// A frame for simulators.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SimulatorModel {
    /// Version of this record's keys.
    pub schema_version: u32,
    /// The frame's name.
    pub name: String,
    /// One line about it.
    pub description: String,
    /// Program and version.
    pub generator: String,
    /// The axes of every number here.
    pub axes: &'static str,
    /// All bodies together.
    pub whole: RigidBody,
    /// All but the propellers that are bodies of their own.
    pub frame: RigidBody,
    /// The motors, counter-clockwise from the front right.
    pub motors: Vec<Motor>,
    /// The inertial sensor.
    pub imu: Imu,
    /// The legs.
    pub legs: LegSpring,
    /// The feet, in the order of the motors.
    pub feet: Vec<Foot>,
    /// Height of the origin above the ground when the frame stands, m.
    pub standing_height_m: f64,
    /// The rods; their masses are in the frame's.
    pub rods: Vec<SeenRod>,
    /// Shapes for contact; they belong to the frame.
    pub shapes: Vec<ConvexShape>,
}

impl SimulatorModel {
    /// The model of a design.
    pub(super) fn new(design: &Design, masses: &MassTable, legs: LegSpring) -> Self {
        let is_propeller = |body: &Body| design.shape(body).kind == BodyKind::Propeller;
        let weighed = |carries: &dyn Fn(Option<&Body>) -> bool| lump_of(design, &masses.lines, carries);
        let whole = RigidBody::of("whole", &weighed(&|_| true));
        let mut motors: Vec<Motor> = (0..4).filter_map(|module| motor(design, masses, module)).collect();
        balance(&mut motors, &whole);
        let ground_mm = design.ground_mm().unwrap_or(0.0);
        Self {
            schema_version: 1,
            name: design.frame.name.clone(),
            description: design.frame.description.clone(),
            generator: format!("flexframe {}", env!("CARGO_PKG_VERSION")),
            axes: "x front, y left, z up, origin at the hub; m, kg, s, N",
            whole,
            frame: RigidBody::of("frame", &weighed(&|body| !body.is_some_and(is_propeller))),
            motors,
            imu: imu(design),
            legs,
            feet: feet(design, ground_mm),
            standing_height_m: rounded(-ground_mm * 1e-3),
            rods: rods(design),
            shapes: shapes(design),
        }
    }
}

fn motor(design: &Design, masses: &MassTable, module: usize) -> Option<Motor> {
    let frame = &design.frame;
    let seat = design.skeleton.node(&format!("M_{}", MODULE_NAMES[module]))?;
    let name = format!("motor_{}", MODULE_NAMES[module]);
    let named = |role: &str| frame.bought.get(role).map(|item| item.name.clone());
    let diameter_m = rounded(frame.motor_mount.propeller_diameter_mm * 1e-3);
    let turns = |body: Option<&Body>| body.is_some_and(|b| b.module == Some(module) && design.shape(b).kind == BodyKind::Propeller);
    let propeller = lump_of(design, &masses.lines, &turns);
    Some(Motor {
        number: ROTORS[module].number,
        spin: ROTORS[module].spin,
        position_m: point_m(Point3::new(seat.x, seat.y, seat.z + frame.motor_mount.propeller_height_mm)),
        axis: [0.0, 0.0, 1.0],
        motor: named("motor"),
        propeller: named("propeller"),
        propeller_diameter_m: diameter_m,
        torque_over_thrust_m: rounded(torque_over_thrust_m(diameter_m)),
        body: (propeller.mass_g > 0.0).then(|| RigidBody::of(format!("propeller_{}", MODULE_NAMES[module]), &propeller)),
        hover_thrust_n: 0.0,
        name,
    })
}

/// The thrusts that hold the frame level: their sum is its weight, and they turn it about no axis through its centre of mass.
/// Motors stand on the corners of a rectangle, so there is one solution.
fn balance(motors: &mut [Motor], whole: &RigidBody) {
    let [cx, cy, _] = whole.centre_m;
    let Ok(four) = <&mut [Motor; 4]>::try_from(motors) else { return };
    let row = |of: &dyn Fn(&Motor) -> f64| [0, 1, 2, 3].map(|at| of(&four[at]));
    let rows = [
        row(&|_| 1.0),
        row(&|motor| motor.position_m[0] - cx),
        row(&|motor| motor.position_m[1] - cy),
        row(&|motor| motor.spin.reaction() * motor.torque_over_thrust_m),
    ];
    let weight = Vector4::new(whole.mass_kg * GRAVITY_M_S2, 0.0, 0.0, 0.0);
    let Some(thrusts_n) = Matrix4::from_fn(|i, j| rows[i][j]).lu().solve(&weight) else { return };
    for (motor, thrust_n) in four.iter_mut().zip(thrusts_n.iter()) {
        motor.hover_thrust_n = rounded(*thrust_n);
    }
}

fn imu(design: &Design) -> Imu {
    let stack = Stack::new(&design.frame, &design.centre);
    let role = if design.frame.is_all_in_one() { "motor_controller" } else { "flight_controller" };
    if let Some(board) = stack.boards.iter().find(|board| board.role == role) {
        return Imu { on: board.role.into(), position_m: point_m(Point3::new(0.0, 0.0, board.middle_mm)) };
    }
    // A board that an extra stands for is where that is, if a place is stated; all else is at the hub.
    let stands_for = |extra: &Extra| extra.position_mm.filter(|_| extra.covers.iter().any(|covered| covered == role));
    let extra = design.frame.extras.iter().find_map(|(name, extra)| Some((name.as_str(), stands_for(extra)?)));
    let (on, position_mm) = extra.unwrap_or(("hub", [0.0; 3]));
    Imu { on: on.into(), position_m: point_m(position_mm.into()) }
}

fn feet(design: &Design, ground_mm: f64) -> Vec<Foot> {
    let foot = |quadrant: &&str| {
        let node = design.skeleton.node(&format!("B_{quadrant}"))?;
        Some(Foot { name: format!("foot_{quadrant}"), position_m: point_m(node), radius_m: rounded((node.z - ground_mm) * 1e-3) })
    };
    MODULE_NAMES.iter().filter_map(foot).collect()
}

fn rods(design: &Design) -> Vec<SeenRod> {
    let radius_m = rounded(0.5e-3 * design.frame.rods.rod_diameter_mm);
    let seen = |rod: &Rod| SeenRod { name: rod.name.clone(), from_m: point_m(rod.start), to_m: point_m(rod.end), radius_m };
    design.skeleton.rods.iter().map(seen).collect()
}
