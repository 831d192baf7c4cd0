//! How long a fold takes, of a frame that is designed: `cargo bench --bench fold`.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use flexframe::export::fold_glb;
use flexframe::frame::assembly::Design;
use flexframe::frame::fold::{FoldSequence, sweeps};
use flexframe::params::Frame;
use std::hint::black_box;

fn folds(criterion: &mut Criterion) {
    // What a design was asked before it keeps: each time another one is asked.
    let designed = || Design::new(Frame::load("cognifly").expect("a preset").0).expect("designs");
    let design = designed();
    let sequence = |design: &Design| FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
    let fold = sequence(&design);
    criterion.bench_function("sequence", |bench| bench.iter(|| sequence(black_box(&design))));
    criterion.bench_function("sweeps", |bench| bench.iter_batched(designed, |design| sweeps(&design, &fold), BatchSize::PerIteration));
    criterion.bench_function("fold.glb", |bench| bench.iter(|| fold_glb::fold(black_box(&design), &fold).expect("a file")));
    criterion.bench_function("all three", |bench| {
        let all = |design: Design| {
            let fold = sequence(&design);
            (sweeps(&design, &fold), fold_glb::fold(&design, &fold).expect("a file"))
        };
        bench.iter_batched(designed, all, BatchSize::PerIteration);
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10).warm_up_time(std::time::Duration::from_millis(500)).measurement_time(std::time::Duration::from_secs(5));
    targets = folds
}
criterion_main!(benches);
