//! Sensor saturation: the reading stops at ± the limit.
//!
//! Source: the range of an accelerometer (ADXL377: ±200 g at least) or of a converter (±230 g here). The model's own limit
//! holds, too: the lower of both acts, so a limit at or above the model's is 'off'.
//!
//! *When it is wrong:* a real front end recovers from overload late.

use super::arrangement::Arrangement;
use super::effect::Effect;
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, singles};

/// Its record.
pub const SPEC: Spec = Spec {
    id: "sensor_saturation",
    title: "sensor saturation",
    stage: Stage::Arrangement,
    availability: Availability::Any,
    parameters: &[Parameter {
        key: "limit_g",
        unit: "g",
        si: 1.0,
        min: 10.0,
        max: 250.0,
        off: None,
        default: None,
        scale: Scale::Logarithmic,
        doc: "largest reading",
    }],
    choice: None,
    states: &[],
    starts: |_| singles(&[15.0, 25.0, 35.0, 50.0, 70.0, 95.0, 130.0, 180.0]),
    build: |inputs| Box::new(SensorSaturation { limit_g: inputs.values[0] }),
    generator: Generator::Conditions(|drop, values, _| drop.limit_g = values[0].min(drop.limit_g)),
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
