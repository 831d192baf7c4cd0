//! Models against measured drops: what a record should read, how far it may lie from that by chance, and the parameters
//! that bring both together. SI units, readings in g.
//!
//! Two objectives: [`Likelihood`] compares mean waves in units of their own scatter, [`Paper`] is what the notebook of
//! arXiv 2103.04423 minimises. Both are sums of squares, so one method finds their minimum ([`fit`]), and resampled drops
//! give intervals.

mod chosen;
mod expected;
mod fitting;
mod free;
mod least_squares;
mod likelihood;
mod paper;
mod waves;

pub use chosen::{Chosen, LeftOut, Unfit};
pub use expected::Expected;
pub use fitting::{Estimate, Fit, Objective, fit};
pub use free::{Free, Layout};
pub use least_squares::{Minimum, minimise};
pub use likelihood::Likelihood;
pub use paper::Paper;
pub use waves::{Drop, Group, Unusable, Waves};
