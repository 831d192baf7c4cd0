//! Air drag in the fall: v' = g - β v², so v0² = g/β (1 - exp(-2 β h)).
//!
//! Source: drag of a bluff body, β = ρ C A / (2 m): for 1.2 kg/m³, C A = 0.02 m² and 0.241 kg it is 0.05 1/m. The fall
//! takes acosh(exp(β h)) / √(g β). After first touch it does not act: the contact is short.
//!
//! *When it is wrong:* for a frame that turns as it falls, or with propellers that spin.

use super::arrangement::Arrangement;
use super::effect::{Effect, Reach};
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, singles};

/// Drag over mass beyond which no frame of this size and mass is, 1/m.
const BLUFF_1_M: f64 = 0.2;

/// Its record.
pub const SPEC: Spec = Spec {
    id: "air_drag",
    title: "air drag in the fall",
    stage: Stage::Arrangement,
    availability: Availability::Any,
    parameters: &[Parameter {
        key: "beta",
        unit: "1/m",
        si: 1.0,
        min: 0.0,
        max: 1.0,
        off: Some(0.0),
        default: None,
        scale: Scale::Linear,
        doc: "drag over mass",
    }],
    choice: None,
    states: &[],
    starts: |_| singles(&[0.05, 0.3]),
    build: |inputs| Box::new(AirDrag { drag_1_m: inputs.values[0] }),
    generator: Generator::Conditions(|drop, values, _| drop.drag_1_m = values[0]),
};

#[derive(Clone, Copy, Debug)]
struct AirDrag {
    drag_1_m: f64,
}

impl Effect for AirDrag {
    fn arrange(&self, arrangement: &mut Arrangement) {
        arrangement.fall.drag_1_m = self.drag_1_m;
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        (self.drag_1_m > BLUFF_1_M && reach.impact_speed_m_s > 0.0)
            .then(|| format!("beta = {} 1/m is more drag than a body of this size has (0.05 1/m, with room {BLUFF_1_M})", self.drag_1_m))
    }
}
