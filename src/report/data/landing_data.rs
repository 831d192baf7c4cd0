//! Landings that are not level, as data.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::impact::diagnose::EffectEstimate;
use crate::impact::landing::{LANDING_TILT, LandingAssessment};

/// Everything that was found of landings.
pub fn landing(assessment: &LandingAssessment) -> Value {
    let LandingAssessment { evidence, estimates, by_drops, heights, gaps, lack_of_fit_p, gates, .. } = assessment;
    let by_key: BTreeMap<&str, &EffectEstimate> = estimates.iter().map(|estimate| (estimate.key, estimate)).collect();
    let mut all = json!(by_key);
    all["named"] = assessment.named().into();
    all["touches"] = json!(evidence);
    all["by_drops"] = json!(by_drops.legs);
    all["heights"] = json!(heights);
    all["gap"] = json!(gaps);
    all["lack_of_fit_p"] = json!(lack_of_fit_p);
    all["gates"] = json!(gates);
    all
}

/// The same in sentences.
pub fn sentences(assessment: &LandingAssessment) -> Vec<String> {
    let covariates = assessment.covariates.iter().map(|covariate| {
        format!(
            "{} explains {:.0} % of the variation between drops of one height (p = {:.3})",
            covariate.id,
            1e2 * covariate.explained,
            covariate.p
        )
    });
    let gates = assessment.gates.iter().map(|gate| format!("{}: {}", gate.id, gate.found));
    std::iter::once(spread(assessment)).chain(gates).chain(covariates).collect()
}

/// How landings vary, in a sentence.
pub fn spread(assessment: &LandingAssessment) -> String {
    let value = |key: &str| {
        let found = assessment.estimates.iter().find(|estimate| estimate.key == key);
        found.map_or(String::new(), |one| format!("{:.3} {} ({:.3} to {:.3})", one.value, one.unit, one.ci95[0], one.ci95[1]))
    };
    format!(
        "landings slope by {} at release along a diagonal, and turn at {} while they fall",
        value("sigma_0_rad"),
        value("sigma_r_rad_s")
    )
}

/// The effect as a diagnosis lists it.
pub fn effect(assessment: &LandingAssessment) -> Value {
    let own = assessment.estimates.iter().filter(|estimate| estimate.key.starts_with("sigma"));
    let parameters: BTreeMap<&str, &EffectEstimate> = own.map(|estimate| (estimate.key, estimate)).collect();
    json!({ "id": LANDING_TILT, "parameters": parameters })
}
