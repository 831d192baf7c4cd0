//! A frame for simulators of rigid bodies: one [`SimulatorModel`], and a writer for each format.
//!
//! SI units. The frame of reference is that of robotics and not that of the design: x to the front, y to the left, z up (FLU), the
//! origin at the hub. `axes.rs` is the only place that turns one into the other.

mod axes;
mod convex_shape;
mod figures;
mod meshes;
mod mjcf;
mod model;
mod propeller;
mod sdf;
mod urdf;
mod xml;

pub use convex_shape::ConvexShape;
pub use model::{Foot, Imu, LegSpring, Motor, RigidBody, SeenRod, SimulatorModel};
pub use propeller::{TORQUE_OVER_THRUST, torque_over_thrust_m};

use super::format::ExportError;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;

/// A format of simulators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SimulatorFormat {
    /// MuJoCo's own.
    Mjcf,
    /// That of ROS, PyBullet and others.
    Urdf,
    /// That of Gazebo.
    Sdf,
}

impl SimulatorFormat {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Mjcf, Self::Urdf, Self::Sdf];
}

/// The model of a design on legs with this spring.
pub fn model(design: &Design, masses: &MassTable, legs: LegSpring) -> SimulatorModel {
    SimulatorModel::new(design, masses, legs)
}

/// The files of a model in some formats, path and bytes: `simulator.json` with all but the shapes, the shapes, and
/// those that simulators read.
///
/// # Errors
/// When a text cannot be written; it is written to memory.
pub fn files(model: &SimulatorModel, formats: &[SimulatorFormat]) -> Result<Vec<(String, Vec<u8>)>, ExportError> {
    let mut files = vec![("simulator.json".to_string(), json(model)?)];
    for format in formats {
        match format {
            SimulatorFormat::Mjcf => {
                files.push(("frame.xml".into(), mjcf::frame(model).map_err(ExportError::of("frame.xml"))?));
                files.push(("scene.xml".into(), mjcf::scene(model).map_err(ExportError::of("scene.xml"))?));
            }
            SimulatorFormat::Urdf => files.push(("frame.urdf".into(), urdf::robot(model).map_err(ExportError::of("frame.urdf"))?)),
            SimulatorFormat::Sdf => {
                files.push(("model.sdf".into(), sdf::model(model).map_err(ExportError::of("model.sdf"))?));
                files.push(("model.config".into(), sdf::config(model).map_err(ExportError::of("model.config"))?));
            }
        }
    }
    // MJCF has its shapes in the file.
    if formats.iter().any(|format| *format != SimulatorFormat::Mjcf) {
        files.extend(model.shapes.iter().map(|shape| (shape.file.clone(), meshes::obj(shape).into_bytes())));
    }
    Ok(files)
}

fn json(model: &SimulatorModel) -> Result<Vec<u8>, ExportError> {
    let mut text = serde_json::to_string_pretty(model).map_err(ExportError::of("simulator.json"))?;
    text.push('\n');
    Ok(text.into_bytes())
}
