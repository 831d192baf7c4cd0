//! Sensor gain: the reading is gain times what it should be.
//!
//! Source: calibration, or an axis tilted by θ (gain = cos θ).
//!
//! *When it is wrong:* tilt also lets sideways motion in, which no gain holds.

use super::effect::{Arrangement, Effect, Parameter, Reach, Spec, Stage};

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "sensor_gain",
    title: "sensor gain",
    stage: Stage::Arrangement,
    parameters: &[Parameter {
        key: "gain",
        unit: "1",
        si: 1.0,
        min: 0.5,
        max: 1.5,
        off: Some(1.0),
        default: None,
        doc: "reading over what it should be",
    }],
    choice: None,
    build: |values, _| Box::new(SensorGain { gain: values[0] }),
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
        // A drop that was felt at all.
        (self.gain > 1.0 && reach.impact_speed_m_s > 0.0).then(|| "a tilt only lowers the gain: more than 1 is a wrong scale".into())
    }
}
