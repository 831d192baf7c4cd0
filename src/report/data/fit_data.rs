//! A fit as JSON.

use serde_json::{Value, json};

use super::drop_data;
use crate::impact::effects::Channel;
use crate::impact::fit::{Chosen, Fit};

/// A fit with what it was made of.
pub struct Run<'a> {
    /// What came out.
    pub fit: &'a Fit,
    /// The drops.
    pub chosen: &'a Chosen<'a>,
    /// What was made small.
    pub objective: &'static str,
    /// Numbers compared, where they are independent.
    pub numbers: Option<usize>,
    /// Bootstrap samples asked for.
    pub bootstrap: usize,
    /// Their seed.
    pub seed: u64,
}

/// Everything.
pub fn json(run: &Run) -> Value {
    let Run { fit, chosen, .. } = run;
    let body = &fit.model.body;
    let parameters: serde_json::Map<String, Value> = fit
        .estimates
        .iter()
        .map(|estimate| {
            let value = json!({
                "effect": estimate.effect,
                "unit": estimate.unit,
                "start": estimate.start,
                "value": estimate.value,
                "ci95": estimate.ci95,
                "at_bound": estimate.at_bound,
            });
            (estimate.key.to_string(), value)
        })
        .collect();
    let mut heights: Vec<(f64, usize)> = Vec::new();
    for drop in &chosen.drops {
        match heights.iter_mut().find(|(height_m, _)| *height_m == drop.record.height_m) {
            Some((_, count)) => *count += 1,
            None => heights.push((drop.record.height_m, 1)),
        }
    }
    let left_out: Vec<Value> = chosen.left_out.iter().map(|left| json!({ "trial": left.trial, "reason": left.reason })).collect();
    json!({
        "schema_version": 1,
        "model": fit.model.name,
        "body": { "mass_kg": body.mass_kg, "gap_mm": body.gap_m * 1e3, "from": drop_data::origin(body) },
        "channel": match chosen.channel { Channel::Axial => "axial", Channel::Magnitude => "magnitude" },
        "objective": {
            "name": run.objective,
            "start": fit.objective[0],
            "fitted": fit.objective[1],
            "degrees_of_freedom": run.numbers.map(|numbers| numbers - fit.estimates.len()),
        },
        "parameters": parameters,
        "bootstrap": { "asked": run.bootstrap, "ended": fit.resampled, "seed": run.seed },
        "drops": chosen.drops.len(),
        "heights": heights.iter().map(|(height_m, drops)| json!({ "height_m": height_m, "drops": drops })).collect::<Vec<_>>(),
        "left_out": left_out,
    })
}
