//! A logger whose clock stalls.

use crate::units::GRAVITY_M_S2;

/// The touch lies so long after the begin of the fall's earliest begin, and before the end of the record, s.
pub(super) const ROOM_S: [f64; 2] = [0.15, 0.35];

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

impl Stalls {
    /// The shortest record that holds a drop from a height, m; in s.
    pub fn least_record_s(height_m: f64) -> f64 {
        (2.0 * height_m / GRAVITY_M_S2).sqrt() + ROOM_S[0] + ROOM_S[1]
    }
}
