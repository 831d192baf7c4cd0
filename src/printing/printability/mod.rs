//! Printability of a part: layers, unsupported regions, walls, and footing on the first layer.
//!
//! Everything is measured on the mesh of the design, before what a printer's compensation changes in the files, in print axes: mm, Z up, resting on z = 0.

mod chords;
mod fault;
mod footing;
mod layers;
mod process;
mod unsupported;
mod walls;

pub use fault::{Fault, hanging, needs_support};
pub use footing::Footing;
pub use process::Process;
pub use unsupported::Hanging;
pub use walls::{AREA_MM2, Thin, Walls};

#[cfg(test)]
mod tests;
