//! The gate: frames checked against their limits, the findings that fail a CI job, and the report formats of CI servers.

pub mod acceptance;
mod baseline;
mod blame;
pub mod data;
pub mod github;
#[cfg(feature = "cli")]
pub mod junit;
pub mod markdown;
mod outcome;
mod policy;
pub mod sarif;

pub use baseline::{Accepted, Baseline, BaselineError, ListedFrame};
pub use blame::{Spot, spots};
pub use outcome::{CheckedFrame, Judged, NO_FRAME_REMEDY, Outcome, Refused};
pub use policy::{Policy, Standing};

#[cfg(test)]
mod tests;
