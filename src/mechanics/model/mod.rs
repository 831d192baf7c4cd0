//! The frame as a structure: parts, rods, ties, masses and feet.

pub(in crate::mechanics) mod frame_builder;
pub mod frame_model;
pub(in crate::mechanics) mod weights;
