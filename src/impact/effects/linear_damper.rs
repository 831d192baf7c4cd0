//! Linear damper: F = c v, in parallel with the spring.
//!
//! Source: arXiv 2103.04423, c = 46 N s/m. All its work is lost.
//!
//! *When it is wrong:* at first touch it pushes with c v0 at once (46 g from 30 cm), which the measured drops do not show:
//! at 150 cm, 5 mm deep, their median force is 29 N where it says 282 N with the spring. Flexible filament relaxes
//! (`maxwell_branch`) rather than flows.

use super::effect::{Effect, Motion, Parameter, Reach, Spec, Stage};

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "linear_damper",
    title: "linear damper",
    stage: Stage::Force,
    parameters: &[Parameter {
        key: "c",
        unit: "N s/m",
        si: 1.0,
        min: 0.0,
        max: 2000.0,
        off: Some(0.0),
        default: None,
        doc: "damping of the frame",
    }],
    choice: None,
    build: |values, _| Box::new(LinearDamper { damping_n_s_m: values[0] }),
};

/// The damper.
#[derive(Clone, Copy, Debug)]
pub struct LinearDamper {
    /// c.
    pub damping_n_s_m: f64,
}

impl Effect for LinearDamper {
    fn force_n(&self, at: &Motion) -> f64 {
        self.damping_n_s_m * at.v_m_s
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        let (damper_n, spring_n) = (self.damping_n_s_m * reach.impact_speed_m_s, reach.stiffness_n_m * reach.deepest_m);
        (damper_n > 0.5 * spring_n).then(|| {
            format!(
                "it pushes with {damper_n:.0} N at once, the spring with {spring_n:.0} N at the most: measured drops begin with nothing"
            )
        })
    }
}
