//! Memoised steps: what a step gave is kept under everything that it read, and taken from there the next time.
//!
//! A step is a pure function. Its [`Key`] is a hash of its name and its inputs, so a value is used again only where the
//! step would give the same. [`Memo`] keeps values in memory, and on a [`Shelf`] where it was given one. It says which steps
//! were carried out.

mod key;
mod store;

pub use key::{Key, PROGRAM};
pub use store::{Made, Memo, Shelf};
