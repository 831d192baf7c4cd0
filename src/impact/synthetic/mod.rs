//! Synthetic drops with a known truth, on which `diagnose` is tested. SI units, readings in g.
//!
//! Nothing here is shared with `sim` but the numbers of a model. The equations are written a second time, each effect's in its
//! record (`effects::Generator` says why), and integrated by the classical Runge-Kutta method of order 4 in steps of microseconds.
//! [`Hidden`] holds effects outside the catalogue, [`Stalls`] a logger whose clock stalls,
//! [`Landings`] bodies that land on one foot first, [`ScatterLaw`] how readings vary.

mod bezier;
mod fine_wave;
mod hidden;
mod plan;
mod plan_text;
mod records;
mod scatter_law;
mod stalls;
mod synthetic_record;
mod tilted_landing;
mod trajectory;
mod whole_record;

pub use hidden::Hidden;
pub use plan::{HEIGHT_BOUNDS_M, HEIGHTS, HIDDEN_NUMBERS, KIND, LAW, PLAN_NUMBERS, Plan, TrialVariation};
pub use records::records;
pub use scatter_law::ScatterLaw;
pub use stalls::Stalls;
pub use synthetic_record::{SyntheticRecord, table};
pub use tilted_landing::Landings;
pub use trajectory::ReferenceTrajectory;
