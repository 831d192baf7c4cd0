//! A diagnosis as data.

use serde_json::{Map, Value, json};

use super::drop_data;
use crate::impact::diagnose::{Diagnosis, EffectEstimate, FrameMode, Gaps, Ranked, StaticComparison};
use crate::impact::effects::{LINEAR_DAMPER, LINEAR_SPRING};
use crate::impact::measured::Fall;

/// What was compared, for the record.
#[derive(Clone, Debug)]
pub struct Compared {
    /// Channel that was used.
    pub channel: &'static str,
    /// Channel that the model states.
    pub stated_channel: &'static str,
    /// Why another was used.
    pub channel_reason: Option<String>,
    /// Drops used, by height, m.
    pub drops: Vec<(f64, usize)>,
    /// Drops left out, with the reason.
    pub left_out: Vec<(String, String)>,
    /// Held-out heights, m.
    pub held_out_heights_m: Vec<f64>,
    /// Seed.
    pub seed: u64,
    /// Duration of the fall, for each height.
    pub falls: Vec<Fall>,
    /// A static test beside the models.
    pub static_test: Option<StaticComparison>,
    /// A frame's own mode beside the one found.
    pub frame_mode: Option<FrameMode>,
}

impl Compared {
    /// Falls, static test and frame mode, in sentences.
    pub fn observed(&self) -> Vec<String> {
        let falls = self.falls.iter().map(|fall| {
            format!(
                "the fall from {} m lasted {:.0} ± {:.0} ms, {:.0} ms are expected: {}",
                fall.height_m,
                1e3 * fall.fall_s,
                1e3 * fall.error_s,
                1e3 * fall.expected_s,
                if fall.agrees() { "it agrees with the height" } else { "the height is not what was stated, or the release was not free" }
            )
        });
        let static_test = self.static_test.iter().flat_map(static_sentences);
        falls.chain(static_test).chain(self.frame_mode.iter().map(frame_mode_sentence)).collect()
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

/// Rounded to what a reader can use, so that the same input gives the same digits.
fn rounded(value: f64) -> Value {
    if value.is_finite() { json!(format!("{value:.6e}").parse::<f64>().unwrap_or(value)) } else { Value::Null }
}

/// Everything as JSON.
pub fn json(diagnosis: &Diagnosis, compared: &Compared) -> Value {
    let effects: Vec<Value> = diagnosis
        .contributions
        .iter()
        .map(|(id, taken)| {
            let own: Map<String, Value> = diagnosis.estimates.iter().filter(|estimate| estimate.effect == *id).map(parameter).collect();
            json!({ "id": id, "parameters": own, "contribution": rounded(*taken) })
        })
        .collect();
    let effects = if diagnosis.verdict == crate::impact::diagnose::Verdict::NothingMissing { Vec::new() } else { effects };
    let base: Map<String, Value> = diagnosis
        .estimates
        .iter()
        .filter(|estimate| [LINEAR_SPRING.id, LINEAR_DAMPER.id].contains(&estimate.effect))
        .map(parameter)
        .collect();
    let [k, c] = diagnosis.base.model().stiffness_and_damping();
    let before = json!({ "k": rounded(k), "c": rounded(c) });
    let alternatives: Vec<Value> = diagnosis
        .alternatives
        .iter()
        .skip(1)
        .map(|other| json!({ "effects": other.candidate.ids(), "weight": rounded(other.weight), "score": rounded(other.candidate.score) }))
        .collect();
    let keys: Vec<String> = diagnosis.estimates.iter().map(|estimate| format!("{}.{}", estimate.effect, estimate.key)).collect();
    let correlations: Vec<Vec<Value>> =
        (0..keys.len()).map(|i| (0..keys.len()).map(|j| rounded(diagnosis.correlations[(i, j)])).collect()).collect();
    let mut all = json!({
        "schema_version": 1,
        "verdict": diagnosis.verdict.id(),
        "reasons": diagnosis.reasons,
        "effects": effects,
        "base": { "before": before, "after": base, "body": drop_data::body(&diagnosis.base.model().body) },
        "weight": diagnosis.alternatives.first().map(|best| rounded(best.weight)),
        "alternatives": alternatives,
        "ranking": diagnosis.ranking.iter().map(ranked).collect::<Vec<_>>(),
        "correlations": { "of": keys, "matrix": correlations },
        "gap": gaps(diagnosis),
        "where": residual_map(diagnosis),
        "lack_of_fit_p": rounded(diagnosis.adequacy.p),
        "base_lack_of_fit": adequacy(&diagnosis.base_adequacy),
        "lack_of_fit": adequacy(&diagnosis.adequacy),
        "trend_over_trials_p": rounded(diagnosis.trend_p),
        "observables": diagnosis.observables,
        "falls": compared.falls,
        "static_test": compared.static_test,
        "clipping": diagnosis.clipping.map(|clipping| json!({ "level_g": rounded(clipping.level_g), "readings": clipping.readings })),
        "restoring_force_left": diagnosis.residual_force,
        "next_experiment": diagnosis.experiments.first(),
        "experiments": diagnosis.experiments,
        "channel": { "used": compared.channel, "stated": compared.stated_channel, "reason": compared.channel_reason },
        "drops": compared.drops.iter().map(|(height_m, count)| json!({ "height_m": height_m, "count": count })).collect::<Vec<_>>(),
        "left_out": compared.left_out.iter().map(|(trial, reason)| json!({ "trial": trial, "reason": reason })).collect::<Vec<_>>(),
        "held_out_heights_m": compared.held_out_heights_m,
        "seed": compared.seed,
    });
    if let Some(mode) = &compared.frame_mode {
        all["frame_mode"] = json!(mode);
    }
    all
}

fn parameter(estimate: &EffectEstimate) -> (String, Value) {
    let ci95 = estimate.ci95.map(rounded);
    (
        estimate.key.to_string(),
        json!({ "value": rounded(estimate.value), "unit": estimate.unit, "ci95": ci95, "at_bound": estimate.at_bound }),
    )
}

fn ranked(ranked: &Ranked) -> Value {
    let by_height = ranked.constancy.as_ref().map(|constancy| {
        let parameters: Map<String, Value> = constancy
            .parameters
            .iter()
            .map(|by| {
                let values: Vec<Value> =
                    by.values.iter().map(|(height_m, value, _)| json!({ "height_m": height_m, "value": rounded(*value) })).collect();
                (format!("{}.{}", by.effect, by.key), json!({ "values": values, "slope_over_impact_speed": by.slope.map(rounded) }))
            })
            .collect();
        json!({ "p": rounded(constancy.p), "parameters": parameters })
    });
    json!({
        "id": ranked.id,
        "score": rounded(ranked.score),
        "left_out_g": ranked.left_out_g.map(rounded),
        "constancy": by_height,
        "reason_rejected": ranked.reason_rejected,
    })
}

fn gaps(diagnosis: &Diagnosis) -> Value {
    let raw = |gaps: &Gaps| json!({ "fitted": rounded(gaps.fitted.raw_g), "held_out": rounded(gaps.held_out.raw_g), "trials": rounded(gaps.trials.raw_g) });
    let (before, after) = (&diagnosis.before, &diagnosis.after);
    json!({
        "unit": "g",
        "floor": rounded(before.fitted.floor_g),
        "before": rounded(before.fitted.net_g),
        "after": rounded(after.fitted.net_g),
        "held_out_floor": rounded(before.held_out.floor_g),
        "held_out_before": rounded(before.held_out.net_g),
        "held_out_after": rounded(after.held_out.net_g),
        "held_out": if diagnosis.heights_held_out { "held-out heights" } else { "each height, predicted from the others" },
        "trials_before": rounded(before.trials.net_g),
        "trials_after": rounded(after.trials.net_g),
        "records": { "template": rounded(before.fitted.template_g), "before": rounded(before.fitted.records_g), "after": rounded(after.fitted.records_g) },
        "held_out_records": { "template": rounded(before.held_out.template_g), "before": rounded(before.held_out.records_g), "after": rounded(after.held_out.records_g) },
        "raw_before": raw(before),
        "raw_after": raw(after),
    })
}

fn residual_map(diagnosis: &Diagnosis) -> Value {
    json!({ "cells": diagnosis.residual_map.cells, "worst": diagnosis.residual_map.worst, "same_in": diagnosis.residual_map.same_in })
}

fn adequacy(adequacy: &crate::impact::diagnose::Adequacy) -> Value {
    let [sum, effect, local] = adequacy.single_p;
    json!({
        "p": rounded(adequacy.p),
        "sum_of_squares": { "value": rounded(adequacy.statistics.sum), "p": rounded(sum) },
        "largest_gain_by_an_effect": { "value": rounded(adequacy.statistics.effect), "p": rounded(effect) },
        "largest_bump": { "value": rounded(adequacy.statistics.local), "p": rounded(local) },
    })
}
