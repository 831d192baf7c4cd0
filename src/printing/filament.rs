//! The filament that a volume is printed from.

use std::f64::consts::FRAC_PI_4;

use crate::params::catalogue::Printer;

/// Diameter where a printer does not say its own, mm: what most take.
const USUAL_MM: f64 = 1.75;

/// What a printer takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filament {
    /// Diameter, mm.
    pub diameter_mm: f64,
}

impl Filament {
    /// That of a printer.
    pub fn of(printer: &Printer) -> Self {
        Self { diameter_mm: printer.filament_mm.unwrap_or(USUAL_MM) }
    }

    /// Volume of a length, mm³.
    pub fn volume_mm3(self, length_mm: f64) -> f64 {
        FRAC_PI_4 * self.diameter_mm * self.diameter_mm * length_mm
    }

    /// Length that has a volume, m.
    pub fn length_m(self, volume_mm3: f64) -> f64 {
        1e-3 * volume_mm3 / self.volume_mm3(1.0)
    }
}
