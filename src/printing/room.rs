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

/// Where a part lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::printing) struct Place {
    /// Whether it is turned by a right angle.
    pub turned: bool,
    /// Middle of its box on the bed, mm.
    pub middle_mm: [f64; 2],
}

/// Where a part lies on the bed alone, without its brim: in the middle, or at an edge where the middle would take what is kept clear; turned by a
/// right angle or not.
pub(super) fn alone(part: &Printed, printer: &Printer) -> Option<Place> {
    let [x, y, z] = part.mesh.size_mm();
    if z > printer.height_mm {
        return None;
    }
    let places = match printer.bed {
        Bed::Rectangular => {
            let bed_mm = printer.size_mm;
            let turns = [(false, [x, y]), (true, [y, x])].into_iter().filter(|(_, side)| side[0] <= bed_mm[0] && side[1] <= bed_mm[1]);
            turns.flat_map(|(turned, side)| along(bed_mm, side).map(move |middle_mm| Place { turned, middle_mm })).collect()
        }
        Bed::Round if reach_mm(part) <= 0.5 * diameter_mm(printer) => vec![Place { turned: false, middle_mm: [0.0; 2] }],
        Bed::Round => Vec::new(),
    };
    places.into_iter().find(|place| lies_clear(place, part, printer, 0.0))
}

/// Whether a part has a place on the bed, alone and without its brim: as large as it needs, and clear of what the printer keeps clear.
pub fn has_place(part: &Printed, printer: &Printer) -> bool {
    alone(part, printer).is_some()
}

/// The middle of a box in the middle of a bed, and at its edges and corners, mm.
fn along(bed_mm: [f64; 2], side_mm: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    let at = move |axis: usize, share: f64| 0.5 * side_mm[axis] + share * (bed_mm[axis] - side_mm[axis]);
    [0.5, 0.0, 1.0].into_iter().flat_map(move |along_x| [0.5, 0.0, 1.0].map(|along_y| [at(0, along_x), at(1, along_y)]))
}

/// The middle of a box on the bed, with this much around it: in the middle of the bed, or at an edge where the middle would take what is kept clear,
/// mm. `None` where the box has no room.
pub(super) fn middle_of_box(side_mm: [f64; 2], printer: &Printer, rim_mm: f64) -> Option<[f64; 2]> {
    let whole_mm = side_mm.map(|side| side + 2.0 * rim_mm);
    let middles = match printer.bed {
        Bed::Rectangular if (0..2).all(|axis| whole_mm[axis] <= printer.size_mm[axis]) => along(printer.size_mm, whole_mm).collect(),
        Bed::Round if libm::hypot(side_mm[0], side_mm[1]) <= diameter_mm(printer) - 2.0 * rim_mm => vec![[0.0; 2]],
        _ => Vec::new(),
    };
    middles.into_iter().find(|middle_mm| box_lies_clear(*middle_mm, side_mm, printer, rim_mm))
}

/// Whether nothing of a part, and of a rim around it, lies where the printer's bed is kept clear.
pub(in crate::printing) fn lies_clear(place: &Place, part: &Printed, printer: &Printer, rim_mm: f64) -> bool {
    let [x, y, _] = part.mesh.size_mm();
    let side = if place.turned { [y, x] } else { [x, y] };
    box_lies_clear(place.middle_mm, side, printer, rim_mm)
}

/// The same of a box on the bed, by its middle and its sides, mm.
fn box_lies_clear(middle_mm: [f64; 2], side_mm: [f64; 2], printer: &Printer, rim_mm: f64) -> bool {
    let apart = |kept: &[f64; 4]| {
        (0..2).any(|axis| {
            let [low, high] = [kept[axis].min(kept[axis + 2]), kept[axis].max(kept[axis + 2])];
            (middle_mm[axis] - 0.5 * (low + high)).abs() >= 0.5 * (side_mm[axis] + high - low) + rim_mm
        })
    };
    printer.kept_clear_mm.iter().flatten().all(apart)
}

fn diameter_mm(printer: &Printer) -> f64 {
    printer.size_mm[0].min(printer.size_mm[1])
}

/// Largest distance of a point of the part from the middle of its box, in plan, mm.
pub fn reach_mm(part: &Printed) -> f64 {
    let [low, high] = part.mesh.bounds_mm();
    let middle = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
    let distance = |v: &[f32; 3]| libm::hypot(f64::from(v[0]) - middle[0], f64::from(v[1]) - middle[1]);
    part.mesh.vertices.iter().map(distance).fold(0.0, f64::max)
}
