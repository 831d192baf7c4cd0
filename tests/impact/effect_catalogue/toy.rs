//! An effect that only this file knows: simulation, model files, synthetic drops, fit and diagnosis take it from its record.

use std::sync::Arc;

use flexframe::impact::diagnose::{DiagnosisOptions, Verdict, diagnose};
use flexframe::impact::effects::{
    Availability, CATALOGUE, Effect, FrameCurve, Generator, Model, MotionState, Parameter, Scale, Spec, Stage, by_id,
};
use flexframe::impact::fit::{FittedDrop, Waves};
use flexframe::impact::sim::{SolverOptions, System, simulate, wave};
use flexframe::impact::synthetic::{Plan, ReferenceTrajectory, ScatterLaw, TrialVariation, records};
use flexframe::params::ImpactFile;

/// A force that follows the compression late: q' = a x - q / 4 ms.
const TOY: Spec = Spec {
    id: "late_spring",
    title: "late spring",
    stage: Stage::Force,
    availability: Availability::Any,
    parameters: &[Parameter {
        key: "a",
        unit: "N/(m s)",
        si: 1.0,
        min: -5e6,
        max: 5e6,
        off: Some(0.0),
        default: None,
        scale: Scale::Linear,
        doc: "rate of the force over the compression",
    }],
    choice: None,
    states: &["force, N"],
    starts: |_| vec![vec![-4e5], vec![4e5], vec![2e6]],
    build: |inputs| Box::new(LateSpring { rate_n_m_s: inputs.values[0] }),
    generator: Generator::Branch(|at, values| values[0] * at.x - at.q / 4e-3),
};

#[derive(Debug)]
struct LateSpring {
    rate_n_m_s: f64,
}

impl Effect for LateSpring {
    fn force_n(&self, at: &MotionState) -> f64 {
        at.own[0]
    }

    fn rates(&self, at: &MotionState, rates: &mut [f64]) {
        rates[0] = self.rate_n_m_s * at.x_m - at.own[0] / 4e-3;
    }
}

/// The catalogue with the toy in it.
const WITH_TOY: [&Spec; 20] = {
    let mut all = [&TOY; 20];
    let mut at = 0;
    while at < CATALOGUE.len() {
        all[at] = CATALOGUE[at];
        at += 1;
    }
    all
};

const TRUTH: f64 = 1.2e6;

pub fn curve() -> Arc<FrameCurve> {
    Arc::new(FrameCurve::new(&[0.0, 2.0, 5.0, 9.0, 16.0], &[0.0, 1.8, 3.9, 5.9, 8.1]).expect("is a curve"))
}

fn truth() -> Model {
    Model::load("paper").expect("the paper's model").with(&TOY, &[TRUTH], 0)
}

#[test]
fn analytic_a_toy_effect_is_simulated_and_generated() {
    let mut simulated = vec![0.0; 700];
    wave(&System::new(&truth()), 1.0, 5e-5, &SolverOptions::REPORT, &mut simulated);
    let generated = ReferenceTrajectory::of(&truth(), None, 1.0, 1.0).wave_g(1.0, 5e-5, 700);
    assert!(simulated.iter().zip(&generated).all(|(a, b)| (a - b).abs() < 0.01));
    let mut plain = vec![0.0; 700];
    wave(&System::new(&Model::load("paper").expect("the paper's model")), 1.0, 5e-5, &SolverOptions::REPORT, &mut plain);
    assert!(simulated.iter().zip(&plain).any(|(a, b)| (a - b).abs() > 1.0));
}

#[test]
fn analytic_a_toy_effect_runs_beside_all_others_with_its_energy() {
    let all = CATALOGUE.into_iter().filter(|spec| !spec.is_base() && !spec.takes_frame_curve());
    let model = all.fold(truth(), |model, spec| {
        let values: Vec<f64> =
            spec.parameters.iter().map(|p| p.off.map_or(0.5 * (p.min + p.max), |off| off + 0.05 * (p.max - off))).collect();
        model.with(spec, &values, 0)
    });
    let balance = simulate(&System::new(&model), 1.0, &SolverOptions::REPORT).compression.expect("turns");
    assert!(balance.terms.iter().any(|term| term.effect == TOY.id), "{:?}", balance.terms);
    assert!(balance.residual().abs() < 1e-8, "{}", balance.residual());
}

#[test]
fn analytic_a_toy_effect_is_read_from_a_model_file() {
    let text = truth().to_toml();
    let file = ImpactFile::parse("toy", &text).expect("TOML");
    let model = Model::resolve_with(&WITH_TOY, &file).expect("a model");
    assert_eq!(model.value("late_spring", "a"), Some(TRUTH));
    assert!(Model::resolve(&file).is_err() && by_id("late_spring").is_none());
}

#[test]
fn planted_a_toy_effect_is_fitted_and_named() {
    let variation =
        TrialVariation { share: 0.1, law: ScatterLaw::Proportional, correlation_s: 1.5e-3, stiffness: 0.0, damping: 0.0, tilt_deg: 0.0 };
    let heights_m = vec![0.5, 1.0, 1.5];
    let plan = Plan {
        model: truth(),
        hidden: None,
        heights_m,
        drops: 20,
        scatter: variation,
        noise_g: 0.17,
        counts_per_g: 8.877,
        rate_hz: 1000.0,
        stalls: None,
        landings: None,
        seed: 7,
    };
    let drop = |record: flexframe::impact::synthetic::SyntheticRecord| FittedDrop {
        trial: record.trial,
        height_m: record.height_m,
        t_s: record.t_s,
        accel_g: record.accel_g,
    };
    let waves = Waves::of(&records(&plan).into_iter().map(drop).collect::<Vec<_>>()).expect("usable");
    let base = Model::load("paper").expect("the paper's model");
    let options = DiagnosisOptions { catalogue: &WITH_TOY, ..DiagnosisOptions::new(1, 1) };
    let found = diagnose(&waves, None, &base, &options).expect("a diagnosis");
    assert_eq!((found.verdict, found.chosen.ids()), (Verdict::Named, vec![TOY.id]), "{:?}", found.reasons);
    let estimate = found.estimates.iter().find(|one| one.key == "a").expect("is estimated");
    assert!((estimate.ci95[0]..=estimate.ci95[1]).contains(&TRUTH), "{:?}", estimate.ci95);
}
