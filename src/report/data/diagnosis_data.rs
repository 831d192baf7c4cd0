//! A diagnosis as data.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};

use super::drop_data;
use super::landing_data;
use crate::figures::{PARAMETER_DIGITS, significant};
use crate::impact::diagnose::{
    Adequacy, ByHeight, CovariateEffect, Diagnosis, EffectEstimate, FrameMode, Gap, Gaps, HeldParameter, HeldValue, Ranked,
    StaticComparison, Verdict, held,
};
use crate::impact::effects::{LINEAR_DAMPER, LINEAR_SPRING, UNILATERAL_CONTACT};
use crate::impact::fit::{Decimation, LeftOut};
use crate::impact::landing::LandingAssessment;
use crate::impact::measured::RELEASE_S;
use crate::impact::request::{Compared, SeparatingExperiment};

impl Compared {
    /// Why the channel was used, and what the lateral axes are used for.
    pub fn channel(&self) -> String {
        std::iter::once(&self.channel_reason).chain(&self.lateral_axes).cloned().collect::<Vec<_>>().join("; ")
    }

    /// Landings on one foot first that touches show, where the verdict is another one.
    pub fn landings_beside(&self) -> Option<&LandingAssessment> {
        self.landing.as_ref().filter(|landing| landing.stands_beside())
    }

    /// What drops read in free fall, where that is not nothing, in a sentence.
    pub fn free_fall(&self) -> Option<String> {
        let told: Vec<String> = self
            .free_fall
            .iter()
            .filter(|reading| reading.is_told())
            .map(|reading| format!("{:.2} g from {} m (zero {:.2} g)", reading.along_g, reading.height_m, reading.zero_g))
            .collect();
        (!told.is_empty()).then(|| {
            format!(
                "note: in free fall the axis reads {}: the sensor's zero, which is taken off what is compared where the fall is long enough to tell it, and \
                 drag of the air",
                told.join(", ")
            )
        })
    }

    /// Where the comparison ends, in a sentence, if a few records end before the others.
    pub fn early_end(&self) -> Option<String> {
        self.early_end.as_ref().map(|early| format!("note: {early}"))
    }

    /// How many drops were left out, by what is wrong with them, in a sentence.
    pub fn left_out(&self) -> Option<String> {
        let each: Vec<String> =
            LeftOut::by_reason(&self.left_out).into_iter().map(|(reason, count)| format!("{reason} ({count})")).collect();
        (!each.is_empty()).then(|| format!("left out: {}; report.md lists them", each.join(", ")))
    }

    /// What the gap before is one of, where that is not the model as it was given.
    pub fn before(&self, diagnosis: &Diagnosis) -> Option<String> {
        let kept = diagnosis.base.ids();
        let left: Vec<&str> = self.own_effects.iter().copied().filter(|own| !kept.contains(own)).collect();
        (!left.is_empty()).then(|| {
            format!("before: spring and damper, fitted without {}, which the model has: it is judged among the others", left.join(" and "))
        })
    }

    /// How the readings of each height are compared, in sentences.
    pub fn sampling(&self) -> Vec<String> {
        self.sampling.iter().map(|(height_m, decimation)| format!("readings from {height_m} m: {decimation}")).collect()
    }

    /// The covariates that explain the variation between drops of one height, and the confounded ones, in sentences.
    pub fn explained(&self) -> Vec<String> {
        let covariates = self.covariates.iter().map(CovariateEffect::sentence);
        let confounding = self.confounding.iter().map(|one| one.found.clone());
        covariates.chain(confounding).chain(self.separating.iter().flat_map(SeparatingExperiment::sentences)).collect()
    }

    /// Falls, static test and frame mode, in sentences.
    pub fn observed(&self) -> Vec<String> {
        let falls = self.falls.iter().map(|fall| {
            let agrees = format!("it agrees with the height, as a release takes up to {:.0} ms", 1e3 * RELEASE_S);
            format!(
                "the fall from {} m lasted {:.0} ± {:.0} ms, {:.0} ms are expected: {}",
                fall.height_m,
                1e3 * fall.fall_s,
                1e3 * fall.error_s,
                1e3 * fall.expected_s,
                if fall.agrees() { agrees } else { "the height is not what was stated, or the release was not free".into() }
            )
        });
        let static_test = self.static_test.iter().flat_map(static_sentences);
        falls.chain(static_test).chain(self.frame_mode.iter().map(frame_mode_sentence)).collect()
    }

    /// What was found of landings that are not level, in sentences.
    pub fn landings(&self) -> Vec<String> {
        self.landing.iter().flat_map(landing_data::sentences).collect()
    }
}

fn static_sentences(test: &StaticComparison) -> Vec<String> {
    let line = format!(
        "static test, {} points: its own straight line, {:.0} N/m, has a residual of {:.1} N, the base model one of {:.1} N",
        test.points, test.line_n_m, test.line_off_n, test.base_off_n
    );
    let sets = test.sets_off_n.iter().map(|(ids, off_n)| format!("static test: {ids} has a residual of {off_n:.1} N"));
    std::iter::once(line).chain(sets).collect()
}

fn frame_mode_sentence(mode: &FrameMode) -> String {
    let own = format!("the frame's own modes are equivalent to a payload mode of mu {:.3} at {:.0} Hz", mode.mu, mode.f_hz);
    match (mode.fitted, mode.agrees) {
        (None, _) => format!("{own}; none is chosen"),
        (Some([mu, f_hz]), true) => format!("{own}; the fitted mode, mu {mu:.3} at {f_hz:.0} Hz, agrees"),
        (Some([mu, f_hz]), false) => format!("{own}; the fitted mode, mu {mu:.3} at {f_hz:.0} Hz, differs"),
    }
}

/// Numbers, wherever they stand in a value, rounded to what a reader can use, so that the same input gives the same digits.
fn rounded(value: impl Into<Value>) -> Value {
    match value.into() {
        Value::Number(number) if number.is_f64() => number.as_f64().and_then(|exact| format!("{exact:.6e}").parse::<f64>().ok()).into(),
        Value::Array(values) => values.into_iter().map(rounded).collect(),
        Value::Object(values) => values.into_iter().map(|(key, value)| (key, rounded(value))).collect(),
        other => other,
    }
}

/// Everything as JSON.
pub fn json(diagnosis: &Diagnosis, compared: &Compared) -> Value {
    let mut all = json!({
        "schema_version": 1,
        "verdict": diagnosis.verdict.id(),
        "reasons": diagnosis.reasons,
        "effects": rounded(effects(diagnosis)),
        "base": base(diagnosis),
        "weight": rounded(diagnosis.alternatives.first().map(|best| best.weight)),
        "alternatives": rounded(alternatives(diagnosis, compared)),
        "ranking": diagnosis.ranking.iter().map(ranked).collect::<Vec<_>>(),
        "correlations": correlations(diagnosis),
        "gap": rounded(gaps(diagnosis, compared.before(diagnosis))),
        "where": diagnosis.residual_map,
        "lack_of_fit_p": rounded(diagnosis.adequacy.p),
        "base_lack_of_fit": rounded(adequacy(&diagnosis.base_adequacy)),
        "lack_of_fit": rounded(adequacy(&diagnosis.adequacy)),
        "trend_over_trials_p": rounded(diagnosis.trend_p),
        "observables": diagnosis.observables,
        "falls": compared.falls,
        "static_test": compared.static_test,
        "clipping": rounded(json!(diagnosis.clipping)),
        "restoring_force_left": diagnosis.residual_force,
        "next_experiment": diagnosis.experiments.first(),
        "experiments": diagnosis.experiments,
        "channel": { "used": compared.channel, "stated": compared.stated_channel, "reason": compared.channel() },
        "drops": compared.drops.iter().map(|(height_m, count)| json!({ "height_m": height_m, "count": count })).collect::<Vec<_>>(),
        "sampling": compared.sampling.iter().map(sampling).collect::<Vec<_>>(),
        "early_end": compared.early_end,
        "left_out": compared.left_out,
        "free_fall": compared.free_fall,
        "held_out_heights_m": compared.held_out_heights_m,
        "covariates": rounded(json!(compared.covariates)),
        "confounding": rounded(json!(compared.confounding)),
        "separating_experiment": compared.separating,
        "seed": compared.seed,
    });
    if let Some(mode) = &compared.frame_mode {
        all["frame_mode"] = json!(mode);
    }
    if let Some(landing) = &compared.landing {
        all["landing"] = rounded(landing_data::landing(landing));
        if landing.decides() {
            all["effects"] = rounded(landing_data::effects(landing));
            // It is not one of the sets along the vertical, which are weighed against each other.
            all["weight"] = Value::Null;
        }
    }
    all
}

/// Estimates of some effects by their key.
fn estimates<'a>(diagnosis: &'a Diagnosis, effects: &[&str]) -> BTreeMap<&'a str, &'a EffectEstimate> {
    diagnosis.estimates.iter().filter(|estimate| effects.contains(&estimate.effect)).map(|estimate| (estimate.key, estimate)).collect()
}

/// What the effects of the estimates have that was not fitted, as rows: name, value, and why there is no interval.
pub fn held_rows(diagnosis: &Diagnosis) -> Vec<[String; 3]> {
    let is_told = |one: &HeldParameter| diagnosis.estimates.iter().any(|estimate| estimate.effect == one.effect);
    let row = |one: HeldParameter| {
        let (value, why) = match one.value {
            HeldValue::Default(value) => (significant(value, PARAMETER_DIGITS), "its default, not fitted: intervals allow for others"),
            HeldValue::Word(word) => (word.to_string(), ""),
        };
        [format!("{}.{}", one.effect, one.key), value, why.into()]
    };
    held(&diagnosis.chosen).into_iter().filter(is_told).map(row).collect()
}

/// The effects of the chosen set; none where nothing is missing.
fn effects(diagnosis: &Diagnosis) -> Value {
    let named = diagnosis.contributions.iter().filter(|_| diagnosis.verdict != Verdict::NothingMissing);
    let held = held(&diagnosis.chosen);
    let held_of =
        |id: &str| -> BTreeMap<&str, HeldValue> { held.iter().filter(|one| one.effect == id).map(|one| (one.key, one.value)).collect() };
    named
        .map(|(id, taken)| json!({ "id": id, "parameters": estimates(diagnosis, &[id]), "held": held_of(id), "contribution": taken }))
        .collect()
}

/// Spring and damper before and after, and the body.
fn base(diagnosis: &Diagnosis) -> Value {
    let [k, c] = diagnosis.base.model().stiffness_and_damping();
    json!({
        "model": diagnosis.base.model().name,
        "before": rounded(json!({ "k": k, "c": c })),
        "after": rounded(json!(estimates(diagnosis, &[LINEAR_SPRING.id, LINEAR_DAMPER.id]))),
        "body": drop_data::body(&diagnosis.base.model().body),
    })
}

/// Sets that explain the drops as well: all but the chosen one, or all where landings that are not level decide.
fn alternatives(diagnosis: &Diagnosis, compared: &Compared) -> Value {
    let decided = compared.landing.as_ref().is_some_and(LandingAssessment::decides);
    let others = diagnosis.alternatives.iter().skip(usize::from(!decided));
    others.map(|other| json!({ "effects": other.candidate.ids(), "weight": other.weight, "score": other.candidate.score })).collect()
}

/// Between which estimates, and the matrix.
fn correlations(diagnosis: &Diagnosis) -> Value {
    let correlated = diagnosis.estimates.iter().take(diagnosis.correlations.nrows());
    let of: Vec<String> = correlated.map(|estimate| format!("{}.{}", estimate.effect, estimate.key)).collect();
    let matrix: Vec<Vec<f64>> = diagnosis.correlations.row_iter().map(|row| row.iter().copied().collect()).collect();
    json!({ "of": of, "matrix": rounded(matrix) })
}

/// The model after as a file. The verdict stands in comments above it, and where landings that are not level decide, what such a file cannot state.
pub fn model_file(diagnosis: &Diagnosis, compared: &Compared) -> String {
    let decided = compared.landing.as_ref().filter(|landing| landing.decides());
    let note = decided.map_or_else(String::new, |landing| {
        format!(
            "# A level landing on the legs that the diagnosis has fitted. A model of one coordinate does not state what the drops miss:\n# {}.\n",
            landing_data::spread(landing)
        )
    });
    let model = &diagnosis.model_after;
    let pulls = model.effects.iter().all(|listed| listed.spec.id != UNILATERAL_CONTACT.id);
    // The fitted legs never pull.
    let model = if decided.is_some() && pulls { model.clone().with(&UNILATERAL_CONTACT, &[0.0], 0) } else { model.clone() };
    in_comments(diagnosis.verdict, &diagnosis.reasons, decided.is_some()) + &note + &model.to_toml()
}

/// What the model of a file is, by the verdict: one line where it explains the drops, or else the reasons, too.
fn in_comments(verdict: Verdict, reasons: &[String], landings_decide: bool) -> String {
    let is = match verdict {
        Verdict::Named if landings_decide => "landings on one foot first explain the drops; of them this file has the legs only",
        Verdict::NothingMissing => "the model as it was given, with k and c fitted, explains the drops",
        Verdict::Named => "this model has the effects that were named, and explains the drops",
        Verdict::Ambiguous => "this is the best supported of several explanations that the drops do not distinguish",
        Verdict::NoneSuffices => {
            "no set of effects passed every test. This is the best of those that were rejected, and no model of the frame"
        }
    };
    let explains = matches!(verdict, Verdict::NothingMissing | Verdict::Named);
    let reasons = reasons.iter().filter(|_| !explains);
    let head = format!("verdict: {}: {is}", verdict.id());
    std::iter::once(&head).chain(reasons).map(|line| format!("# {}\n", in_one_line(line))).collect()
}

/// Text without what a comment must not contain, such as the end of a line in a drop's name.
fn in_one_line(text: &str) -> String {
    text.chars().map(|letter| if letter.is_control() { ' ' } else { letter }).collect()
}

fn sampling((height_m, decimation): &(f64, Decimation)) -> Value {
    let Decimation { native_s, kept_s } = decimation;
    rounded(json!({ "height_m": height_m, "rate_hz": 1.0 / native_s, "mean_of": decimation.readings(), "compared_hz": 1.0 / kept_s }))
}

fn ranked(ranked: &Ranked) -> Value {
    let by_height = ranked.constancy.as_ref().map(|constancy| {
        let of = |by: &ByHeight| {
            let values = by.values.iter().map(|(height_m, value, _)| json!({ "height_m": height_m, "value": rounded(*value) }));
            json!({ "values": values.collect::<Value>(), "slope_over_impact_speed": rounded(by.slope) })
        };
        let parameters: Map<String, Value> = constancy.parameters.iter().map(|by| (format!("{}.{}", by.effect, by.key), of(by))).collect();
        json!({ "p": rounded(constancy.p), "parameters": parameters })
    });
    json!({
        "id": ranked.id,
        "score": rounded(ranked.score),
        "left_out_g": rounded(ranked.left_out_g),
        "constancy": by_height,
        "reason_rejected": ranked.reason_rejected,
    })
}

fn gaps(diagnosis: &Diagnosis, note: Option<String>) -> Value {
    let raw = |gaps: &Gaps| json!({ "fitted": gaps.fitted.raw_g, "held_out": gaps.held_out.raw_g, "trials": gaps.trials.raw_g });
    let records =
        |before: &Gap, after: &Gap| json!({ "template": before.template_g, "before": before.records_g, "after": after.records_g });
    let (before, after) = (&diagnosis.before, &diagnosis.after);
    json!({
        "unit": "g",
        "floor": before.fitted.floor_g,
        "before": before.fitted.net_g,
        "after": after.fitted.net_g,
        "held_out_floor": before.held_out.floor_g,
        "held_out_before": before.held_out.net_g,
        "held_out_after": after.held_out.net_g,
        "held_out": if diagnosis.heights_held_out { "held-out heights" } else { "each height, predicted from the others" },
        "trials_floor": before.trials.floor_g,
        "trials_before": before.trials.net_g,
        "trials_after": after.trials.net_g,
        "records": records(&before.fitted, &after.fitted),
        "before_is_without": note,
        "held_out_records": records(&before.held_out, &after.held_out),
        "raw_before": raw(before),
        "raw_after": raw(after),
    })
}

fn adequacy(adequacy: &Adequacy) -> Value {
    let Adequacy { statistics, single_p: [sum, effect, local], p, .. } = adequacy;
    json!({
        "p": p,
        "sum_of_squares": { "value": statistics.sum, "p": sum },
        "largest_gain_by_an_effect": { "value": statistics.effect, "p": effect },
        "largest_bump": { "value": statistics.local, "p": local },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::effects::Model;
    use crate::params::ImpactFile;

    #[test]
    fn analytic_a_model_file_states_its_verdict_and_is_still_one() {
        let model = Model::load("paper").expect("comes with the program");
        let reasons = ["k ended at its bound".to_string(), "session `mon\nmass_kg = 1` differs".to_string()];
        for (verdict, lines) in [(Verdict::NothingMissing, 1), (Verdict::Named, 1), (Verdict::Ambiguous, 3), (Verdict::NoneSuffices, 3)] {
            let head = in_comments(verdict, &reasons, false);
            assert!(head.starts_with(&format!("# verdict: {}: ", verdict.id())), "{head}");
            assert!(head.lines().count() == lines && head.lines().all(|line| line.starts_with("# ")), "{head}");
            let file = ImpactFile::parse("model.toml", &(head + &model.to_toml())).expect("is TOML");
            let read = Model::resolve(&file).expect("is a model");
            assert_eq!(read.stiffness_and_damping(), model.stiffness_and_damping());
        }
    }
}
