//! A Pareto front, as data.

use serde_json::{Value, json};

use crate::export::ExportError;
use crate::export::table;
use crate::variant::{Front, caveats};

/// The front as JSON; `ended` says why the search ended.
pub fn json(front: &Front, frame: &str, ended: &str) -> Value {
    let keys: Vec<String> = front.vary.iter().map(crate::variant::Vary::key).collect();
    let named = |names: &[String], values: &[f64]| -> Value {
        names.iter().cloned().zip(values.iter().map(|value| json!(value))).collect::<serde_json::Map<_, _>>().into()
    };
    let goals: Vec<String> = front.goals.iter().map(|goal| goal.name.to_string()).collect();
    let point =
        |point: &crate::variant::FrontPoint| json!({ "values": named(&keys, &point.values), "measures": named(&goals, &point.goals) });
    let mut value = json!({
        "schema_version": 1,
        "frame": frame,
        "goals": front.goals.iter().map(|goal| json!({ "measure": goal.name, "unit": goal.unit })).collect::<Vec<_>>(),
        "looked_at": front.looked_at,
        "ended": ended,
        "points": front.points.iter().map(point).collect::<Vec<_>>(),
    });
    for [name, caveat] in caveats(front.goals.iter().copied()) {
        value[name] = caveat.into();
    }
    value
}

/// The front as CSV: the goals, each with its unit, then what varied, a row a frame.
///
/// # Errors
/// When the table cannot be written.
pub fn csv(front: &Front) -> Result<String, ExportError> {
    let goals = front.goals.iter().map(|goal| format!("{} ({})", goal.name, goal.unit));
    let columns = goals.chain(front.vary.iter().map(crate::variant::Vary::key));
    let rows = front.points.iter().map(|point| point.goals.iter().chain(&point.values).map(ToString::to_string).collect::<Vec<_>>());
    table::csv("pareto.csv", columns, rows)
}
