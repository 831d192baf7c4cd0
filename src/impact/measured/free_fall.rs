//! A fall without air.

use crate::units::GRAVITY_M_S2;

/// Speed at its end, m/s.
pub fn impact_speed_m_s(height_m: f64) -> f64 {
    (2.0 * GRAVITY_M_S2 * height_m).sqrt()
}

/// How long it lasts, s.
pub(super) fn lasting_s(height_m: f64) -> f64 {
    (2.0 * height_m / GRAVITY_M_S2).sqrt()
}
