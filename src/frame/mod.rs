//! The frame from its parameters: positions, printed parts, the assembled bodies with their masses, and the fold.

pub mod assembly;
pub mod fold;
pub mod parts;
pub mod skeleton;
