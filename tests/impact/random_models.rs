//! Random models within all bounds: never a panic, a hang or a number that is none; energies balance.

use crate::bodies;
use flexframe::impact::effects::{CATALOGUE, Model, candidates};
use flexframe::impact::sim::{SolverOptions, Stop, System, simulate, wave};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// How many.
const MODELS: usize = 400;

fn models() -> Vec<(Model, f64)> {
    let mut runner = TestRunner::new_with_rng(Config::default(), TestRng::from_seed(RngAlgorithm::ChaCha, &[4; 32]));
    let mut drawn = |low: f64, high: f64| (low..=high).new_tree(&mut runner).expect("no filter").current();
    let effects = candidates(&CATALOGUE, &bodies::base());
    let mut models = Vec::new();
    for number in 0..MODELS {
        let mut model = bodies::base();
        model.body.gap_m = drawn(0.0, 0.03);
        model.sensor.order = 1 + number % 3;
        for spec in &effects {
            // Every effect at its bounds now and then, and about one in four at all.
            if drawn(0.0, 1.0) < 0.25 || number % effects.len() == usize::from(spec.id.len() as u8 % 16) {
                let edge = drawn(0.0, 1.0);
                let values: Vec<f64> = spec
                    .parameters
                    .iter()
                    .map(|p| {
                        if edge < 0.1 {
                            p.min
                        } else if edge > 0.9 {
                            p.max
                        } else {
                            drawn(p.min, p.max)
                        }
                    })
                    .collect();
                model = model.with(spec, &values, number % 2);
            }
        }
        models.push((model, drawn(0.05, 4.0)));
    }
    models
}

#[test]
fn analytic_random_models_stay_finite_and_balance() {
    let (mut ended, mut balanced) = (0, 0);
    for (model, height_m) in models() {
        let system = System::new(&model);
        let mut out = vec![f64::NAN; 601];
        wave(&system, height_m, 1e-4, &SolverOptions::FIT, &mut out);
        assert!(out.iter().all(|reading_g| reading_g.is_finite()), "{}", model.to_toml());
        let trace = simulate(&system, height_m, &SolverOptions { tolerance: 1e-9, ..SolverOptions::REPORT });
        ended += usize::from(trace.stop == Stop::End);
        for balance in trace.compression.iter().chain(&trace.release) {
            let share = balance.residual().abs() * balance.input_j.abs();
            let size: f64 = balance.input_j.abs() + balance.terms.iter().map(|term| term.work_j.abs()).sum::<f64>();
            assert!(share < 1e-6 * size, "{} of {size}: {balance:?}\n{}", share, model.to_toml());
            balanced += 1;
        }
    }
    assert!(ended > MODELS * 3 / 4, "only {ended} of {MODELS} ran to their end");
    assert!(balanced > MODELS, "only {balanced} balances");
}
