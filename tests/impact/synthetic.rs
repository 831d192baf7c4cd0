//! Synthetic drops against the simulation, which shares no equation with them.

use std::sync::Arc;

use crate::effect_cases::CASES;
use flexframe::impact::effects::{FrameCurve, Model, by_id};
use flexframe::impact::sim::{SolverOptions, System, wave};
use flexframe::impact::synthetic::ReferenceTrajectory;

/// The base with a frame's curve, which acts where an effect takes it.
fn base() -> Model {
    let curve = FrameCurve::new(&[0.0, 2.0, 5.0, 9.0, 16.0], &[0.0, 1.8, 3.9, 5.9, 8.1]).expect("is a curve");
    Model { frame_curve: Some(Arc::new(curve)), ..Model::load("paper").expect("the paper's model") }
}

fn compare(id: &str, model: &Model) {
    for height_m in [0.5, 1.5] {
        let mut simulated = vec![0.0; 700];
        wave(&System::new(model), height_m, 5e-5, &SolverOptions::REPORT, &mut simulated);
        let trajectory = ReferenceTrajectory::of(model, None, 1.0, 1.0);
        let limit_g = trajectory.limit_g();
        let generated = trajectory.wave_g(height_m, 5e-5, 700);
        let (at, residual) = simulated
            .iter()
            .zip(&generated)
            .map(|(a, b)| (a - b.clamp(-limit_g, limit_g)).abs())
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .expect("a wave");
        // Staggered feet are met within one step of 2 microseconds, which lets a force of tens of g come that much late.
        let allowed = if id == "foot_stagger" { 0.2 } else { 0.01 };
        assert!(residual < allowed, "{id} at {height_m} m: {residual} g at {at}");
    }
}

#[test]
fn analytic_two_codes_two_methods_one_wave() {
    for case in CASES {
        for (values, word) in case.compared {
            compare(case.id, &base().with(by_id(case.id).expect("an effect"), values, *word));
        }
    }
}

#[test]
fn analytic_feet_on_a_frames_curve_agree_too() {
    let curved = base().with(by_id("frame_force_curve").expect("an effect"), &[0.8], 0);
    compare("foot_stagger", &curved.with(by_id("foot_stagger").expect("an effect"), &[6.0], 0));
}
