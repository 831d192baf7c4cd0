//! The screws that hold the computer on its carrier. The hub lies right under the carrier, so they have no nuts: they come from above, cut their
//! thread in the carrier's holes, and end above the hub.

use super::mount::TIE;
use super::pilot_hole::{holds_mm, is_held};
use crate::params::Frame;
use crate::params::catalogue::BoughtPart;

/// Threads of small screws, mm.
pub(super) const THREADS_MM: [f64; 3] = [2.0, 2.5, 3.0];
/// Lengths that they are sold in, mm.
pub(super) const LENGTHS_MM: [f64; 8] = [3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0];
/// What the washers under the board are thicker than the strap of a tie that passes beside them, mm.
const ABOVE_STRAP_MM: f64 = 0.1;
/// Thickness of the strap of a tie whose entry does not state it, mm.
const USUAL_STRAP_MM: f64 = 1.1;

/// Screws of one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarrierScrew {
    /// Length, mm.
    pub length_mm: f64,
    /// From below its head to the carrier's upper face, mm: board and washers, and a connector's foot where it lies on one.
    pub clamped_mm: f64,
}

impl CarrierScrew {
    /// The longest that ends above the hub; none where the shortest is too long.
    fn longest(clamped_mm: f64, carrier_mm: f64) -> Option<Self> {
        let length_mm = LENGTHS_MM.into_iter().rev().find(|length| *length <= clamped_mm + carrier_mm)?;
        Some(Self { length_mm, clamped_mm })
    }

    /// How deep it is in the carrier, mm; negative where it does not reach it.
    pub fn engaged_mm(&self) -> f64 {
        self.length_mm - self.clamped_mm
    }
}

/// Thread and lengths of the screws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CarrierScrews {
    /// Thread, mm.
    pub thread_mm: f64,
    /// Those whose heads lie on the board.
    pub on_board: CarrierScrew,
    /// Those whose heads lie on the feet of the camera's connectors; none without a camera.
    pub on_feet: Option<CarrierScrew>,
}

impl CarrierScrews {
    /// Those of a frame; none where it has no computer, where no small screw passes the board's holes and holds in the carrier's, or
    /// none of these is short enough.
    pub fn new(frame: &Frame) -> Option<Self> {
        let board = &frame.bought.get("computer")?.part;
        let thread_mm = Self::thread_mm(frame)?;
        let clamped_mm = board.board_mm() + washers_mm(frame);
        let of = |clamped_mm: f64| CarrierScrew::longest(clamped_mm, frame.pi_carrier.carrier_thickness_mm);
        let on_feet = match frame.bought.contains_key("camera") {
            true => Some(of(frame.camera.camera_foot_mm + clamped_mm)?),
            false => None,
        };
        Some(Self { thread_mm, on_board: of(clamped_mm)?, on_feet })
    }

    /// Thread of the smallest screw that passes the board's holes and holds in the carrier's, mm.
    pub fn thread_mm(frame: &Frame) -> Option<f64> {
        let board = &frame.bought.get("computer")?.part;
        passing(board).find(|thread| is_held(*thread, frame.pi_carrier.pi_hole_diameter_mm))
    }

    /// Least and most of the carrier's holes in which a screw holds that passes the board's, mm: what one thread leaves the next takes.
    pub fn holes_mm(board: &BoughtPart) -> [f64; 2] {
        let widest = passing(board).fold(THREADS_MM[0], f64::max);
        [holds_mm(THREADS_MM[0])[0], holds_mm(widest)[1]]
    }

    /// A screw in words.
    pub fn words(&self, screw: CarrierScrew) -> String {
        format!("M{} x {}", self.thread_mm, screw.length_mm)
    }
}

/// Thickness of the washers on each of the carrier's holes together, mm: the strap of a tie passes beside them.
pub(super) fn washers_mm(frame: &Frame) -> f64 {
    let strap_mm = frame.bought.get(TIE).and_then(|tie| tie.part.strap_mm).map_or(USUAL_STRAP_MM, |strap| strap[1]);
    strap_mm + ABOVE_STRAP_MM
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
        let of = |frame: &Frame| {
            let screws = CarrierScrews::new(frame)?;
            Some((screws.thread_mm, screws.on_board.length_mm, screws.on_feet.map(|screw| screw.length_mm)))
        };
        assert_eq!(of(&frame), Some((2.0, 4.0, Some(8.0))));
        frame.pi_carrier.pi_hole_diameter_mm = 2.3;
        assert_eq!(of(&frame), Some((2.5, 4.0, Some(8.0))));
        frame.pi_carrier.pi_hole_diameter_mm = 1.97;
        assert_eq!(of(&frame), Some((2.5, 4.0, Some(8.0))), "between two threads");
        frame.pi_carrier.pi_hole_diameter_mm = 1.55;
        assert_eq!(of(&frame), None, "M2 splits it");
        frame.pi_carrier.pi_hole_diameter_mm = 2.3;
        frame.bought.remove("camera");
        assert_eq!(of(&frame), Some((2.5, 4.0, None)));
        frame.pi_carrier.pi_hole_diameter_mm = 2.75;
        assert_eq!(of(&frame), None, "M3 does not pass the board's holes");
    }

    /// Of 8 mm 4.3 mm are in the foot, 1.4 mm in the board, 1.2 mm in washers.
    #[test]
    fn analytic_what_is_not_clamped_is_in_the_carrier() {
        let (mut frame, _) = Frame::load("cognifly").expect("is a preset");
        let engaged = |frame: &Frame| {
            let screws = CarrierScrews::new(frame).expect("has them");
            [Some(screws.on_board), screws.on_feet].map(|screw| screw.map_or(f64::NAN, |screw| (screw.engaged_mm() * 1e6).round() / 1e6))
        };
        assert_eq!(engaged(&frame), [1.4, 1.1]);
        frame.camera.camera_foot_mm = 5.3;
        assert_eq!(engaged(&frame), [1.4, 0.1]);
        frame.pi_carrier.carrier_thickness_mm = 1.2;
        assert_eq!(engaged(&frame), [0.4, 0.1]);
    }

    #[test]
    fn analytic_holes_of_one_thread_reach_those_of_the_next() {
        for pair in THREADS_MM.windows(2) {
            assert!(holds_mm(pair[1])[0] <= holds_mm(pair[0])[1] + 1e-9, "{pair:?}");
        }
    }
}
