//! How a part prints: in layers, over air, in walls, on its first layer.
//!
//! Everything is measured on the mesh that is printed, in print axes: mm, Z up, resting on z = 0.

mod chords;
mod footing;
mod layers;
mod unsupported;
mod walls;

pub use footing::Footing;
pub use unsupported::Hanging;
pub use walls::{Thin, Walls};

use crate::frame::assembly::Printed;
use crate::params::catalogue::{Material, Printer};
use crate::units::Angle;

/// What a material prints over air on a printer.
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
        }
    }
}

/// What a place that hangs breaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// It begins on nothing.
    Island,
    /// It reaches out too far.
    Overhang,
    /// It is bridged, too long.
    Bridge,
}

impl Hanging {
    /// What it breaks, if anything.
    pub fn fault(&self, process: &Process) -> Option<Fault> {
        if self.island {
            Some(Fault::Island)
        } else if self.bridged {
            (self.span_mm > process.bridge_mm).then_some(Fault::Bridge)
        } else {
            (self.reach_mm > process.ledge_mm).then_some(Fault::Overhang)
        }
    }
}

/// The places of a part that hang over air.
pub fn hanging(part: &Printed, process: &Process) -> Vec<Hanging> {
    unsupported::of(&part.printed, &part.mesh, process)
}

/// Whether a part needs support.
pub fn needs_support(part: &Printed, process: &Process) -> bool {
    hanging(part, process).iter().any(|place| place.fault(process).is_some())
}

#[cfg(test)]
mod tests;
