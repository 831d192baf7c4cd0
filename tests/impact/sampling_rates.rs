//! The same drops at the rates of other loggers: the same verdict, and intervals that overlap.

use flexframe::impact::diagnose::{Diagnosis, Verdict, joined};
use flexframe::impact::effects::Model;
use flexframe::impact::measured::{self, FileFormat, FormatError, TableFormat};
use flexframe::impact::request::DiagnosisRequest;
use flexframe::impact::synthetic::{Plan, records};

const FASTEST_HZ: f64 = 51_200.0;
const RATES_HZ: [f64; 5] = [500.0, 1000.0, 3200.0, 10_000.0, FASTEST_HZ];

fn plan(rate_hz: f64) -> Plan {
    let plan = Plan::load(concat!(env!("CARGO_MANIFEST_DIR"), "/params/synthetic/bottoming.toml")).expect("comes with the program");
    Plan { rate_hz, ..plan }
}

/// Rows of a table of the same drops as a slower logger would have written them, each with a phase of its own; from the heights that are
/// wanted.
fn rows(rate_hz: f64, wanted: impl Fn(f64) -> bool) -> String {
    let mut text = String::new();
    for (at, record) in records(&plan(FASTEST_HZ)).iter().enumerate().filter(|(_, record)| wanted(record.height_m)) {
        // Multiples of the golden section lie evenly between 0 and 1.
        let phase = if rate_hz == FASTEST_HZ { 0.0 } else { (at as f64 * 0.618_034).fract() };
        let reading = |t_s: f64| {
            let place = t_s * FASTEST_HZ;
            let left = (place as usize).min(record.accel_g.len() - 2);
            record.accel_g[left] + (place - left as f64) * (record.accel_g[left + 1] - record.accel_g[left])
        };
        let last_s = (record.accel_g.len() - 1) as f64 / FASTEST_HZ;
        for t_s in (0..).map(|i| (f64::from(i) + phase) / rate_hz).take_while(|t_s| *t_s <= last_s) {
            text += &format!("{},{},{t_s:.7},{:.5}\n", record.trial, record.height_m, reading(t_s));
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
    let request = DiagnosisRequest {
        model,
        drops: &set,
        axes: None,
        hold_out_heights_m: &[],
        static_test: None,
        covariates: &[],
        max_effects: 2,
        seed: 1,
    };
    request.diagnosed(&|_| ()).expect("a diagnosis").0
}

/// Keys with their intervals.
fn intervals(found: &Diagnosis) -> Vec<(&'static str, [f64; 2])> {
    found.estimates.iter().map(|one| (one.key, one.ci95)).collect()
}

#[test]
fn planted_drops_get_the_same_verdict_at_every_rate() {
    let found: Vec<Diagnosis> = RATES_HZ.iter().map(|rate_hz| diagnosed(&rows(*rate_hz, |_| true))).collect();
    for (rate_hz, one) in RATES_HZ.iter().zip(&found) {
        println!("{rate_hz} Hz: {} {:?} {:?}", joined(&one.chosen), one.verdict, intervals(one));
    }
    for (rate_hz, one) in RATES_HZ.iter().zip(&found) {
        assert_eq!((one.verdict, joined(&one.chosen).as_str()), (Verdict::Named, "bottoming"), "{rate_hz} Hz: {:?}", one.reasons);
        for other in &found {
            for ((key, a), (_, b)) in intervals(one).iter().zip(intervals(other)) {
                assert!(a[0] <= b[1] && b[0] <= a[1], "{rate_hz} Hz: {key} {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn planted_heights_of_different_rates_are_diagnosed_together() {
    let low = |height_m: f64| height_m < 1.2;
    let found = diagnosed(&(rows(1000.0, low) + &rows(3200.0, |height_m| !low(height_m))));
    assert_eq!((found.verdict, joined(&found.chosen).as_str()), (Verdict::Named, "bottoming"), "{:?}", found.reasons);
}

#[test]
fn analytic_a_table_of_another_logger_reads_like_its_own() {
    let strings = |all: &[&str]| all.iter().map(ToString::to_string).collect::<Vec<String>>();
    let lowest = rows(1000.0, |height_m| height_m < 0.6);
    let own = format!("trial,height_m,t_s,accel_g\n{lowest}");
    let other: String = lowest
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
