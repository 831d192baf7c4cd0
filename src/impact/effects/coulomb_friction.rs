//! Coulomb friction: F = Fc tanh(v / 0.05 m/s).
//!
//! Source: dry friction of sockets on rods and of feet on the ground; the tanh in place of the sign is usual (see
//! E. Pennestrì et al., *Review and comparison of dry friction force models*, Nonlinear Dyn. 83, 2016). All its work is lost.
//!
//! *When it is wrong:* below 0.05 m/s, where it creeps instead of sticking.

use super::effect::{Effect, MotionState, Reach};
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, singles};

/// Speed over which the sign turns, m/s.
pub const TURN_M_S: f64 = 0.05;

/// Its record.
pub(super) const SPEC: Spec = Spec {
    id: "coulomb_friction",
    title: "Coulomb friction",
    stage: Stage::Force,
    availability: Availability::Any,
    parameters: &[Parameter {
        key: "f_c_n",
        unit: "N",
        si: 1.0,
        min: 0.0,
        // As far as landings are searched for; the legs of the real drops rub with 62 N (docs/case-study.md).
        max: 200.0,
        off: Some(0.0),
        default: None,
        scale: Scale::Linear,
        doc: "friction force",
    }],
    choice: None,
    states: &[],
    starts: |_| singles(&[3.0, 15.0, 45.0]),
    build: |inputs| Box::new(CoulombFriction { force_n: inputs.values[0] }),
    generator: Generator::Force(|at, values| values[0] * libm::tanh(at.v / 0.05)),
};

#[derive(Clone, Copy, Debug)]
struct CoulombFriction {
    force_n: f64,
}

impl Effect for CoulombFriction {
    fn force_n(&self, at: &MotionState) -> f64 {
        self.force_n * libm::tanh(at.v_m_s / TURN_M_S)
    }

    fn resists_slow_motion_n(&self) -> f64 {
        self.force_n
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        reach.contact_s.is_none().then(|| format!("the body comes to rest, where friction below {TURN_M_S} m/s creeps instead of sticking"))
    }
}
