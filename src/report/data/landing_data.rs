//! Landings that are not level, as data.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::figures::decimals;
use crate::impact::diagnose::EffectEstimate;
use crate::impact::landing::{
    ATTITUDE_SENSOR, AttitudeAssessment, COULOMB_FRICTION, FOOT_MODE, Gate, LANDING_TILT, LandingAssessment, MOUNT_LOW_PASS, RefusedEffect,
};

/// Everything that was found of landings.
pub fn landing(assessment: &LandingAssessment) -> Value {
    let LandingAssessment { evidence, estimates, fit, heights, gaps, adequacy, gates, .. } = assessment;
    let by_key: BTreeMap<&str, &EffectEstimate> = estimates.iter().map(|estimate| (estimate.key, estimate)).collect();
    let mut all = json!(by_key);
    all["named"] = assessment.named().into();
    all["touches"] = json!(evidence);
    all["by_drops"] = json!(fit.legs);
    all["heights"] = json!(heights);
    all["gap"] = json!(gaps);
    all["lack_of_fit_p"] = json!(adequacy.p);
    all["left_given_touches"] = json!(assessment.given_touches);
    all["refused"] = json!(assessment.refused);
    all["gates"] = json!(gates);
    all[ATTITUDE_SENSOR] = attitude(&assessment.attitude);
    all
}

/// How the sensor leans.
fn attitude(found: &AttitudeAssessment) -> Value {
    let by_key: BTreeMap<&str, &EffectEstimate> = found.estimates.iter().map(|estimate| (estimate.key, estimate)).collect();
    let mut all = json!(by_key);
    all["named"] = found.named().is_some().into();
    all["reason"] = found.reason().into();
    all["lateral_g"] = found.lateral_g.into();
    all["cosine"] = json!(found.cosines);
    all["gates"] = json!(found.gates);
    all
}

/// The same in a sentence, without the reason of its name or of its lack.
pub fn lean(found: &AttitudeAssessment) -> String {
    let [toward_x, toward_y] = ["lean_x_rad", "lean_y_rad"].map(|key| {
        let estimate = found.estimates.iter().find(|estimate| estimate.key == key);
        estimate.map_or_else(|| "an unknown angle".into(), |one| format!("{:.3} rad ({:.3} to {:.3})", one.value, one.ci95[0], one.ci95[1]))
    });
    let most = found.cosines.iter().max_by(|a, b| a.largest_g.total_cmp(&b.largest_g));
    let cosine = most.map_or_else(String::new, |most| {
        format!(
            "; it turns with the body, whose cosine changes the peak of the mean wave from {} m by {} % and no reading by more than {:.1} g",
            most.height_m,
            decimals(1e2 * most.peak_change, 1),
            most.largest_g
        )
    });
    format!("the sensor's axis leans by {toward_x} toward x and by {toward_y} toward y{cosine}")
}

/// The same in sentences; without the tests that the reasons of the verdict name, and without slopes where the lateral readings are along the legs.
pub fn sentences(assessment: &LandingAssessment) -> Vec<String> {
    let is_reason = |at: usize, gate: &Gate| assessment.decides() || assessment.stands_beside() && (at == 0 || !gate.passed);
    let gates = assessment.gates.iter().enumerate().filter(|(at, gate)| !is_reason(*at, gate));
    let gates = gates.map(|(_, gate)| format!("test {} {}: {}", gate.id, gate.word(), gate.found));
    let attitude = [lean(&assessment.attitude), assessment.attitude.reason()];
    let refused = assessment.refused.iter().filter(|_| !assessment.stands_beside()).map(RefusedEffect::sentence);
    let slopes = (!assessment.evidence.is_turned()).then(|| spread(assessment));
    slopes.into_iter().chain(gates).chain(refused).chain(attitude).collect()
}

/// How landings vary, in a sentence.
pub fn spread(assessment: &LandingAssessment) -> String {
    let value = |key: &str| {
        let found = assessment.estimates.iter().find(|estimate| estimate.key == key);
        let unit = |one: &EffectEstimate| if one.unit == "1" { String::new() } else { format!(" {}", one.unit) };
        found.map_or(String::new(), |one| format!("{:.3}{} ({:.3} to {:.3})", one.value, unit(one), one.ci95[0], one.ci95[1]))
    };
    let mount = match assessment.fit.legs.mount {
        Some(_) => format!("; what carries the sensor swings at {}, with a damping of {}", value("f_hz"), value("zeta")),
        None => String::new(),
    };
    let feet = match assessment.fit.legs.feet {
        Some(_) => format!(
            "; the feet have {} of the mass, swing against the body at {} and lose {} of the critical damping",
            value("foot_share"),
            value("foot_f_hz"),
            value("foot_zeta")
        ),
        None => String::new(),
    };
    let friction = if assessment.rubs() { format!("; the legs rub with {}", value("f_c_n")) } else { String::new() };
    format!(
        "landings slope by {} at release along a diagonal, and turn at {} while they fall{friction}{feet}{mount}",
        value("sigma_0_rad"),
        value("sigma_r_rad_s")
    )
}

/// The effects as a diagnosis lists them: the slopes, the mount where there is one, and the sensor's lean where it is named.
pub fn effects(assessment: &LandingAssessment) -> Value {
    let listed = |id: &str, keep: &dyn Fn(&EffectEstimate) -> bool| {
        let own = assessment.estimates.iter().filter(|estimate| keep(estimate));
        let parameters: BTreeMap<&str, &EffectEstimate> = own.map(|estimate| (estimate.key, estimate)).collect();
        json!({ "id": id, "parameters": parameters })
    };
    let attitude = || {
        let parameters: BTreeMap<&str, &EffectEstimate> =
            assessment.attitude.estimates.iter().map(|estimate| (estimate.key, estimate)).collect();
        json!({ "id": ATTITUDE_SENSOR, "parameters": parameters })
    };
    let mut all = vec![listed(LANDING_TILT, &|estimate| estimate.key.starts_with("sigma"))];
    if assessment.rubs() {
        all.push(listed(COULOMB_FRICTION, &|estimate| estimate.effect == COULOMB_FRICTION));
    }
    if assessment.fit.legs.feet.is_some() {
        all.push(listed(FOOT_MODE, &|estimate| estimate.effect == FOOT_MODE));
    }
    if assessment.fit.legs.mount.is_some() {
        all.push(listed(MOUNT_LOW_PASS, &|estimate| estimate.effect == MOUNT_LOW_PASS));
    }
    if assessment.attitude.named().is_some() {
        all.push(attitude());
    }
    all.into()
}
