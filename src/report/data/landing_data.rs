//! Landings that are not level, as data.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::impact::landing::{LandingAssessment, LandingEstimate};

/// Everything that was found of landings.
pub fn landing(assessment: &LandingAssessment) -> Value {
    let LandingAssessment { evidence, estimates, by_drops, heights, gaps, lack_of_fit_p, gates, .. } = assessment;
    let by_key: BTreeMap<&str, &LandingEstimate> = estimates.iter().map(|estimate| (estimate.key, estimate)).collect();
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
    let value = |key: &str| assessment.estimates.iter().find(|estimate| estimate.key == key);
    let spread = value("sigma_r_rad_s").zip(value("sigma_0_rad")).map(|(rate, fixed)| {
        format!(
            "landings turn at {:.2} rad/s a diagonal ({:.2} to {:.2}), and slope by {:.3} rad at release ({:.3} to {:.3})",
            rate.value, rate.ci95[0], rate.ci95[1], fixed.value, fixed.ci95[0], fixed.ci95[1]
        )
    });
    let covariates = assessment.covariates.iter().map(|covariate| {
        format!(
            "{} explains {:.0} % of the variation between drops of one height (p = {:.3})",
            covariate.id,
            1e2 * covariate.explained,
            covariate.p
        )
    });
    let gates = assessment.gates.iter().map(|gate| format!("{}: {}", gate.id, gate.found));
    spread.into_iter().chain(gates).chain(covariates).collect()
}
