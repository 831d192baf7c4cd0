//! The boards under the hub: where each hangs on the four screws of the stack.
//!
//! From the hub's underside down: air, the flight controller between rubber dampers, the motor controller, a nut on each screw. A board is taken as it is
//! catalogued: its height is that of everything on it, and its circuit board lies in the middle of it, for no entry says how much is
//! on which side. A screw's head lies in its counterbore on the hub's plate. Heights are in the frame's axes, mm.

use super::Centre;
use crate::params::Frame;
use crate::params::catalogue::BoughtPart;

/// Air between the hub's underside and the first board, mm: chosen, for wires and solder.
const AIR_MM: f64 = 1.5;

/// A board of the stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StackBoard<'a> {
    /// Its role.
    pub role: &'static str,
    /// Its entry.
    pub part: &'a BoughtPart,
    /// Height of the middle of its circuit board.
    pub middle_mm: f64,
}

/// The stack of a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Stack<'a> {
    /// The boards, from the hub down.
    pub boards: Vec<StackBoard<'a>>,
    /// The dampers' entry, and the height of their middle; none where there is no board to hold.
    pub dampers: Option<(&'a BoughtPart, f64)>,
    /// Height of the faces that the screws' heads rest on.
    pub seat_mm: f64,
}

impl<'a> Stack<'a> {
    /// The stack under a hub.
    pub fn new(frame: &'a Frame, centre: &Centre) -> Self {
        let part = |role: &str| frame.bought.get(role).map(|item| &item.part);
        let under_hub_mm = -centre.hub_half_height_mm;
        let (mut low_mm, mut boards, mut dampers) = (under_hub_mm - AIR_MM, Vec::new(), None);
        for role in ["flight_controller", "motor_controller"] {
            let Some(board) = part(role) else { continue };
            let damper = part("damper").filter(|_| boards.is_empty());
            let half = [0.5 * board.size_mm[2], damper.map_or(0.0, |damper| 0.5 * damper.size_mm[2])];
            // Dampers are taller than a flat board: they reach the hub first.
            let middle_mm = (low_mm - half[0]).min(under_hub_mm - half[1]);
            dampers = dampers.or(damper.map(|damper| (damper, middle_mm)));
            boards.push(StackBoard { role, part: board, middle_mm });
            low_mm = middle_mm - half[0].max(half[1]);
        }
        Self { boards, dampers, seat_mm: centre.plate_top_mm - frame.hub.stack_counterbore_depth_mm }
    }

    /// The four screws' axes, x and y.
    pub fn axes_mm(frame: &Frame) -> [[f64; 2]; 4] {
        let half = 0.5 * frame.hub.stack_pattern_mm;
        [[half, half], [-half, half], [-half, -half], [half, -half]]
    }

    /// The face that the nuts press on: the underside of the lowest circuit board, or of its dampers where it hangs in them.
    pub fn nut_seat_mm(&self) -> Option<f64> {
        let lowest = self.boards.last()?;
        let board_mm = lowest.middle_mm - 0.5 * lowest.part.board_mm();
        let dampers = self.dampers.map(|(damper, middle_mm)| middle_mm - 0.5 * damper.size_mm[2]);
        Some(dampers.map_or(board_mm, |dampers_mm| board_mm.min(dampers_mm)))
    }
}
