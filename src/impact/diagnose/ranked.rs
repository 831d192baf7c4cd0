//! All that was fitted, and why it was not chosen.

use rayon::prelude::*;

use super::candidate::{Candidate, joined};
use super::constancy::{Constancy, UNSTEADY, constancy};
use super::gap::left_out_heights;
use super::search::{Search, SearchContext};
use crate::impact::effects::candidates;
use crate::impact::fit::Waves;

/// Sets whose parameters are looked at height by height.
const LOOKED_AT: usize = 6;

/// A candidate that was looked at.
#[derive(Clone, Debug)]
pub struct Ranked {
    /// Ids, joined by ` + `.
    pub id: String,
    /// Sum of squares and price of the parameters; lower is better.
    pub score: f64,
    /// Gap at each height when fitted to the others, g.
    pub left_out_g: Option<f64>,
    /// Parameters by height, where that was looked at.
    pub constancy: Option<Constancy>,
    /// Why it was not chosen.
    pub reason_rejected: Option<String>,
}

/// All that a search fitted on top of the base, the best first.
pub(super) fn ranking(setting: &SearchContext, waves: &Waves, search: &Search, chosen: &Candidate, nothing: bool) -> Vec<Ranked> {
    let problem = setting.problem;
    let looked_at: Vec<(usize, &Candidate)> = search.levels.iter().skip(1).flat_map(|level| level.candidates.iter().enumerate()).collect();
    let one = |(at, candidate): (usize, &Candidate)| {
        let close = at < LOOKED_AT;
        let constancy = close.then(|| constancy(problem, candidate)).flatten();
        let left_out_g =
            (close && problem.chosen.len() > 1).then(|| left_out_heights(problem, waves, candidate)).flatten().map(|gap| gap.net_g);
        let reason_rejected = (nothing || candidate.ids() != chosen.ids()).then(|| reason(candidate, chosen, constancy.as_ref(), nothing));
        Ranked { id: joined(candidate), score: candidate.score, left_out_g, constancy, reason_rejected }
    };
    let mut all: Vec<Ranked> = looked_at.into_par_iter().map(one).collect();
    all.sort_by(|a, b| a.score.total_cmp(&b.score));
    for spec in candidates(setting.catalogue, chosen.model())
        .iter()
        .filter(|spec| search.levels.get(1).is_some_and(|level| level.candidates.iter().all(|one| one.ids() != [spec.id])))
    {
        all.push(Ranked {
            id: spec.id.into(),
            score: f64::INFINITY,
            left_out_g: None,
            constancy: None,
            reason_rejected: Some("the simulation diverges in every fit".into()),
        });
    }
    all
}

fn reason(candidate: &Candidate, chosen: &Candidate, steady: Option<&Constancy>, nothing: bool) -> String {
    if nothing {
        return "nothing is missing: the improvement is within trial variation".into();
    }
    if let Some(parameter) = candidate.implausible().first() {
        return format!("{parameter} at its bound");
    }
    if let Some(steady) = steady.filter(|steady| steady.p < UNSTEADY) {
        let moved: Vec<String> = steady
            .parameters
            .iter()
            .map(|by| {
                let values: Vec<String> = by.values.iter().map(|(_, value, _)| format!("{value:.4}")).collect();
                let slope = by.slope.map_or(String::new(), |slope| format!(", slope {slope:.2} over impact speed"));
                format!("{} {}{slope}", by.key, values.join(" / "))
            })
            .collect();
        return format!("not the same at all heights (p = {:.1e}): {}", steady.p, moved.join("; "));
    }
    let higher = candidate.score - chosen.score;
    let score = format!("score {:.1} {}", higher.abs(), if higher < 0.0 { "lower" } else { "higher" });
    if candidate.ids().len() < chosen.ids().len() { format!("residual exceeds trial variation; {score}") } else { score }
}
