//! A logger whose clock stalls.

/// A logger that stalls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stalls {
    /// Time that is lost at the end of a sector, s; 0 for a logger that never stalls.
    pub lost_s: f64,
    /// Samples of a sector.
    pub sector: f64,
    /// Samples that it takes in the time of one while it catches up.
    pub catch_up: f64,
    /// Length of a record, s.
    pub record_s: f64,
}
