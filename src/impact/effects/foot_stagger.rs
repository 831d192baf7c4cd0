//! Foot stagger: four feet touch one after the other, F = Σ ¼ [k (x - d_i) + c v] over those that have touched,
//! d_i = δ i/3 for i = 0 … 3, in place of the base spring and damper.
//!
//! Source: a frame that lands tilted. A foot that has touched stays linked, as in the bilateral base. It stores
//! Σ k (x - d_i)²/8.
//!
//! *When it is wrong:* a tilted body also turns, which takes energy out of the fall; feet are taken evenly spaced.

use super::arrangement::{Arrangement, Feet};
use super::effect::{Effect, Reach};
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, singles};

/// Its record.
pub(super) const SPEC: Spec = Spec {
    id: "foot_stagger",
    title: "foot stagger",
    stage: Stage::Arrangement,
    availability: Availability::Any,
    parameters: &[Parameter {
        key: "delta_mm",
        unit: "mm",
        si: 1e-3,
        min: 0.0,
        max: 20.0,
        off: Some(0.0),
        default: None,
        scale: Scale::Linear,
        doc: "from the first foot's touch to the last's",
    }],
    choice: None,
    states: &[],
    starts: |_| singles(&[1.0, 4.0, 10.0]),
    build: |inputs| Box::new(FootStagger { spread_m: inputs.values[0] }),
    generator: Generator::Conditions(|drop, values, _| drop.stagger_m = values[0] * 1e-3),
};

#[derive(Clone, Copy, Debug)]
struct FootStagger {
    spread_m: f64,
}

impl Effect for FootStagger {
    fn arrange(&self, arrangement: &mut Arrangement) {
        arrangement.feet = Some(Feet { at_m: [0.0, 1.0, 2.0, 3.0].map(|i| self.spread_m * i / 3.0) });
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        (reach.deepest_m < self.spread_m).then(|| {
            format!(
                "the last foot, at {:.1} mm, does not touch within {:.1} mm: a body tilted this far rotates",
                self.spread_m * 1e3,
                reach.deepest_m * 1e3
            )
        })
    }
}
