//! Printed parts: one file a part, each a plain struct and a pure function to features.

pub mod battery_bracket;
pub mod battery_lid;
pub mod battery_sleeve;
pub mod bought_solids;
pub mod camera_connector;
pub mod centre;
#[cfg(test)]
mod gauges;
pub mod hub;
mod outline;
pub mod pi_carrier;

pub use bought_solids::BoughtSolid;
pub use centre::Centre;
