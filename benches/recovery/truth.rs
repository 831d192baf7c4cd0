//! Drops with a known truth: base models, effects on top of them at a stated strength, and how strong they are.

use flexframe::impact::diagnose::{Candidate, Ground, Nulls, Search, Setting};
use flexframe::impact::effects::{Model, by_id};
use flexframe::impact::fit::{Drop, Expected, Layout, Problem, Scatter, Waves, Whitening};
use flexframe::impact::synthetic::{Plan, Scatter as Spread, clean, records};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

use crate::covariance::exact;

const HEIGHTS_M: [f64; 3] = [0.5, 1.0, 1.5];
/// Noncentralities at the middle level.
pub const STRENGTHS: [f64; 5] = [5.0, 19.0, 71.0, 266.0, 1000.0];
/// Noncentrality beyond which an effect is detectable.
pub const DETECTABLE: f64 = 30.0;

pub fn base() -> Model {
    Model::load("paper").expect("the paper's model")
}

/// Drops of the base model at a level of noise, its k and c a little different for every seed.
pub fn plan(level: usize, seed: u64) -> Plan {
    let (drops, share) = if level == 1 { (80, 0.5) } else { (20, 0.1) };
    let varied = if level == 3 { 0.1 } else { 0.0 };
    let mut rng = Pcg64::seed_from_u64(seed ^ 0x5eed);
    let mut model = base();
    let (k, c): (f64, f64) = (rng.random_range(0.8..1.25), rng.random_range(0.8..1.25));
    model.effects[0].values[0] *= k;
    model.effects[1].values[0] *= c;
    let scatter = Spread { share, correlation_s: 1.5e-3, stiffness: varied, damping: varied, tilt_deg: 0.0 };
    Plan { model, hidden: None, heights_m: HEIGHTS_M.to_vec(), drops, scatter, noise_g: 0.17, counts_per_g: 8.877, rate_hz: 1000.0, seed }
}

/// An effect with as much of it as `amount` says; its other parameters by chance.
fn with(model: &Model, id: &str, amount: f64, rng: &mut impl Rng) -> Option<Model> {
    let spec = by_id(id)?;
    let side = if rng.random_bool(0.4) { -1.0 } else { 1.0 };
    let one = |value: f64| vec![value];
    let values = match id {
        "unilateral_contact" => one(1.0 - amount),
        "bottoming" => vec![rng.random_range(5.0..14.0), 1e4 + 4e6 * amount, 0.3],
        "cubic_stiffness" => one(side * 5e6 * amount),
        "bilinear_stiffness" => vec![rng.random_range(4.0..14.0), side * 3e3 * amount],
        "hunt_crossley_damping" => one(side * 1.5e3 * amount),
        "coulomb_friction" => one(20.0 * amount),
        "maxwell_branch" => vec![8e3 * amount, libm::exp(rng.random_range(-0.7..2.3))],
        "quadratic_damping" => one(side * 5.0 * amount),
        "preload" => one(20.0 * amount),
        "sensor_low_pass" => one(model.sensor.cutoff_hz * libm::exp(side * 0.5 * amount)),
        "sensor_saturation" => one(250.0 * libm::exp(-amount)),
        "sensor_gain" => one(1.0 + side * 0.15 * amount),
        "payload_mode" => vec![0.15 * amount, libm::exp(rng.random_range(4.0..5.8)), 0.05],
        "foot_stagger" => one(4.0 * amount),
        "drop_height_error" => one(side * 0.12 * amount),
        _ => one(0.2 * amount),
    };
    // The library's least stiffness of a stop; the catalogue lets it vanish.
    let inside = (id != "bottoming" || values[1] >= 1e4)
        && spec.parameters.iter().zip(&values).all(|(parameter, value)| (parameter.min..=parameter.max).contains(value));
    inside.then(|| model.clone().with(spec, &values, 0))
}

pub fn waves(plan: &Plan) -> Waves {
    let drop = |record: flexframe::impact::synthetic::Record| Drop {
        trial: record.trial,
        height_m: record.height_m,
        t_s: record.t_s,
        accel_g: record.accel_g,
    };
    Waves::of(&records(plan).into_iter().map(drop).collect::<Vec<_>>()).expect("planted drops are usable")
}

/// A truth's noise-free mean waves with the generator's own covariance of the mean: read off many drops, or by quadrature
/// where k and c scatter, as the mean of some hundred such drops is not without noise.
pub fn noise_free(plan: &Plan) -> Option<Problem> {
    if plan.scatter.stiffness > 0.0 && plan.hidden.is_none() {
        return exact(plan);
    }
    let counts = vec![plan.drops; plan.heights_m.len()];
    let limited = plan.model.value("sensor_saturation", "limit_g").is_some();
    let many = waves(&Plan { drops: if limited { 3000 } else { 300 }, ..plan.clone() });
    let mut problem = Problem::of(&many, Whitening::of(&Scatter::of(&many).plain_covariances(), &counts)?, 0.0);
    let expected: Expected = problem.expected;
    if plan.scatter.stiffness == 0.0 && !limited {
        for (height_m, mean) in &mut problem.means {
            *mean = expected.mean_over_phases(&clean(plan, *height_m));
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
    let ground = Ground::of(&few, &base())?;
    let nulls = Nulls::of(&ground.scatter, &ground.family, 1)?;
    let setting = Setting { problem: &problem, nulls: &nulls, limit_seen: false, most: 2, stage: &|_| () };
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
