//! flexframe: from one parameter file to a flexible, printable drone frame.
//!
//! The folders are the data flow. [`params`] reads a frame file and refuses what cannot be. [`solid`] holds the feature tree and
//! both kernels. [`frame`] closes the skeleton, the only source of positions; it turns parameters into printed parts, assembles,
//! weighs and folds them. [`printing`] looks at the parts layer by layer, arranges them on the bed, and compares masses with slicer
//! and scale. [`mechanics`] computes stiffness, modes and impact from the frame's own geometry. [`checks`] compares the frame with
//! its limits, and judges the findings for build servers. [`export`] turns the frame into bytes.
//! [`impact`] simulates the drop, reads real drops, fits a model to them and finds what the model lacks. [`variant`] compares frames
//! and searches for better ones, and [`study`] tabulates many of them. [`schema`] describes the files for editors, [`report`] makes pages, pictures and charts.
//! Only the command line in `cli` prints and writes files.
//!
//! Without the feature `cli` the library needs no operating system: it takes texts and bytes, gives bytes, and compiles for
//! `wasm32-unknown-unknown` (`studio/wasm` is that module). Charts need the feature `charts`, which `cli` brings.
//!
//! A rule, a printed part, an effect, a format and a subcommand are one record each; `docs/extending.md` says how to add one.
//!
//! [`workspace`] is where a program begins: a frame that is changed value by value, with its findings, masses and files; [`memo`] keeps what
//! was computed. `examples/library.rs` and `docs/library.md` show both.
//!
//! Units are millimetres, grams and degrees, in the names of the fields; [`impact`] uses SI, [`mechanics`] mm, N, g and ms. Axes: X
//! right, Y front, Z up, origin where the hub's axis crosses the plane of the arms.

pub mod checks;
#[cfg(feature = "cli")]
pub mod cli;
pub mod export;
pub mod figures;
pub mod frame;
pub mod impact;
pub mod markdown;
pub mod mechanics;
pub mod memo;
pub mod paper_logger;
pub mod params;
pub mod printing;
pub mod report;
pub mod schema;
pub mod solid;
pub mod study;
pub mod units;
pub mod variant;
pub mod workspace;

// Their types are in what is public here; a program takes them from here, and has the same versions.
pub use {nalgebra, toml};
