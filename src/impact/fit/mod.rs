//! Models against measured drops: what a drop's mean wave should read, how far it may lie from that by chance, and the
//! parameters that bring both together. SI units, readings in g.
//!
//! A logger's clock knows nothing of the impact, so every record is laid at its first sample beyond the trigger. What a
//! model predicts for the mean of such records is its wave averaged over all phases of the clock ([`Expected`]): no phase
//! is fitted. [`Scatter`] holds how the records of one height differ from each other, over time; distances between mean
//! and model are measured in it.
//!
//! [`fit`] finds the parameters of one model: [`Likelihood`] compares mean waves in units of their own scatter, [`Paper`] is
//! what the notebook of arXiv 2103.04423 minimises; resampled drops give intervals. [`Problem`] is the same distance for
//! many models one after the other, as a diagnosis needs it.

mod chosen;
mod expected;
mod family;
mod fitting;
mod flicker;
mod free;
mod least_squares;
mod likelihood;
mod paper;
mod problem;
mod scatter;
mod waves;

pub use chosen::{Chosen, Keep, LeftOut, Unfit};
pub use expected::{Expected, Ready};
pub use family::{Family, inverse_root};
pub use fitting::{Estimate, Fit, Objective, fit};
pub use flicker::Flicker;
pub use free::{Free, Layout};
pub use least_squares::{Minimum, inverse, minimise};
pub use likelihood::Likelihood;
pub use paper::Paper;
pub use problem::{Fitted, Problem};
pub use scatter::{Scatter, Whitening};
pub use waves::{BEFORE, Drop, Group, Unusable, Waves};
