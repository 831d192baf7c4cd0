//! Synthetic drops with a known truth, to test `diagnose`. SI units, readings in g.
//!
//! This module shares only the numbers of a model with `sim`. The equations are written a second time, each effect's in its
//! record (`effects::Generator` says why), and integrated by the classical Runge-Kutta method of order 4 in steps of microseconds.
//! [`Hidden`] is an effect outside the catalogue, [`Stalls`] a logger whose clock stalls, [`Landings`] bodies that land on one foot
//! first, and [`ScatterLaw`] the variation of the readings.

mod bezier;
mod fine_wave;
mod hidden;
mod plan;
mod plan_number;
mod plan_text;
mod records;
mod scatter_law;
mod stalls;
mod synthetic_record;
mod tilted_landing;
mod trajectory;
mod whole_record;

pub use hidden::Hidden;
pub use plan::{HEIGHT_BOUNDS_M, HEIGHTS, KIND, LAW, Plan, TrialVariation};
pub use plan_number::{PLAN_NUMBERS, PlanNumber};
pub use records::records;
pub use scatter_law::ScatterLaw;
pub use stalls::Stalls;
pub use synthetic_record::{SyntheticRecord, table};
pub use tilted_landing::{HeavyFeet, Landings};
pub use trajectory::ReferenceTrajectory;
