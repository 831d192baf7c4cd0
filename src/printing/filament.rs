//! The filament that a volume is printed from: 1.75 mm thick.

use std::f64::consts::FRAC_PI_4;

/// Diameter, mm.
pub const FILAMENT_MM: f64 = 1.75;
/// Section, mm².
pub const FILAMENT_MM2: f64 = FRAC_PI_4 * FILAMENT_MM * FILAMENT_MM;

/// Length that has a volume, m.
pub fn filament_m(volume_mm3: f64) -> f64 {
    1e-3 * volume_mm3 / FILAMENT_MM2
}
