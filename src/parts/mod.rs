//! Printed parts: one file a part, each a plain struct and a pure function to features.

pub mod battery_bracket;
pub mod battery_lid;
pub mod battery_sleeve;
pub mod bought_solids;
pub mod camera_connector;
pub mod centre;
pub mod hub;
mod outline;
pub mod pi_carrier;

pub use centre::Centre;
pub mod bottom_corner;
pub mod corner;
pub mod fork;
pub mod hub_joint;
pub mod knee;
mod knee_window;
#[cfg(test)]
mod measure;
pub mod motor_mount;
mod motor_outline;
pub mod place;
pub mod top_corner;

pub use bottom_corner::BottomCorner;
pub use fork::Fork;
pub use hub_joint::HubJoint;
pub use knee::Knee;
pub use motor_mount::MotorMount;
pub use top_corner::TopCorner;
