//! Solvers: static equilibrium, motion in time, small vibrations.

pub mod dynamics;
pub mod memory;
pub mod modes;
pub mod statics;
