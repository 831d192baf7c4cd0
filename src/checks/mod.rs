//! The frame against its limits: one rule a file, each a struct that holds the numbers of what it found.
//!
//! Rules measure the assembled bodies, not the parameters that made them. What holds is reported too, with its margin.

mod bounds;
mod cartridge;
mod centre_of_mass;
mod clearance;
mod envelope;
mod finding;
mod fold;
pub mod gate;
mod ground;
mod hinge;
mod interference;
mod mass_budget;
pub mod printing;
mod propeller;
mod scene;
mod seating;
mod strength;

pub use cartridge::{CartridgeMeeting, CartridgePassage};
pub use centre_of_mass::CentreOffset;
pub use clearance::RodClearance;
pub use envelope::Extent;
pub use finding::{Finding, Tightest, Verdict, tightest};
pub use ground::GroundClearance;
pub use hinge::{HingeStrain, LayerStrain, NotchPreload};
pub use interference::SharedVolume;
pub use mass_budget::TakeOffMass;
pub use printing::bed::BedUse;
pub use printing::stance::standing;
pub use printing::wall::ThinnestWall;
pub use propeller::PropellerClearance;
pub use seating::{SeatedEnd, SocketGeometry};
pub use strength::strength;

use rayon::prelude::*;

use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use scene::Scene;

/// A rule: what it finds in a frame.
type Rule = fn(&Scene) -> Vec<Finding>;

/// How long a rule takes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Pace {
    /// Short.
    Short,
    /// Longer than the others together.
    Long,
}

/// Every rule, in the order of the report.
const RULES: [(Rule, Pace); 16] = [
    (envelope::check, Pace::Short),
    (mass_budget::check, Pace::Short),
    (centre_of_mass::check, Pace::Short),
    (propeller::check, Pace::Short),
    (clearance::check, Pace::Short),
    (seating::check, Pace::Short),
    (interference::check, Pace::Short),
    (ground::check, Pace::Short),
    (hinge::check, Pace::Short),
    (fold::check, Pace::Short),
    (fold::way, Pace::Long),
    (printing::wall::check, Pace::Short),
    (cartridge::check, Pace::Short),
    (printing::bed::check, Pace::Short),
    (printing::layer_direction::check, Pace::Short),
    (printing::stance::check, Pace::Long),
];

/// Holds a design against its limits. The order of the findings depends on the design only.
pub fn check(design: &Design, masses: &MassTable) -> Vec<Finding> {
    found(design, masses, &[Pace::Short, Pace::Long])
}

/// The same without the rules that take longer than the rest: they move all parts through all steps of the fold, and look for
/// what hangs over air in all layers.
pub fn quick(design: &Design, masses: &MassTable) -> Vec<Finding> {
    found(design, masses, &[Pace::Short])
}

fn found(design: &Design, masses: &MassTable, paces: &[Pace]) -> Vec<Finding> {
    let scene = Scene::new(design, masses);
    let rules: Vec<Rule> = RULES.iter().filter(|(_, pace)| paces.contains(pace)).map(|(rule, _)| *rule).collect();
    let found: Vec<Vec<Finding>> = rules.par_iter().map(|rule| rule(&scene)).collect();
    found.into_iter().flatten().collect()
}

/// The room under the centre, as the rule measures it.
pub fn ground_clearance(design: &Design, masses: &MassTable) -> Option<GroundClearance> {
    ground::measure(&Scene::new(design, masses))
}

#[cfg(test)]
mod planted;
#[cfg(test)]
mod tests;
