//! What a material prints over air, and the brim that it is printed with.

use crate::params::catalogue::{Material, Printer};
use crate::units::Angle;

/// What a material prints over air on a printer, and with which brim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Process {
    /// Width of a line, mm.
    pub line_mm: f64,
    /// Height of a layer, mm.
    pub layer_mm: f64,
    /// Steepest lean out of the vertical without support.
    pub overhang: Angle,
    /// Farthest that what leans more may reach out with a free edge, mm.
    pub ledge_mm: f64,
    /// Longest bridge, mm.
    pub bridge_mm: f64,
    /// Whether support comes off.
    pub support_comes_off: bool,
    /// Width of the brim around the first layer, mm.
    pub brim_mm: f64,
}

impl Process {
    /// That of a material on a printer; rules of thumb where the material says nothing.
    pub fn of(material: &Material, printer: &Printer) -> Self {
        Self {
            line_mm: printer.line_mm(),
            layer_mm: printer.layer_mm(material),
            overhang: Angle::deg(material.overhang_deg.unwrap_or(45.0)),
            ledge_mm: material.ledge_mm.unwrap_or(2.0),
            bridge_mm: material.bridge_mm.unwrap_or(10.0),
            support_comes_off: material.support_comes_off.unwrap_or(true),
            brim_mm: material.brim_mm.unwrap_or(0.0),
        }
    }
}
