//! Static preload: F = F0 tanh(x / 0.2 mm), a force that is there from the first touch.
//!
//! Source: the static test's free fit has an intercept of 10.1 N (2.36 N by the scales): folded hinges push before the
//! frame moves. It stores F0 · 0.2 mm · ln cosh(x / 0.2 mm).
//!
//! *When it is wrong:* within the first 0.2 mm, which stand for the step; for x < 0, where it pulls.

use super::effect::{Effect, Motion, Parameter, Reach, Spec, Stage};

/// Compression over which the step rises, m.
const RISE_M: f64 = 0.2e-3;

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "preload",
    title: "static preload",
    stage: Stage::Force,
    parameters: &[Parameter {
        key: "f0_n",
        unit: "N",
        si: 1.0,
        min: 0.0,
        max: 150.0,
        off: Some(0.0),
        default: None,
        doc: "force that the frame holds before it gives",
    }],
    choice: None,
    build: |values, _| Box::new(Preload { force_n: values[0] }),
};

#[derive(Clone, Copy, Debug)]
struct Preload {
    force_n: f64,
}

impl Effect for Preload {
    fn force_n(&self, at: &Motion) -> f64 {
        self.force_n * libm::tanh(at.x_m / RISE_M)
    }

    fn stored_j(&self, at: &Motion) -> f64 {
        let ratio = (at.x_m / RISE_M).abs();
        // ln cosh u = u + ln((1 + exp(-2u)) / 2), without overflow.
        self.force_n * RISE_M * (ratio + libm::log1p(libm::exp(-2.0 * ratio)) - std::f64::consts::LN_2)
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        reach.above_ground.then(|| "above x = 0 it pulls the frame down, as no preload does".into())
    }
}
