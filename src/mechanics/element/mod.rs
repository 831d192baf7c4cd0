//! Elements of a structure: corotational beams, elastic ties, feet on the ground, and their rotations and relaxation.

pub mod beam;
pub mod bushing;
pub(in crate::mechanics) mod corotation;
pub mod foot;
pub mod relaxation;
pub mod rotation;
