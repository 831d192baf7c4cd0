//! What is mounted beside the fold, as data: hub and electronics before it, wires and battery after it.
//!
//! [`MOUNTS`] says what there is to mount, and from where; `way` asks the meshes what is in the way; [`Mounting`] has the steps in an order
//! that follows from both.

mod mount;
mod mounting_plan;
mod part_lines;
mod way;

pub use mount::{Fixing, MOUNTS, Mount, Stage};
pub use mounting_plan::{MountStep, Mounting, Precedence, mounts_of};
pub use part_lines::{PartLine, without_a_step};
