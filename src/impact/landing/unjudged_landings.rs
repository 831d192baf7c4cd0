//! Landings that were fitted, and not yet put beside what the diagnosis found along the vertical.

use super::assessment::LandingAssessment;
use crate::impact::diagnose::{Diagnosis, Verdict};

/// A fitted population whose tests are still to be made.
#[derive(Clone, Debug)]
pub struct UnjudgedLandings(pub(super) LandingAssessment);

impl UnjudgedLandings {
    /// The tests, beside the best set of effects along the vertical.
    pub fn beside(self, diagnosis: &Diagnosis) -> LandingAssessment {
        let mut judged = self.0;
        judged.gates = judged.gates(diagnosis);
        judged.decides = judged.named() && diagnosis.verdict != Verdict::NothingMissing;
        judged
    }
}
