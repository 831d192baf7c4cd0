//! The room on a bed.

use crate::frame::assembly::Printed;
use crate::params::catalogue::{Bed, Printer};

/// Least kept free at the bed's edge, mm: clips, and a bed that is not quite where the firmware believes.
const EDGE_MM: f64 = 3.0;
/// Least kept free between parts, mm: half of it is taken by each part's brim, and the nozzle passes without touching.
const GAP_MM: f64 = 8.0;

/// The rectangle that is filled, in the bed's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::printing) struct Room {
    pub low_mm: [f64; 2],
    pub size_mm: [f64; 2],
    /// Kept free between parts.
    pub gap_mm: f64,
    /// Kept free at the bed's edge.
    pub edge_mm: f64,
}

impl Room {
    /// The whole of a rectangular bed, of a round one the square that stands in it, with room for brims of this width at the edge and
    /// between the parts.
    pub fn of(printer: &Printer, brim_mm: f64) -> Self {
        let (edge_mm, gap_mm) = (EDGE_MM.max(brim_mm), GAP_MM.max(2.0 * brim_mm));
        match printer.bed {
            Bed::Rectangular => {
                Self { low_mm: [edge_mm; 2], size_mm: printer.size_mm.map(|size| (size - 2.0 * edge_mm).max(0.0)), gap_mm, edge_mm }
            }
            Bed::Round => {
                let side = ((diameter_mm(printer) - 2.0 * edge_mm) / std::f64::consts::SQRT_2).max(0.0);
                Self { low_mm: [-0.5 * side; 2], size_mm: [side; 2], gap_mm, edge_mm }
            }
        }
    }

    /// The same with a share of its sides.
    pub fn shrunk(self, percent: u32) -> Self {
        Self { size_mm: self.size_mm.map(|size| 0.01 * f64::from(percent) * size), ..self }
    }

    /// Middle of the bed.
    pub fn middle_mm(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.low_mm[axis] + 0.5 * self.size_mm[axis])
    }
}

/// Whether a part alone in the middle of the bed lies on it, without its brim; turned by a right angle or not.
pub(super) fn alone(part: &Printed, printer: &Printer) -> Option<bool> {
    let [x, y, z] = part.mesh.size_mm();
    if z > printer.height_mm {
        return None;
    }
    match printer.bed {
        Bed::Rectangular => {
            let fits = |x: f64, y: f64| x <= printer.size_mm[0] && y <= printer.size_mm[1];
            [false, true].into_iter().find(|turned| if *turned { fits(y, x) } else { fits(x, y) })
        }
        Bed::Round => (reach_mm(part) <= 0.5 * diameter_mm(printer)).then_some(false),
    }
}

fn diameter_mm(printer: &Printer) -> f64 {
    printer.size_mm[0].min(printer.size_mm[1])
}

/// Largest distance of a point of the part from the middle of its box, in plan, mm.
fn reach_mm(part: &Printed) -> f64 {
    let [low, high] = part.mesh.bounds_mm();
    let middle = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
    let distance = |v: &[f32; 3]| libm::hypot(f64::from(v[0]) - middle[0], f64::from(v[1]) - middle[1]);
    part.mesh.vertices.iter().map(distance).fold(0.0, f64::max)
}
