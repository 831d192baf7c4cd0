//! A static test beside the models of a diagnosis.

use serde::Serialize;

use super::candidate::{Candidate, joined};
use super::diagnosis::Diagnosis;
use crate::impact::effects::Model;
use crate::impact::measured::StaticTest;
use crate::impact::sim::{SlowWay, System};

/// A static test beside the models of a diagnosis. It is compared, not fitted; its forces are those of loading.
#[derive(Clone, Debug, Serialize)]
pub struct StaticComparison {
    /// Points.
    pub points: usize,
    /// Straight line through the origin, N/m.
    pub line_n_m: f64,
    /// What that leaves, rms, N.
    pub line_off_n: f64,
    /// What the base model leaves, its spring fitted to the drops, rms, N.
    pub base_off_n: f64,
    /// What the sets of effects leave, the chosen one first, rms, N.
    pub sets_off_n: Vec<(String, f64)>,
}

impl StaticComparison {
    /// Compares.
    pub fn of(test: &StaticTest, diagnosis: &Diagnosis) -> Self {
        let off_n = |candidate: &Candidate| off_n(test, candidate.model());
        let (line_n_m, line_off_n) = test.line_through_origin();
        let sets = diagnosis.alternatives.iter().map(|set| &set.candidate).filter(|set| !set.ids().is_empty());
        let sets_off_n = sets.map(|set| (joined(set), off_n(set))).collect();
        Self { points: test.points.len(), line_n_m, line_off_n, base_off_n: off_n(&diagnosis.base), sets_off_n }
    }

    /// With effects that `model` stands for: before the sets where they are what is chosen, after them otherwise.
    pub fn beside(mut self, test: &StaticTest, effects: String, model: &Model, is_chosen: bool) -> Self {
        let at = if is_chosen { 0 } else { self.sets_off_n.len() };
        self.sets_off_n.insert(at, (effects, off_n(test, model)));
        self
    }
}

/// What a model leaves of a test, rms, N.
fn off_n(test: &StaticTest, model: &Model) -> f64 {
    let system = System::new(model);
    test.off_n(|x_m| system.slow_force_n(x_m, SlowWay::Loading))
}
