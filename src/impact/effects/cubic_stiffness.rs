//! Cubic stiffness: F = k3 x³. It stores k3 x⁴/4.
//!
//! Source: the first term that a symmetric spring has beyond the linear one (Duffing); legs at a slope stiffen or soften
//! as they turn.
//!
//! *When it is wrong:* far beyond the compressions it was fitted on. With a negative k3 the total stiffness becomes negative where
//! k x + k3 x³ turns, at 18.8 mm for k = 7040 N/m and k3 = -2e7 N/m³; the simulation then diverges.

use super::effect::{Effect, MotionState, Reach};
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, singles};

/// Its record.
pub(super) const SPEC: Spec = Spec {
    id: "cubic_stiffness",
    title: "cubic stiffness",
    stage: Stage::Force,
    availability: Availability::Any,
    parameters: &[Parameter {
        key: "k3",
        unit: "N/m^3",
        si: 1.0,
        min: -2e7,
        max: 2e8,
        off: Some(0.0),
        default: None,
        scale: Scale::Linear,
        doc: "cubic stiffness",
    }],
    choice: None,
    states: &[],
    starts: |_| singles(&[-5e6, 4e6, 4e7]),
    build: |inputs| Box::new(CubicStiffness { k3_n_m3: inputs.values[0] }),
    generator: Generator::Force(|at, values| values[0] * at.x * at.x * at.x),
};

#[derive(Clone, Copy, Debug)]
struct CubicStiffness {
    k3_n_m3: f64,
}

impl Effect for CubicStiffness {
    fn force_n(&self, at: &MotionState) -> f64 {
        self.k3_n_m3 * at.x_m * at.x_m * at.x_m
    }

    fn stored_j(&self, at: &MotionState) -> f64 {
        let square = at.x_m * at.x_m;
        0.25 * self.k3_n_m3 * square * square
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        let slope = reach.stiffness_n_m + 3.0 * self.k3_n_m3 * reach.deepest_m * reach.deepest_m;
        (slope < 0.0).then(|| format!("at {:.1} mm the stiffness is negative: {slope:.0} N/m", reach.deepest_m * 1e3))
    }
}
