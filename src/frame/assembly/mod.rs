//! The assembled frame: every part made once, flat and folded, and placed in the poses of the skeleton.

mod board_solid;
mod body;
mod body_box;
pub mod cables;
pub mod centre_body;
#[cfg(test)]
mod centre_tests;
pub mod compensated;
mod design;
pub mod mass;
mod not_printed;
#[cfg(test)]
mod parts_tests;
pub mod press_fit;
mod printed;
mod refusal;
pub mod rod_piece;
pub mod screw_solids;
pub mod wire;
pub mod wires;

pub use body::{Body, BodyKind, Shape};
pub use centre_body::CentreBody;
pub use design::{Design, DesignError};
pub use printed::{Printed, sides};
