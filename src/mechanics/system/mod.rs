//! Nodes and elements assembled to equations, and the sparse matrix that holds them.

pub mod sparse;
pub mod structure;
pub mod system;
