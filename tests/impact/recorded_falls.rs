//! An error of the drop heights is believed only as far as the recorded falls allow.

use flexframe::impact::diagnose::Verdict;
use flexframe::impact::effects::{Channel, Model, Sensor, by_id};
use flexframe::impact::measured::{self, FileFormat};
use flexframe::impact::synthetic::{Plan, Stalls, records, table};
use flexframe::report::data::diagnosis_request::DiagnosisRequest;

/// Whole records, whose falls last as long as the stated heights say, of impacts from so much higher.
fn diagnosed(extra_m: f64, record_s: f64) -> (Verdict, String) {
    let plan = Plan::load(concat!(env!("CARGO_MANIFEST_DIR"), "/params/synthetic/bottoming.toml")).expect("comes with the program");
    let sensor = Sensor { channel: Channel::Axial, ..plan.model.sensor };
    let base = Model::base(plan.model.body.clone(), sensor, 6600.0, 50.0);
    let model = base.clone().with(by_id("drop_height_error").expect("an effect"), &[extra_m], 0);
    let stalls = (record_s > 0.0).then_some(Stalls { lost_s: 0.0, sector: 409.6, catch_up: 2.7, record_s });
    let plan = Plan { model, stalls, heights_m: vec![0.3, 0.6, 1.2], drops: 20, seed: 5, ..plan };
    let text = table(&records(&plan));
    let set = measured::read_bytes(&[("drops.csv".into(), text.into_bytes())], &FileFormat::default()).expect("reads");
    let request = DiagnosisRequest {
        model: base,
        drops: &set,
        axes: None,
        hold_out_heights_m: &[],
        static_test: None,
        covariates: &[],
        max_effects: 1,
        seed: 1,
    };
    let (found, _) = request.diagnosed(&|_| ()).expect("drops that can be diagnosed");
    assert_eq!(found.contributions.first().map(|one| one.0), Some("drop_height_error"));
    (found.verdict, found.reasons.join("; "))
}

#[test]
fn planted_a_height_error_that_falls_contradict_is_not_named() {
    let (verdict, reasons) = diagnosed(0.2, 2.0);
    assert!(verdict == Verdict::NoneSuffices && reasons.contains("contradicts the recorded falls: from 0.3 m"), "{verdict:?}: {reasons}");
    // Records that begin just before the impact tell nothing of the fall.
    let (verdict, reasons) = diagnosed(0.2, 0.0);
    assert!(verdict == Verdict::Named, "{verdict:?}: {reasons}");
}
