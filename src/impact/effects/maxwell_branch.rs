//! Maxwell branch: a spring and a damper in series beside the base (Zener's solid), q' = k_m v - q/τ, F = q.
//!
//! Source: the standard linear solid of viscoelasticity, e.g. R. Christensen, *Theory of Viscoelasticity*. It stores
//! q²/(2 k_m); what else goes in is lost.
//!
//! *When it is wrong:* filament relaxes over decades of time, one branch holds one τ; stiffness depends on temperature.

use super::effect::{Effect, Motion, Parameter, Reach, Spec, Stage};

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "maxwell_branch",
    title: "Maxwell branch",
    stage: Stage::Force,
    parameters: &[
        Parameter {
            key: "k_m",
            unit: "N/m",
            si: 1.0,
            min: 0.0,
            max: 4e4,
            off: Some(0.0),
            default: None,
            doc: "stiffness of the branch before it relaxes",
        },
        Parameter { key: "tau_ms", unit: "ms", si: 1e-3, min: 0.2, max: 20.0, off: None, default: None, doc: "relaxation time" },
    ],
    choice: None,
    build: |values, _| Box::new(MaxwellBranch { stiffness_n_m: values[0], relaxation_s: values[1] }),
};

#[derive(Clone, Copy, Debug)]
struct MaxwellBranch {
    stiffness_n_m: f64,
    relaxation_s: f64,
}

impl Effect for MaxwellBranch {
    fn own_states(&self) -> usize {
        1
    }

    fn force_n(&self, at: &Motion) -> f64 {
        at.own[0]
    }

    fn rates(&self, at: &Motion, rates: &mut [f64]) {
        rates[0] = self.stiffness_n_m * at.v_m_s - at.own[0] / self.relaxation_s;
    }

    fn stored_j(&self, at: &Motion) -> f64 {
        0.5 * at.own[0] * at.own[0] / self.stiffness_n_m
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        let decades = libm::log10(reach.contact_s? / self.relaxation_s).abs();
        (decades > 1.0).then(|| {
            format!("one relaxation time of {:.1} ms says nothing of a contact that is more than a decade from it", self.relaxation_s * 1e3)
        })
    }
}
