//! The room on a bed.

use crate::frame::assembly::Printed;
use crate::params::catalogue::{Bed, Printer};

/// Kept free at the bed's edge beside the brim, mm: clips, and a bed that is not quite where the firmware believes.
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
        let (edge_mm, gap_mm) = (EDGE_MM + brim_mm, GAP_MM.max(2.0 * brim_mm));
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

/// What is no farther over an edge lies on it, mm: rounding.
const ON_MM: f64 = 1e-9;

/// Where a part lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::printing) struct Place {
    /// Whether it is turned by a right angle.
    pub turned: bool,
    /// Middle of its box on the bed, mm.
    pub middle_mm: [f64; 2],
}

/// Where a part lies on the bed alone, without its brim: in the middle, or at an edge or beside what is kept clear where the middle would take that;
/// turned by a right angle or not.
pub(super) fn alone(part: &Printed, printer: &Printer) -> Option<Place> {
    let [x, y, z] = part.mesh.size_mm();
    if z > printer.height_mm {
        return None;
    }
    // A part that is no box reaches less far around the middle of a round bed than its box does.
    let as_it_is = printer.bed == Bed::Round && reach_mm(part) <= 0.5 * diameter_mm(printer);
    let in_the_middle = as_it_is.then_some(Place { turned: false, middle_mm: [0.0; 2] });
    let turns = [(false, [x, y]), (true, [y, x])].into_iter();
    let places =
        turns.flat_map(|(turned, side)| middles_mm(side, printer, 0.0).into_iter().map(move |middle_mm| Place { turned, middle_mm }));
    in_the_middle.into_iter().chain(places).find(|place| lies_clear(place, part, printer, 0.0))
}

/// Whether a part has a place on the bed, alone and without its brim: as large as it needs, and clear of what the printer keeps clear.
pub fn has_place(part: &Printed, printer: &Printer) -> bool {
    alone(part, printer).is_some()
}

/// Where the middle of a box with a rim may lie on the bed, mm: the middle of the bed, its edges, and beside each area that is kept clear, along each
/// axis. A place that is as far to a side as it goes is among these where there is any.
fn middles_mm(side_mm: [f64; 2], printer: &Printer, rim_mm: f64) -> Vec<[f64; 2]> {
    let half_mm = side_mm.map(|side| 0.5 * side + rim_mm);
    let kept = || printer.kept_clear_mm.iter().flatten();
    let beside = |axis: usize| {
        kept().flat_map(move |area| {
            let [low, high] = [area[axis].min(area[axis + 2]), area[axis].max(area[axis + 2])];
            [low - half_mm[axis], high + half_mm[axis]]
        })
    };
    match printer.bed {
        Bed::Rectangular => {
            let bed_mm = printer.size_mm;
            let along = |axis: usize| -> Vec<f64> {
                let all = [0.5 * bed_mm[axis], half_mm[axis], bed_mm[axis] - half_mm[axis]].into_iter().chain(beside(axis));
                all.filter(|at| half_mm[axis] <= *at + ON_MM && *at <= bed_mm[axis] - half_mm[axis] + ON_MM).collect()
            };
            let across = along(1);
            along(0).into_iter().flat_map(|x| across.iter().map(move |y| [x, *y])).collect()
        }
        Bed::Round => {
            let radius_mm = 0.5 * diameter_mm(printer) - rim_mm;
            let corner_mm = side_mm.map(|side| 0.5 * side);
            let lies_on = |at: &[f64; 2]| libm::hypot(at[0].abs() + corner_mm[0], at[1].abs() + corner_mm[1]) <= radius_mm + ON_MM;
            let [xs, ys] = [0, 1].map(|axis| std::iter::once(0.0).chain(beside(axis)).collect::<Vec<f64>>());
            // As far as the edge along one axis.
            let edge = |other: f64, axis: usize| {
                let far = other.abs() + corner_mm[1 - axis];
                (radius_mm * radius_mm - far * far).max(0.0).sqrt() - corner_mm[axis]
            };
            let crossed = xs.iter().flat_map(|x| ys.iter().map(move |y| [*x, *y]));
            let at_edges = xs
                .iter()
                .flat_map(|x| [[*x, edge(*x, 1)], [*x, -edge(*x, 1)]])
                .chain(ys.iter().flat_map(|y| [[edge(*y, 0), *y], [-edge(*y, 0), *y]]));
            crossed.chain(at_edges).filter(lies_on).collect()
        }
    }
}

/// The middle of a box on the bed, with this much around it: in the middle of the bed, or at an edge or beside what is kept clear where the middle
/// would take that, mm. `None` where the box has no room.
pub(super) fn middle_of_box(side_mm: [f64; 2], printer: &Printer, rim_mm: f64) -> Option<[f64; 2]> {
    middles_mm(side_mm, printer, rim_mm).into_iter().find(|middle_mm| box_lies_clear(*middle_mm, side_mm, printer, rim_mm))
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
            (middle_mm[axis] - 0.5 * (low + high)).abs() >= 0.5 * (side_mm[axis] + high - low) + rim_mm - ON_MM
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
