//! The drop: the frame reduced to a body, effects, simulation, measured records, fits and the diagnosis. SI units.

pub mod body;
pub mod diagnose;
pub mod effects;
pub mod fit;
pub mod frame_fit;
pub mod landing;
pub mod measured;
pub mod request;
pub mod sim;
pub mod synthetic;
mod wide_registers;
