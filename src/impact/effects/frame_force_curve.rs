//! A frame's own static curve: the base's spring k x becomes k [(1 - s) x + s φ(x)], φ with slope 1 at rest.
//!
//! φ is the force of a static load test over the stiffness at rest, as `flexframe stiffness` computes it from the frame's geometry:
//! sloping legs soften as they turn. The points stand in the model file; between them runs the cubic whose slopes are
//! those of the parabolas through three neighbours, beyond the last point the curve goes on straight, above the ground it
//! is x. The share s says how much of it there is: 0 none, 1 as the frame says. It stores k [(1 - s) x²/2 + s Φ(x)], Φ the
//! area under φ.
//!
//! *When it is wrong:* beyond the last point; in an impact, where motors and ring swing against the centre, and the force on the
//! ground is not that on the payload; for another frame than the curve's.

use std::sync::Arc;

use super::arrangement::{Arrangement, SpringCurve};
use super::effect::{Effect, Reach};
use super::frame_curve::FrameCurve;
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, singles};

/// Its record.
pub const SPEC: Spec = Spec {
    id: "frame_force_curve",
    title: "the frame's static curve",
    stage: Stage::Arrangement,
    availability: Availability::WithFrameCurve,
    parameters: &[Parameter {
        key: "share",
        unit: "1",
        si: 1.0,
        min: 0.0,
        max: 1.5,
        off: Some(0.0),
        default: None,
        scale: Scale::Linear,
        doc: "how much of the frame's curve stands in the spring's place",
    }],
    choice: None,
    states: &[],
    starts: |_| singles(&[0.3, 1.0]),
    build: |inputs| Box::new(FrameForceCurve { share: inputs.values[0], curve: inputs.frame_curve.cloned() }),
    generator: Generator::Conditions(|drop, values, _| drop.curve_share = values[0]),
};

#[derive(Clone, Debug)]
struct FrameForceCurve {
    share: f64,
    curve: Option<Arc<FrameCurve>>,
}

impl Effect for FrameForceCurve {
    fn arrange(&self, arrangement: &mut Arrangement) {
        arrangement.spring_curve = self.curve.clone().map(|curve| SpringCurve { share: self.share, curve });
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        let known_m = self.curve.as_ref()?.reach_m();
        let [deep, known] = [reach.deepest_m, known_m].map(|m| m * 1e3);
        (reach.deepest_m > known_m).then(|| format!("{deep:.1} mm is deeper than the {known:.1} mm to which the frame's curve goes"))
    }
}
