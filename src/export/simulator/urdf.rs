//! URDF: links and joints (wiki.ros.org/urdf/XML). It has no springs, no motors and no sensors: feet are rigid, and what is known of
//! motors and legs is in `simulator.json`.

use std::io;

use super::figures::{number, numbers};
use super::model::{Motor, RigidBody, SimulatorModel};
use super::xml::{Xml, comment, document, empty, within};

/// The robot.
pub(super) fn robot(model: &SimulatorModel) -> io::Result<Vec<u8>> {
    document("robot", &[("name", &model.name)], |xml| {
        comment(xml, "SI units; x front, y left, z up, origin at the hub; no springs: docs/simulators.md")?;
        within(xml, "link", &[("name", "base_link")], |xml| {
            inertial(xml, Some(&model.frame), [0.0; 3])?;
            for shape in &model.shapes {
                for kind in ["visual", "collision"] {
                    within(xml, kind, &[("name", &shape.name)], |xml| {
                        within(xml, "geometry", &[], |xml| empty(xml, "mesh", &[("filename", &shape.file)]))
                    })?;
                }
            }
            feet(xml, model)
        })?;
        fixed(xml, "imu_link", model.imu.position_m)?;
        model.motors.iter().try_for_each(|motor| propeller(xml, motor))
    })
}

fn feet(xml: &mut Xml, model: &SimulatorModel) -> io::Result<()> {
    for foot in &model.feet {
        let radius = number(foot.radius_m);
        within(xml, "collision", &[("name", &foot.name)], |xml| {
            origin(xml, foot.position_m)?;
            within(xml, "geometry", &[], |xml| empty(xml, "sphere", &[("radius", &radius)]))
        })?;
    }
    Ok(())
}

/// A link without mass that marks a place.
fn fixed(xml: &mut Xml, name: &str, at_m: [f64; 3]) -> io::Result<()> {
    within(xml, "link", &[("name", name)], |xml| inertial(xml, None, at_m))?;
    joint(xml, name, "fixed", at_m, None)
}

/// The motor's axis with its propeller; where the propeller has no mass of its own, a place without motion.
fn propeller(xml: &mut Xml, motor: &Motor) -> io::Result<()> {
    let Some(body) = &motor.body else { return fixed(xml, &motor.name, motor.position_m) };
    within(xml, "link", &[("name", &motor.name)], |xml| inertial(xml, Some(body), motor.position_m))?;
    joint(xml, &motor.name, "continuous", motor.position_m, Some(motor.axis))
}

fn joint(xml: &mut Xml, link: &str, kind: &str, at_m: [f64; 3], axis: Option<[f64; 3]>) -> io::Result<()> {
    within(xml, "joint", &[("name", &format!("{link}_joint")), ("type", kind)], |xml| {
        empty(xml, "parent", &[("link", "base_link")])?;
        empty(xml, "child", &[("link", link)])?;
        origin(xml, at_m)?;
        axis.map_or(Ok(()), |axis| empty(xml, "axis", &[("xyz", &numbers(axis))]))
    })
}

fn origin(xml: &mut Xml, at_m: [f64; 3]) -> io::Result<()> {
    empty(xml, "origin", &[("xyz", &numbers(at_m)), ("rpy", "0 0 0")])
}

/// Mass and inertia of a link whose origin is here; nothing for a place, as readers take a link without these for one of 1 kg.
fn inertial(xml: &mut Xml, body: Option<&RigidBody>, origin_m: [f64; 3]) -> io::Result<()> {
    let at_m = body.map_or([0.0; 3], |body| [0, 1, 2].map(|axis| body.centre_m[axis] - origin_m[axis]));
    let terms = body.map_or([0.0; 6], RigidBody::inertia_terms).map(number);
    within(xml, "inertial", &[], |xml| {
        origin(xml, at_m)?;
        empty(xml, "mass", &[("value", &number(body.map_or(0.0, |body| body.mass_kg)))])?;
        let names = ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"];
        let inertia: Vec<(&str, &str)> = names.into_iter().zip(terms.iter().map(String::as_str)).collect();
        empty(xml, "inertia", &inertia)
    })
}
