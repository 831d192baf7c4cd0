//! The same drops at the rates of other loggers: the same verdict, and intervals that overlap.

use flexframe::impact::diagnose::{Diagnosis, Verdict, joined};
use flexframe::impact::effects::Model;
use flexframe::impact::measured::{self, FileFormat, FormatError, TableFormat};
use flexframe::impact::synthetic::{Plan, records};
use flexframe::report::data::diagnosis_request::DiagnosisRequest;

const RATES_HZ: [f64; 5] = [500.0, 1000.0, 3200.0, 10_000.0, 51_200.0];

fn plan(rate_hz: f64) -> Plan {
    let plan = Plan::load(concat!(env!("CARGO_MANIFEST_DIR"), "/params/synthetic/bottoming.toml")).expect("comes with the program");
    Plan { rate_hz, ..plan }
}

/// Rows of a table of synthetic drops, from the heights that are wanted.
fn rows(plan: &Plan, wanted: impl Fn(f64) -> bool) -> String {
    let mut text = String::new();
    for record in records(plan).iter().filter(|record| wanted(record.height_m)) {
        for (t_s, accel_g) in record.t_s.iter().zip(&record.accel_g) {
            text += &format!("{},{},{t_s:.7},{accel_g:.5}\n", record.trial, record.height_m);
        }
    }
    text
}

fn diagnosed(rows: &str) -> Diagnosis {
    let text = format!("trial,height_m,t_s,accel_g\n{rows}");
    let set = measured::read_bytes(&[("drops.csv".into(), text.into_bytes())], &FileFormat::default()).expect("reads");
    let truth = plan(1000.0).model;
    let [k, c] = truth.stiffness_and_damping();
    let model = Model::base(truth.body.clone(), truth.sensor, 0.9 * k, 1.1 * c);
    let request =
        DiagnosisRequest { model, drops: &set, channel: None, hold_out_heights_m: &[], static_test: None, max_effects: 2, seed: 1 };
    request.diagnosed(&|_| ()).expect("a diagnosis").0
}

/// Keys with their intervals.
fn intervals(found: &Diagnosis) -> Vec<(&'static str, [f64; 2])> {
    found.estimates.iter().map(|one| (one.key, one.ci95)).collect()
}

#[test]
fn planted_drops_get_the_same_verdict_at_every_rate() {
    let found: Vec<Diagnosis> = RATES_HZ.iter().map(|rate_hz| diagnosed(&rows(&plan(*rate_hz), |_| true))).collect();
    for (rate_hz, one) in RATES_HZ.iter().zip(&found) {
        println!("{rate_hz} Hz: {} {:?} {:?}", joined(&one.chosen), one.verdict, intervals(one));
    }
    for (rate_hz, one) in RATES_HZ.iter().zip(&found) {
        assert_eq!((one.verdict, joined(&one.chosen).as_str()), (Verdict::Named, "bottoming"), "{rate_hz} Hz: {:?}", one.reasons);
        // Intervals of different rates need not overlap: docs/limitations.md.
        for (estimate, (truth, share)) in one.estimates.iter().zip([(6600.0, 0.02), (50.0, 0.02), (11.0, 0.03), (1e6, 0.25)]) {
            assert!((estimate.value / truth - 1.0).abs() < share, "{rate_hz} Hz: {} is {}", estimate.key, estimate.value);
        }
    }
}

#[test]
fn planted_heights_of_different_rates_are_diagnosed_together() {
    let low = |height_m: f64| height_m < 1.2;
    let found = diagnosed(&(rows(&plan(1000.0), low) + &rows(&plan(3200.0), |height_m| !low(height_m))));
    assert_eq!((found.verdict, joined(&found.chosen).as_str()), (Verdict::Named, "bottoming"), "{:?}", found.reasons);
}

#[test]
fn analytic_a_table_of_another_logger_reads_like_its_own() {
    let strings = |all: &[&str]| all.iter().map(ToString::to_string).collect::<Vec<String>>();
    let plan = Plan { drops: 3, ..plan(1000.0) };
    let own = format!("trial,height_m,t_s,accel_g\n{}", rows(&plan, |_| true));
    let other: String = rows(&plan, |_| true)
        .lines()
        .map(|row| {
            let fields: Vec<&str> = row.split(',').collect();
            let number = |at: usize| fields[at].parse::<f64>().expect("a number");
            let decimal = |value: f64| format!("{value:.6}").replace('.', ",");
            format!("{};{};{};{}\n", fields[0], decimal(100.0 * number(1)), decimal(1e3 * number(2)), decimal(-9.806_65 * number(3)))
        })
        .collect();
    let table = TableFormat::new(&strings(&["trial=Drop", "h=Height", "t=Time", "z=-Az"]), &strings(&["m/s2", "ms", "cm"]), None);
    let format = FileFormat { table: table.expect("is one"), ..FileFormat::default() };
    let read = |text: String, format: &FileFormat| measured::read_bytes(&[("a.csv".into(), text.into_bytes())], format).expect("reads");
    let (own, other) = (read(own, &FileFormat::default()), read(format!("Drop;Height;Time;Az\n{other}"), &format));
    for (own, other) in own.records().zip(other.records()) {
        assert_eq!((&own.trial, own.height_m), (&other.trial, other.height_m));
        assert!(own.accel_g.iter().zip(&other.accel_g).all(|(a, b)| (a - b).abs() < 1e-5));
        assert!(own.t_s.iter().zip(&other.t_s).all(|(a, b)| (a - b).abs() < 1e-9));
    }
    assert_eq!(TableFormat::new(&[], &strings(&["furlong"]), None), Err(FormatError::Unit { given: "furlong".into() }));
}
