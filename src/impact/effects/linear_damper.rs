//! Linear damper: F = c v, in parallel with the spring.
//!
//! Source: arXiv 2103.04423, c = 46 N s/m. All its work is lost.
//!
//! *When it is wrong:* at first touch it pushes with c v0 at once (46 g from 30 cm), which the measured drops do not show:
//! at 150 cm, 5 mm deep, their median force is 29 N where it says 282 N with the spring. Flexible filament relaxes
//! (`maxwell_branch`) rather than flows.

use super::effect::{Effect, MotionState, Reach};
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage};

/// Its record.
pub const SPEC: Spec = Spec {
    id: "linear_damper",
    title: "linear damper",
    stage: Stage::Force,
    availability: Availability::Base,
    parameters: &[Parameter {
        key: "c",
        unit: "N s/m",
        si: 1.0,
        min: 0.0,
        max: 2000.0,
        off: Some(0.0),
        default: None,
        scale: Scale::LinearStep(0.2),
        doc: "damping of the frame",
    }],
    choice: None,
    states: &[],
    starts: |_| Vec::new(),
    build: |inputs| Box::new(LinearDamper { damping_n_s_m: inputs.values[0] }),
    generator: Generator::Conditions(|drop, values, _| drop.damping_n_s_m = values[0]),
};

/// The damper.
#[derive(Clone, Copy, Debug)]
pub struct LinearDamper {
    /// c.
    pub damping_n_s_m: f64,
}

impl Effect for LinearDamper {
    fn force_n(&self, at: &MotionState) -> f64 {
        self.damping_n_s_m * at.v_m_s
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        let (damper_n, spring_n) = (self.damping_n_s_m * reach.impact_speed_m_s, reach.stiffness_n_m * reach.deepest_m);
        (damper_n > 0.5 * spring_n).then(|| {
            format!("its force is {damper_n:.0} N at first touch, the spring's at most {spring_n:.0} N; measured drops start at zero force")
        })
    }
}
