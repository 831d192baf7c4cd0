//! The parts that are mounted before and after the fold, as data: hub and electronics before it, wires and battery after it.
//!
//! [`MOUNTS`] lists the mounts with their directions. `way` tests the meshes for collisions on the path of each mount. [`Mounting`] contains
//! the steps in an order that follows from both.

mod camera_screws;
mod carrier_screws;
mod figures;
mod fragments;
mod mount;
mod mounting_plan;
mod mounts;
mod part_lines;
mod pilot_hole;
#[cfg(test)]
mod text_tests;
mod untold;
mod way;

pub use camera_screws::CameraScrews;
pub use carrier_screws::{CarrierScrew, CarrierScrews};
pub use mount::{Fixing, Mount, RADIO, Stage};
pub use mounting_plan::{MountStep, Mounting, Precedence, mounts_of};
pub use mounts::MOUNTS;
pub use part_lines::{PartLine, without_a_step};
pub use pilot_hole::holds_mm as pilot_hole_mm;
pub use untold::untold;
