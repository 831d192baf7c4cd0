//! Linear spring: F = k x.
//!
//! Source: R. de Azambuja, H. Fouad, G. Beltrame, arXiv 2103.04423, whose static test gives k = 7040 N/m (6375 N/m with a
//! free intercept). It stores k x²/2.
//!
//! *When it is wrong:* past the legs' buckling load, where legs or battery touch, and for x < 0, where it pulls on a
//! ground that cannot hold the frame.

use super::effect::{Effect, Motion, Parameter, Reach, Spec, Stage};

/// How far the frame was pressed in the static test, m.
const TESTED_M: f64 = 0.016;

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "linear_spring",
    title: "linear spring",
    stage: Stage::Force,
    parameters: &[Parameter {
        key: "k",
        unit: "N/m",
        si: 1.0,
        min: 10.0,
        max: 1e6,
        off: None,
        default: None,
        doc: "stiffness of the frame on its corners",
    }],
    choice: None,
    build: |values, _| Box::new(LinearSpring { stiffness_n_m: values[0] }),
};

/// The spring.
#[derive(Clone, Copy, Debug)]
pub struct LinearSpring {
    /// k.
    pub stiffness_n_m: f64,
}

impl Effect for LinearSpring {
    fn force_n(&self, at: &Motion) -> f64 {
        self.stiffness_n_m * at.x_m
    }

    fn stored_j(&self, at: &Motion) -> f64 {
        0.5 * self.stiffness_n_m * at.x_m * at.x_m
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        (reach.deepest_m > TESTED_M).then(|| {
            format!("{:.1} mm is deeper than the {:.0} mm to which the static test behind k goes", reach.deepest_m * 1e3, TESTED_M * 1e3)
        })
    }
}
