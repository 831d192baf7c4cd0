//! The printed mass of a frame from three sources: volume times density, a slicer, and a scale; and the print factors fitted to the
//! scale.

mod print_factor;
mod weighed;

pub use print_factor::{PrintFactor, Ratio};
pub use weighed::{Fitted, Misread, Reading, Row, Sliced, Weighing};
