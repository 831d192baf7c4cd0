//! The screws that hold the computer on its carrier. The hub lies right under the carrier, so they have no nuts: they come from above, cut their
//! thread in the carrier's holes, and end above the hub.

use crate::params::Frame;
use crate::params::catalogue::BoughtPart;

/// Threads of small screws, mm.
const THREADS_MM: [f64; 3] = [2.0, 2.5, 3.0];
/// Lengths that they are sold in, mm.
const LENGTHS_MM: [f64; 8] = [3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0];
/// By how much a thread that is cut in a printed hole is wider than that, mm: least of all, and most of the smallest. The real frame's hub has 0.1 mm.
const BITE_MM: [f64; 2] = [-0.1, 0.3];
/// What the washers under the board are thicker than the strap of a tie that passes beside them, mm.
const ABOVE_STRAP_MM: f64 = 0.1;
/// Thickness of the strap of a tie whose entry does not state it, mm.
const USUAL_STRAP_MM: f64 = 1.1;

/// Thread and lengths of the screws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarrierScrews {
    /// Thread, mm.
    pub thread_mm: f64,
    /// Length of those whose heads lie on the board, mm.
    pub on_board_mm: f64,
    /// Length of those whose heads lie on the feet of the camera's connectors, mm; none without a camera.
    pub on_feet_mm: Option<f64>,
}

impl CarrierScrews {
    /// Those of a frame; none where it has no computer, where no small screw passes the board's holes and holds in the carrier's, or
    /// none of these is short enough.
    pub fn new(frame: &Frame) -> Option<Self> {
        let board = &frame.bought.get("computer")?.part;
        let pilot_mm = frame.pi_carrier.pi_hole_diameter_mm;
        let [least_mm, most_mm] = Self::holes_mm(board);
        // The smallest that holds: between two threads the larger one bites by 0.4 mm at most.
        let thread_mm =
            passing(board).find(|thread| thread - pilot_mm >= BITE_MM[0]).filter(|_| (least_mm..=most_mm).contains(&pilot_mm))?;
        let strap_mm = frame.bought.get("tie").and_then(|tie| tie.part.strap_mm).map_or(USUAL_STRAP_MM, |strap| strap[1]);
        let under_board_mm = strap_mm + ABOVE_STRAP_MM + frame.pi_carrier.carrier_thickness_mm;
        let longest = |room_mm: f64| LENGTHS_MM.into_iter().rev().find(|length| *length <= room_mm);
        let on_board_mm = longest(board.board_mm() + under_board_mm)?;
        let on_feet_mm = match frame.bought.contains_key("camera") {
            true => Some(longest(frame.camera.camera_foot_mm + board.board_mm() + under_board_mm)?),
            false => None,
        };
        Some(Self { thread_mm, on_board_mm, on_feet_mm })
    }

    /// Least and most of the carrier's holes in which a screw holds that passes the board's, mm.
    pub fn holes_mm(board: &BoughtPart) -> [f64; 2] {
        let widest = passing(board).fold(THREADS_MM[0], f64::max);
        [THREADS_MM[0] - BITE_MM[1], widest - BITE_MM[0]]
    }

    /// A screw of a length in words.
    pub fn words(&self, length_mm: f64) -> String {
        format!("M{} x {length_mm}", self.thread_mm)
    }
}

/// Threads that pass a board's holes, the smallest first.
fn passing(board: &BoughtPart) -> impl Iterator<Item = f64> {
    let hole = board.hole_diameter_mm;
    THREADS_MM.into_iter().filter(move |thread| hole.is_none_or(|hole| *thread <= hole))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Strap 1.1 mm, carrier 2 mm, board 1.4 mm, foot 4.3 mm: 4.6 mm below a head on the board, 8.9 mm below one on a foot.
    #[test]
    fn analytic_screws_of_the_carrier_end_above_the_hub() {
        let (mut frame, _) = Frame::load("cognifly").expect("is a preset");
        let of = |frame: &Frame| CarrierScrews::new(frame).map(|screws| (screws.thread_mm, screws.on_board_mm, screws.on_feet_mm));
        assert_eq!(of(&frame), Some((2.0, 4.0, Some(8.0))));
        frame.pi_carrier.pi_hole_diameter_mm = 2.3;
        assert_eq!(of(&frame), Some((2.5, 4.0, Some(8.0))));
        frame.pi_carrier.pi_hole_diameter_mm = 2.15;
        assert_eq!(of(&frame), Some((2.5, 4.0, Some(8.0))), "between two threads");
        frame.pi_carrier.pi_hole_diameter_mm = 1.65;
        assert_eq!(of(&frame), None, "M2 splits it");
        frame.pi_carrier.pi_hole_diameter_mm = 2.3;
        frame.bought.remove("camera");
        assert_eq!(of(&frame), Some((2.5, 4.0, None)));
        frame.pi_carrier.pi_hole_diameter_mm = 2.75;
        assert_eq!(of(&frame), None, "M3 does not pass the board's holes");
    }
}
