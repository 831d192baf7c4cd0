//! Hunt-Crossley damping: F = χ x v, a damper that grows with the compression.
//!
//! Source: K. H. Hunt, F. R. E. Crossley, *Coefficient of Restitution Interpreted as Damping in Vibroimpact*, J. Appl.
//! Mech. 42 (1975), with exponent 1. It gives no force at first touch. All its work is lost.
//!
//! *When it is wrong:* it has no memory; a material that relaxes is `maxwell_branch`. A negative χ feeds energy in: it
//! stands for a parallel damper that is too strong, and is no law of its own.

use super::effect::{Effect, MotionState, Reach};
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, singles};

/// Its record.
pub(super) const SPEC: Spec = Spec {
    id: "hunt_crossley_damping",
    title: "Hunt-Crossley damping",
    stage: Stage::Force,
    availability: Availability::Any,
    parameters: &[Parameter {
        key: "chi",
        unit: "N s/m^2",
        si: 1.0,
        min: -5e3,
        max: 2e4,
        off: Some(0.0),
        default: None,
        scale: Scale::Linear,
        doc: "damping per compression",
    }],
    choice: None,
    states: &[],
    starts: |_| singles(&[-1.5e3, 1e3, 6e3]),
    build: |inputs| Box::new(HuntCrossleyDamping { chi_n_s_m2: inputs.values[0] }),
    generator: Generator::Force(|at, values| values[0] * at.x * at.v),
};

#[derive(Clone, Copy, Debug)]
struct HuntCrossleyDamping {
    chi_n_s_m2: f64,
}

impl Effect for HuntCrossleyDamping {
    fn force_n(&self, at: &MotionState) -> f64 {
        self.chi_n_s_m2 * at.x_m * at.v_m_s
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        (self.chi_n_s_m2 < 0.0 && reach.deepest_m > 0.0).then(|| "a negative chi feeds energy in".into())
    }
}
