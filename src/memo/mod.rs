//! Memoised steps: the result of a step is cached under a hash of its inputs, and reused for the same inputs.
//!
//! A step is a pure function. Its [`Key`] is a hash of its name and its inputs, so a value is used again only where the
//! step would give the same. [`Memo`] keeps values in memory, and in a [`Storage`] if it was given one. [`Prepared`] is a storage of results that come
//! with the program. A memo reports which steps were carried out. Computations of many steps report to a [`Progress`], which may end them between two steps.

mod key;
mod prepared;
mod progress;
mod store;

pub use key::{Key, PROGRAM};
pub use prepared::{OtherBuild, Prepared};
pub use progress::{Progress, Step, Unwatched};
pub use store::{Made, Memo, Storage};
