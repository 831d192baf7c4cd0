//! Between the frame that a search began with and its best one, where the rules that are asked at the end refuse the best.
//!
//! One parameter often is to blame, and those rules say nothing of the way there: so each that moved is taken back alone, and all of them
//! together by halves.

use super::goal::broken;
use super::measures::Evaluation;
use super::search::Search;
use crate::checks::Cost;

/// Parts of the way to the best frame that are tried.
const PARTS: [f64; 3] = [0.5, 0.25, 0.125];

/// The best frame that keeps every rule and goal, the one the search began with or one between it and the best, and how many frames were evaluated.
/// `None` if the first frame breaks a rule or a goal itself.
pub(super) fn retreated(search: &Search, began: &[f64], best: &[f64]) -> (Option<Vec<f64>>, usize) {
    let keeps = |evaluation: &Evaluation| broken(evaluation, &search.problem().goals).is_empty();
    let Some(first) = search.evaluated(began, Cost::Slow).ok().filter(keeps) else { return (None, 1) };
    let between = between(search, began, best);
    let looked_at = 1 + between.len();
    let value = |evaluation: &Evaluation| search.problem().value(evaluation);
    let evaluated = search.evaluated_each(&between, Cost::Slow).into_iter();
    let kept = between.iter().zip(evaluated).filter_map(|(values, one)| Some((values.as_slice(), value(&one.ok().filter(keeps)?))));
    let least = std::iter::once((began, value(&first))).chain(kept).min_by(|a, b| a.1.total_cmp(&b.1));
    (least.map(|(values, _)| values.to_vec()), looked_at)
}

/// The frames that are tried.
fn between(search: &Search, began: &[f64], best: &[f64]) -> Vec<Vec<f64>> {
    let moved: Vec<usize> = (0..best.len()).filter(|at| began[*at] != best[*at]).collect();
    let without = |at: &usize| {
        let mut values = best.to_vec();
        values[*at] = began[*at];
        values
    };
    let [from, to] = [search.shares(began), search.shares(best)];
    let part = |part: f64| search.values(&from.iter().zip(&to).map(|(a, b)| a + part * (b - a)).collect::<Vec<f64>>());
    let alone = if moved.len() > 1 { moved.iter().map(without).collect() } else { Vec::new() };
    alone.into_iter().chain(PARTS.map(part)).collect()
}
