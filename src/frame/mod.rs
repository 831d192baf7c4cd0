//! The frame from its parameters: positions, printed parts, the assembled bodies with their masses, the fold, and what is mounted
//! before and after it.

pub mod assembly;
pub mod fold;
pub mod mounting;
pub mod parts;
pub mod skeleton;
