//! Our score with the generator's own covariance: what is lost by having to estimate it.

use flexframe::impact::diagnose::{Bootstrap, PreparedDrops, Search, SearchContext};
use flexframe::impact::effects::CATALOGUE;
use flexframe::impact::fit::FitProblem;
use flexframe::impact::synthetic::Plan;

use crate::strength::recorded;
use crate::truth::{DETECTABLE, STRENGTHS, at_strength, base, noise_free, noncentrality, waves};

/// The single effect with the best score for somebody who is told the generator's own covariance: what is lost by having to
/// estimate it. No bound: the score is ours, not the best there could be.
fn told_the_covariance(plan: &Plan) -> Option<&'static str> {
    let few = waves(plan);
    let whitening = noise_free(plan)?.whitening;
    let prepared = PreparedDrops::of(&few, &base())?;
    let mut problem = FitProblem::of(&few, whitening, prepared.problem.expected.spread);
    problem.expected = prepared.problem.expected;
    let bootstrap = Bootstrap::of(&few, &prepared.trial_covariance, &prepared.covariance_model, 1)?;
    let setting = SearchContext {
        problem: &problem,
        bootstrap: &bootstrap,
        catalogue: &CATALOGUE,
        limit_seen: prepared.clipping.is_some(),
        most: 1,
        stage: &|_| (),
    };
    let search = Search::run(&setting, &base())?;
    let singles = search.levels.iter().flat_map(|level| &level.candidates).filter(|candidate| candidate.ids().len() == 1);
    singles.min_by(|a, b| a.score.total_cmp(&b.score)).and_then(|best| best.ids().first().copied())
}

pub fn oracle(level: usize, from: u64, to: u64) {
    let (mut good, mut all, mut detectable) = ([0; STRENGTHS.len()], [0; STRENGTHS.len()], [0; 2]);
    for spec in recorded(&base()) {
        for seed in from..to {
            for (at, strength) in STRENGTHS.iter().enumerate() {
                let Some(plan) = at_strength(spec.id, seed, *strength, level) else { continue };
                let right = usize::from(told_the_covariance(&plan) == Some(spec.id));
                good[at] += right;
                all[at] += 1;
                if noncentrality(&plan).is_some_and(|found| found > DETECTABLE) {
                    detectable[0] += right;
                    detectable[1] += 1;
                }
            }
        }
    }
    println!("ORACLE level {level}: detectable {}/{}, by strength {good:?} of {all:?}", detectable[0], detectable[1]);
    println!("ORACLE level {level}: all {}/{}", good.iter().sum::<usize>(), all.iter().sum::<usize>());
}
