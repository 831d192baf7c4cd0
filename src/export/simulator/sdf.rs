//! SDFormat 1.9 (sdformat.org), the format of Gazebo: a model, and the file by which Gazebo finds it.
//!
//! A foot's contact has the leg's stiffness and damping as ODE's `kp` and `kd`. Engines without ODE do not read them.

use std::io;

use super::figures::{number, numbers};
use super::model::{Motor, RigidBody, SimulatorModel};
use super::xml::{Attributes, Xml, attributed_text, comment, document, text, within};

/// Version of the format.
const VERSION: &str = "1.9";
/// Samples a second of the inertial sensor, Hz: a choice.
const IMU_HZ: &str = "1000";

/// The model.
pub(super) fn model(model: &SimulatorModel) -> io::Result<Vec<u8>> {
    document("sdf", &[("version", VERSION)], |xml| {
        within(xml, "model", &[("name", &model.name), ("canonical_link", "base_link")], |xml| {
            comment(xml, "SI units; x front, y left, z up, origin at the hub; docs/simulators.md says what is estimated")?;
            pose(xml, &[], [0.0, 0.0, model.standing_height_m])?;
            within(xml, "link", &[("name", "base_link")], |xml| base(xml, model))?;
            within(xml, "frame", &[("name", "imu_frame"), ("attached_to", "base_link")], |xml| pose(xml, &[], model.imu.position_m))?;
            model.motors.iter().try_for_each(|motor| propeller(xml, motor))
        })
    })
}

/// What Gazebo lists the model by.
pub(super) fn config(model: &SimulatorModel) -> io::Result<Vec<u8>> {
    document("model", &[], |xml| {
        text(xml, "name", &model.name)?;
        text(xml, "version", "1.0")?;
        attributed_text(xml, "sdf", &[("version", VERSION)], "model.sdf")?;
        text(xml, "description", &model.description)
    })
}

fn base(xml: &mut Xml, model: &SimulatorModel) -> io::Result<()> {
    inertial(xml, &model.frame, [0.0; 3])?;
    for shape in &model.shapes {
        for kind in ["visual", "collision"] {
            within(xml, kind, &[("name", &format!("{}_{kind}", shape.name))], |xml| {
                within(xml, "geometry", &[], |xml| within(xml, "mesh", &[], |xml| text(xml, "uri", &shape.file)))
            })?;
        }
    }
    feet(xml, model)?;
    within(xml, "sensor", &[("name", "imu"), ("type", "imu")], |xml| {
        pose(xml, &[], model.imu.position_m)?;
        text(xml, "always_on", "true")?;
        text(xml, "update_rate", IMU_HZ)
    })
}

fn feet(xml: &mut Xml, model: &SimulatorModel) -> io::Result<()> {
    let feet = model.feet.len() as f64;
    for foot in &model.feet {
        within(xml, "collision", &[("name", &foot.name)], |xml| {
            pose(xml, &[], foot.position_m)?;
            within(xml, "geometry", &[], |xml| within(xml, "sphere", &[], |xml| text(xml, "radius", &number(foot.radius_m))))?;
            within(xml, "surface", &[], |xml| {
                within(xml, "contact", &[], |xml| {
                    within(xml, "ode", &[], |xml| {
                        text(xml, "kp", &number(model.legs.stiffness_n_m / feet))?;
                        text(xml, "kd", &number(model.legs.damping_n_s_m / feet))
                    })
                })
            })
        })?;
    }
    Ok(())
}

/// The motor's axis with its propeller; a frame without motion where the propeller has no mass of its own.
fn propeller(xml: &mut Xml, motor: &Motor) -> io::Result<()> {
    let Some(body) = &motor.body else {
        return within(xml, "frame", &[("name", &motor.name), ("attached_to", "base_link")], |xml| pose(xml, &[], motor.position_m));
    };
    within(xml, "link", &[("name", &motor.name)], |xml| {
        pose(xml, &[("relative_to", "base_link")], motor.position_m)?;
        inertial(xml, body, motor.position_m)
    })?;
    within(xml, "joint", &[("name", &format!("{}_joint", motor.name)), ("type", "revolute")], |xml| {
        text(xml, "parent", "base_link")?;
        text(xml, "child", &motor.name)?;
        within(xml, "axis", &[], |xml| text(xml, "xyz", &numbers(motor.axis)))
    })
}

fn pose(xml: &mut Xml, attributes: Attributes, at_m: [f64; 3]) -> io::Result<()> {
    attributed_text(xml, "pose", attributes, &numbers(at_m.into_iter().chain([0.0; 3])))
}

fn inertial(xml: &mut Xml, body: &RigidBody, origin_m: [f64; 3]) -> io::Result<()> {
    within(xml, "inertial", &[], |xml| {
        pose(xml, &[], [0, 1, 2].map(|axis| body.centre_m[axis] - origin_m[axis]))?;
        text(xml, "mass", &number(body.mass_kg))?;
        within(xml, "inertia", &[], |xml| {
            let names = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"];
            names.into_iter().zip(body.inertia_terms()).try_for_each(|(name, term)| text(xml, name, &number(term)))
        })
    })
}
