//! How often a diagnosis is right: over effects, strengths, seeds and three levels of noise, on drops with a known truth.
//!
//! `cargo bench --bench recovery -- --level 2 --seeds 0..3 --what nulls,singles,pairs,hidden`: a line a case, then the table of
//! docs/diagnosis.md. Strengths are noncentralities: squared whitened distances between the truth's noise-free mean waves
//! and those of the base model refitted to them.

mod case;
mod ceiling;
mod covariance;
mod oracle;
mod pairs;
mod singles;
mod strength;
mod truth;

use flexframe::impact::diagnose::Verdict;
use flexframe::impact::synthetic::{Hidden, ScatterLaw};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use case::diagnosed;
use truth::{DETECTABLE, left_by_catalogue, plan};

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
    if let Some(name) = option("--law") {
        let at = ScatterLaw::NAMES.iter().position(|known| known == name).expect("a scatter law");
        truth::LAW.set(ScatterLaw::ALL[at]).expect("set once");
    }
    if what.contains("nulls") {
        nulls(level, from, to);
    }
    if what.contains("singles") {
        singles::singles(level, from, to, only);
    }
    if what.contains("oracle") {
        oracle::oracle(level, from, to);
    }
    if what.contains("ceiling") {
        let gain = option("--gain").map_or(1.0, |text| text.parse().expect("a number"));
        ceiling::ceiling(level, from, to, gain);
    }
    if what.contains("pairs") {
        pairs::pairs(level, from, to);
    }
    if what.contains("hidden") {
        hidden(level, from, to);
    }
}

fn nulls(level: usize, from: u64, to: u64) {
    let mut alarms = 0;
    let mut p_values = Vec::new();
    for seed in 10 * from..10 * to {
        let case = diagnosed(&plan(level, 1000 + seed));
        p_values.push(case.diagnosis.base_adequacy.p);
        alarms += usize::from(case.diagnosis.verdict != Verdict::NothingMissing);
        println!("null {seed}: {}", case.line());
    }
    println!("REPLICATES level {level}: {alarms} alarms of {}, p-values uniform with p = {:.3}", 10 * (to - from), uniform_p(p_values));
}

/// p-value of the largest distance between a distribution and the even one on 0 to 1 (Kolmogorov's limit, with M. A. Stephens' factor
/// for few values, J. R. Stat. Soc. B 32 (1970) 115).
fn uniform_p(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let count = values.len() as f64;
    let off = |(at, value): (usize, &f64)| f64::max(value - at as f64 / count, (at as f64 + 1.0) / count - value);
    let distance = values.iter().enumerate().map(off).fold(0.0, f64::max);
    let scaled = distance * (count.sqrt() + 0.12 + 0.11 / count.sqrt());
    let term = |k: i32| 2.0 * f64::from(1 - 2 * ((k + 1) % 2)) * libm::exp(-2.0 * f64::from(k * k) * scaled * scaled);
    (1..=100).map(term).sum::<f64>().clamp(0.0, 1.0)
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
