//! MJCF, the format of MuJoCo (tested with MuJoCo 4.0): the frame as one free body, and a scene with a floor.
//!
//! **Legs.** Each foot is a sphere with a contact of its own. MuJoCo takes stiffness and damping of a contact by the unit of its
//! effective mass when `solref` is negative, and mixes what it computes with them by the impedance d of `solimp`: with a constant d the
//! force of a contact is m (stiffness r + damping v) / (1 - d) + d (what holds the body without them). So d is the least that it takes,
//! 0.0001, and `solref` holds a quarter of the frame's stiffness and damping over its whole mass. A load that is added scales both.
//!
//! **Motors.** `ctrl` is the thrust in N. The torque about the axis follows by the gear.

use std::io;

use super::figures::{number, numbers};
use super::model::{Motor, RigidBody, SimulatorModel};
use super::xml::{Xml, comment, document, empty, within};
use crate::units::GRAVITY_M_S2;

/// Step of the simulation, s. A foot that falls from 1.5 m moves 0.5 mm in a step, so the first force has that much of the spring in it:
/// 1 to 2 % of the peak.
const STEP_S: f64 = 0.0001;
/// The least impedance that MuJoCo takes.
const IMPEDANCE: &str = "0.0001 0.0001 0.001";
/// Time constant, s, and damping ratio of the contact of what is rigid: a choice, ten times as stiff as MuJoCo's own. With that one
/// a contact gives less than the feet do, and the sleeve would sink into the ground.
const RIGID: &str = "0.002 1";
/// Contacts are as stiff as stated here, whatever the frame stands on or hits.
const PRIORITY: (&str, &str) = ("priority", "1");
/// The group of contact shapes that viewers do not show until they are asked to.
const HIDDEN: (&str, &str) = ("group", "3");
/// What nothing touches: it is for the eye.
const SEEN: [(&str, &str); 2] = [("contype", "0"), ("conaffinity", "0")];
/// Height of the disc that represents a propeller, m: a visual shape only.
const DISC_M: f64 = 0.002;

/// The frame.
pub(super) fn frame(model: &SimulatorModel) -> io::Result<Vec<u8>> {
    document("mujoco", &[("model", &model.name)], |xml| {
        comment(xml, "SI units; x front, y left, z up, origin at the hub; docs/simulators.md says what is estimated")?;
        empty(xml, "compiler", &[("angle", "radian"), ("autolimits", "true")])?;
        let gravity = numbers([0.0, 0.0, -GRAVITY_M_S2]);
        let option =
            [("timestep", number(STEP_S)), ("gravity", gravity), ("integrator", "implicitfast".into()), ("cone", "elliptic".into())];
        empty_of(xml, "option", &option)?;
        custom(xml, model)?;
        assets(xml, model)?;
        within(xml, "worldbody", &[], |xml| body(xml, model))?;
        within(xml, "actuator", &[], |xml| in_order(model).try_for_each(|motor| actuator(xml, motor)))?;
        within(xml, "sensor", &[], |xml| {
            empty(xml, "accelerometer", &[("name", "imu_accelerometer"), ("site", "imu")])?;
            empty(xml, "gyro", &[("name", "imu_gyro"), ("site", "imu")])?;
            empty(xml, "framequat", &[("name", "imu_attitude"), ("objtype", "site"), ("objname", "imu")])
        })
    })
}

/// The frame above a floor, with the hover as a key frame.
pub(super) fn scene(model: &SimulatorModel) -> io::Result<Vec<u8>> {
    document("mujoco", &[("model", &format!("{} scene", model.name))], |xml| {
        empty(xml, "include", &[("file", "frame.xml")])?;
        within(xml, "worldbody", &[], |xml| {
            empty(xml, "light", &[("pos", "0 0 3"), ("dir", "0 0 -1")])?;
            empty(xml, "geom", &[("name", "floor"), ("type", "plane"), ("size", "0 0 0.05"), ("rgba", "0.8 0.8 0.8 1")])
        })?;
        within(xml, "keyframe", &[], |xml| {
            let pose = numbers([0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
            let thrusts = numbers(in_order(model).map(|motor| motor.hover_thrust_n));
            empty(xml, "key", &[("name", "hover"), ("qpos", &pose), ("ctrl", &thrusts)])
        })
    })
}

/// An empty element whose values are made here.
fn empty_of(xml: &mut Xml, name: &str, attributes: &[(&str, String)]) -> io::Result<()> {
    let borrowed: Vec<(&str, &str)> = attributes.iter().map(|(key, value)| (*key, value.as_str())).collect();
    empty(xml, name, &borrowed)
}

/// The motors in the order of their numbers.
fn in_order(model: &SimulatorModel) -> impl Iterator<Item = &Motor> {
    let mut motors: Vec<&Motor> = model.motors.iter().collect();
    motors.sort_by_key(|motor| motor.number);
    motors.into_iter()
}

/// What MJCF has no element for.
fn custom(xml: &mut Xml, model: &SimulatorModel) -> io::Result<()> {
    within(xml, "custom", &[], |xml| {
        let lists = [
            ("propeller_diameter_m", numbers(in_order(model).map(|motor| motor.propeller_diameter_m))),
            ("torque_over_thrust_m", numbers(in_order(model).map(|motor| motor.torque_over_thrust_m))),
            ("leg_stiffness_n_m", number(model.legs.stiffness_n_m)),
            ("leg_damping_n_s_m", number(model.legs.damping_n_s_m)),
        ];
        for (name, data) in &lists {
            empty(xml, "numeric", &[("name", name), ("data", data)])?;
        }
        let spins: Vec<&str> = in_order(model).map(|motor| motor.spin.abbreviation()).collect();
        empty(xml, "text", &[("name", "motor_spin"), ("data", &spins.join(" "))])?;
        if let Some(propeller) = model.motors.iter().find_map(|motor| motor.propeller.as_deref()) {
            empty(xml, "text", &[("name", "propeller"), ("data", propeller)])?;
        }
        empty(xml, "text", &[("name", "generator"), ("data", &model.generator)])
    })
}

fn assets(xml: &mut Xml, model: &SimulatorModel) -> io::Result<()> {
    within(xml, "asset", &[], |xml| {
        model.shapes.iter().try_for_each(|shape| {
            let vertices = numbers(shape.vertices_m.iter().flatten().copied());
            empty(xml, "mesh", &[("name", &shape.name), ("vertex", &vertices)])
        })
    })
}

fn body(xml: &mut Xml, model: &SimulatorModel) -> io::Result<()> {
    let height = numbers([0.0, 0.0, model.standing_height_m]);
    within(xml, "body", &[("name", "frame"), ("pos", &height)], |xml| {
        empty(xml, "freejoint", &[("name", "free")])?;
        inertial(xml, &model.frame, [0.0; 3])?;
        for shape in &model.shapes {
            let geom = [
                ("name", shape.name.as_str()),
                ("type", "mesh"),
                ("mesh", &shape.name),
                PRIORITY,
                ("solref", RIGID),
                HIDDEN,
                ("rgba", "0.3 0.5 0.8 0.3"),
            ];
            empty(xml, "geom", &geom)?;
        }
        rods(xml, model)?;
        feet(xml, model)?;
        let imu = numbers(model.imu.position_m);
        empty(xml, "site", &[("name", "imu"), ("pos", &imu), ("size", "0.003"), ("rgba", "0.8 0.1 0.1 1")])?;
        for motor in &model.motors {
            let at = numbers(motor.position_m);
            empty(xml, "site", &[("name", &motor.name), ("pos", &at), ("size", "0.003"), ("rgba", "0.1 0.1 0.1 1")])?;
        }
        model
            .motors
            .iter()
            .filter_map(|motor| Some((motor, motor.body.as_ref()?)))
            .try_for_each(|(motor, body)| propeller(xml, motor, body))
    })
}

/// The rods, to be seen.
fn rods(xml: &mut Xml, model: &SimulatorModel) -> io::Result<()> {
    for rod in &model.rods {
        let (ends, radius) = (numbers(rod.from_m.into_iter().chain(rod.to_m)), number(rod.radius_m));
        let geom = [("type", "capsule"), ("fromto", ends.as_str()), ("size", &radius), ("rgba", "0.15 0.15 0.15 1")];
        empty(xml, "geom", &[&geom[..], &SEEN].concat())?;
    }
    Ok(())
}

/// The spheres that the frame stands on, each with its share of the legs.
fn feet(xml: &mut Xml, model: &SimulatorModel) -> io::Result<()> {
    let share = model.feet.len() as f64 * model.whole.mass_kg;
    let spring = numbers([-model.legs.stiffness_n_m / share, -model.legs.damping_n_s_m / share]);
    for foot in &model.feet {
        let (at, radius) = (numbers(foot.position_m), number(foot.radius_m));
        let geom = [("name", foot.name.as_str()), ("type", "sphere"), ("size", &radius), ("pos", &at), PRIORITY];
        let contact = [("solref", spring.as_str()), ("solimp", IMPEDANCE), ("rgba", "0.1 0.1 0.1 1")];
        empty(xml, "geom", &[&geom[..], &contact[..]].concat())?;
    }
    Ok(())
}

/// A propeller: fixed, as its rotation is in the motor's torque.
fn propeller(xml: &mut Xml, motor: &Motor, body: &RigidBody) -> io::Result<()> {
    let at = numbers(motor.position_m);
    within(xml, "body", &[("name", &body.name), ("pos", &at)], |xml| {
        inertial(xml, body, motor.position_m)?;
        let size = numbers([0.5 * motor.propeller_diameter_m, 0.5 * DISC_M]);
        let disc = [("type", "cylinder"), ("size", size.as_str()), ("rgba", "0.9 0.6 0.1 0.4")];
        empty(xml, "geom", &[&disc[..], &SEEN].concat())
    })
}

/// Mass and inertia of a body whose origin is here.
fn inertial(xml: &mut Xml, body: &RigidBody, origin_m: [f64; 3]) -> io::Result<()> {
    let at = numbers([0, 1, 2].map(|axis| body.centre_m[axis] - origin_m[axis]));
    let (mass, inertia) = (number(body.mass_kg), numbers(body.inertia_terms()));
    empty(xml, "inertial", &[("pos", &at), ("mass", &mass), ("fullinertia", &inertia)])
}

fn actuator(xml: &mut Xml, motor: &Motor) -> io::Result<()> {
    let [x, y, z] = motor.axis;
    let torque = motor.spin.reaction() * motor.torque_over_thrust_m;
    let gear = numbers([x, y, z, torque * x, torque * y, torque * z]);
    let name = format!("motor_{}", motor.number);
    empty(xml, "motor", &[("name", &name), ("site", &motor.name), ("gear", &gear)])
}
