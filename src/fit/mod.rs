//! Models against measured waves: what a drop's mean wave should read, how far it may lie from that by chance, and the
//! parameters that bring both together. SI units, readings in g.
//!
//! A logger's clock knows nothing of the impact, so every record is laid at its first sample beyond the trigger. What a
//! model predicts for the mean of such records is its wave averaged over all phases of the clock ([`Expected`]): no phase
//! is fitted. [`Scatter`] holds how the records of one height differ from each other, over time; distances between mean
//! and model are measured in it.

mod expected;
mod family;
mod free;
mod least_squares;
mod problem;
mod scatter;
mod waves;

pub use expected::Expected;
pub use family::{Family, inverse_root};
pub use free::{Free, Layout};
pub use least_squares::{Minimum, inverse, minimise};
pub use problem::{Fitted, Problem};
pub use scatter::{Scatter, Whitening};
pub use waves::{BEFORE, Drop, Group, Unusable, Waves};
