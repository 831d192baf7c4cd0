//! The screws that hold the camera on its connectors: they pass its board and the connectors' posts, and have their nuts behind these.

use super::carrier_screws::{LENGTHS_MM, THREADS_MM};
use crate::frame::parts::camera_connector::POST_LENGTH_MM;
use crate::params::Frame;

/// Height of a nut over the thread's diameter (ISO 4032).
const NUT: f64 = 0.8;
/// Two on each connector.
const COUNT: usize = 4;

/// Thread and length of the screws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraScrews {
    /// Thread, mm.
    pub thread_mm: f64,
    /// Length, mm: the shortest that reaches through the nut.
    pub length_mm: f64,
}

impl CameraScrews {
    /// Those of a frame; none where it has no camera, or no small screw passes its holes and the connectors'.
    pub fn new(frame: &Frame) -> Option<Self> {
        let board = &frame.bought.get("camera")?.part;
        let hole_mm = board.hole_diameter_mm.unwrap_or(f64::INFINITY).min(frame.camera.camera_hole_diameter_mm);
        let thread_mm = THREADS_MM.into_iter().rev().find(|thread| *thread <= hole_mm)?;
        let through_mm = board.board_mm() + POST_LENGTH_MM + NUT * thread_mm;
        let length_mm = LENGTHS_MM.into_iter().find(|length| *length >= through_mm)?;
        Some(Self { thread_mm, length_mm })
    }

    /// How many of which, in a step.
    pub fn words(&self) -> String {
        format!("{COUNT} screws M{} x {}, a nut behind each post", self.thread_mm, self.length_mm)
    }

    /// The same in a bill.
    pub fn bill_words(&self) -> String {
        format!("{COUNT} x M{} x {} with nuts", self.thread_mm, self.length_mm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Posts of 3.5 mm, a board of 1.6 mm, a nut of 1.6 mm of M2: 6.7 mm, so the next longer screw.
    #[test]
    fn analytic_screws_of_the_camera_reach_through_their_nuts() {
        let (mut frame, _) = Frame::load("cognifly").expect("is a preset");
        let of = |frame: &Frame| CameraScrews::new(frame).map(|screws| (screws.thread_mm, screws.length_mm));
        assert_eq!(of(&frame), Some((2.0, 8.0)));
        let camera = &mut frame.bought.get_mut("camera").expect("has one").part;
        (camera.hole_diameter_mm, camera.board_thickness_mm) = (Some(2.6), Some(1.0));
        assert_eq!(of(&frame), Some((2.0, 8.0)), "the connectors' holes are narrower");
        frame.camera.camera_hole_diameter_mm = 2.5;
        assert_eq!(of(&frame), Some((2.5, 8.0)));
        frame.camera.camera_hole_diameter_mm = 1.9;
        assert_eq!(of(&frame), None);
        frame.bought.remove("camera");
        assert_eq!(of(&frame), None);
    }
}
