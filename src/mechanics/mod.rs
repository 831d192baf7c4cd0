//! Stiffness, strength and impact from the frame's own geometry: beams in space, large rotations, contact, viscoelastic
//! joints. Millimetre, newton, gram, millisecond.

pub mod element;
pub mod model;
pub mod parts;
pub mod result;
pub mod settings;
pub mod solve;
pub mod system;
#[cfg(test)]
mod verification;
