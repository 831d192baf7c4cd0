//! A diagnosis beside its truth.

use std::time::Instant;

use flexframe::impact::diagnose::{Diagnosis, DiagnosisOptions, EffectEstimate, Verdict, diagnose};
use flexframe::impact::effects::Model;
use flexframe::impact::fit::Expected;
use flexframe::impact::synthetic::Plan;

use crate::truth::{base, clean, waves};

const HELD_OUT_M: f64 = 2.0;

/// A diagnosis of drops with a known truth.
pub struct Case {
    pub diagnosis: Diagnosis,
    pub seconds: f64,
}

pub fn diagnosed(plan: &Plan) -> Case {
    let all = waves(plan);
    let from = Instant::now();
    let diagnosis = diagnose(&all, None, &base(), &DiagnosisOptions::new(3, plan.seed)).expect("a diagnosis");
    Case { diagnosis, seconds: from.elapsed().as_secs_f64() }
}

impl Case {
    pub fn first(&self) -> Option<&'static str> {
        (self.diagnosis.verdict != Verdict::NothingMissing).then(|| self.diagnosis.contributions.first().map(|one| one.0)).flatten()
    }

    pub fn set(&self) -> Vec<&'static str> {
        self.diagnosis.chosen.ids()
    }

    /// Top of the ranking of single effects, whatever the verdict.
    pub fn top(&self) -> &str {
        self.diagnosis.ranking.iter().find(|one| !one.id.contains('+')).map_or("", |one| &one.id)
    }

    /// Each parameter and whether its interval holds the truth; none when the set is not the true one.
    pub fn covered(&self, truth: &Model) -> Vec<(&'static str, bool)> {
        if self.diagnosis.verdict == Verdict::NothingMissing || truth.effects.len() != self.diagnosis.chosen.model().effects.len() {
            return Vec::new();
        }
        let held = |one: &EffectEstimate| Some((one.key, (one.ci95[0]..=one.ci95[1]).contains(&truth.value(one.effect, one.key)?)));
        self.diagnosis.estimates.iter().map(held).collect::<Option<_>>().unwrap_or_default()
    }

    /// Gap to the noise-free wave at a height that was not dropped from, after over before.
    pub fn ratio(&self, plan: &Plan) -> Option<f64> {
        let expected = Expected::plain(1e-3, 31);
        let truth = expected.mean_over_phases(&clean(plan, HELD_OUT_M));
        let apart = |model: &Model| {
            let predicted = expected.window(&expected.system(model), HELD_OUT_M)?;
            Some(truth.iter().zip(&predicted).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt())
        };
        Some(apart(self.diagnosis.chosen.model())? / apart(self.diagnosis.base.model())?)
    }

    pub fn line(&self) -> String {
        let weight = self.diagnosis.alternatives.first().map_or(0.0, |best| best.weight);
        format!(
            "{} set {:?} weight {weight:.2} p {:.3} then {:.3} trend {:.2} {:.2} s",
            self.diagnosis.verdict.id(),
            self.set(),
            self.diagnosis.base_adequacy.p,
            self.diagnosis.adequacy.p,
            self.diagnosis.trend_p,
            self.seconds
        )
    }
}
