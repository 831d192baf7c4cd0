//! How long one drop takes: `cargo bench --bench drop`.

use criterion::{Criterion, criterion_group, criterion_main};
use flexframe::impact::effects::Model;
use flexframe::impact::sim::{Settings, System, simulate, wave};
use std::hint::black_box;

#[path = "../tests/impact/mod.rs"]
#[allow(dead_code)]
mod impact;

/// Cheap, with switches, stiff, and many effects at once.
fn models() -> [(&'static str, Model); 5] {
    let with = |effects: &[(&str, &[f64])]| impact::model(effects);
    [
        ("base", impact::base()),
        ("unilateral, feet", with(&[("unilateral_contact", &[0.0]), ("foot_stagger", &[8.0])])),
        ("payload", with(&[("payload_mode", &[0.3, 120.0, 0.05])])),
        ("stiff stop, sensor at 2 kHz", with(&[("bottoming", &[9.0, 3e7, 0.3]), ("sensor_low_pass", &[2000.0])])),
        (
            "eight effects",
            with(&[
                ("unilateral_contact", &[0.0]),
                ("bottoming", &[11.0, 3e5, 0.2]),
                ("cubic_stiffness", &[5e6]),
                ("hunt_crossley_damping", &[1e3]),
                ("coulomb_friction", &[8.0]),
                ("maxwell_branch", &[4e3, 4.0]),
                ("preload", &[15.0]),
                ("payload_mode", &[0.2, 150.0, 0.1]),
            ]),
        ),
    ]
}

fn drops(criterion: &mut Criterion) {
    let mut out = vec![0.0; 1201];
    for (name, model) in models() {
        criterion.bench_function(&format!("wave, 60 ms: {name}"), |bench| {
            bench.iter(|| wave(&System::new(black_box(&model)), 1.5, 5e-5, &Settings::FIT, &mut out));
        });
    }
    let base = impact::base();
    criterion.bench_function("full trace, 60 ms: base", |bench| {
        bench.iter(|| simulate(&System::new(black_box(&base)), 1.5, &Settings::REPORT));
    });
    for (name, effects) in [("base", &[][..]), ("payload", &[("payload_mode", &[0.3, 120.0, 0.05][..])][..])] {
        criterion.bench_function(&format!("ode_solvers DOPRI5 at the same tolerance: {name}"), |bench| {
            bench.iter(|| impact::quick(impact::Table::new(black_box(effects)), 1.5, 0.06));
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).warm_up_time(std::time::Duration::from_millis(300)).measurement_time(std::time::Duration::from_secs(1));
    targets = drops
}
criterion_main!(benches);
