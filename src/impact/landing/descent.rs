//! How a body comes down: how fast, and how fast it turns.

use super::legged_body::Slopes;
use crate::impact::effects::{Fall, Model};

/// The end of a fall, at first touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Descent {
    /// Downward, m/s.
    pub speed_m_s: f64,
    /// Turning rate over the slope that it has led to, 1/s: a landing turns on as it turned while it fell.
    pub turning_1_s: f64,
}

impl Descent {
    /// From the stated height, with the turning rate that landings of one slope have in mean. Nothing turns the body in the air.
    pub fn of(model: &Model, slopes: &Slopes, height_m: f64) -> Self {
        let fall: Fall = model.arrangement().fall;
        Self { speed_m_s: fall.impact_speed_m_s(height_m), turning_1_s: slopes.turning_1_s(fall.duration_s(height_m)) }
    }
}
