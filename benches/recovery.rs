//! How often a diagnosis is right: over effects, strengths, seeds and three levels of noise, on drops with a known truth.
//!
//! `cargo bench --bench recovery -- --level 2 --seeds 0..3 --what nulls,singles,pairs,hidden`: a line a case, then the table of
//! docs/diagnosis.md. Strengths are noncentralities: squared whitened distances between the truth's noise-free mean waves
//! and those of the base model refitted to them.

use std::collections::BTreeMap;
use std::time::Instant;

use flexframe::diagnose::{Candidate, Diagnosis, Ground, Nulls, Search, Setting, Settings, Verdict, diagnose};
use flexframe::effects::{CATALOGUE, Model, by_id};
use flexframe::fit::{Drop, Expected, Layout, Problem, Scatter, Waves, Whitening};
use flexframe::plant::{Hidden, Plan, Scatter as Spread, clean, records};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

const HEIGHTS_M: [f64; 3] = [0.5, 1.0, 1.5];
const HELD_OUT_M: f64 = 2.0;
const STRENGTHS: [f64; 5] = [5.0, 19.0, 71.0, 266.0, 1000.0];
const DETECTABLE: f64 = 30.0;

fn base() -> Model {
    Model::load("paper").expect("the paper's model")
}

/// Drops of the base model at a level of noise, its k and c a little different for every seed.
fn plan(level: usize, seed: u64) -> Plan {
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

fn waves(plan: &Plan) -> Waves {
    let drop = |record: flexframe::plant::Record| Drop {
        trial: record.trial,
        height_m: record.height_m,
        t_s: record.t_s,
        accel_g: record.accel_g,
    };
    Waves::of(&records(plan).into_iter().map(drop).collect::<Vec<_>>()).expect("planted drops are usable")
}

/// A truth's noise-free mean waves with the generator's own covariance of the mean, read off many drops.
fn noise_free(plan: &Plan) -> Option<(Problem, Scatter)> {
    let drops = if plan.model.value("sensor_saturation", "limit_g").is_some() { 3000 } else { 300 };
    let many = waves(&Plan { drops, ..plan.clone() });
    let scatter = Scatter::of(&many);
    let whitening = Whitening::of(&scatter.plain_covariances(), &vec![plan.drops; plan.heights_m.len()])?;
    let mut problem = Problem::of(&many, whitening, 0.0);
    let expected: Expected = problem.expected;
    if plan.scatter.stiffness == 0.0 && plan.model.value("sensor_saturation", "limit_g").is_none() {
        for (height_m, mean) in &mut problem.means {
            *mean = expected.mean_over_phases(&clean(plan, *height_m));
        }
    }
    Some((problem, scatter))
}

fn noncentrality(plan: &Plan) -> Option<f64> {
    let (problem, _) = noise_free(plan)?;
    let [k, c] = plan.model.stiffness_and_damping();
    Some(problem.fit(Layout::of(Model::base(plan.model.body.clone(), plan.model.sensor, k, c)), 25)?.chi2())
}

/// What the best catalogue fit, pairs included, leaves of a truth.
fn left_by_catalogue(plan: &Plan) -> Option<f64> {
    let (problem, _) = noise_free(plan)?;
    let few = waves(plan);
    let ground = Ground::of(&few, &base())?;
    let nulls = Nulls::of(&ground.scatter, &ground.family, 1)?;
    let setting = Setting { problem: &problem, nulls: &nulls, limit_seen: false, most: 2, stage: &|_| () };
    let search = Search::run(&setting, &base())?;
    search.levels.iter().flat_map(|level| &level.candidates).map(|candidate: &Candidate| candidate.fitted.chi2()).min_by(f64::total_cmp)
}

/// The single effect with the best score for somebody who is told the generator's own covariance: what is lost by having to
/// estimate it. No bound: the score is ours, not the best there could be.
fn told_the_scatter(plan: &Plan) -> Option<&'static str> {
    let few = waves(plan);
    let whitening = noise_free(plan)?.0.whitening;
    let ground = Ground::of(&few, &base())?;
    let mut problem = Problem::of(&few, whitening, ground.problem.expected.spread);
    problem.expected = ground.problem.expected;
    let nulls = Nulls::of(&ground.scatter, &ground.family, 1)?;
    let setting = Setting { problem: &problem, nulls: &nulls, limit_seen: ground.flat_top.is_some(), most: 1, stage: &|_| () };
    let search = Search::run(&setting, &base())?;
    let singles = search.levels.iter().flat_map(|level| &level.candidates).filter(|candidate| candidate.ids().len() == 1);
    singles.min_by(|a, b| a.score.total_cmp(&b.score)).and_then(|best| best.ids().first().copied())
}

fn oracle(level: usize, from: u64, to: u64) {
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

struct Case {
    diagnosis: Diagnosis,
    seconds: f64,
}

fn diagnosed(plan: &Plan) -> Case {
    let all = waves(plan);
    let from = Instant::now();
    let diagnosis = diagnose(&all, None, &base(), &Settings { most_effects: 3, seed: plan.seed }).expect("a diagnosis");
    Case { diagnosis, seconds: from.elapsed().as_secs_f64() }
}

impl Case {
    fn first(&self) -> Option<&'static str> {
        (self.diagnosis.verdict != Verdict::NothingMissing).then(|| self.diagnosis.contributions.first().map(|one| one.0)).flatten()
    }

    fn set(&self) -> Vec<&'static str> {
        self.diagnosis.chosen.ids()
    }

    /// Top of the ranking of single effects, whatever the verdict.
    fn top(&self) -> &str {
        self.diagnosis.ranking.iter().find(|one| !one.id.contains('+')).map_or("", |one| &one.id)
    }

    /// Parameters whose interval holds the truth, and how many there are; none when the set is not the true one.
    fn covered(&self, truth: &Model) -> [usize; 2] {
        if self.diagnosis.verdict == Verdict::NothingMissing || truth.effects.len() != self.diagnosis.chosen.model().effects.len() {
            return [0, 0];
        }
        let mut count = [0, 0];
        for one in &self.diagnosis.estimates {
            let Some(value) = truth.value(one.effect, one.key) else { return [0, 0] };
            count[0] += usize::from((one.ci95[0]..=one.ci95[1]).contains(&value));
            count[1] += 1;
        }
        count
    }

    /// Gap to the noise-free wave at a height that was not dropped from, after over before.
    fn ratio(&self, plan: &Plan) -> Option<f64> {
        let expected = Expected { step_s: 1e-3, samples: 31, spread: 0.0, varied: [0.0; 2] };
        let truth = expected.mean_over_phases(&clean(plan, HELD_OUT_M));
        let apart = |model: &Model| {
            let predicted = expected.window(&expected.system(model), HELD_OUT_M)?;
            Some(truth.iter().zip(&predicted).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt())
        };
        Some(apart(self.diagnosis.chosen.model())? / apart(self.diagnosis.base.model())?)
    }

    fn line(&self) -> String {
        let weight = self.diagnosis.alternatives.first().map_or(0.0, |best| best.weight);
        format!(
            "{} set {:?} weight {weight:.2} p {:.3} then {:.3} trend {:.2} {:.2} s",
            self.diagnosis.verdict.id(),
            self.set(),
            self.diagnosis.base_adequacy.p,
            self.diagnosis.adequacy.p,
            self.diagnosis.trend_p,
            self.seconds
        )
    }
}

#[derive(Default)]
struct Sums {
    table: BTreeMap<String, Vec<[usize; 2]>>,
    curve: BTreeMap<usize, [usize; 2]>,
    confused: BTreeMap<(String, String), usize>,
    ratios: Vec<f64>,
    covered: [usize; 2],
    seconds: Vec<f64>,
    stronger: [usize; 2],
    /// First of the ranking of single effects, whatever the verdict; a strength each, and how many there are.
    ranked: [[usize; 2]; STRENGTHS.len()],
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let option = |name: &str| arguments.iter().position(|argument| argument == name).and_then(|at| arguments.get(at + 1));
    let level: usize = option("--level").map_or(2, |text| text.parse().expect("a level"));
    let (from, to) = option("--seeds").map_or((0, 1), |text| {
        let (from, to) = text.split_once("..").expect("a..b");
        (from.parse::<u64>().expect("a number"), to.parse::<u64>().expect("a number"))
    });
    let what = option("--what").map_or("nulls", String::as_str);
    let only = option("--only").map(String::as_str);
    if what.contains("nulls") {
        nulls(level, from, to);
    }
    if what.contains("singles") {
        singles(level, from, to, only);
    }
    if what.contains("oracle") {
        oracle(level, from, to);
    }
    if what.contains("pairs") {
        pairs(level, from, to);
    }
    if what.contains("hidden") {
        hidden(level, from, to);
    }
}

fn nulls(level: usize, from: u64, to: u64) {
    let mut alarms = 0;
    for seed in 10 * from..10 * to {
        let case = diagnosed(&plan(level, 1000 + seed));
        alarms += usize::from(case.diagnosis.verdict != Verdict::NothingMissing);
        println!("null {seed}: {}", case.line());
    }
    println!("NULLS level {level}: {alarms} alarms of {}", 10 * (to - from));
}

/// The plan of an effect at a strength of the middle level, for a level; `None` when the bounds do not allow it.
fn at_strength(id: &str, seed: u64, strength: f64, level: usize) -> Option<Plan> {
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

fn singles(level: usize, from: u64, to: u64, only: Option<&str>) {
    let mut sums = Sums::default();
    for spec in CATALOGUE.iter().filter(|spec| only.is_none_or(|only| only == spec.id)) {
        for seed in from..to {
            for (at, strength) in STRENGTHS.iter().enumerate() {
                let Some(plan) = at_strength(spec.id, seed, *strength, level) else { continue };
                let found = noncentrality(&plan).unwrap_or(f64::NAN);
                let case = diagnosed(&plan);
                let good = case.first() == Some(spec.id);
                let ratio = case.ratio(&plan);
                let values = plan.model.effects.last().map(|listed| listed.values.clone()).unwrap_or_default();
                println!(
                    "{} {} {values:.3?} nc {found:.0} top {} ratio {:.2}: {}",
                    if good { "ok " } else { "BAD" },
                    spec.id,
                    case.top(),
                    ratio.unwrap_or(f64::NAN),
                    case.line()
                );
                let row = sums.table.entry(spec.id.into()).or_insert_with(|| vec![[0; 2]; STRENGTHS.len()]);
                row[at][0] += usize::from(good);
                row[at][1] += 1;
                let bin = sums.curve.entry((libm::log2(found.max(1.0)) as usize).min(10)).or_default();
                bin[0] += usize::from(good);
                bin[1] += 1;
                sums.ranked[at][0] += usize::from(case.top() == spec.id);
                sums.ranked[at][1] += 1;
                if at > 0 {
                    sums.stronger[0] += usize::from(good);
                    sums.stronger[1] += 1;
                }
                if found > DETECTABLE {
                    sums.ratios.extend(ratio);
                    *sums.confused.entry((spec.id.into(), case.first().unwrap_or("nothing").into())).or_default() += 1;
                }
                let covered = case.covered(&plan.model);
                sums.covered[0] += covered[0];
                sums.covered[1] += covered[1];
                sums.seconds.push(case.seconds);
            }
        }
    }
    summary(level, &mut sums);
}

fn summary(level: usize, sums: &mut Sums) {
    println!("\n| effect | {} |", STRENGTHS.map(|strength| strength.to_string()).join(" | "));
    for (id, row) in &sums.table {
        println!("| {id} | {} |", row.iter().map(|cell| format!("{}/{}", cell[0], cell[1])).collect::<Vec<_>>().join(" | "));
    }
    for (bin, [good, all]) in &sums.curve {
        println!("CURVE level {level}: noncentrality {}..{}: {good}/{all}", 1 << bin, 1 << (bin + 1));
    }
    for ((truth, named), count) in sums.confused.iter().filter(|((truth, named), _)| truth != named) {
        println!("CONFUSED level {level}: {truth} named {named}: {count}");
    }
    let (good, all) = sums.table.values().flatten().fold((0, 0), |(good, all), cell| (good + cell[0], all + cell[1]));
    let wrong: usize = sums.confused.iter().filter(|((truth, named), _)| truth != named).map(|(_, count)| count).sum();
    let detectable: usize = sums.confused.values().sum();
    sums.ratios.sort_by(f64::total_cmp);
    sums.seconds.sort_by(f64::total_cmp);
    let middle = |values: &[f64], part: f64| values.get((values.len() as f64 * part) as usize).copied().unwrap_or(f64::NAN);
    println!(
        "SINGLES level {level}: detectable {}/{detectable}, all {good}/{all}, four stronger {}/{}",
        detectable - wrong,
        sums.stronger[0],
        sums.stronger[1]
    );
    let ranked = sums.ranked.iter().fold([0, 0], |sum, one| [sum[0] + one[0], sum[1] + one[1]]);
    println!("RANKED FIRST level {level}: {:?}, all {}/{}", sums.ranked, ranked[0], ranked[1]);
    println!("COVERAGE level {level}: {}/{}", sums.covered[0], sums.covered[1]);
    println!("HELD OUT level {level}: median ratio {:.3}, 90 % below {:.3}", middle(&sums.ratios, 0.5), middle(&sums.ratios, 0.9));
    println!("TIME level {level}: median {:.2} s, 95 % below {:.2} s", middle(&sums.seconds, 0.5), middle(&sums.seconds, 0.95));
}

fn pairs(level: usize, from: u64, to: u64) {
    let (mut exact, mut count) = (0, 0);
    for seed in 10 * from..10 * to {
        let mut rng = Pcg64::seed_from_u64(seed + 4242);
        let (a, b) = (rng.random_range(0..CATALOGUE.len()), rng.random_range(0..CATALOGUE.len()));
        if a == b {
            continue;
        }
        let strength = 400.0;
        let (Some(first), Some(second)) =
            (at_strength(CATALOGUE[a].id, seed, strength, level), at_strength(CATALOGUE[b].id, seed, strength, level))
        else {
            continue;
        };
        let Some(added) = second.model.effects.iter().find(|listed| listed.spec.id == CATALOGUE[b].id) else { continue };
        let mut plan = first.clone();
        plan.model = plan.model.with(added.spec, &added.values, added.word);
        plan.scatter.tilt_deg = 0.0;
        let case = diagnosed(&plan);
        let mut truth = vec![CATALOGUE[a].id, CATALOGUE[b].id];
        truth.sort_by_key(|id| CATALOGUE.iter().position(|spec| spec.id == *id));
        let good = case.set() == truth;
        exact += usize::from(good);
        count += 1;
        println!("{} pair {truth:?}: {}", if good { "ok " } else { "BAD" }, case.line());
    }
    println!("PAIRS level {level}: {exact}/{count} exact");
}

fn hidden(level: usize, from: u64, to: u64) {
    let (mut honest, mut count) = (0, 0);
    for seed in 10 * from..10 * to {
        let mut rng = Pcg64::seed_from_u64(seed + 999);
        let mut plan = plan(level, 5000 + seed);
        let strength = libm::exp(rng.random_range(0.0..1.5));
        let kind = match seed % 4 {
            0 => {
                Hidden::TwoStage { x1_m: rng.random_range(0.004..0.010), stiffness_n_m: 6e3 * strength, loss: rng.random_range(0.6..0.95) }
            }
            1 => Hidden::TwoModes {
                shares: [0.08 * strength, 0.08 * strength],
                f_hz: [rng.random_range(60.0..110.0), rng.random_range(150.0..300.0)],
                zeta: 0.04,
            },
            2 => Hidden::Wear { loss: 0.25 * strength },
            _ => Hidden::Snap { x1_m: rng.random_range(0.003..0.009), loss: (0.15 * strength).min(0.8) },
        };
        plan.hidden = Some(kind);
        let wears = matches!(kind, Hidden::Wear { .. });
        let left = if wears { f64::INFINITY } else { left_by_catalogue(&plan).unwrap_or(0.0) };
        if left < DETECTABLE {
            println!("skip {kind:?}: the catalogue leaves {left:.0}");
            continue;
        }
        let case = diagnosed(&plan);
        let good = matches!(case.diagnosis.verdict, Verdict::NoneSuffices | Verdict::Ambiguous);
        honest += usize::from(good);
        count += 1;
        println!("{} {kind:.3?} left {left:.0}: {}", if good { "ok " } else { "BAD" }, case.line());
    }
    println!("HIDDEN level {level}: {honest}/{count} none_suffices or ambiguous");
}
