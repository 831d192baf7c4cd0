//! A frame's printed mass three ways: volume times density, as a slicer fills it, on a scale; and the print factors that the
//! scale asks for.

mod print_factor;
mod weighed;

pub use print_factor::{PrintFactor, Ratio};
pub use weighed::{Fitted, Misread, Reading, Row, Sliced, Weighing};
