//! Landings that were fitted, and not yet put beside what the diagnosis found along the vertical.

use super::assessment::LandingAssessment;
use super::landing_evidence::LandingEvidence;
use super::turned_back;
use crate::impact::diagnose::{Diagnosis, Verdict};
use crate::impact::fit::Waves;

/// A fitted population whose tests are still to be made.
#[derive(Clone, Debug)]
pub struct UnjudgedLandings(pub(super) LandingAssessment);

impl UnjudgedLandings {
    /// Looks at the drops; `None` where no fit is possible. Readings of a sensor whose lean is named are turned back, and looked at once more.
    ///
    /// Nothing here depends on what the diagnosis finds along the vertical, so that both can be computed at the same time.
    pub fn of(evidence: &LandingEvidence) -> Option<Self> {
        let as_read = LandingAssessment::fitted(evidence, None)?;
        let Some(attitude) = as_read.attitude.named() else { return Some(Self(as_read)) };
        let observed = turned_back::landings(evidence.observed, &attitude);
        let waves = |waves: &Waves| turned_back::waves(waves, &observed);
        let (fitted, held_out) = (waves(evidence.fitted), evidence.held_out.map(waves));
        let turned = LandingEvidence { fitted: &fitted, held_out: held_out.as_ref(), observed: &observed, ..*evidence };
        LandingAssessment::fitted(&turned, Some(as_read.attitude)).map(Self)
    }

    /// The tests, beside the best set of effects along the vertical.
    pub fn beside(self, diagnosis: &Diagnosis) -> LandingAssessment {
        let mut judged = self.0;
        judged.gates = judged.gates(diagnosis);
        judged.decides = judged.named() && diagnosis.verdict != Verdict::NothingMissing;
        judged
    }
}
