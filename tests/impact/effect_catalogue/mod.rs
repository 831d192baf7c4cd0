//! What every effect must have, walked over the catalogue, and an effect from outside of it.

mod toy;

use flexframe::impact::effects::{Availability, CATALOGUE, Generator, Model, Spec, Stage, candidates};
use flexframe::impact::synthetic::ReferenceTrajectory;
use flexframe::study::recovery::values;
use rand::SeedableRng;
use rand_pcg::Pcg64;

use crate::bodies;
use crate::effect_cases::CASES;

fn on_top() -> impl Iterator<Item = &'static Spec> {
    CATALOGUE.into_iter().filter(|spec| !spec.is_base())
}

#[test]
fn analytic_every_effect_has_starts_within_its_bounds() {
    let model = Model { frame_mode: Some([0.2, 150.0]), ..bodies::base() };
    for spec in on_top() {
        let starts = (spec.starts)(&model.known());
        assert!(!starts.is_empty(), "{} has no start", spec.id);
        for start in starts {
            assert_eq!(start.len(), spec.parameters.len(), "{}", spec.id);
            for (value, parameter) in start.iter().zip(spec.parameters) {
                assert!((parameter.min..=parameter.max).contains(value), "{} {} = {value}", spec.id, parameter.key);
            }
        }
    }
}

#[test]
fn analytic_every_effect_has_a_generator_of_its_stage() {
    for spec in CATALOGUE {
        let fits = match spec.generator {
            Generator::Force(_) => spec.stage == Stage::Force && spec.states.is_empty(),
            Generator::Branch(_) => spec.stage == Stage::Force && spec.states.len() == 1,
            Generator::Stop(_) => spec.stage == Stage::Stop,
            Generator::Conditions(_) => spec.stage == Stage::Arrangement || spec.is_base(),
        };
        assert!(fits, "{}", spec.id);
    }
}

#[test]
fn analytic_every_effect_changes_the_synthetic_drop() {
    let base = Model { frame_curve: Some(toy::curve()), ..bodies::base() };
    let wave = |model: &Model| {
        let trajectory = ReferenceTrajectory::of(model, None, 1.0, 1.0);
        let limit_g = trajectory.limit_g();
        trajectory.wave_g(1.5, 5e-5, 500).into_iter().map(|reading| reading.min(limit_g)).collect::<Vec<f64>>()
    };
    let plain = wave(&base);
    for case in &CASES {
        let spec = on_top().find(|spec| spec.id == case.id).expect("is in the catalogue");
        let (values, word) = case.compared[0];
        let changed = wave(&base.clone().with(spec, values, word));
        let most = plain.iter().zip(&changed).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(most > 0.1, "{}: {most} g", case.id);
    }
}

#[test]
fn analytic_every_effect_has_a_recovery_case_and_a_strength() {
    let mut rng = Pcg64::seed_from_u64(1);
    for spec in on_top() {
        let case = CASES.iter().find(|case| case.id == spec.id).unwrap_or_else(|| panic!("{} has no case in tests/effect_cases", spec.id));
        assert_eq!(case.planned.is_none(), spec.availability == Availability::WithFrameCurve, "{}", spec.id);
        assert!(!case.compared.is_empty(), "{}", spec.id);
    }
    for spec in candidates(&CATALOGUE, &bodies::base()) {
        assert!(values(spec.id, &bodies::base(), 0.5, &mut rng).is_some(), "{} has no strength in src/study/recovery/strength.rs", spec.id);
    }
}

#[test]
fn analytic_every_effect_has_a_paragraph_in_the_docs() {
    let page = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/physics.md")).expect("the page");
    for spec in CATALOGUE {
        let id = format!("`{}`", spec.id);
        assert!(page.lines().any(|line| line.starts_with('|') && line.contains(&id)), "{id} is not in the table of docs/physics.md");
        assert!(page.lines().any(|line| !line.starts_with('|') && line.contains(&id)), "{id} has no paragraph in docs/physics.md");
    }
}
