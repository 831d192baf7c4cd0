//! The sensor: proper acceleration in, a reading in g out.
//!
//! It reads 0 g in free fall and more while the ground pushes. A low-pass of n equal first-order stages, each with the
//! stated cutoff, then gain, then the limit. Sampling and quantisation come after (`sim::Sampler`).

use crate::units::GRAVITY_M_S2;

/// What a model was fitted to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Channel {
    /// Acceleration along the axis.
    Axial,
    /// The magnitude of all three axes, as the paper did; it contains sideways motion.
    Magnitude,
}

/// A sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensor {
    /// Cutoff of each stage, Hz.
    pub cutoff_hz: f64,
    /// Number of stages.
    pub order: usize,
    /// Reading over true value.
    pub gain: f64,
    /// Largest reading, g.
    pub limit_g: f64,
    /// Whether it rides on the payload; on the frame otherwise.
    pub on_payload: bool,
    /// What it is compared with.
    pub channel: Channel,
}

impl Sensor {
    /// Rate of each stage, 1/s.
    pub fn rate_1_s(&self) -> f64 {
        2.0 * std::f64::consts::PI * self.cutoff_hz
    }

    /// The reading in g, from the low-pass's output in m/s².
    pub fn reading_g(&self, filtered_m_s2: f64) -> f64 {
        (self.gain * (filtered_m_s2 / GRAVITY_M_S2)).clamp(-self.limit_g, self.limit_g)
    }
}
