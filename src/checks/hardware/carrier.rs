//! The screws of the computer hold in its carrier.

use super::comparison::{measure, name, part};
use super::screws::ENGAGED;
use crate::checks::finding::Finding;
use crate::frame::mounting::{CarrierScrew, CarrierScrews};
use crate::params::Frame;

pub(super) const CARRIER_HOLES: &[&str] = &["pi_carrier.pi_hole_diameter_mm"];
pub(super) const ON_BOARD: &[&str] = &["pi_carrier.carrier_thickness_mm"];
pub(super) const ON_FEET: &[&str] = &["camera.camera_foot_mm", "pi_carrier.carrier_thickness_mm"];

/// The screws of the computer form their thread in the carrier's holes.
pub(super) fn holes(frame: &Frame) -> Vec<Finding> {
    let Some(board) = part(frame, "computer") else { return Vec::new() };
    let (called, hole) = (name(frame, "computer"), frame.pi_carrier.pi_hole_diameter_mm);
    let [least, most] = CarrierScrews::holes_mm(board).map(|limit| measure(hole, limit, "mm", CARRIER_HOLES));
    let ([wide, needed], [loose, held]) = (least.figures(2), most.figures(2));
    let screw = format!("the carrier's holes for {called} are {wide} mm wide, an M2 screw that forms its thread there needs {needed} mm");
    let thread = format!(
        "the carrier's holes for {called} are {loose} mm wide, a screw that passes the board's holes holds in {held} mm, and nuts have no room above \
         the hub"
    );
    vec![least.at_least("holes for the computer: screw".into(), screw), most.at_most("holes for the computer: thread".into(), thread)]
}

/// They are deep enough in it: those on the board, and those on the feet of the camera's connectors.
pub(super) fn engagement(frame: &Frame) -> Vec<Finding> {
    // Where no thread holds, the findings about the holes say so.
    let Some(thread_mm) = CarrierScrews::thread_mm(frame) else { return Vec::new() };
    let Some(screws) = CarrierScrews::new(frame) else {
        let message = format!("no screw M{thread_mm} that is sold is short enough to end in the carrier above the hub");
        return vec![measure(0.0, ENGAGED * thread_mm, "mm", ON_BOARD).at_least("screws of the computer: on the board".into(), message)];
    };
    let of = |screw: CarrierScrew, place: &str, through: &str, levers: &'static [&'static str]| {
        let engaged = measure(screw.engaged_mm(), ENGAGED * thread_mm, "mm", levers);
        let [reach, need] = engaged.figures(2);
        let message = format!(
            "{}, the longest that ends above the hub, goes through {:.1} mm of {through} and {reach} mm into the carrier, {need} mm are needed",
            screws.words(screw),
            screw.clamped_mm
        );
        engaged.at_least(format!("screws of the computer: {place}"), message)
    };
    let on_feet = screws.on_feet.map(|screw| of(screw, "on the connectors' feet", "foot, board and washers", ON_FEET));
    [of(screws.on_board, "on the board", "board and washers", ON_BOARD)].into_iter().chain(on_feet).collect()
}

#[cfg(test)]
mod tests {
    use crate::checks::hardware::tests::{broken, own};

    #[test]
    fn planted_holes_of_the_carrier() {
        assert_eq!(broken(|frame| frame.pi_carrier.pi_hole_diameter_mm = 1.5), ["holes for the computer: screw"]);
        assert_eq!(broken(|frame| frame.pi_carrier.pi_hole_diameter_mm = 2.75), ["holes for the computer: thread"]);
        let wider = broken(|frame| {
            own(frame, "computer", |board| board.hole_diameter_mm = Some(2.2));
            frame.pi_carrier.pi_hole_diameter_mm = 2.1;
        });
        assert_eq!(wider, ["holes for the computer: thread"], "an M2 screw falls through a hole that is wider than it");
    }

    /// M2 x 8 on feet of 5.3 mm, of which 7.9 mm are clamped, and M2 x 3 on the board over a carrier of 1.2 mm.
    #[test]
    fn planted_screws_that_hardly_reach_the_carrier() {
        assert_eq!(broken(|frame| frame.camera.camera_foot_mm = 5.3), ["screws of the computer: on the connectors' feet"]);
        assert_eq!(broken(|frame| frame.camera.camera_foot_mm = 6.0), Vec::<String>::new());
        assert!(broken(|frame| frame.pi_carrier.carrier_thickness_mm = 1.2).contains(&"screws of the computer: on the board".into()));
    }
}
