//! A fit as JSON.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::drop_data;
use crate::impact::fit::{Chosen, Fit};
use crate::impact::measured::Drop;

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
    /// How the fitted model is wrong, with the height, m.
    pub warnings: &'a [(f64, String)],
}

impl Run<'_> {
    /// What of a drop was compared, g: the paper's objective takes readings with their zeros.
    pub fn series(&self, drop: &Drop) -> Vec<f64> {
        if self.numbers.is_some() { self.chosen.series(drop) } else { self.chosen.series_as_read(drop.record) }
    }
}

/// Everything.
pub fn json(run: &Run) -> Value {
    let Run { fit, chosen, .. } = run;
    let parameters: BTreeMap<_, _> = fit.estimates.iter().map(|estimate| (estimate.key, estimate)).collect();
    let mut heights: Vec<(f64, usize)> = Vec::new();
    for drop in &chosen.drops {
        match heights.iter_mut().find(|(height_m, _)| *height_m == drop.record.height_m) {
            Some((_, count)) => *count += 1,
            None => heights.push((drop.record.height_m, 1)),
        }
    }
    json!({
        "schema_version": 1,
        "model": fit.model.name,
        "body": drop_data::body(&fit.model.body),
        "channel": chosen.channel,
        "objective": {
            "name": run.objective,
            "start": fit.objective[0],
            "fitted": fit.objective[1],
            "degrees_of_freedom": run.numbers.map(|numbers| numbers - fit.estimates.len()),
            "p": fit.p,
        },
        "parameters": parameters,
        "bootstrap": { "asked": run.bootstrap, "ended": fit.resampled, "seed": run.seed },
        "drops": chosen.drops.len(),
        "heights": heights.iter().map(|(height_m, drops)| json!({ "height_m": height_m, "drops": drops })).collect::<Vec<_>>(),
        "early_end": run.numbers.and_then(|_| chosen.early_end()),
        "left_out": chosen.left_out,
        "warnings": run.warnings.iter().map(|(height_m, warning)| json!({ "height_m": height_m, "warning": warning })).collect::<Vec<_>>(),
    })
}
