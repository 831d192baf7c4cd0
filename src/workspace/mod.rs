//! A frame that is being changed: set a value, ask for what follows.
//!
//! Only what a change drives is computed again, and every answer says what that was. Results are those of a frame that is read and
//! built from nothing, to the last bit. Nothing here opens a file.

mod answer;
#[cfg(test)]
mod tests;
mod workspace;

pub use answer::{Answer, Refused};
pub use workspace::Workspace;
