//! Nodes and elements assembled to equations, and the sparse matrix that holds them.

pub mod equation_system;
mod ldlt;
pub mod sparse;
pub mod structure;
