//! Bottoming: the lowest body meets the ground, F = k_b d^1.5 (1 + 1.5 λ v) with d = x - x_b where that is positive.
//!
//! Hertz' contact with the damping of K. H. Hunt and F. R. E. Crossley, *Coefficient of Restitution Interpreted as
//! Damping in Vibroimpact*, J. Appl. Mech. 42 (1975), as H. M. Lankarani and P. E. Nikravesh write it. It stores
//! 2/5 k_b d^2.5 and is never less than zero.
//!
//! *When it is wrong:* a battery on concrete is no sphere on a half-space, and breaks; k_b is then a fitted number.

use super::effect::{Effect, MotionState, Reach, Threshold};
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, products};

/// Its record.
pub(super) const SPEC: Spec = Spec {
    id: "bottoming",
    title: "bottoming contact",
    stage: Stage::Stop,
    availability: Availability::Any,
    parameters: &[
        Parameter {
            key: "x_b_mm",
            unit: "mm",
            si: 1e-3,
            min: 2.0,
            max: 25.0,
            off: None,
            default: None,
            scale: Scale::Logarithmic,
            doc: "compression at which the stop is met",
        },
        Parameter {
            key: "k_b",
            unit: "N/m^1.5",
            si: 1.0,
            min: 0.0,
            max: 3e7,
            off: Some(0.0),
            default: None,
            scale: Scale::Logarithmic,
            doc: "stiffness of the stop",
        },
        Parameter {
            key: "lambda",
            unit: "s/m",
            si: 1.0,
            min: 0.0,
            max: 1.0,
            off: None,
            default: Some(0.3),
            scale: Scale::Linear,
            doc: "damping of the stop",
        },
    ],
    choice: None,
    states: &[],
    starts: |_| products(&[3.0, 5.0, 8.0, 11.0, 14.0, 18.0, 23.0], &[2e5, 2e6, 1.5e7], &[0.3]),
    build: |inputs| Box::new(Bottoming { onset_m: inputs.values[0], stiffness: inputs.values[1], lambda_s_m: inputs.values[2] }),
    generator: Generator::Stop(|at, values| {
        let depth = at.x - values[0] * 1e-3;
        if depth > 0.0 { values[1] * depth * depth.sqrt() * (1.0 + 1.5 * values[2] * at.v) } else { 0.0 }
    }),
};

#[derive(Clone, Copy, Debug)]
struct Bottoming {
    onset_m: f64,
    /// N/m^1.5.
    stiffness: f64,
    lambda_s_m: f64,
}

impl Effect for Bottoming {
    fn force_n(&self, at: &MotionState) -> f64 {
        let depth = at.x_m - self.onset_m;
        if depth <= 0.0 {
            return 0.0;
        }
        (self.stiffness * depth * depth.sqrt() * (1.0 + 1.5 * self.lambda_s_m * at.v_m_s)).max(0.0)
    }

    fn stored_j(&self, at: &MotionState) -> f64 {
        let depth = (at.x_m - self.onset_m).max(0.0);
        0.4 * self.stiffness * depth * depth * depth.sqrt()
    }

    fn thresholds(&self) -> Vec<Threshold> {
        let mut found = vec![Threshold::Compression(self.onset_m)];
        if self.lambda_s_m > 0.0 {
            found.push(Threshold::Speed(-1.0 / (1.5 * self.lambda_s_m)));
        }
        found
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        let depth_m = reach.deepest_m - self.onset_m;
        (depth_m > 0.0)
            .then(|| format!("the stop is compressed by {:.2} mm: the contact is not Hertzian, k_b is a fitted number", depth_m * 1e3))
    }
}
