//! Parameters: a frame file as typed, the frame as meant, and every refusal in between.

pub mod frame;
pub mod groups;
pub mod parameter;
pub mod part_name;

pub use frame::Frame;
pub use part_name::PartName;
