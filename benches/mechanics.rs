//! How long the frame's mechanics take: cutting the parts, a static curve, modes, a drop.

use criterion::{Criterion, criterion_group, criterion_main};
use flexframe::frame::assembly::{Design, mass};
use flexframe::mechanics::model::frame_model::{Extent, FrameModel};
use flexframe::mechanics::parts::parts_plan::part_models;
use flexframe::mechanics::result::impact::{Impact, Run};
use flexframe::mechanics::result::static_curve::StaticCurve;
use flexframe::mechanics::settings::MechanicsSettings;
use flexframe::mechanics::solve::modes::Modes;
use flexframe::params::Frame;

fn mechanics(criterion: &mut Criterion) {
    let design = Design::new(Frame::load("cognifly-v8").expect("is valid").0).expect("closes");
    let (masses, settings) = (mass::table(&design), MechanicsSettings::load(None).expect("is sound"));
    let parts = part_models(&design, &settings).expect("are cut");
    let model = |extent| FrameModel::of_parts(&design, &parts, &masses, &settings, extent).expect("has a model");
    let (quarter, whole) = (model(Extent::Quarter), model(Extent::Whole));
    let mut group = criterion.benchmark_group("mechanics");
    group.sample_size(10);
    group.bench_function("cutting the parts", |b| b.iter(|| part_models(&design, &settings)));
    group.bench_function("static curve to 34 mm, quarter", |b| b.iter(|| StaticCurve::new(&quarter, 34.0, &[])));
    group.bench_function("static curve to 34 mm, whole", |b| b.iter(|| StaticCurve::new(&whole, 34.0, &[])));
    group.bench_function("drop from 1 m, quarter", |b| b.iter(|| Impact::new(&quarter, &settings, 1.0, &Run::default())));
    group.bench_function("eight modes, whole", |b| b.iter(|| Modes::new(&whole, 8)));
    group.finish();
}

criterion_group!(benches, mechanics);
criterion_main!(benches);
