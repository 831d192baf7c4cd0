//! Our score with the generator's own covariance: what is lost by having to estimate it.

use flexframe::impact::diagnose::{Ground, Nulls, Search, Setting};
use flexframe::impact::effects::CATALOGUE;
use flexframe::impact::fit::Problem;
use flexframe::impact::synthetic::Plan;

use crate::truth::{DETECTABLE, STRENGTHS, at_strength, base, noise_free, noncentrality, waves};

/// The single effect with the best score for somebody who is told the generator's own covariance: what is lost by having to
/// estimate it. No bound: the score is ours, not the best there could be.
fn told_the_scatter(plan: &Plan) -> Option<&'static str> {
    let few = waves(plan);
    let whitening = noise_free(plan)?.whitening;
    let ground = Ground::of(&few, &base())?;
    let mut problem = Problem::of(&few, whitening, ground.problem.expected.spread);
    problem.expected = ground.problem.expected;
    let nulls = Nulls::of(&ground.scatter, &ground.family, 1)?;
    let setting = Setting { problem: &problem, nulls: &nulls, limit_seen: ground.flat_top.is_some(), most: 1, stage: &|_| () };
    let search = Search::run(&setting, &base())?;
    let singles = search.levels.iter().flat_map(|level| &level.candidates).filter(|candidate| candidate.ids().len() == 1);
    singles.min_by(|a, b| a.score.total_cmp(&b.score)).and_then(|best| best.ids().first().copied())
}

pub fn oracle(level: usize, from: u64, to: u64) {
    let (mut good, mut all, mut detectable) = ([0; STRENGTHS.len()], [0; STRENGTHS.len()], [0; 2]);
    for spec in &CATALOGUE {
        for seed in from..to {
            for (at, strength) in STRENGTHS.iter().enumerate() {
                let Some(plan) = at_strength(spec.id, seed, *strength, level) else { continue };
                let right = usize::from(told_the_scatter(&plan) == Some(spec.id));
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
