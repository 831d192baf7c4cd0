//! Random bytes and damaged records: a record or a refusal, never a panic; what reads can be judged, drawn and written.

use std::fs;

use flexframe::impact::measured;
use flexframe::impact::measured::FileFormat;
use flexframe::report::chart::measure_plots;
use flexframe::report::data::measure_data;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// Reads a file of these bytes and does with it all that `measure` does, plots now and then; says whether it read.
fn survives(name: &str, bytes: &[u8], plots: bool) -> bool {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path().join("soft_050cm");
    fs::create_dir(&place).expect("a folder");
    let path = place.join(name);
    fs::write(&path, bytes).expect("can be written");
    match measured::read(&[path], &FileFormat::default()) {
        Err(malformed) => {
            assert!(malformed.to_string().contains(name) && !malformed.fault.remedy().is_empty());
            false
        }
        Ok(set) => {
            let judged = measured::JudgedDrops::of(&set);
            let groups = &judged.groups;
            assert!(!measure_data::json(&set, &judged).to_string().is_empty());
            assert!(measure_data::heights_csv(groups).expect("is a table").lines().count() == groups.len() + 1);
            assert!(measure_data::drops_csv(groups).expect("is a table").lines().count() > groups.len());
            if plots {
                measure_plots::plots(groups).expect("can be drawn");
            }
            true
        }
    }
}

fn runner(cases: u32, seed: u8) -> TestRunner {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]))
}

#[test]
fn analytic_random_bytes_never_panic() {
    let cases = (vec(any::<u8>(), 0..400), prop_oneof![Just("a.bin"), Just("a.bhn"), Just("a.csv")]);
    let checked = runner(400, 1).run(&cases, |(bytes, name)| {
        survives(name, &bytes, false);
        Ok(())
    });
    checked.expect("no panic");
}

#[test]
fn analytic_random_counts_are_judged() {
    // Samples in order of time with any counts of the converter, any length, now and then a gap.
    let cases = vec((1_u32..3000, 0_u16..4096, 0_u16..4096, 0_u16..4096), 1..120);
    let checked = runner(150, 2).run(&cases, |samples| {
        let (mut t_us, mut bytes) = (0, Vec::new());
        for (at, (step, x, y, z)) in samples.iter().enumerate() {
            t_us += if step % 7 == 0 { *step } else { 1000 };
            bytes.extend(t_us.to_le_bytes());
            // A fall before the impact in every other case.
            let counts = if samples.len() % 2 == 0 && at < samples.len() / 2 { [2020, 2020, 2021] } else { [*x, *y, *z] };
            bytes.extend(counts.iter().flat_map(|count| count.to_le_bytes()));
        }
        assert!(survives("a.bin", &bytes, samples.len() % 8 == 0));
        Ok(())
    });
    checked.expect("no panic");
}

#[test]
fn analytic_damaged_tables_never_panic() {
    let mut good = "trial,height_m,t_s,accel_g,x,y,z\n".to_string();
    for trial in 0..3 {
        for at in 0..40 {
            let accel = if (10..20).contains(&at) { 60 + trial } else { 0 };
            good += &format!("{trial},0.5,0.0{at:02},{accel},0,1,{accel}\n");
        }
    }
    assert!(survives("a.csv", good.as_bytes(), true));
    let size = good.len();
    let words = prop_oneof![
        Just("nan"),
        Just("-inf"),
        Just("1e308"),
        Just(","),
        Just("\n"),
        Just("\""),
        Just("\0"),
        Just("-"),
        Just("9"),
        Just("\u{feff}")
    ];
    let cases = (vec((0..size, words), 1..6), 0..size);
    let checked = runner(300, 3).run(&cases, |(damages, cut)| {
        let mut bytes = good.clone().into_bytes();
        for (at, word) in &damages {
            let end = (at + word.len()).min(bytes.len());
            bytes.splice(*at..end, word.bytes());
        }
        if cut % 3 == 0 {
            bytes.truncate(cut);
        }
        survives("a.csv", &bytes, false);
        Ok(())
    });
    checked.expect("no panic");
}
