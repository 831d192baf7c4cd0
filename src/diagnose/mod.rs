//! Where simulation and measurement disagree, and which named effect is missing.

mod adequacy;
mod candidate;
mod dictionary;
mod ground;
mod search;

pub use adequacy::{Adequacy, Statistics};
pub use candidate::Candidate;
pub use ground::Ground;
pub use search::{Level, RARE, Search, Setting};
