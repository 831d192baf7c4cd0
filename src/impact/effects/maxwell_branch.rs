//! Maxwell branch: a spring and a damper in series beside the base (Zener's solid), q' = k_m v - q/τ, F = q.
//!
//! Source: the standard linear solid of viscoelasticity, e.g. R. Christensen, *Theory of Viscoelasticity*. It stores
//! q²/(2 k_m); what else goes in is lost.
//!
//! *When it is wrong:* filament relaxes over decades of time, one branch holds one τ; stiffness depends on temperature.

use super::effect::{Effect, MotionState, Reach};
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, products};

/// Its record.
pub(super) const SPEC: Spec = Spec {
    id: "maxwell_branch",
    title: "Maxwell branch",
    stage: Stage::Force,
    availability: Availability::Any,
    parameters: &[
        Parameter {
            key: "k_m",
            unit: "N/m",
            si: 1.0,
            min: 0.0,
            max: 4e4,
            off: Some(0.0),
            default: None,
            scale: Scale::Linear,
            doc: "stiffness of the branch before it relaxes",
        },
        Parameter {
            key: "tau_ms",
            unit: "ms",
            si: 1e-3,
            min: 0.2,
            max: 20.0,
            off: None,
            default: None,
            scale: Scale::Logarithmic,
            doc: "relaxation time",
        },
    ],
    choice: None,
    states: &["force, N"],
    starts: |_| products(&[1e3, 8e3, 2.5e4], &[0.4, 1.0, 2.5, 6.0, 15.0], &[]),
    build: |inputs| Box::new(MaxwellBranch { stiffness_n_m: inputs.values[0], relaxation_s: inputs.values[1] }),
    generator: Generator::Branch(|at, values| values[0] * at.v - at.q / (values[1] * 1e-3)),
};

#[derive(Clone, Copy, Debug)]
struct MaxwellBranch {
    stiffness_n_m: f64,
    relaxation_s: f64,
}

impl Effect for MaxwellBranch {
    fn force_n(&self, at: &MotionState) -> f64 {
        at.own[0]
    }

    fn rates(&self, at: &MotionState, rates: &mut [f64]) {
        rates[0] = self.stiffness_n_m * at.v_m_s - at.own[0] / self.relaxation_s;
    }

    fn stored_j(&self, at: &MotionState) -> f64 {
        0.5 * at.own[0] * at.own[0] / self.stiffness_n_m
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        let decades = libm::log10(reach.contact_s? / self.relaxation_s).abs();
        (decades > 1.0).then(|| {
            format!("one relaxation time of {:.1} ms does not describe a contact that is more than a decade away", self.relaxation_s * 1e3)
        })
    }
}
