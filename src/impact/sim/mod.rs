//! The simulation of a drop: the sum of the effects, integrated with its events, and the output of a sensor. SI units.
//!
//! [`System`] is a model made ready to run. [`wave`] gives the sensor's output alone, fast, for fits; [`simulate`] gives
//! a [`Trace`] with events, peaks and energies. t = 0 is first touch.

mod balance;
mod dormand_prince;
mod events;
mod heights;
mod integrate;
mod phase;
mod root;
mod sampler;
mod spring;
mod switch;
mod switches;
mod system;
mod trace;
mod validity_warning;
mod wave;

pub use balance::{Balance, Moment, PaperShares, TermEnergy};
pub use heights::{HEIGHTS_M, HeightError, check_heights};
pub use integrate::{SolverOptions, Stop};
pub use sampler::Sampler;
pub use system::{SlowWay, System};
pub use trace::{Peaks, Trace, simulate};
pub use validity_warning::ValidityWarning;
pub use wave::wave;
