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

use super::arrangement::{Arrangement, AttachedMass};
use super::effect::Effect;
use super::generator::{Generator, Rider};
use super::parameter::{Choice, Parameter, Scale};
use super::spec::{Availability, Spec, Stage, products};

/// A payload's frequencies. Two waves that ring out within 20 ms are out of step when they differ by more than 25 Hz, and a fit
/// from there ends in a minimum of its own.
const FREQUENCIES_HZ: [f64; 16] =
    [45.0, 58.0, 72.0, 88.0, 105.0, 124.0, 144.0, 166.0, 189.0, 214.0, 240.0, 268.0, 298.0, 330.0, 365.0, 410.0];

/// Frequencies of a payload that is damped much: it hardly rings, and waves are alike over wider ranges.
const DAMPED_HZ: [f64; 7] = [45.0, 65.0, 95.0, 135.0, 190.0, 270.0, 380.0];
/// Its damping ratio.
const DAMPED: f64 = 0.4;

/// Its record.
pub const SPEC: Spec = Spec {
    id: "payload_mode",
    title: "payload mode",
    stage: Stage::Arrangement,
    availability: Availability::Any,
    parameters: &[
        Parameter {
            key: "mu",
            unit: "1",
            si: 1.0,
            min: 0.0,
            max: 0.6,
            off: Some(0.0),
            default: None,
            scale: Scale::Linear,
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
            scale: Scale::Logarithmic,
            doc: "payload's frequency on a frame that is held",
        },
        Parameter {
            key: "zeta",
            unit: "1",
            si: 1.0,
            min: 0.005,
            max: 1.5,
            off: None,
            default: Some(0.05),
            scale: Scale::Logarithmic,
            doc: "its damping ratio",
        },
    ],
    choice: Some(Choice { key: "sensor_on", words: &["frame", "payload"] }),
    states: &AttachedMass::STATES,
    starts: |known| {
        let own = known.frame_mode.map(|[mu, f_hz]| vec![mu, f_hz, 0.05]);
        let damped = products(&[0.2], &DAMPED_HZ, &[DAMPED]);
        products(&[0.05, 0.2], &FREQUENCIES_HZ, &[0.05]).into_iter().chain(damped).chain(own).collect()
    },
    build: |inputs| {
        let circular = 2.0 * std::f64::consts::PI * inputs.values[1];
        let payload = AttachedMass {
            effect: SPEC.id,
            share: inputs.values[0],
            stiffness_1_s2: circular * circular,
            damping_1_s: 2.0 * inputs.values[2] * circular,
        };
        Box::new(PayloadMode { payload, on_payload: inputs.word == 1 })
    },
    generator: Generator::Conditions(|drop, values, word| {
        if values[0] > 0.0 {
            drop.riders.push(Rider { share: values[0], f_hz: values[1], zeta: values[2] });
            drop.on_rider = word == 1;
        }
    }),
};

#[derive(Clone, Copy, Debug)]
struct PayloadMode {
    payload: AttachedMass,
    on_payload: bool,
}

impl Effect for PayloadMode {
    fn arrange(&self, arrangement: &mut Arrangement) {
        arrangement.attached = Some(self.payload);
        arrangement.sensor.on_payload = self.on_payload;
    }
}
