//! Each statistical step of a diagnosis on a case whose answer is known.

use flexframe::impact::diagnose::{DiagnosisOptions, HeldValue, PreparedDrops, Verdict, clipping, diagnose, held, trend_p};
use flexframe::impact::effects::{Model, Sensor, by_id};
use flexframe::impact::fit::{Expected, FittedDrop, MeanWave, TrialCovariance, Waves, Whitening, minimise};
use flexframe::impact::synthetic::{Hidden, Plan, ReferenceTrajectory, ScatterLaw, TrialVariation, records};
use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;

fn base() -> Model {
    Model::load("paper").expect("the paper's model")
}

fn plan(seed: u64) -> Plan {
    let variation =
        TrialVariation { share: 0.1, law: ScatterLaw::Proportional, correlation_s: 1.5e-3, stiffness: 0.0, damping: 0.0, tilt_deg: 0.0 };
    let heights_m = vec![0.5, 1.0, 1.5];
    Plan {
        model: base(),
        hidden: None,
        heights_m,
        drops: 20,
        scatter: variation,
        noise_g: 0.17,
        counts_per_g: 8.877,
        rate_hz: 1000.0,
        stalls: None,
        landings: None,
        seed,
    }
}

/// The wave of one synthetic drop without anything random, at steps of 0.05 ms from first touch, within the sensor's limit, g.
fn clean(plan: &Plan, height_m: f64) -> Vec<f64> {
    let trajectory = ReferenceTrajectory::of(&plan.model, plan.hidden, 1.0, 1.0);
    let limit_g = trajectory.limit_g();
    trajectory.wave_g(height_m, 5e-5, 802).into_iter().map(|reading| reading.clamp(-limit_g, limit_g)).collect()
}

fn waves(plan: &Plan) -> Waves {
    let drops: Vec<FittedDrop> = records(plan)
        .into_iter()
        .map(|record| FittedDrop { trial: record.trial, height_m: record.height_m, t_s: record.t_s, accel_g: record.accel_g })
        .collect();
    Waves::of(&drops).expect("usable")
}

#[test]
fn analytic_mean_over_phases_is_the_mean_of_trigger_aligned_records() {
    let fine = clean(&plan(1), 1.0);
    let expected = Expected::plain(1e-3, 31);
    let at = |t_s: f64| {
        let place = t_s.max(0.0) / 5e-5;
        let left = place.floor() as usize;
        if t_s <= 0.0 { 0.0 } else { fine[left] + (place - left as f64) * (fine[left + 1] - fine[left]) }
    };
    let mut mean = vec![0.0; 31];
    const PHASES: usize = 4000;
    for phase in 0..PHASES {
        let offset_s = (phase as f64 + 0.5) / PHASES as f64 * 1e-3;
        let first = (0..40).find(|i| at(offset_s + f64::from(*i) * 1e-3).abs() > 3.0).expect("an impact");
        for (i, sum) in mean.iter_mut().enumerate() {
            *sum += at(offset_s + (f64::from(first) + i as f64 - 1.0) * 1e-3) / PHASES as f64;
        }
    }
    for (ours, theirs) in expected.mean_over_phases(&fine).iter().zip(&mean) {
        assert!((ours - theirs).abs() < 0.05, "{ours} {theirs}");
    }
}

#[test]
fn planted_half_noise_moves_the_trigger_as_predicted() {
    // Coloured noise of half the reading lets one in fifty records be aligned a step too late.
    let variation = TrialVariation { share: 0.5, ..plan(1).scatter };
    let synthetic = Plan { scatter: variation, ..plan(3) };
    let many = waves(&Plan { drops: 12_000, heights_m: vec![1.0], ..synthetic.clone() });
    let prepared = PreparedDrops::of(&waves(&Plan { drops: 80, ..synthetic.clone() }), &base()).expect("a fit");
    let apart = |expected: Expected| {
        let predicted = expected.window(&expected.system(&base()), 1.0).expect("it holds the body");
        // In units of the standard error of a mean of 80 drops, at the trigger and the sample behind it.
        let mean = &many.groups[0].mean;
        [1, 2].map(|i| (mean[i] - predicted[i]) / (0.5 * mean[i] / 80f64.sqrt()))
    };
    let (without, with) = (apart(Expected::plain(1e-3, 31)), apart(prepared.problem.expected));
    assert!(without[0] > 0.6 && without[1] > 0.3, "{without:?}");
    // The mean of 12,000 is itself known to 0.1 of that.
    assert!(with.iter().all(|apart| apart.abs() < 0.25), "{with:?}");
}

#[test]
fn analytic_bounds_and_units_do_not_stop_a_minimum() {
    // A minimum at (2, 3e-8 · 1e8 = 3) whose second parameter is eight orders smaller, and one that lies behind a bound.
    let residual = |x: &[f64]| Some(DVector::from_vec(vec![x[0] - 2.0, 1e8 * x[1] - 3.0, 0.1 * (x[0] - 2.0) * (1e8 * x[1] - 3.0)]));
    let found = minimise(residual, &[0.0, 0.0], &[[-9.0, 9.0], [0.0, 1e-7]], &[1e-6, 1e-14], 50).expect("a value");
    assert!((found.at[0] - 2.0).abs() < 1e-3 && (1e8 * found.at[1] - 3.0).abs() < 1e-3 && !found.at_bound[1], "{:?}", found.at);
    let held = minimise(residual, &[0.0, 0.0], &[[-9.0, 1.0], [0.0, 1e-7]], &[1e-6, 1e-14], 50).expect("a value");
    assert!(held.at[0] == 1.0 && held.at_bound[0] && (1e8 * held.at[1] - 3.0).abs() < 1e-3, "{:?}", held.at);
}

#[test]
fn analytic_whitened_means_have_variance_one() {
    // One estimate of the trial covariance from 20 drops a height, judged by the means of many other sets of the same truth.
    let prepared = PreparedDrops::of(&waves(&plan(5)), &base()).expect("a fit");
    let sums: Vec<f64> = (0..24_u64)
        .into_par_iter()
        .map(|seed| {
            let others = waves(&plan(100 + seed));
            let mut problem = prepared.problem.clone();
            problem.means = others.groups.iter().map(MeanWave::of).collect();
            problem.residual(&base()).expect("it holds the body").norm_squared() / problem.len() as f64
        })
        .collect();
    let mean = sums.iter().sum::<f64>() / sums.len() as f64;
    // 93 numbers in 24 sets: 0.03 by chance; the estimate from 57 records brings about 0.1.
    assert!((0.8..1.3).contains(&mean), "{mean}");
}

#[test]
fn analytic_drawn_trial_covariance_is_that_asked_for() {
    let covariance = DMatrix::from_fn(4, 4, |i, j| if i == j { 2.0 } else { 0.5 });
    let mut rng = Pcg64::seed_from_u64(3);
    // Few records are drawn one by one, many by a triangle: both have the covariance that was asked for.
    for count in [4, 40] {
        let sets = 4000;
        let mut mean = DMatrix::<f64>::zeros(4, 4);
        for _ in 0..sets {
            let drawn = TrialCovariance::drawn(std::slice::from_ref(&covariance), &[count], &mut rng).expect("positive definite");
            let error = &drawn.standard_errors()[0];
            mean[(0, 0)] += error[0] * error[0] * count as f64 / sets as f64;
        }
        assert!((mean[(0, 0)] - 2.0).abs() < 0.1, "{count}: {}", mean[(0, 0)]);
    }
    let whitening = Whitening::of(std::slice::from_ref(&covariance), &[1]).expect("positive definite");
    let white = whitening.height(0) * &covariance * whitening.height(0).transpose();
    assert!((white - DMatrix::identity(4, 4)).norm() < 1e-12);
}

#[test]
fn analytic_chances_are_even_and_intervals_cover_where_nothing_is_missing() {
    let truth = base().stiffness_and_damping();
    let found: Vec<(f64, usize)> = (0..16_u64)
        .into_par_iter()
        .map(|seed| {
            let found = diagnose(&waves(&plan(300 + seed)), None, &base(), &DiagnosisOptions::new(1, seed)).expect("a diagnosis");
            let covered = found
                .estimates
                .iter()
                .zip(truth)
                .filter(|(one, truth)| found.verdict != Verdict::NothingMissing || (one.ci95[0]..=one.ci95[1]).contains(truth));
            (found.base_adequacy.p, covered.count())
        })
        .collect();
    let mut chances: Vec<f64> = found.iter().map(|one| one.0).collect();
    chances.sort_by(f64::total_cmp);
    let count = chances.len() as f64;
    let apart = chances.iter().enumerate().map(|(i, p)| (p - (i as f64 + 0.5) / count).abs()).fold(0.0, f64::max);
    // Kolmogorov's bound for 16 numbers at 1 %.
    assert!(apart < 0.39, "{chances:?}");
    let covered: usize = found.iter().map(|one| one.1).sum();
    assert!(covered >= 27, "{covered} of 32 intervals of 95 %");
}

#[test]
fn planted_wear_is_a_trend_and_scatter_is_none() {
    let changes = |plan: &Plan| {
        let waves = waves(plan);
        let prepared = PreparedDrops::of(&waves, &base()).expect("a fit");
        let fitted = prepared.problem.fit(flexframe::impact::fit::Layout::of(base()), 20).expect("a fit");
        let changes = prepared.problem.sensitivity(&fitted).expect("it holds the body");
        trend_p(&waves, &changes, 1).expect("a chance")
    };
    let wearing = Plan { hidden: Some(Hidden::Wear { loss: 0.4 }), ..plan(7) };
    assert!(changes(&wearing) < 0.002);
    assert!(changes(&plan(8)) > 0.01);
}

#[test]
fn planted_limits_show_and_scatter_does_not() {
    let mut limited = plan(9);
    limited.model = limited.model.with(by_id("sensor_saturation").expect("an effect"), &[60.0], 0);
    let found = clipping(&waves(&limited)).expect("readings pile up");
    assert!((found.level_g - 60.0).abs() < 0.5 && found.readings > 20, "{found:?}");
    for seed in 10..20 {
        assert_eq!(clipping(&waves(&plan(seed))), None);
    }
}

/// Drops from four heights of which the readings of some are cut, below the peaks of all drops or of the strongest alone.
fn limited(limit_g: f64, seed: u64) -> Plan {
    let mut limited = plan(seed);
    limited.heights_m.push(2.0);
    limited.scatter = TrialVariation { share: 0.06, stiffness: 0.1, ..limited.scatter };
    limited.model = limited.model.with(by_id("sensor_saturation").expect("an effect"), &[limit_g], 0);
    limited
}

/// Means of which only the strongest drops are cut say little of the limit: it was fitted up to 4 g above the level at which readings lie. Where most
/// are cut, on the wave's first steep rise, readings vary by the clock's phase.
#[test]
fn planted_limits_are_read_where_readings_pile_up() {
    for (limit_g, seed) in [(85.0, 1), (85.0, 2), (80.0, 3), (40.0, 5), (40.0, 6)] {
        let found = diagnose(&waves(&limited(limit_g, seed)), None, &base(), &DiagnosisOptions::new(1, 1)).expect("a diagnosis");
        assert_eq!((found.verdict, found.chosen.ids()), (Verdict::Named, vec!["sensor_saturation"]), "{limit_g} g, seed {seed}");
        let limit = found.estimates.iter().find(|one| one.key == "limit_g").expect("is stated");
        let [low, high] = limit.ci95;
        assert!((limit.value - limit_g).abs() < 0.12 && low < limit_g && limit_g < high, "{limit_g} g, seed {seed}: {limit:?}");
        assert!(found.experiments.iter().all(|one| one.between[0] != one.between[1]), "{:?}", found.experiments);
    }
}

/// Whether as an effect or as the end of the sensor's range.
#[test]
fn planted_a_model_that_has_the_limit_lacks_nothing() {
    let drops = waves(&limited(40.0, 5));
    let own = Model { sensor: Sensor { limit_g: 40.0, ..base().sensor }, ..base() };
    for model in [limited(40.0, 5).model, own] {
        let found = diagnose(&drops, None, &model, &DiagnosisOptions::new(1, 1)).expect("a diagnosis");
        assert_eq!(found.verdict, Verdict::NothingMissing, "{:?}: {:?}", found.reasons, found.adequacy.p);
    }
}

#[test]
fn planted_pair_whose_first_choice_is_wrong_is_found_all_the_same() {
    let mut synthetic = plan(41);
    for (id, values) in [("maxwell_branch", &[6e3, 3.0][..]), ("sensor_low_pass", &[110.0])] {
        synthetic.model = synthetic.model.with(by_id(id).expect("an effect"), values, 0);
    }
    let found = diagnose(&waves(&synthetic), None, &base(), &DiagnosisOptions::new(3, 1)).expect("a diagnosis");
    let first = found.ranking.iter().find(|one| !one.id.contains('+')).expect("singles were ranked");
    assert_eq!(first.id, "bilinear_stiffness", "the best single effect is neither of the two");
    assert_eq!(found.chosen.ids(), ["maxwell_branch", "sensor_low_pass"]);
}

/// Drops on a sensor of 500 Hz, in which something is hidden.
fn hidden(effects: &[(&str, &[f64], usize)]) -> Plan {
    let base = Model::load("paper-corrected").expect("the corrected model");
    let model = effects.iter().fold(base, |model, (id, values, word)| model.with(by_id(id).expect("an effect"), values, *word));
    Plan { model, heights_m: vec![0.5, 1.0, 1.5, 2.0], ..plan(1) }
}

fn diagnosed(effects: &[(&str, &[f64], usize)]) -> flexframe::impact::diagnose::Diagnosis {
    let model = Model::load("paper-corrected").expect("the corrected model");
    diagnose(&waves(&hidden(effects)), None, &model, &DiagnosisOptions::new(3, 1)).expect("a diagnosis")
}

/// Zero is the end of a damping by nature.
#[test]
fn planted_a_stop_without_damping_is_named() {
    let found = diagnosed(&[("bottoming", &[8.0, 1e6, 0.0], 0)]);
    assert_eq!((found.verdict, found.chosen.ids()), (Verdict::Named, vec!["bottoming"]), "{:?}", found.reasons);
    let damping = found.estimates.iter().find(|one| one.key == "lambda").expect("is fitted");
    assert!(damping.value < 0.01, "{damping:?}");
}

/// What was freed in a set of one effect is a parameter of the set of two, with its price and its interval.
#[test]
fn planted_a_damping_beside_its_default_is_a_parameter_of_larger_sets() {
    let found = diagnosed(&[("bottoming", &[8.0, 1e6, 0.95], 0), ("drop_height_error", &[-0.15], 0)]);
    assert_eq!((found.verdict, found.chosen.ids()), (Verdict::Named, vec!["bottoming", "drop_height_error"]), "{:?}", found.reasons);
    let damping = found.estimates.iter().find(|one| one.key == "lambda").expect("is fitted");
    assert!((damping.value - 0.95).abs() < 0.1 && damping.ci95[0] < 0.95 && 0.95 < damping.ci95[1], "{damping:?}");
    assert_eq!(held(&found.chosen), []);
}

/// A payload that hardly rings, with the sensor on it.
#[test]
fn planted_a_payload_with_much_damping_is_named() {
    let found = diagnosed(&[("payload_mode", &[0.3, 90.0, 0.4], 1)]);
    assert_eq!((found.verdict, found.chosen.ids()), (Verdict::Named, vec!["payload_mode"]), "{:?}", found.reasons);
    let damping = found.estimates.iter().find(|one| one.key == "zeta").expect("is fitted");
    assert!(damping.ci95[0] < 0.4 && 0.4 < damping.ci95[1], "{damping:?}");
    let words: Vec<HeldValue> = held(&found.chosen).iter().map(|one| one.value).collect();
    assert_eq!(words, [HeldValue::Word("payload")]);
}

/// A damping that the drops do not tell stays at its default, and share and frequency are known less well for it.
#[test]
fn planted_intervals_allow_for_a_damping_that_was_not_fitted() {
    let found = diagnosed(&[("payload_mode", &[0.3, 90.0, 0.06], 1)]);
    assert_eq!(found.chosen.ids(), ["payload_mode"]);
    let told: Vec<HeldValue> = held(&found.chosen).iter().map(|one| one.value).collect();
    assert_eq!(told, [HeldValue::Default(0.05), HeldValue::Word("payload")]);
    let share = found.estimates.iter().find(|one| one.key == "mu").expect("is fitted");
    // 0.014 wide for the default alone.
    assert!(share.ci95[1] - share.ci95[0] > 0.1 && share.ci95[0] < 0.3 && 0.3 < share.ci95[1], "{share:?}");
}
