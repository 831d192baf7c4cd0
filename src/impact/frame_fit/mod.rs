//! The two numbers of the flexible material that no static test gives, from measured drops of a frame: its modulus and its loss in an
//! impact ([`crate::mechanics::settings::MechanicsSettings`]).
//!
//! A drop height gives two figures with their standard errors ([`Height`]): the median peak and the median impulse along the axis. Both
//! exclude the drops that a diagnosis excludes. The frame's own model predicts both. [`ResponseSurface`] stores its predictions over the
//! bounds of the two numbers, so that heights can be left out one after the other without a new run for every step of the search.
//!
//! *When it is wrong:* both numbers compensate for everything that the level landing of a linear material leaves out: large strains,
//! slip, tilt. They hold for this print, this ground and this way of release, and are no constants of the material.

mod fitting;
mod frame_reduction;
mod height;
mod response_surface;

pub use fitting::{FrameFit, FrameFitError, MaterialEstimate, Predicted, fit};
pub use frame_reduction::{CURVE_MM, ReductionError, reduced_model};
pub use height::{Height, MeasuredHeights, MeasuredHeightsError, MedianEstimate};
pub use response_surface::{LoggedDrop, Response, ResponseSurface, Subject};
