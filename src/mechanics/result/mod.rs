//! Engineering results of the solvers: curves, impacts, strength, calibration.

pub mod calibration;
pub mod deformed;
pub mod impact;
pub(in crate::mechanics) mod landing;
pub mod prediction;
pub mod ratio;
pub mod reduction;
pub mod static_curve;
pub mod strength;
pub mod underside;
