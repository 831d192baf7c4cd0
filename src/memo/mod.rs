//! Memoised steps: what a step gave is kept under everything that it read, and taken from there the next time.
//!
//! A step is a pure function. Its [`Key`] is a hash of its name and its inputs, so a value is used again only where the
//! step would give the same. [`Memo`] keeps values in memory, and on a [`Storage`] where it was given one. It says which steps
//! were carried out. Computations of many steps tell a [`Progress`] where they are, which may end them between two steps.

mod key;
mod progress;
mod store;

pub use key::{Key, PROGRAM};
pub use progress::{Progress, Step, Unwatched};
pub use store::{Made, Memo, Storage};
