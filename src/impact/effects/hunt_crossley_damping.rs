//! Hunt-Crossley damping: F = χ x v, a damper that grows with the compression.
//!
//! Source: K. H. Hunt, F. R. E. Crossley, *Coefficient of Restitution Interpreted as Damping in Vibroimpact*, J. Appl.
//! Mech. 42 (1975), with exponent 1. It gives no force at first touch. All its work is lost.
//!
//! *When it is wrong:* it has no memory; a material that relaxes is `maxwell_branch`. A negative χ feeds energy in: it
//! stands for a parallel damper that is too strong, and is no law of its own.

use super::effect::{Effect, Motion, Parameter, Reach, Spec, Stage};

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "hunt_crossley_damping",
    title: "Hunt-Crossley damping",
    stage: Stage::Force,
    parameters: &[Parameter {
        key: "chi",
        unit: "N s/m^2",
        si: 1.0,
        min: -5e3,
        max: 2e4,
        off: Some(0.0),
        default: None,
        doc: "damping per compression",
    }],
    choice: None,
    build: |values, _| Box::new(HuntCrossleyDamping { chi_n_s_m2: values[0] }),
};

#[derive(Clone, Copy, Debug)]
struct HuntCrossleyDamping {
    chi_n_s_m2: f64,
}

impl Effect for HuntCrossleyDamping {
    fn force_n(&self, at: &Motion) -> f64 {
        self.chi_n_s_m2 * at.x_m * at.v_m_s
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        (self.chi_n_s_m2 < 0.0 && reach.deepest_m > 0.0).then(|| "a negative chi feeds energy in".into())
    }
}
