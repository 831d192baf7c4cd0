//! Bilinear stiffness: F = k_bl (x - x1) where x > x1. It stores k_bl (x - x1)²/2.
//!
//! Source: two springs, the second with play x1; negative where a leg buckles.
//!
//! *When it is wrong:* real stops have no kink. On the measured drops the fitted kink moves with the height (15, 23,
//! 27 mm at 50, 100, 150 cm), which a stop at a gap cannot.

use super::effect::{Effect, MotionState, Reach, Threshold};
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, products};

/// Its record.
pub(super) const SPEC: Spec = Spec {
    id: "bilinear_stiffness",
    title: "bilinear stiffness",
    stage: Stage::Force,
    availability: Availability::Any,
    parameters: &[
        Parameter {
            key: "x1_mm",
            unit: "mm",
            si: 1e-3,
            min: 1.0,
            max: 60.0,
            off: None,
            default: None,
            scale: Scale::Logarithmic,
            doc: "compression at the kink",
        },
        Parameter {
            key: "k_bl",
            unit: "N/m",
            si: 1.0,
            min: -6e3,
            max: 6e4,
            off: Some(0.0),
            default: None,
            scale: Scale::Linear,
            doc: "stiffness that comes on top behind the kink",
        },
    ],
    choice: None,
    states: &[],
    starts: |_| products(&[2.0, 5.0, 8.0, 12.0, 16.0, 22.0, 30.0], &[-3e3, 3e3, 2e4], &[]),
    build: |inputs| Box::new(BilinearStiffness { kink_m: inputs.values[0], stiffness_n_m: inputs.values[1] }),
    generator: Generator::Force(|at, values| values[1] * (at.x - values[0] * 1e-3).max(0.0)),
};

#[derive(Clone, Copy, Debug)]
struct BilinearStiffness {
    kink_m: f64,
    stiffness_n_m: f64,
}

impl Effect for BilinearStiffness {
    fn force_n(&self, at: &MotionState) -> f64 {
        self.stiffness_n_m * (at.x_m - self.kink_m).max(0.0)
    }

    fn stored_j(&self, at: &MotionState) -> f64 {
        let beyond = (at.x_m - self.kink_m).max(0.0);
        0.5 * self.stiffness_n_m * beyond * beyond
    }

    fn thresholds(&self) -> Vec<Threshold> {
        vec![Threshold::Compression(self.kink_m)]
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        if reach.deepest_m <= self.kink_m {
            return None;
        }
        let slope = reach.stiffness_n_m + self.stiffness_n_m;
        let gives_way = if slope < 0.0 { "behind it the stiffness is negative" } else { "real stops have none" };
        Some(format!("the kink at {:.1} mm is passed: {gives_way}", self.kink_m * 1e3))
    }
}
