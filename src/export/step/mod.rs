//! Parts and assembly as STEP, ISO 10303-21 by AP214: solids with names, colours and places, in mm.
//!
//! A solid is exact if every facet of the mesh can be assigned to a surface of its features. Otherwise it is mixed: the faces that can
//! be are exact, the others are facets of the mesh, by the name `facet`. Where no face can be exact, it is the mesh with coplanar facets
//! merged. Every file states which it contains.

mod files;
mod product;
mod shape;
mod shaped;
mod writer;

pub use files::{FORMAT, StepError, solid};
