//! How strong a truth is: fits to its mean waves without noise, in units of the covariance that the generator has.

use std::sync::Arc;

use super::covariance::exact;
use crate::impact::diagnose::{Bootstrap, PreparedDrops, Search, SearchContext};
use crate::impact::effects::{CATALOGUE, Model};
use crate::impact::fit::{FitProblem, FittedDrop, Layout, TrialCovariance, Waves, Whitening};
use crate::impact::synthetic::{Plan, ReferenceTrajectory, ScatterLaw, SyntheticRecord, records};

/// Drops a height from which a covariance is read off.
const MANY: usize = 300;
/// The same where readings are cut, whose mean is then read off, too.
const MANY_CUT: usize = 3000;

/// The wave of one drop without anything random, at steps of 0.05 ms from first touch, within the sensor's limit, g.
pub(super) fn clean(plan: &Plan, height_m: f64) -> Vec<f64> {
    let trajectory = ReferenceTrajectory::of(&plan.model, plan.hidden, 1.0, 1.0);
    let limit_g = trajectory.limit_g();
    trajectory.wave_g(height_m, 5e-5, 802).into_iter().map(|reading| reading.clamp(-limit_g, limit_g)).collect()
}

/// The drops of a plan, aligned; `None` when they cannot be.
pub(super) fn waves(plan: &Plan) -> Option<Waves> {
    let drop =
        |record: SyntheticRecord| FittedDrop { trial: record.trial, height_m: record.height_m, t_s: record.t_s, accel_g: record.accel_g };
    Waves::of(&records(plan).into_iter().map(drop).collect::<Vec<_>>()).ok()
}

/// A truth's noise-free mean waves with the generator's own covariance of the mean: read off many drops, or by quadrature
/// where k and c vary from trial to trial, as the mean of some hundred such drops is not without noise.
pub(super) fn noise_free(plan: &Plan) -> Option<FitProblem> {
    if plan.scatter.stiffness > 0.0 && plan.hidden.is_none() && plan.scatter.law == ScatterLaw::Proportional {
        return exact(plan);
    }
    let counts = vec![plan.drops; plan.heights_m.len()];
    let limited = plan.model.value("sensor_saturation", "limit_g").is_some();
    let many = waves(&Plan { drops: if limited { MANY_CUT } else { MANY }, ..plan.clone() })?;
    let mut problem = FitProblem::of(&many, Whitening::of(&TrialCovariance::of(&many).plain_covariances(), &counts)?, Arc::default());
    if plan.scatter.stiffness == 0.0 && !limited {
        for mean in &mut problem.means {
            mean.wave = problem.expected.mean_over_phases(&clean(plan, mean.height_m));
        }
    }
    Some(problem)
}

/// How strong the effects of a truth are: the squared whitened distance between its noise-free mean waves and those of the base model
/// refitted to them.
pub(super) fn noncentrality(plan: &Plan) -> Option<f64> {
    let problem = noise_free(plan)?;
    let [k, c] = plan.model.stiffness_and_damping();
    Some(problem.fit(Layout::of(Model::base(plan.model.body.clone(), plan.model.sensor, k, c)), 25)?.chi2())
}

/// The catalogue's fits to a truth's noise-free mean waves, pairs included.
pub(super) fn catalogue(plan: &Plan, base: &Model) -> Option<Search> {
    let problem = noise_free(plan)?;
    let few = waves(plan)?;
    let prepared = PreparedDrops::of(&few, base)?;
    let bootstrap = Bootstrap::of(&few, &prepared.trial_covariance, &prepared.covariance_model, 1)?;
    let setting = SearchContext { problem: &problem, bootstrap: &bootstrap, catalogue: &CATALOGUE, most: 2, stage: &|_| () };
    Search::run(&setting, base)
}

/// The single effect with the best score under the generator's own covariance: what is lost by having to
/// estimate it. No bound: the score is the diagnosis' own, not the best there could be.
pub(super) fn ranked_with_known_covariance(plan: &Plan, base: &Model) -> Option<&'static str> {
    let few = waves(plan)?;
    let whitening = noise_free(plan)?.whitening;
    let prepared = PreparedDrops::of(&few, base)?;
    let mut problem = FitProblem::of(&few, whitening, prepared.problem.expected.spread.clone());
    problem.expected = prepared.problem.expected;
    problem.seen_limit_g = prepared.problem.seen_limit_g;
    let bootstrap = Bootstrap::of(&few, &prepared.trial_covariance, &prepared.covariance_model, 1)?;
    let setting = SearchContext { problem: &problem, bootstrap: &bootstrap, catalogue: &CATALOGUE, most: 1, stage: &|_| () };
    let search = Search::run(&setting, base)?;
    let singles = search.levels.iter().flat_map(|level| &level.candidates).filter(|candidate| candidate.ids().len() == 1);
    singles.min_by(|a, b| a.score.total_cmp(&b.score)).and_then(|best| best.ids().first().copied())
}
