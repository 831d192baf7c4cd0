//! Stiffness, strength and impact from the frame's own geometry: beams in space, large rotations, contact, viscoelastic
//! joints. Millimetre, newton, gram, millisecond.

pub mod beam;
pub mod bushing;
pub mod calibration;
mod corner_plan;
mod corotation;
pub mod deformed;
pub mod dynamics;
pub mod foot;
mod frame_builder;
pub mod frame_model;
pub mod impact;
mod joint_plans;
mod landing;
mod ldlt;
pub mod memory;
pub mod modes;
pub mod parts_plan;
pub mod plan;
pub mod prediction;
pub mod ratio;
pub mod reduction;
pub mod relaxation;
pub mod rotation;
pub mod section;
pub mod settings;
pub mod sparse;
pub mod static_curve;
pub mod statics;
pub mod strength;
pub mod structure;
pub mod system;
pub mod torsion;
#[cfg(test)]
mod verification;
mod weights;
