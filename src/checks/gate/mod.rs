//! The gate: frames held against their limits, what of it fails a job, and the forms that build servers read.

pub mod baseline;
mod blame;
pub mod github;
pub mod junit;
pub mod markdown;
mod outcome;
pub mod sarif;

pub use baseline::Baseline;
pub use blame::{Spot, spots};
pub use outcome::{Held, Judged, Outcome, Refused, Rules, Standing};
