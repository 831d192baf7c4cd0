//! What weighs how much in the model: flexible parts, rods, motors, and the rigid centre with all the rest.

use crate::frame::assembly::Design;
use crate::frame::assembly::mass::{LineKind, Lump, MassLine, MassTable, lump};
use crate::mechanics::parts::parts_plan::is_beams;
use crate::params::PartName;

/// A motor with what turns and holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorMass {
    /// Mass, g.
    pub mass_g: f64,
    /// Moments of inertia, g mm².
    pub inertia_g_mm2: [f64; 3],
    /// Centre above its seat, mm.
    pub above_seat_mm: f64,
}

/// The masses.
#[derive(Clone, Debug)]
pub struct Weights {
    parts: Vec<(PartName, f64)>,
    /// Of the rods' material, g/mm³.
    pub rod_g_mm3: f64,
    /// One of the four motors.
    pub motor: MotorMass,
    /// The rigid centre.
    pub centre: Lump,
}

impl Weights {
    /// Mass of one part, g.
    pub fn of_part(&self, name: PartName) -> f64 {
        self.parts.iter().find(|(part, _)| *part == name).map_or(0.0, |(_, mass_g)| *mass_g)
    }
}

/// Lines that ride on the motors.
const ON_MOTORS: [&str; 3] = ["motor", "propeller", "motor_screw"];

/// Shares the table out.
pub fn weights(design: &Design, masses: &MassTable) -> Weights {
    let flexible = |line: &MassLine| PartName::ALL.into_iter().find(|part| is_beams(*part) && part.slug() == line.name);
    let on_motor = |line: &MassLine| ON_MOTORS.contains(&line.name.as_str());
    let parts = masses.lines.iter().filter_map(|line| Some((flexible(line)?, line.each_g))).collect();
    let centre: Vec<MassLine> =
        masses.lines.iter().filter(|line| flexible(line).is_none() && line.kind != LineKind::Rod && !on_motor(line)).cloned().collect();
    let mass_g = masses.lines.iter().filter(|line| on_motor(line)).map(|line| line.total_g).sum::<f64>() / 4.0;
    let (height, radius) = design.frame.bought.get("motor").map_or((10.0, 7.0), |motor| {
        let part = &motor.part;
        (part.height_mm.unwrap_or(part.size_mm[2]), 0.5 * part.body_diameter_mm.unwrap_or(part.size_mm[0]))
    });
    // A solid cylinder.
    let across = mass_g * (3.0 * radius * radius + height * height) / 12.0;
    let motor = MotorMass { mass_g, inertia_g_mm2: [across, across, 0.5 * mass_g * radius * radius], above_seat_mm: 0.5 * height };
    let rod_g_mm3 = design.frame.rod_material.material.density_g_cm3 * 1e-3;
    Weights { parts, rod_g_mm3, motor, centre: lump(design, &centre) }
}
