//! The assembled frame: every part made once, flat and folded, and put where the skeleton says.

mod body;
pub mod compensated;
mod design;
pub mod fold;
pub mod mass;
pub mod press_fit;
mod printed;
mod workshop;

pub use body::{Body, Kind, Shape};
pub use design::{Design, DesignError};
pub use printed::Printed;
pub use workshop::Workshop;
