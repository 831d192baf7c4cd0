//! How files of drops are written.

use super::logger::Calibration;
use super::table_format::TableFormat;

/// How files of drops are written: the logger's counts, and the tables' columns and units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FileFormat {
    /// Of the logger's files.
    pub calibration: Calibration,
    /// Of tables.
    pub table: TableFormat,
}
