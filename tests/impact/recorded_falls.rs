//! An error of the drop heights, or a drag, is believed only as far as the recorded falls allow.

use flexframe::impact::diagnose::Verdict;
use flexframe::impact::effects::{Channel, Model, Sensor, by_id};
use flexframe::impact::measured::{self, DropSet, Fall, FileFormat};
use flexframe::impact::request::DiagnosisRequest;
use flexframe::impact::synthetic::{Plan, Stalls, SyntheticRecord, records, table};

const HEIGHTS_M: [f64; 3] = [0.5, 1.0, 2.0];

/// Records of drops that an effect changes, and the model without it.
fn dropped(effect: &str, value: f64, record_s: f64) -> (Model, Plan, Vec<SyntheticRecord>) {
    let plan = Plan::load(concat!(env!("CARGO_MANIFEST_DIR"), "/params/synthetic/bottoming.toml")).expect("comes with the program");
    let sensor = Sensor { channel: Channel::Axial, ..plan.model.sensor };
    let base = Model::base(plan.model.body.clone(), sensor, 6600.0, 50.0);
    let model = base.clone().with(by_id(effect).expect("an effect"), &[value], 0);
    let stalls = (record_s > 0.0).then_some(Stalls { lost_s: 0.0, sector: 409.6, catch_up: 2.7, record_s });
    let plan = Plan { model, stalls, heights_m: HEIGHTS_M.to_vec(), drops: 20, seed: 5, ..plan };
    let all = records(&plan);
    (base, plan, all)
}

fn read(all: &[SyntheticRecord]) -> DropSet {
    measured::read_bytes(&[("drops.csv".into(), table(all).into_bytes())], &FileFormat::default()).expect("reads")
}

/// Takes out of the fall, and begins the record so much later, what makes it longer than a free fall from the stated height; or puts it in.
fn as_long_as_a_free_fall(plan: &Plan, record: &mut SyntheticRecord) {
    let step_s = record.t_s[1] - record.t_s[0];
    let free_s = (2.0 * record.height_m / 9.81_f64).sqrt();
    let longer = ((plan.model.arrangement().fall.duration_s(record.height_m) - free_s) / step_s).round() as usize;
    let trigger = record.accel_g.iter().position(|reading| *reading > 3.0).expect("has an impact");
    record.accel_g.drain(trigger - 20 - longer..trigger - 20);
    record.t_s.truncate(record.accel_g.len());
}

fn diagnosed(model: Model, all: &[SyntheticRecord], effect: &str) -> (Verdict, String) {
    let set = read(all);
    let request = DiagnosisRequest {
        model,
        drops: &set,
        axes: None,
        hold_out_heights_m: &[],
        static_test: None,
        covariates: &[],
        max_effects: 1,
        seed: 1,
    };
    let (found, _) = request.diagnosed(&|_| ()).expect("drops that can be diagnosed");
    assert_eq!(found.contributions.first().map(|one| one.0), Some(effect));
    (found.verdict, found.reasons.join("; "))
}

#[test]
fn analytic_synthetic_falls_last_as_the_model_says() {
    for (effect, value) in [("drop_height_error", -0.15), ("air_drag", 0.3)] {
        let (_, plan, all) = dropped(effect, value, 2.0);
        for fall in Fall::of(&read(&all)) {
            let lasting_s = plan.model.arrangement().fall.duration_s(fall.height_m);
            assert!((fall.fall_s - lasting_s).abs() < 0.012, "{effect}: {fall:?}, {lasting_s} s");
        }
    }
}

#[test]
fn planted_what_falls_contradict_is_not_named() {
    for (effect, value) in [("drop_height_error", 0.2), ("air_drag", 0.3)] {
        let (model, plan, mut all) = dropped(effect, value, 2.0);
        let (verdict, reasons) = diagnosed(model.clone(), &all, effect);
        assert!(verdict != Verdict::NoneSuffices && !reasons.contains("the fall"), "{effect}, {verdict:?}: {reasons}");
        all.iter_mut().for_each(|record| as_long_as_a_free_fall(&plan, record));
        let (verdict, reasons) = diagnosed(model, &all, effect);
        let told = format!("{effect} of 0.");
        assert!(verdict == Verdict::NoneSuffices && reasons.contains(&told), "{effect}, {verdict:?}: {reasons}");
        assert!(reasons.contains("contradicts the recorded falls: from"), "{reasons}");
    }
    // Records that begin just before the impact tell nothing of the fall.
    let (model, _, all) = dropped("drop_height_error", 0.2, 0.0);
    let (verdict, reasons) = diagnosed(model, &all, "drop_height_error");
    assert!(verdict == Verdict::Named, "{verdict:?}: {reasons}");
}
