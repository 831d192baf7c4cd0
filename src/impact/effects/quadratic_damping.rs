//! Quadratic damping: F = c2 v |v|.
//!
//! Source: the drag of a flow, and the next term of a damper in v. All its work is lost.
//!
//! *When it is wrong:* there is no flow in a frame; with a negative c2 it feeds energy in, and the simulation diverges where it
//! outweighs the damper.

use super::effect::{Effect, MotionState, Reach, Threshold};
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, singles};

/// Its record.
pub(super) const SPEC: Spec = Spec {
    id: "quadratic_damping",
    title: "quadratic damping",
    stage: Stage::Force,
    availability: Availability::Any,
    parameters: &[Parameter {
        key: "c2",
        unit: "N s^2/m^2",
        si: 1.0,
        min: -20.0,
        max: 60.0,
        off: Some(0.0),
        default: None,
        scale: Scale::Linear,
        doc: "quadratic damping",
    }],
    choice: None,
    states: &[],
    starts: |_| singles(&[-4.0, 3.0, 20.0]),
    build: |inputs| Box::new(QuadraticDamping { c2_n_s2_m2: inputs.values[0] }),
    generator: Generator::Force(|at, values| values[0] * at.v * at.v.abs()),
};

#[derive(Clone, Copy, Debug)]
struct QuadraticDamping {
    c2_n_s2_m2: f64,
}

impl Effect for QuadraticDamping {
    fn force_n(&self, at: &MotionState) -> f64 {
        self.c2_n_s2_m2 * at.v_m_s * at.v_m_s.abs()
    }

    fn thresholds(&self) -> Vec<Threshold> {
        vec![Threshold::Speed(0.0)]
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        (self.c2_n_s2_m2 < 0.0 && reach.impact_speed_m_s > 0.0).then(|| "a negative c2 feeds energy in".into())
    }
}
