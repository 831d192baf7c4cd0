//! flexframe: from one parameter file to a flexible, printable drone frame.
//!
//! The folders are the data flow. [`params`] reads a frame file and refuses what cannot be; [`skeleton`] closes the
//! frame and is the only source of positions; [`solid`] holds the feature tree and both kernels; [`parts`] turns
//! parameters into features; [`assembly`] makes every part, folds it and puts it in its place, and weighs it;
//! [`mechanics`] presses, shakes and drops it by its own geometry; [`printability`] prints the parts in layers;
//! [`plates`] lays them on the printer's bed;
//! [`checks`] holds the frame against its limits; [`export`] turns it into bytes; [`report`] into words and pictures.
//! [`coupon`] is what tells a printer's clearances, [`weighing`] compares masses with what slicer and scale say.
//! [`gate`] judges findings for build servers, [`variant`] compares frames and searches for better ones.
//! [`body`] leads from there to the drop: [`effects`] is the library of what can act, [`sim`] lets a body fall. [`measured`]
//! reads real drops, [`fit`] brings a model to them, [`impact_fit`] the frame's own mechanics.
//! [`schema`] tells editors what files look like.
//! Only the command line in `cli` prints and writes files.
//!
//! Units are millimetres, grams and degrees, in the names of the fields, from [`body`] on SI, in [`mechanics`] with N and ms. Axes: X right, Y front, Z up, origin where
//! the hub's axis crosses the plane of the arms.

pub mod checks;
pub mod cli;
pub mod export;
pub mod figures;
pub mod frame;
pub mod impact;
pub mod mechanics;
pub mod params;
pub mod printing;
pub mod report;
pub mod schema;
pub mod solid;
pub mod units;
pub mod variant;
