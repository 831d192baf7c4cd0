//! What `solve` found, in words and as JSON.

use crate::cli::choice;
use crate::cli::searching;
use crate::params::FrameFile;
use crate::variant::{Chosen, Evaluation, MEASURES, MECHANICS_CAVEAT, Measure, PEAK_CAVEAT, Vary, units, why_not_compared};

/// What was found beside what there was; the frame that the search began at need not be one that can be built.
pub(super) fn formatted(chosen: &Chosen, before: &str, file: &FrameFile, begun: Option<&Evaluation>) -> String {
    let Chosen { names, refused, solution } = chosen;
    let mut text = format!("{}\n\n{:<34} {:>10} {:>10}\n", searching::summary(solution.looked_at, solution.ended), "", before, "solved");
    for (key, name) in names {
        let was = choice::stated(file, key).map_or("-".into(), |(was, _)| was);
        text += &format!("{key:<34} {was:>10} {name:>10}\n");
    }
    for (vary, before, after) in &solution.values {
        text += &format!("{:<34} {before:>10.3} {after:>10.3} {}\n", vary.key(), vary.parameter.unit());
    }
    text.push('\n');
    for measure in known(&solution.evaluation) {
        let [was, is] = [begun, Some(&solution.evaluation)].map(|evaluation| measure.reported(evaluation.and_then(|e| measure.of(e))));
        text += &format!("{:<34} {was:>10} {is:>10} {}\n", measure.name, measure.unit);
    }
    if let Some(begun) = begun {
        let sides = [(before, begun), ("the solved frame", &solution.evaluation)];
        known(&solution.evaluation).filter_map(|measure| why_not_compared(measure, sides)).for_each(|why| text += &format!("{why}\n"));
    }
    text += "\nwhat holds it back\n";
    for binding in &solution.binding {
        text += &format!("  {} (room {:.3} {})\n", binding.what, binding.margin, binding.unit);
    }
    if solution.binding.is_empty() {
        text += "  no limit and no bound is reached: a minimum within, a cliff, or the search ended early\n";
    }
    if !solution.refused.is_empty() {
        text += "\nwhat is wrong with the nearest frames beyond\n";
        solution.refused.iter().for_each(|reason| text += &format!("  {reason}\n"));
    }
    if !refused.is_empty() {
        text += "\nnot searched, as the frame refuses it\n";
        refused.iter().for_each(|reason| text += &format!("  {reason}\n"));
    }
    let mechanics = if solution.evaluation.prediction.is_some() { format!("{MECHANICS_CAVEAT}\n") } else { String::new() };
    format!("{text}\n{PEAK_CAVEAT}\n{mechanics}")
}

/// The measures that were asked for.
fn known(evaluation: &Evaluation) -> impl Iterator<Item = &'static Measure> {
    let mechanics = evaluation.prediction.is_some();
    MEASURES.iter().filter(move |measure| mechanics || !measure.is_mechanics())
}

pub(super) fn json(chosen: &Chosen) -> serde_json::Value {
    let Chosen { names, refused, solution } = chosen;
    let value = |(vary, before, after): &(Vary, f64, f64)| serde_json::json!({ "key": vary.key(), "before": before, "after": after });
    let binding = |b: &crate::variant::Binding| serde_json::json!({ "what": b.what, "margin": b.margin, "unit": b.unit });
    let measures: serde_json::Map<String, serde_json::Value> =
        known(&solution.evaluation).map(|m| (m.name.to_string(), serde_json::json!(m.of(&solution.evaluation)))).collect();
    serde_json::json!({
        "schema_version": 1,
        "looked_at": solution.looked_at,
        "ended": searching::id(solution.ended),
        "chosen": names.iter().map(|(key, name)| (key.clone(), serde_json::json!(name))).collect::<serde_json::Map<_, _>>(),
        "values": solution.values.iter().map(value).collect::<Vec<_>>(),
        "measures": measures,
        "units": units(known(&solution.evaluation)),
        "names_refused": refused,
        "refused": solution.refused,
        "binding": solution.binding.iter().map(binding).collect::<Vec<_>>(),
        "peak": PEAK_CAVEAT,
    })
}
