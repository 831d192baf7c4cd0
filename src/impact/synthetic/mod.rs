//! Synthetic drops with a known truth, on which `diagnose` is tested. SI units, readings in g.
//!
//! Nothing here is shared with `sim` but the numbers of a model. The equations are written a second time, each effect's in its
//! record (`effects::Generator` says why), and integrated by the classical Runge-Kutta method of order 4 in steps of microseconds.
//! [`Hidden`] holds effects outside the catalogue, [`Stalls`] a logger whose clock stalls,
//! [`Landings`] bodies that land on one foot first.

mod bezier;
mod hidden;
mod plan;
mod records;
mod stalls;
mod tilted_landing;
mod trajectory;

pub use hidden::Hidden;
pub use plan::{HEIGHT_BOUNDS_M, HEIGHTS, HIDDEN_NUMBERS, KIND, PLAN_NUMBERS, Plan, TrialVariation};
pub use records::{SyntheticRecord, records, table};
pub use stalls::Stalls;
pub use tilted_landing::Landings;
pub use trajectory::ReferenceTrajectory;
