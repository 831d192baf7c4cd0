//! Sensor gain: the reading is gain times the true value.
//!
//! Source: calibration, or an axis tilted by θ (gain = cos θ).
//!
//! *When it is wrong:* tilt also lets sideways motion in, which no gain describes.

use super::arrangement::Arrangement;
use super::effect::{Effect, Reach};
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, singles};

/// Its record.
pub(super) const SPEC: Spec = Spec {
    id: "sensor_gain",
    title: "sensor gain",
    stage: Stage::Arrangement,
    availability: Availability::Any,
    parameters: &[Parameter {
        key: "gain",
        unit: "1",
        si: 1.0,
        min: 0.5,
        max: 1.5,
        off: Some(1.0),
        default: None,
        scale: Scale::Linear,
        doc: "reading over true value",
    }],
    choice: None,
    states: &[],
    starts: |_| singles(&[0.85, 1.15]),
    build: |inputs| Box::new(SensorGain { gain: inputs.values[0] }),
    generator: Generator::Conditions(|drop, values, _| drop.gain = values[0]),
};

#[derive(Clone, Copy, Debug)]
struct SensorGain {
    gain: f64,
}

impl Effect for SensorGain {
    fn arrange(&self, arrangement: &mut Arrangement) {
        arrangement.sensor.gain = self.gain;
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        // A drop with an impact.
        (self.gain > 1.0 && reach.impact_speed_m_s > 0.0)
            .then(|| "tilt can only lower the gain; a value above 1 indicates a wrong scale".into())
    }
}
