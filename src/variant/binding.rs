//! What holds the answer of a search back, and why nothing beyond it is one.

use super::constraint::scale;
use super::measures::Evaluation;
use super::problem::{Binding, Vary};
use super::search::{Search, worst_of};
use crate::checks::Finding;

/// How near its limit a scaled margin binds.
const BINDS: f64 = 0.03;
/// How many reasons are reported why better frames are refused.
const REASONS: usize = 3;

/// Why the point nearest to another is no frame, where something is known of such points.
pub(super) fn not_designed(search: &Search, own: &[f64]) -> Option<String> {
    let far = |values: &[f64]| search.problem().distance(values, own);
    search.without_frame().into_iter().min_by(|a, b| far(&a.0).total_cmp(&far(&b.0))).map(|(_, why)| why)
}

/// Which frame a point is, beside the one that the search began with.
pub(super) fn moved_words(search: &Search, own: &[f64], point: &[f64]) -> String {
    let all = search.problem().vary.iter().zip(own.iter().zip(point));
    let moved: Vec<String> = all.filter(|(_, (a, b))| a != b).map(|(vary, (_, b))| format!("{} {b}", vary.key())).collect();
    if moved.is_empty() { "the frame that it began with".into() } else { format!("with {}", moved.join(", ")) }
}

/// What is wrong with the nearest frames that would be better, or of which nothing is known but that there is none.
pub(super) fn refused(search: &Search, best: &[f64]) -> Vec<String> {
    // What lies between points that were looked at is not one of them: then all are better.
    let own_aim = search.point_of(best).map_or(f64::INFINITY, |own| own.aim);
    let reason = |values: Vec<f64>| {
        let point = search.point_of(&values)?;
        let breaks =
            |margins: &Vec<f64>| if point.aim < own_aim { worst_of(margins, search).map(|what| format!("misses {what}")) } else { None };
        let why = point.margins.as_ref().map_or_else(|| point.why.clone(), breaks)?;
        Some((search.problem().distance(&values, best), why))
    };
    let none = search.without_frame().into_iter().map(|(values, why)| (search.problem().distance(&values, best), why));
    let mut reasons: Vec<(f64, String)> = search.order().into_iter().filter_map(reason).chain(none).collect();
    reasons.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| a.1.cmp(&b.1)));
    let mut reported: Vec<String> = Vec::new();
    for (_, reason) in reasons {
        if !reported.contains(&reason) && reported.len() < REASONS {
            reported.push(reason);
        }
    }
    reported
}

/// Limits with hardly any room, and bounds that are reached.
pub(super) fn binding(evaluation: &Evaluation, search: &Search, values: &[(Vary, f64, f64)]) -> Vec<Binding> {
    let mut found: Vec<(f64, Binding)> = Vec::new();
    for constraint in search.constraints().iter().filter(|constraint| constraint.rule.binds()) {
        let of = evaluation.findings.iter().filter(|finding| constraint.concerns(finding));
        // What is meant to be zero has no room to begin with and limits nothing.
        let real = of.filter(|f| f.limit.abs() / scale(&f.unit) > 2.0 * BINDS);
        let tightest: Option<&Finding> = real.min_by(|a, b| (a.margin / scale(&a.unit)).total_cmp(&(b.margin / scale(&b.unit))));
        if let Some(f) = tightest.filter(|f| f.margin / scale(&f.unit) < BINDS) {
            let what = format!("{}: {}", f.rule, f.message);
            let binding = Binding { what, margin: f.margin, unit: f.unit.clone().into_owned() };
            if found.iter().all(|(_, known)| *known != binding) {
                found.push((f.margin / scale(&f.unit), binding));
            }
        }
    }
    for goal in &search.problem().goals {
        let margin = goal.measure.of(evaluation).map_or(0.0, |value| goal.margin(value));
        if margin / scale(goal.measure.unit) < BINDS {
            found.push((margin, Binding { what: goal.reported(), margin, unit: goal.measure.unit.into() }));
        }
    }
    for (vary, _, value) in values {
        let [least, most] = vary.bounds;
        for (bound, margin, sign) in [(least, value - least, ">="), (most, most - value, "<=")] {
            if margin < 0.005 * (most - least) {
                let what = format!("{} {sign} {bound}", vary.key());
                found.push((margin, Binding { what, margin, unit: vary.parameter.unit().into() }));
            }
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|(_, binding)| binding).collect()
}
