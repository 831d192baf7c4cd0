//! Sensor low-pass: y' = 2π f (F/m - y), with this cutoff in place of the model's.
//!
//! Source: an accelerometer behind its output filter. Leaving it out, or stating the model's own cutoff, is 'off'. The
//! order stays the model's (1 in the shipped files).
//!
//! *When it is wrong:* a sensor on wires and foam has a resonance, too; the impulse stays what it was.

use super::effect::{Arrangement, Effect, Parameter, Spec, Stage};

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "sensor_low_pass",
    title: "sensor low-pass",
    stage: Stage::Arrangement,
    parameters: &[Parameter {
        key: "cutoff_hz",
        unit: "Hz",
        si: 1.0,
        min: 20.0,
        max: 2000.0,
        off: None,
        default: None,
        doc: "cutoff in place of the model's",
    }],
    choice: None,
    build: |values, _| Box::new(SensorLowPass { cutoff_hz: values[0] }),
};

#[derive(Clone, Copy, Debug)]
struct SensorLowPass {
    cutoff_hz: f64,
}

impl Effect for SensorLowPass {
    fn arrange(&self, arrangement: &mut Arrangement) {
        arrangement.sensor.cutoff_hz = self.cutoff_hz;
    }
}
