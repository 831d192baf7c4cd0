//! Drops with a known truth: base models, effects on top of them at a stated strength, and how strong they are.

use std::sync::OnceLock;

use flexframe::impact::diagnose::{Bootstrap, Candidate, PreparedDrops, Search, SearchContext};
use flexframe::impact::effects::{CATALOGUE, Model, by_id};
use flexframe::impact::fit::{Expected, FitProblem, FittedDrop, Layout, TrialCovariance, Waves, Whitening};
use flexframe::impact::synthetic::{Plan, ReferenceTrajectory, ScatterLaw, TrialVariation, records};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

use crate::covariance::exact;
use crate::strength;

const HEIGHTS_M: [f64; 3] = [0.5, 1.0, 1.5];
/// Noncentralities at the middle level.
pub const STRENGTHS: [f64; 5] = [5.0, 19.0, 71.0, 266.0, 1000.0];
/// Noncentrality beyond which an effect is detectable.
pub const DETECTABLE: f64 = 30.0;

pub fn base() -> Model {
    Model::load("paper").expect("the paper's model")
}

/// The law of the scatter of every plan; one for the whole run.
pub static LAW: OnceLock<ScatterLaw> = OnceLock::new();

/// Drops of the base model at a level of noise, its k and c a little different for every seed.
pub fn plan(level: usize, seed: u64) -> Plan {
    let law = *LAW.get_or_init(|| ScatterLaw::Proportional);
    let (drops, share) = if level == 1 { (80, 0.5) } else { (20, 0.1) };
    let varied = if level == 3 { 0.1 } else { 0.0 };
    let mut rng = Pcg64::seed_from_u64(seed ^ 0x5eed);
    let mut model = base();
    let (k, c): (f64, f64) = (rng.random_range(0.8..1.25), rng.random_range(0.8..1.25));
    model.effects[0].values[0] *= k;
    model.effects[1].values[0] *= c;
    let variation = TrialVariation { share, law, correlation_s: 1.5e-3, stiffness: varied, damping: varied, tilt_deg: 0.0 };
    Plan {
        model,
        hidden: None,
        heights_m: HEIGHTS_M.to_vec(),
        drops,
        scatter: variation,
        noise_g: 0.17,
        counts_per_g: 8.877,
        rate_hz: 1000.0,
        stalls: None,
        landings: None,
        seed,
    }
}

/// An effect with as much of it as `amount` says; its other parameters by chance.
fn with(model: &Model, id: &str, amount: f64, rng: &mut impl Rng) -> Option<Model> {
    let spec = by_id(id)?;
    let values = strength::values(id, model, amount, rng)?;
    // The library's least stiffness of a stop; the catalogue lets it vanish.
    let inside = (id != "bottoming" || values[1] >= 1e4)
        && spec.parameters.iter().zip(&values).all(|(parameter, value)| (parameter.min..=parameter.max).contains(value));
    inside.then(|| model.clone().with(spec, &values, 0))
}

/// The wave of one synthetic drop without anything random, at steps of 0.05 ms from first touch, within the sensor's limit, g.
pub fn clean(plan: &Plan, height_m: f64) -> Vec<f64> {
    let trajectory = ReferenceTrajectory::of(&plan.model, plan.hidden, 1.0, 1.0);
    let limit_g = trajectory.limit_g();
    trajectory.wave_g(height_m, 5e-5, 802).into_iter().map(|reading| reading.clamp(-limit_g, limit_g)).collect()
}

pub fn waves(plan: &Plan) -> Waves {
    let drop = |record: flexframe::impact::synthetic::SyntheticRecord| FittedDrop {
        trial: record.trial,
        height_m: record.height_m,
        t_s: record.t_s,
        accel_g: record.accel_g,
    };
    Waves::of(&records(plan).into_iter().map(drop).collect::<Vec<_>>()).expect("synthetic drops are usable")
}

/// A truth's noise-free mean waves with the generator's own covariance of the mean: read off many drops, or by quadrature
/// where k and c vary from trial to trial, as the mean of some hundred such drops is not without noise.
pub fn noise_free(plan: &Plan) -> Option<FitProblem> {
    if plan.scatter.stiffness > 0.0 && plan.hidden.is_none() && plan.scatter.law == ScatterLaw::Proportional {
        return exact(plan);
    }
    let counts = vec![plan.drops; plan.heights_m.len()];
    let limited = plan.model.value("sensor_saturation", "limit_g").is_some();
    let many = waves(&Plan { drops: if limited { 3000 } else { 300 }, ..plan.clone() });
    let mut problem = FitProblem::of(&many, Whitening::of(&TrialCovariance::of(&many).plain_covariances(), &counts)?, 0.0);
    let expected: Expected = problem.expected;
    if plan.scatter.stiffness == 0.0 && !limited {
        for mean in &mut problem.means {
            mean.wave = expected.mean_over_phases(&clean(plan, mean.height_m));
        }
    }
    Some(problem)
}

pub fn noncentrality(plan: &Plan) -> Option<f64> {
    let problem = noise_free(plan)?;
    let [k, c] = plan.model.stiffness_and_damping();
    Some(problem.fit(Layout::of(Model::base(plan.model.body.clone(), plan.model.sensor, k, c)), 25)?.chi2())
}

/// The catalogue's fits to a truth's noise-free mean waves, pairs included.
pub fn catalogue(plan: &Plan) -> Option<Search> {
    let problem = noise_free(plan)?;
    let few = waves(plan);
    let prepared = PreparedDrops::of(&few, &base())?;
    let bootstrap = Bootstrap::of(&few, &prepared.trial_covariance, &prepared.covariance_model, 1)?;
    let setting =
        SearchContext { problem: &problem, bootstrap: &bootstrap, limit_seen: false, catalogue: &CATALOGUE, most: 2, stage: &|_| () };
    Search::run(&setting, &base())
}

/// What the best catalogue fit leaves of a truth.
pub fn left_by_catalogue(plan: &Plan) -> Option<f64> {
    let search = catalogue(plan)?;
    search.levels.iter().flat_map(|level| &level.candidates).map(|candidate: &Candidate| candidate.fitted.chi2()).min_by(f64::total_cmp)
}

/// The plan of an effect at a strength of the middle level, for a level; `None` when the bounds do not allow it.
pub fn at_strength(id: &str, seed: u64, strength: f64, level: usize) -> Option<Plan> {
    let own = |amount: f64, level: usize| {
        let mut plan = plan(level, 7919 * seed + 17);
        plan.model = with(&plan.model, id, amount, &mut Pcg64::seed_from_u64(seed * 31 + 5))?;
        plan.seed = seed * 977 + strength as u64;
        Some(plan)
    };
    let (mut low, mut high) = (1e-3_f64, 30.0_f64);
    for _ in 0..12 {
        let middle = (low * high).sqrt();
        let enough = own(middle, 2).is_none_or(|plan| noncentrality(&plan).is_none_or(|found| found > strength));
        if enough { high = middle } else { low = middle }
    }
    let reached = noncentrality(&own(low, 2)?)?;
    if reached < 0.7 * strength {
        return None;
    }
    let mut plan = own(low, level)?;
    if level == 3 {
        plan.scatter.tilt_deg = 5.0;
    }
    Some(plan)
}
