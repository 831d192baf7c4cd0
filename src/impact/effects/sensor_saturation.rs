//! Sensor saturation: the reading stops at ± the limit.
//!
//! Source: the range of an accelerometer (ADXL377: ±200 g at least) or of a converter (±230 g here). The model's own limit
//! holds, too: the lower of both acts, so a limit at or above the model's is 'off'.
//!
//! *When it is wrong:* a real front end recovers from overload late.

use super::effect::{Arrangement, Effect, Parameter, Spec, Stage};

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "sensor_saturation",
    title: "sensor saturation",
    stage: Stage::Arrangement,
    parameters: &[Parameter {
        key: "limit_g",
        unit: "g",
        si: 1.0,
        min: 10.0,
        max: 250.0,
        off: None,
        default: None,
        doc: "largest reading",
    }],
    choice: None,
    build: |values, _| Box::new(SensorSaturation { limit_g: values[0] }),
};

#[derive(Clone, Copy, Debug)]
struct SensorSaturation {
    limit_g: f64,
}

impl Effect for SensorSaturation {
    fn arrange(&self, arrangement: &mut Arrangement) {
        arrangement.sensor.limit_g = arrangement.sensor.limit_g.min(self.limit_g);
    }
}
