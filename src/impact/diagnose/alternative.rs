//! Sets of effects with the weight that the drops give them.

use super::candidate::Candidate;

/// A set of effects with the weight that the drops give it.
#[derive(Clone, Debug)]
pub struct Alternative {
    /// The set.
    pub candidate: Candidate,
    /// Its weight among the sets of its size, 0 to 1.
    pub weight: f64,
}

/// Sets of one size, the best first, with their weights.
pub(super) fn alternatives(candidates: &[Candidate]) -> Vec<Alternative> {
    let best = candidates.first().map_or(0.0, |best| best.score);
    let each: Vec<f64> = candidates.iter().map(|candidate| libm::exp(0.5 * (best - candidate.score))).collect();
    let sum: f64 = each.iter().sum();
    candidates.iter().zip(each).map(|(candidate, weight)| Alternative { candidate: candidate.clone(), weight: weight / sum }).collect()
}
