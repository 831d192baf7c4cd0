//! How long 1000 records take to read and to judge: `cargo bench --bench read`.

use std::fs;
use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use flexframe::impact::measured;
use flexframe::impact::measured::FileFormat;

/// Records.
const RECORDS: usize = 1000;
/// Samples of a record, 2 s at 1 kHz.
const SAMPLES: u32 = 2000;

/// Counts along the axis: a fall, an impact, rest.
fn counts(record: usize, sample: u32) -> u16 {
    match sample {
        0..1000 => 2021,
        1000..1012 => 2021 + 60 * (sample - 999) as u16 + record as u16 % 7,
        _ => 2030,
    }
}

fn logger(folder: &Path) {
    for record in 0..RECORDS {
        let place = folder.join(["soft_050cm", "soft_100cm", "soft_150cm"][record % 3]);
        fs::create_dir_all(&place).expect("a folder");
        let mut bytes = Vec::new();
        for sample in 0..SAMPLES {
            bytes.extend((1000 * sample).to_le_bytes());
            bytes.extend([2020, 2020, counts(record, sample)].into_iter().flat_map(u16::to_le_bytes));
        }
        fs::write(place.join(format!("{record}.bin")), bytes).expect("can be written");
    }
}

fn table(path: &Path) {
    let mut text = "trial,height_m,t_s,accel_g\n".to_string();
    for record in 0..RECORDS {
        for sample in 0..SAMPLES {
            let accel_g = (f64::from(counts(record, sample)) - 2020.77) / 8.877;
            text += &format!("{record},1.5,{:.3},{accel_g:.4}\n", f64::from(sample) * 1e-3);
        }
    }
    fs::write(path, text).expect("can be written");
}

fn reading(criterion: &mut Criterion) {
    let folder = tempfile::tempdir().expect("a folder");
    let (logged, listed) = (folder.path().join("logged"), folder.path().join("drops.csv"));
    logger(&logged);
    table(&listed);
    for (name, path) in [("1000 logger files of 2000 samples", logged), ("a table of 1000 drops of 2000 samples", listed)] {
        criterion.bench_function(&format!("read and judge: {name}"), |bench| {
            bench.iter(|| {
                let set = measured::read(&[black_box(&path).clone()], &FileFormat::default()).expect("reads");
                let groups = measured::JudgedDrops::of(&set).groups;
                assert_eq!(groups.iter().map(|(_, drops)| drops.len()).sum::<usize>(), RECORDS);
            });
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10).warm_up_time(std::time::Duration::from_millis(500)).measurement_time(std::time::Duration::from_secs(5));
    targets = reading
}
criterion_main!(benches);
