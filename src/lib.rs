//! flexframe: from one parameter file to a flexible, printable drone frame.

#![warn(missing_docs)]

pub mod params;
pub mod parts;
pub mod skeleton;
pub mod solid;
pub mod units;
