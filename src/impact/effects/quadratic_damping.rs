//! Quadratic damping: F = c2 v |v|.
//!
//! Source: the drag of a flow, and the next term of a damper in v. All its work is lost.
//!
//! *When it is wrong:* there is no flow in a frame; with a negative c2 it feeds energy in, and the body runs away where it
//! outweighs the damper.

use super::effect::{Effect, Motion, Parameter, Reach, Spec, Stage, Threshold};

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "quadratic_damping",
    title: "quadratic damping",
    stage: Stage::Force,
    parameters: &[Parameter {
        key: "c2",
        unit: "N s^2/m^2",
        si: 1.0,
        min: -20.0,
        max: 60.0,
        off: Some(0.0),
        default: None,
        doc: "quadratic damping",
    }],
    choice: None,
    build: |values, _| Box::new(QuadraticDamping { c2_n_s2_m2: values[0] }),
};

#[derive(Clone, Copy, Debug)]
struct QuadraticDamping {
    c2_n_s2_m2: f64,
}

impl Effect for QuadraticDamping {
    fn force_n(&self, at: &Motion) -> f64 {
        self.c2_n_s2_m2 * at.v_m_s * at.v_m_s.abs()
    }

    fn thresholds(&self) -> Vec<Threshold> {
        vec![Threshold::Speed(0.0)]
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        (self.c2_n_s2_m2 < 0.0 && reach.impact_speed_m_s > 0.0).then(|| "a negative c2 feeds energy in".into())
    }
}
