//! The checks of a frame against its limits: one rule a file, with its record and a struct for the measured numbers.
//!
//! Rules of place measure the assembled bodies, not the parameters that made them; those of hinges and of most hardware compare figures. Findings that keep their limit are reported too, with their
//! margin. A new rule is a file with a `RULE`, and a line of [`CATALOGUE`].

mod bounds;
mod cartridge;
mod catalogue;
mod centre_of_mass;
mod clearance;
mod envelope;
mod finding;
mod fold;
pub mod gate;
mod ground;
mod hardware;
mod hinge;
mod interference;
mod mass_budget;
mod measure;
pub mod printing;
mod propeller;
mod rule;
mod scene;
mod seating;
mod strength;

pub use cartridge::{CartridgeMeeting, CartridgePassage};
pub use catalogue::{CATALOGUE, check, check_by, check_one, followed, ground_clearance};
pub use centre_of_mass::{CentreOffset, RULE as CENTRE_OF_MASS};
pub use clearance::{RULE as PART_CLEARANCE, RodClearance};
pub use envelope::{Extent, RULE as ENVELOPE};
pub use finding::{Finding, Tightest, Verdict, tightest};
pub use fold::RULE as FOLD_SEQUENCE;
pub use ground::{GroundClearance, RULE as GROUND_CLEARANCE};
pub use hinge::{HingeStrain, LayerStrain, NotchPreload, RULE as HINGE_STRAIN};
pub use interference::SharedVolume;
pub use mass_budget::TakeOffMass;
pub use printing::bed::BedUse;
pub use printing::footing::standing;
pub use printing::heat::is_too_cold;
pub use printing::wall::{RULE as THINNEST_WALL, ThinnestWall};
pub use propeller::{PropellerClearance, RULE as PROPELLER_CLEARANCE};
pub use rule::{Blame, Cost, InSearch, Levers, Limit, Rule};
pub use seating::{RULE as SOCKET_SEATING, SeatedEnd, SocketGeometry};
pub use strength::{design_drop, strength};

#[cfg(test)]
pub(crate) mod planted;
#[cfg(test)]
mod tests;
