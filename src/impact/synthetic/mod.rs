//! Drops with a known truth: what `diagnose` is tested on. SI units, readings in g.
//!
//! Nothing here is shared with `sim` but the numbers of a model: the equations are written again, and integrated by the
//! classical method of order 4 in steps of microseconds. [`Hidden`] holds what the catalogue of effects does not.

mod bezier;
mod hidden;
mod plan;
mod records;
mod trajectory;

pub use hidden::Hidden;
pub use plan::{HEIGHT_BOUNDS_M, HEIGHTS, HIDDEN_NUMBERS, KIND, PLAN_NUMBERS, Plan, TrialVariation};
pub use records::{SyntheticRecord, records};
pub use trajectory::ReferenceTrajectory;
