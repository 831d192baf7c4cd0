//! The two numbers of the flexible material that no static test gives, from measured drops of a frame: its modulus in an
//! impact and its loss there ([`crate::mechanics::settings::MechanicsSettings`]).
//!
//! A drop height brings two figures that replicates show with their scatter ([`Height`]): the median peak and the median
//! impulse along the axis. The frame's own model answers for both; [`Surface`] keeps its answers over the numbers' bounds, so
//! that heights can be left out one after the other without a new run for every step of the search.
//!
//! *When it is wrong:* both numbers stand for all that a level landing of a linear material lacks: large strains, slip, tilt. They are
//! those of this print, this ground and this way of letting go, and no constants of the material.

mod fitting;
mod height;
mod surface;

pub use fitting::{Estimate, FrameFit, ImpactFitError, Predicted, fit};
pub use height::{Height, Known};
pub use surface::{Answer, Subject, Surface};
