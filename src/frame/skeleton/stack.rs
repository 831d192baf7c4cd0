//! The boards under the hub: where each hangs on the four screws of the stack.
//!
//! From the hub's underside down: spacers, the flight controller between rubber dampers, spacers, the motor controller, a nut on each screw. How far each
//! board is below the hub is in [`hung_boards`](crate::params::hung_boards). A screw's head lies in its counterbore on the hub's plate.
//! Heights are in the frame's axes, mm.

use super::Centre;
use crate::params::Frame;
use crate::params::catalogue::BoughtPart;
use crate::params::hung_boards::{HungBoard, Spacers, hung_boards};

/// The stack of a frame, its boards' heights in the frame's axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Stack<'a> {
    /// The boards, from the hub down.
    pub boards: Vec<HungBoard<'a>>,
    /// Height of the faces that the screws' heads rest on.
    pub seat_mm: f64,
}

impl<'a> Stack<'a> {
    /// The stack under a hub.
    pub fn new(frame: &'a Frame, centre: &Centre) -> Self {
        let under_hub_mm = -centre.hub_half_height_mm;
        let spacers = |spacers: Spacers<'a>| Spacers { top_mm: spacers.top_mm + under_hub_mm, ..spacers };
        let hung = hung_boards(|role| frame.bought.get(role).map(|item| &item.part)).into_iter();
        let boards = hung
            .map(|board| HungBoard { middle_mm: board.middle_mm + under_hub_mm, spacers: board.spacers.map(spacers), ..board })
            .collect();
        Self { boards, seat_mm: centre.plate_top_mm - frame.hub.stack_counterbore_depth_mm }
    }

    /// The four screws' axes, x and y.
    pub fn axes_mm(frame: &Frame) -> [[f64; 2]; 4] {
        let half = 0.5 * frame.hub.stack_pattern_mm;
        [[half, half], [-half, half], [-half, -half], [half, -half]]
    }

    /// The dampers' entry, and the height of their middle; none where there is no board to hold.
    pub fn dampers(&self) -> Option<(&'a BoughtPart, f64)> {
        self.boards.iter().find_map(|board| Some((board.dampers?, board.middle_mm)))
    }

    /// The face that the nuts press on: the underside of the lowest circuit board, or of its dampers where it hangs in them.
    pub fn nut_seat_mm(&self) -> Option<f64> {
        self.boards.last().map(HungBoard::held_low_mm)
    }
}
