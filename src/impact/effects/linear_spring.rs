//! Linear spring: F = k x.
//!
//! Source: R. de Azambuja, H. Fouad, G. Beltrame, arXiv 2103.04423, whose static test gives k = 7040 N/m (6375 N/m with a
//! free intercept). It stores k x²/2.
//!
//! *When it is wrong:* past the legs' buckling load, where legs or battery touch, and for x < 0, where it pulls on a
//! ground that cannot hold the frame.

use super::effect::{Effect, MotionState, Reach};
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage};

/// Largest compression of the static test, m.
const TESTED_M: f64 = 0.016;

/// Its record.
pub const SPEC: Spec = Spec {
    id: "linear_spring",
    title: "linear spring",
    stage: Stage::Force,
    availability: Availability::Base,
    parameters: &[Parameter {
        key: "k",
        unit: "N/m",
        si: 1.0,
        min: 10.0,
        max: 1e6,
        off: None,
        default: None,
        scale: Scale::Logarithmic,
        doc: "stiffness of the frame on its corners",
    }],
    choice: None,
    states: &[],
    starts: |_| Vec::new(),
    build: |inputs| Box::new(LinearSpring { stiffness_n_m: inputs.values[0] }),
    generator: Generator::Conditions(|drop, values, _| drop.stiffness_n_m = values[0]),
};

/// The spring.
#[derive(Clone, Copy, Debug)]
pub struct LinearSpring {
    /// k.
    pub stiffness_n_m: f64,
}

impl Effect for LinearSpring {
    fn force_n(&self, at: &MotionState) -> f64 {
        self.stiffness_n_m * at.x_m
    }

    fn stored_j(&self, at: &MotionState) -> f64 {
        0.5 * self.stiffness_n_m * at.x_m * at.x_m
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        (reach.deepest_m > TESTED_M).then(|| {
            format!("{:.1} mm is deeper than the {:.0} mm to which the static test behind k goes", reach.deepest_m * 1e3, TESTED_M * 1e3)
        })
    }
}
