//! What weighs how much in the model: flexible parts, rods, motors, and the rigid centre with all the rest.

use crate::frame::assembly::Design;
use crate::frame::assembly::mass::{LineKind, Lump, MassLine, MassTable, lump, uncovered_g};
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

/// The rods, motors and propellers, as far as extras cover them: mass of each, g, that an extra's line holds. An extra of motors and their screws
/// alone rides on the motors; beside other roles its screws stay with it: they are too light to matter.
#[derive(Default)]
struct Covered {
    rods_g: f64,
    on_motors_g: f64,
}

impl Covered {
    /// Of one extra. What covers rods and motors alone is all of it theirs; beside others they have what they weigh uncovered.
    fn of(design: &Design, line: &MassLine) -> Self {
        let Some(extra) = design.frame.extras.get(&line.name).filter(|_| line.kind == LineKind::Extra) else { return Self::default() };
        let is_placed = |role: &str| role == "rod" || ON_MOTORS.contains(&role);
        let of = |wanted: &dyn Fn(&str) -> bool| -> f64 {
            extra.covers.iter().filter(|role| wanted(role)).map(|role| uncovered_g(design, role)).sum()
        };
        let (rods_g, on_motors_g) = (of(&|role| role == "rod"), of(&|role| role == "motor" || role == "propeller"));
        let uncovered_g = rods_g + on_motors_g;
        if uncovered_g <= 0.0 {
            return Self::default();
        }
        let whole = line.total_g / uncovered_g;
        let share = if extra.covers.iter().all(|role| is_placed(role)) { whole } else { whole.min(1.0) };
        Self { rods_g: share * rods_g, on_motors_g: share * on_motors_g }
    }
}

/// Shares the table out.
pub fn weights(design: &Design, masses: &MassTable) -> Weights {
    let covered: Vec<Covered> = masses.lines.iter().map(|line| Covered::of(design, line)).collect();
    let flexible = |line: &MassLine| {
        let is_of = |part: &PartName| line.kind == LineKind::Printed && is_beams(*part) && part.slug() == line.name;
        PartName::ALL.into_iter().find(is_of)
    };
    let on_motor = |line: &MassLine| line.kind == LineKind::Bought && ON_MOTORS.contains(&line.name.as_str());
    let parts = masses.lines.iter().filter_map(|line| Some((flexible(line)?, line.each_g))).collect();
    let left = |(line, covered): (&MassLine, &Covered)| {
        let total_g = line.total_g - covered.rods_g - covered.on_motors_g;
        MassLine { total_g, each_g: total_g / f64::from(line.quantity.max(1)), ..line.clone() }
    };
    let is_central = |line: &MassLine| flexible(line).is_none() && line.kind != LineKind::Rod && !on_motor(line);
    let centre: Vec<MassLine> = masses.lines.iter().zip(&covered).filter(|(line, _)| is_central(line)).map(left).collect();
    let of_motors_g: f64 = masses.lines.iter().filter(|line| on_motor(line)).map(|line| line.total_g).sum();
    let mass_g = (of_motors_g + covered.iter().map(|covered| covered.on_motors_g).sum::<f64>()) / 4.0;
    let (height, radius) = design.frame.bought.get("motor").map_or((10.0, 7.0), |motor| {
        let part = &motor.part;
        (part.height_mm.unwrap_or(part.size_mm[2]), 0.5 * part.body_diameter_mm.unwrap_or(part.size_mm[0]))
    });
    // A solid cylinder.
    let across = mass_g * (3.0 * radius * radius + height * height) / 12.0;
    let motor = MotorMass { mass_g, inertia_g_mm2: [across, across, 0.5 * mass_g * radius * radius], above_seat_mm: 0.5 * height };
    let rods_g: f64 = covered.iter().map(|covered| covered.rods_g).sum();
    let heavier = if rods_g > 0.0 { rods_g / uncovered_g(design, "rod") } else { 1.0 };
    let rod_g_mm3 = design.frame.rod_material.material.density_g_cm3 * 1e-3 * heavier;
    Weights { parts, rod_g_mm3, motor, centre: lump(design, &centre) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::assembly::mass;
    use crate::params::{Frame, FrameFile};

    /// Weights of the default frame with an extra of this name, and all that they hold, g, beside the table's total.
    fn with(name: &str, extra: &str) -> (Weights, f64, f64) {
        let text = format!("base = \"cognifly\"\n[extras.{name}]\nmass_basis = \"measured\"\nsource = \"scale\"\n{extra}\n");
        let file = FrameFile::parse("covered", &text).expect("is TOML");
        let design = Design::new(Frame::resolve(&file).expect("is a frame")).expect("closes");
        let masses = mass::table(&design);
        let weights = weights(&design, &masses);
        let rods_g = weights.rod_g_mm3 / (design.frame.rod_material.material.density_g_cm3 * 1e-3) * uncovered_g(&design, "rod");
        let flexible = PartName::ALL.into_iter().filter(|part| is_beams(*part));
        let parts_g: f64 =
            flexible.map(|part| weights.of_part(part) * f64::from(design.part(part).map_or(0, |made| made.part.quantity()))).sum();
        let all_g = weights.centre.mass_g + 4.0 * weights.motor.mass_g + rods_g + parts_g;
        (weights, all_g, masses.total_g)
    }

    #[test]
    fn analytic_the_model_weighs_what_the_table_says_whatever_extras_cover() {
        let (plain, ..) = with("weighed", "mass_g = 0.0");
        for extra in [
            "mass_g = 33.0\ncovers = [\"rod\"]",
            "mass_g = 40.0\ncovers = [\"motor\", \"motor_screw\"]",
            "mass_g = 80.0\ncovers = [\"rod\", \"motor\", \"battery\"]",
            "mass_g = 20.0\ncovers = [\"rod\", \"battery\"]",
        ] {
            let (weights, all_g, total_g) = with("weighed", extra);
            assert!((all_g - total_g).abs() < 1e-6 * total_g, "{extra}: {all_g} and {total_g}");
            assert!(weights.centre.mass_g < plain.centre.mass_g + 5.0, "{extra}: {}", weights.centre.mass_g);
        }
        // An extra that is called as a part is, is not that part.
        for name in ["knee", "fork", "ballast"] {
            let (weights, all_g, total_g) = with(name, "mass_g = 60.0");
            assert!((all_g - total_g).abs() < 1e-6 * total_g, "{name}: {all_g} and {total_g}");
            assert!((weights.centre.mass_g - plain.centre.mass_g - 60.0).abs() < 1e-9, "{name}: {}", weights.centre.mass_g);
        }
    }
}
