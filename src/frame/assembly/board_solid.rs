//! The solid of a circuit board with what is soldered onto it, by its catalogue entry.
//!
//! Its box is that of `size_mm`. The circuit board has the mounting holes, and around each a corner is free of components: a screw's
//! head, a damper or a foot stands there. What else is on it is one block, for no entry says where its components are.

use crate::frame::parts::outline::{SINK_MM, upright};
use crate::params::catalogue::BoughtPart;
use crate::solid::{Contour, Feature, Profile};

/// Free of components beyond a mounting hole's rim, mm: a washer of the screw that fits, and a damper.
const FREE_MM: f64 = 1.75;
/// Rounding of a board's corners where it has the room, mm: that of a Raspberry Pi Zero.
const ROUND_MM: f64 = 3.0;
/// Two pieces of a board lie in each other by this, so that they are one body, mm.
const SUNK_MM: f64 = 0.1;

/// Which sides of a circuit board carry components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Populated {
    /// The upper one: the lower face is that of the circuit board.
    Above,
    /// Both alike: the circuit board is in the middle of the height.
    Both,
}

/// A board that lies: length along y and width along x where `turned`, else length along x. Its holes are `pattern_mm` apart in x and
/// in y, and `low_mm` is the height of its lowest face.
pub(super) fn board(part: &BoughtPart, turned: bool, pattern_mm: [f64; 2], low_mm: f64, populated: Populated) -> Feature {
    let [length, width, height] = part.size_mm;
    let half = if turned { [0.5 * width, 0.5 * length] } else { [0.5 * length, 0.5 * width] };
    let thick = part.board_mm();
    let board_low = match populated {
        Populated::Above => low_mm,
        Populated::Both => low_mm + 0.5 * (height - thick),
    };
    let hole_mm = part.hole_diameter_mm.unwrap_or(0.0);
    let plate = upright(plate(half, pattern_mm, hole_mm), [board_low, board_low + thick]);
    if height - thick < 2.0 * SUNK_MM {
        return plate;
    }
    let reach = match populated {
        Populated::Above => [board_low + thick - SUNK_MM.min(0.5 * thick), low_mm + height],
        Populated::Both => [low_mm, low_mm + height],
    };
    Feature::union([plate, upright(Profile::new(populated_area(half, pattern_mm, hole_mm)), reach)])
}

/// The circuit board with its holes, those that it has room for.
fn plate(half: [f64; 2], pattern_mm: [f64; 2], hole_mm: f64) -> Profile {
    let margin = (0..2).map(|axis| half[axis] - 0.5 * pattern_mm[axis]).fold(f64::INFINITY, f64::min);
    let round = ROUND_MM.min(0.9 * half[0]).min(0.9 * half[1]).min(margin.max(0.0));
    let outline = Contour::rounded_rectangle([0.0, 0.0], half.map(|h| 2.0 * h), round);
    let inside = hole_mm > 0.0 && margin > 0.5 * hole_mm + SUNK_MM && pattern_mm.iter().all(|p| *p > hole_mm + SUNK_MM);
    let [x, y] = pattern_mm.map(|p| 0.5 * p);
    let holes = [[x, y], [-x, y], [-x, -y], [x, -y]].into_iter().filter(|_| inside);
    Profile::new(outline).with_holes(holes.map(|at| Contour::bore(at, 0.5 * hole_mm)))
}

/// The outline of a board without its four corners.
fn populated_area(half: [f64; 2], pattern_mm: [f64; 2], hole_mm: f64) -> Contour {
    let free = 0.5 * hole_mm + FREE_MM;
    // A board that is hardly wider than its pattern's pads keeps a bar in the middle.
    let inner = [0, 1].map(|axis| (0.5 * pattern_mm[axis] - free).clamp(0.1 * half[axis], half[axis]));
    // A little less than the circuit board, so that no two of their faces coincide.
    let ([x, y], [ix, iy]) = (half.map(|h| h - SINK_MM), inner);
    if ix >= x - SUNK_MM || iy >= y - SUNK_MM {
        return Contour::rectangle([0.0, 0.0], [2.0 * ix.min(x), 2.0 * iy.min(y)]);
    }
    Contour::polygon(&[
        [x, -iy],
        [x, iy],
        [ix, iy],
        [ix, y],
        [-ix, y],
        [-ix, iy],
        [-x, iy],
        [-x, -iy],
        [-ix, -iy],
        [-ix, -y],
        [ix, -y],
        [ix, -iy],
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Frame;
    use crate::solid::{MeshSolid, gate};

    #[test]
    fn analytic_every_catalogued_board_has_its_stated_box() {
        let (frame, _) = Frame::load("cognifly").expect("a preset");
        let mut part = frame.bought["computer"].part.clone();
        for (size, pattern) in [
            ([65.0, 30.0, 5.0], [58.0, 23.0]),
            ([28.0, 28.0, 7.0], [20.0, 20.0]),
            ([33.0, 33.0, 8.0], [25.5, 25.5]),
            ([90.0, 90.0, 60.0], [30.5, 30.5]),
            ([21.0, 21.0, 1.6], [20.0, 20.0]),
        ] {
            part.size_mm = size;
            for (turned, populated) in [(true, Populated::Above), (false, Populated::Both)] {
                let across = if turned { [pattern[1], pattern[0]] } else { pattern };
                let solid = MeshSolid::build(&board(&part, turned, across, -3.0, populated));
                let [low, high] = solid.bounds_mm();
                let box_mm = [0, 1, 2].map(|axis| high[axis] - low[axis]);
                let stated = if turned { [size[1], size[0], size[2]] } else { size };
                assert!((0..3).all(|axis| (box_mm[axis] - stated[axis]).abs() < 1e-4), "{size:?}: {box_mm:?}");
                assert!((low[2] + 3.0).abs() < 1e-4);
                assert!(gate::pass(&solid.to_mesh()).is_ok(), "{size:?}");
            }
        }
    }
}
