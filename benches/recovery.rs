//! How often the right effect is named, over effects, strengths, seeds and levels of noise.
//!
//! `cargo bench --bench recovery -- --level 2 --seeds 0..3 --what singles,nulls,pairs,hidden`

use std::collections::BTreeMap;
use std::time::Instant;

use flexframe::diagnose::{Ground, RARE, Search, Setting};
use flexframe::effects::{CATALOGUE, Model, by_id};
use flexframe::fit::{Drop, Expected, Layout, Problem, Scatter, Waves, Whitening};
use flexframe::plant::{Plan, Scatter as Spread, clean, records};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

const HEIGHTS_M: [f64; 3] = [0.5, 1.0, 1.5];
const STRENGTHS: [f64; 5] = [5.0, 19.0, 71.0, 266.0, 1000.0];

fn plan(level: usize, seed: u64) -> Plan {
    let (drops, share) = if level == 1 { (80, 0.5) } else { (20, 0.1) };
    let varied = if level == 3 { 0.1 } else { 0.0 };
    let mut rng = Pcg64::seed_from_u64(seed ^ 0x5eed);
    let mut model = Model::load("paper").expect("the paper's model");
    let (k, c): (f64, f64) = (rng.random_range(0.8..1.25), rng.random_range(0.8..1.25));
    model.effects[0].values[0] *= k;
    model.effects[1].values[0] *= c;
    let scatter = Spread { share, correlation_s: 1.5e-3, stiffness: varied, damping: varied, tilt_deg: if level == 3 { 5.0 } else { 0.0 } };
    Plan { model, hidden: None, heights_m: HEIGHTS_M.to_vec(), drops, scatter, noise_g: 0.17, counts_per_g: 8.877, rate_hz: 1000.0, seed }
}

/// An effect with as much of it as `amount` (1: a plain strength) says.
fn with(model: &Model, id: &str, amount: f64, rng: &mut impl Rng) -> Option<(Model, Vec<f64>)> {
    let spec = by_id(id)?;
    let side = if rng.random_bool(0.4) { -1.0 } else { 1.0 };
    let sign = |both: bool| if both { side } else { 1.0 };
    let one = |value: f64| vec![value];
    let values = match id {
        "unilateral_contact" => one(1.0 - amount),
        "bottoming" => vec![rng.random_range(5.0..16.0), 4e6 * amount, 0.3],
        "cubic_stiffness" => one(sign(true) * 5e6 * amount),
        "bilinear_stiffness" => vec![rng.random_range(4.0..16.0), sign(true) * 3e3 * amount],
        "hunt_crossley_damping" => one(sign(true) * 1.5e3 * amount),
        "coulomb_friction" => one(20.0 * amount),
        "maxwell_branch" => vec![8e3 * amount, libm::exp(rng.random_range(-0.7..2.3))],
        "quadratic_damping" => one(sign(true) * 5.0 * amount),
        "preload" => one(20.0 * amount),
        "sensor_low_pass" => one(model.sensor.cutoff_hz * libm::exp(sign(true) * 0.5 * amount)),
        "sensor_saturation" => one(100.0 / (0.2 + amount)),
        "sensor_gain" => one(1.0 + sign(true) * 0.15 * amount),
        "payload_mode" => vec![0.15 * amount, libm::exp(rng.random_range(4.0..5.8)), 0.05],
        "foot_stagger" => one(4.0 * amount),
        "drop_height_error" => one(sign(true) * 0.12 * amount),
        _ => one(0.2 * amount),
    };
    let inside = spec.parameters.iter().zip(&values).all(|(parameter, value)| (parameter.min..=parameter.max).contains(value));
    inside.then(|| (model.clone().with(spec, &values, 0), values))
}

/// Squared whitened distance between a truth's mean waves and those of the base model refitted to them.
fn noncentrality(plan: &Plan) -> Option<f64> {
    let many = Plan { drops: 300, ..plan.clone() };
    let waves = waves(&many);
    let scatter = Scatter::of(&waves);
    let counts = vec![plan.drops; HEIGHTS_M.len()];
    let whitening = Whitening::of(&scatter.plain_covariances(), &counts)?;
    let mut problem = Problem::of(&waves, whitening, 0.0);
    let expected = Expected { spread: 0.0, ..problem.expected };
    if plan.scatter.stiffness == 0.0 {
        for (height_m, mean) in &mut problem.means {
            *mean = expected.mean_over_phases(&clean(plan, *height_m));
        }
    }
    let [k, c] = plan.model.stiffness_and_damping();
    let base = Model::base(plan.model.body.clone(), plan.model.sensor, k, c);
    Some(problem.fit(Layout::of(base), 25)?.chi2())
}

fn waves(plan: &Plan) -> Waves {
    let drops: Vec<Drop> = records(plan)
        .into_iter()
        .map(|record| Drop { trial: record.trial, height_m: record.height_m, t_s: record.t_s, accel_g: record.accel_g })
        .collect();
    Waves::of(&drops).expect("planted drops are usable")
}

struct Outcome {
    first: Option<String>,
    set: Vec<String>,
    top: String,
    weight: f64,
    p: Vec<f64>,
    parts: [f64; 3],
    seconds: f64,
}

fn diagnosed(plan: &Plan) -> Outcome {
    let from = Instant::now();
    let waves = waves(plan);
    let model = Model::load("paper").expect("the paper's model");
    let Ground { problem, scatter, family, .. } = Ground::of(&waves, &model).expect("a base fit");
    let setting = Setting { problem: &problem, scatter: &scatter, family: &family, most: 3, seed: 7 };
    let search = Search::run(&setting, &model).expect("a search");
    let seconds = from.elapsed().as_secs_f64();
    let last = search.levels.last().expect("a level");
    let something = search.levels[0].adequacy.p < RARE;
    let ids = |at: usize| -> Vec<String> { last.candidates[at].ids().into_iter().map(String::from).collect() };
    let weights: Vec<f64> = last.candidates.iter().map(|candidate| libm::exp(0.5 * (last.candidates[0].score - candidate.score))).collect();
    if std::env::var_os("LOUD").is_some() {
        for candidate in search.levels[1].candidates.iter().take(6) {
            let listed: Vec<String> =
                candidate.model().effects.iter().map(|listed| format!("{} {:.3?}", listed.spec.id, listed.values)).collect();
            println!("      {:.1} {:.1} {}", candidate.score, candidate.fitted.chi2(), listed.join("; "));
        }
    }
    let top = search.levels[1].candidates[0].ids()[0].to_string();
    Outcome {
        first: something.then(|| top.clone()),
        set: if something { ids(0) } else { Vec::new() },
        top,
        weight: 1.0 / weights.iter().sum::<f64>(),
        parts: search.levels[0].adequacy.single_p,
        p: search.levels.iter().map(|level| level.adequacy.p).collect(),
        seconds,
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let option = |name: &str| arguments.iter().position(|argument| argument == name).and_then(|at| arguments.get(at + 1));
    let level: usize = option("--level").map_or(2, |text| text.parse().expect("a level"));
    let (from, to) = option("--seeds").map_or((0, 1), |text| {
        let (from, to) = text.split_once("..").expect("a..b");
        (from.parse::<u64>().expect("a number"), to.parse::<u64>().expect("a number"))
    });
    let what = option("--what").map_or("singles,nulls", String::as_str);
    if what.contains("mean") {
        mean_check();
    }
    if what.contains("scatter") {
        scatter_check(level, from);
    }
    if what.contains("nulls") {
        let mut alarms = 0;
        for seed in from..to {
            let outcome = diagnosed(&plan(level, 1000 + seed));
            alarms += usize::from(outcome.first.is_some());
            println!("null {seed}: p {:.3?} parts {:.3?} top {} {:.2} s", outcome.p, outcome.parts, outcome.top, outcome.seconds);
        }
        println!("NULLS level {level}: {alarms} alarms of {}", to - from);
    }
    if what.contains("singles") {
        singles(level, from, to, option("--only").map(String::as_str));
    }
}

fn singles(level: usize, from: u64, to: u64, only: Option<&str>) {
    let mut table: BTreeMap<&str, Vec<[usize; 4]>> = BTreeMap::new();
    let (mut seen, mut right, mut top_right) = ([0; 2], [0; 2], 0);
    for spec in CATALOGUE.iter().filter(|spec| only.is_none_or(|only| only == spec.id)) {
        for seed in from..to {
            for (strength, wanted) in STRENGTHS.iter().enumerate() {
                let own = |amount: f64, level: usize| {
                    let mut plan = plan(level, 7919 * seed + 17);
                    let (model, values) = with(&plan.model, spec.id, amount, &mut Pcg64::seed_from_u64(seed * 31 + 5))?;
                    plan.model = model;
                    plan.seed = seed * 977 + strength as u64;
                    Some((plan, values))
                };
                let (mut low, mut high) = (1e-3_f64, 30.0_f64);
                for _ in 0..14 {
                    let middle = (low * high).sqrt();
                    let enough = own(middle, 2).map_or(true, |(plan, _)| noncentrality(&plan).is_none_or(|found| found > *wanted));
                    if enough { high = middle } else { low = middle }
                }
                let Some((plan, values)) = own(low, level) else { continue };
                let found = noncentrality(&plan).unwrap_or(f64::NAN);
                let outcome = diagnosed(&plan);
                let good = outcome.first.as_deref() == Some(spec.id);
                let detectable = usize::from(found > 30.0);
                seen[detectable] += 1;
                right[detectable] += usize::from(good);
                top_right += usize::from(outcome.top == spec.id);
                let row = table.entry(spec.id).or_insert_with(|| vec![[0; 4]; STRENGTHS.len()]);
                row[strength][0] += 1;
                row[strength][1] += usize::from(good);
                println!(
                    "{} {} {values:.3?} nc {found:.0}: first {:?} top {} set {:?} weight {:.2} p {:.3?} {:.2} s",
                    if good { "ok " } else { "BAD" },
                    spec.id,
                    outcome.first,
                    outcome.top,
                    outcome.set,
                    outcome.weight,
                    outcome.p,
                    outcome.seconds
                );
            }
        }
    }
    for (id, row) in &table {
        println!("{id:24} {}", row.iter().map(|cell| format!("{}/{}", cell[1], cell[0])).collect::<Vec<_>>().join("  "));
    }
    println!(
        "SINGLES level {level}: detectable {}/{} others {}/{} top {}/{}",
        right[1],
        seen[1],
        right[0],
        seen[0],
        top_right,
        seen[0] + seen[1]
    );
}

/// What an estimate from few drops makes of the scatter that many show.
fn scatter_check(level: usize, seed: u64) {
    let model = Model::load("paper").expect("the paper's model");
    let few = plan(level, seed);
    let waves_few = waves(&few);
    let ground = Ground::of(&waves_few, &model).expect("ground");
    let many_waves = waves(&Plan { drops: 3000, ..few.clone() });
    let many_ground = Ground::of(&many_waves, &model).expect("ground");
    let many = Scatter::of(&many_waves).plain_covariances();
    let best = many_ground.family.nearest(&many);
    let inverse = best[1].clone().cholesky().unwrap().inverse();
    println!("family on many: {}", (inverse * &many[1]).diagonal().iter().map(|v| format!("{v:.2}")).collect::<Vec<_>>().join(" "));
    let estimated = ground.scatter.covariances(&ground.family).expect("covariances");
    for (many, estimated) in many.iter().zip(&estimated) {
        let ratios: Vec<String> = (0..many.nrows()).map(|i| format!("{:.2}", many[(i, i)] / estimated[(i, i)])).collect();
        println!("{}", ratios.join(" "));
        let root = estimated.clone().cholesky().expect("positive").unpack();
        let inverse = root.solve_lower_triangular(&nalgebra::DMatrix::identity(31, 31)).expect("regular");
        let white = &inverse * many * inverse.transpose();
        println!(
            "   white {:.2}: {}",
            white.trace() / 31.0,
            (0..31).map(|i| format!("{:.2}", white[(i, i)])).collect::<Vec<_>>().join(" ")
        );
    }
}

/// Many drops of a truth against what that truth predicts for their mean.
fn mean_check() {
    let mut truth = plan(2, 7919 + 17);
    truth.model = truth.model.clone().with(by_id("cubic_stiffness").unwrap(), &[-3773027.503], 0);
    let model = Model::load("paper").expect("the paper's model");
    for drops in [20, 20, 20, 3000] {
        truth.drops = drops;
        truth.seed += 1;
        let waves = waves(&truth);
        let ground = Ground::of(&waves, &model).expect("ground");
        let residual = ground.problem.residual(&truth.model).unwrap();
        println!("{drops}: chi2 at truth {:.1}", residual.norm_squared());
        let raw = ground.problem.measured() - ground.problem.prediction(&truth.model).unwrap();
        println!("   raw {}", raw.iter().take(31).map(|v| format!("{v:.2}")).collect::<Vec<_>>().join(" "));
        println!("   white {}", residual.iter().take(31).map(|v| format!("{v:.1}")).collect::<Vec<_>>().join(" "));
        let fit = ground.problem.fit(Layout::of(truth.model.clone()), 25).unwrap();
        println!("   fitted {:?} chi2 {:.1}", fit.model().effects.iter().map(|l| l.values[0]).collect::<Vec<_>>(), fit.chi2());
    }
}
