//! Payload mode: a share μ of the mass rides on a spring and a damper of its own.
//!
//! With z the payload's lag behind the frame, m_p = μ m, P = m_p [(2π f)² z + 2 ζ 2π f z']:
//!
//! (m - m_p) x'' = (m - m_p) g - F + P, m_p (x'' + z'') = m_p g - P.
//!
//! f is the payload's frequency on a frame that is held. The sensor sits on the frame, (F - P)/(m - m_p), unless the model
//! says `sensor_on = "payload"`, P/m_p. It stores m_p (2π f z)²/2. Source: two masses, e.g. J. P. Den Hartog, *Mechanical
//! Vibrations*.
//!
//! *When it is wrong:* where the payload has more than one mode, or hits its stops.

use super::effect::{Arrangement, Choice, Effect, Parameter, Spec, Stage};

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "payload_mode",
    title: "payload mode",
    stage: Stage::Arrangement,
    parameters: &[
        Parameter {
            key: "mu",
            unit: "1",
            si: 1.0,
            min: 0.0,
            max: 0.6,
            off: Some(0.0),
            default: None,
            doc: "payload's share of the whole mass",
        },
        Parameter {
            key: "f_hz",
            unit: "Hz",
            si: 1.0,
            min: 40.0,
            max: 450.0,
            off: None,
            default: None,
            doc: "payload's frequency on a frame that is held",
        },
        Parameter { key: "zeta", unit: "1", si: 1.0, min: 0.005, max: 1.5, off: None, default: Some(0.05), doc: "its damping ratio" },
    ],
    choice: Some(Choice { key: "sensor_on", words: &["frame", "payload"] }),
    build: |values, word| {
        let circular = 2.0 * std::f64::consts::PI * values[1];
        let payload = Payload { share: values[0], stiffness_1_s2: circular * circular, damping_1_s: 2.0 * values[2] * circular };
        Box::new(PayloadMode { payload, on_payload: word == 1 })
    },
};

#[derive(Clone, Copy, Debug)]
struct PayloadMode {
    payload: Payload,
    on_payload: bool,
}

impl Effect for PayloadMode {
    fn arrange(&self, arrangement: &mut Arrangement) {
        arrangement.payload = Some(self.payload);
        arrangement.sensor.on_payload = self.on_payload;
    }
}

/// A payload on a spring of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Payload {
    /// Its share of the whole mass.
    pub share: f64,
    /// Stiffness over its mass, 1/s².
    pub stiffness_1_s2: f64,
    /// Damping over its mass, 1/s.
    pub damping_1_s: f64,
}

impl Payload {
    /// Proper acceleration of the payload, m/s²: what pushes it up, over its mass.
    pub fn proper_m_s2(&self, lag_m: f64, lag_rate_m_s: f64) -> f64 {
        self.stiffness_1_s2 * lag_m + self.damping_1_s * lag_rate_m_s
    }
}
