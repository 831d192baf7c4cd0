//! The real frame's parts beside ours: figures, scans, and one way of measuring for both.

pub mod figures;
pub mod ours;
pub mod probe;
pub mod rays;
pub mod scan;
