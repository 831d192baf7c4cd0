//! The drop itself: the sum of the effects, integrated with its events, and what a sensor makes of it. SI units.
//!
//! [`System`] is a model made ready to run. [`wave`] gives the sensor's output alone, fast, for fits; [`simulate`] gives
//! a [`Trace`] with events, peaks and energies. t = 0 is first touch.

mod balance;
mod dormand_prince;
mod events;
mod integrate;
mod outside;
mod root;
mod sampler;
mod spring;
mod switch;
mod system;
mod trace;
mod wave;

pub use balance::{Balance, Moment, Paper, TermEnergy};
pub use integrate::{Settings, Stop};
pub use outside::Outside;
pub use sampler::Sampler;
pub use system::System;
pub use trace::{Trace, simulate};
pub use wave::wave;
