//! Drops with a known truth: what `diagnose` is tested on. SI units, readings in g.
//!
//! Nothing here is shared with `sim` but the numbers of a model: the equations are written again, and integrated by the
//! classical method of order 4 in steps of microseconds. [`Hidden`] holds what the catalogue of effects does not.

mod hidden;
mod motion;
mod plan;
mod records;

pub use hidden::Hidden;
pub use motion::Motion;
pub use plan::{HEIGHT_BOUNDS_M, HEIGHTS, HIDDEN_NUMBERS, KIND, PLAN_NUMBERS, Plan, Scatter};
pub use records::{Record, clean, records};
