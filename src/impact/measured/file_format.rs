//! How files of drops are written.

use super::logger::Calibration;
use super::table_format::TableFormat;
use crate::units::Angle;

/// How files of drops are written: the logger's counts, and the tables' columns and units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FileFormat {
    /// Of the logger's files.
    pub calibration: Calibration,
    /// Of tables.
    pub table: TableFormat,
    /// From the frame's front to the sensor's x, counted toward its left; readings are turned back by it.
    pub turn: Angle,
}
