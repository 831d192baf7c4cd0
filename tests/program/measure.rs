//! `flexframe measure` and `flexframe fit` from outside.

use crate::drops;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::drops::Seen;
use assert_cmd::cargo::cargo_bin;
use serde_json::Value;

fn run(command: &str, folder: &Path, arguments: &[&str]) -> Output {
    let mut program = Command::new(cargo_bin("flexframe"));
    program.arg(command).args(arguments).arg("-o").arg(folder.join("out")).current_dir(folder).env("NO_COLOR", "1");
    program.output().expect("the program starts")
}

fn json(command: &str, folder: &Path, arguments: &[&str]) -> Value {
    let output = run(command, folder, &[arguments, &["--json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

#[test]
fn analytic_drops_of_a_model_are_read_and_fitted_back() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("drops.csv"), drops::csv(&drops::model(6000.0, 30.0), 20, Seen::Varied)).expect("can be written");
    let read = json("measure", folder.path(), &["drops.csv"]);
    let heights = read["heights"].as_array().expect("a list");
    assert_eq!(heights.len(), 3);
    for height in heights {
        assert_eq!((&height["drops"], &height["clean"]), (&Value::from(20), &Value::from(20)), "{}", read["drops"]);
        assert!((number(&height["noise_g"]["median"]) - drops::NOISE_G).abs() < 0.08);
        assert!(height["peak_g"].is_null() && height["fall_s"].is_null());
    }
    fs::write(folder.path().join("aligned.csv"), drops::csv(&drops::model(6000.0, 30.0), 6, Seen::Aligned)).expect("can be written");
    // The paper's objective begins each drop at its trigger, which with an unknown phase is up to a sample early.
    for (objective, drops) in [("ml", "drops.csv"), ("paper", "aligned.csv")] {
        let arguments = ["--model", "paper-corrected", "--objective", objective, "--bootstrap", "40", drops];
        let fit = json("fit", folder.path(), &arguments);
        assert_eq!(fit["body"]["from"], "model paper-corrected");
        for (key, truth) in [("k", 6000.0), ("c", 30.0)] {
            let found = &fit["parameters"][key];
            assert!((number(&found["value"]) / truth - 1.0).abs() < 0.02, "{objective}: {fit:#}");
            // Aligned drops are all alike, and so are their resampled fits, but for where they stop.
            let room = 1e-3 * truth;
            assert!(
                number(&found["ci95"][0]) <= number(&found["value"]) + room && number(&found["value"]) <= number(&found["ci95"][1]) + room
            );
        }
        assert_eq!(fit, json("fit", folder.path(), &arguments), "the same seed gives the same result");
    }
    for name in ["fit-0.5-m.svg", "fit-1-m.png", "fit-1.5-m.svg", "fit.json", "model.toml"] {
        assert!(fs::read(folder.path().join("out/fit-paper-corrected").join(name)).expect("was written").len() > 100, "{name}");
    }
    // The model that was written drops.
    let model = folder.path().join("out/fit-paper-corrected/model.toml").display().to_string();
    assert_eq!(run("drop", folder.path(), &["--model", &model]).status.code(), Some(0));
}

#[test]
fn planted_saturated_drops_are_left_out_of_a_fit() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = drops::csv(&drops::model(6000.0, 30.0), 20, drops::Seen::Varied);
    // The first so many drops of the heights from a least one on are clipped: at 65 g those from 1.5 m have five samples there or more.
    let write = |name: &str, clipped: u32, from_m: f64, limit_g: f64| {
        let clip = |line: &str| {
            let fields: Vec<f64> = line.split(',').filter_map(|field| field.parse().ok()).collect();
            let [trial, height_m, t_s, accel_g] = fields[..] else { return format!("{line}\n") };
            let is_clipped = trial < f64::from(clipped) && height_m >= from_m;
            format!("{trial},{height_m},{t_s},{}\n", if is_clipped { accel_g.min(limit_g) } else { accel_g })
        };
        fs::write(folder.path().join(name), text.lines().map(clip).collect::<String>()).expect("can be written");
    };
    let fitted = |arguments: &[&str]| json("fit", folder.path(), &[&["--bootstrap", "0"], arguments].concat());
    let reasons = |fit: &Value, part: &str| {
        let left_out = fit["left_out"].as_array().expect("a list");
        left_out.iter().filter(|left| left["reason"].as_str().is_some_and(|reason| reason.contains(part))).count()
    };
    let off = |fit: &Value| (number(&fit["parameters"]["k"]["value"]) / 6000.0 - 1.0).abs();
    for (clipped, saturated, weakest) in [(5, 5, 0), (12, 12, 8), (20, 20, 0)] {
        write("clipped.csv", clipped, 1.5, 65.0);
        let fit = fitted(&["clipped.csv"]);
        assert_eq!(number(&fit["drops"]), f64::from(60 - saturated - weakest), "{fit:#}");
        assert_eq!([reasons(&fit, "saturation: "), reasons(&fit, "the weakest")], [saturated as usize, weakest as usize], "{fit:#}");
        assert!(off(&fit) < 0.02, "{fit:#}");
    }
    let all = fitted(&["--all", "clipped.csv"]);
    assert!(number(&all["drops"]) == 60.0 && off(&all) > 0.02, "{all:#}");
    // Clipped impulses are no evidence, and where all are clipped nothing is fitted.
    write("low.csv", 20, 0.0, 16.0);
    let refused = run("fit", folder.path(), &["low.csv"]);
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(refused.status.code() == Some(2) && said.contains("60 are saturated") && said.contains("larger range"), "{said}");
}

#[test]
fn analytic_any_subset_is_fitted_and_a_frame_brings_its_body() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("drops.csv"), drops::csv(&drops::model(7040.0, 30.0), 12, Seen::Varied)).expect("can be written");
    let fit = json("fit", folder.path(), &["--free", "c", "--bootstrap", "0", "cognifly-v8", "drops.csv"]);
    assert_eq!(fit["body"]["from"], "frame cognifly-v8");
    assert!((number(&fit["body"]["gap_mm"]) - 10.9).abs() < 0.05);
    assert_eq!(fit["parameters"].as_object().expect("an object").len(), 1);
    assert!((number(&fit["parameters"]["c"]["value"]) - 30.0).abs() < 0.5, "{fit:#}");
    let refused = run("fit", folder.path(), &["--channel", "all", "drops.csv"]);
    let told = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(refused.status.code() == Some(2) && told.contains("a fit compares one channel"), "{told}");
    let table = run("fit", folder.path(), &["--free", "c", "cognifly-v8", "drops.csv"]);
    let table = String::from_utf8_lossy(&table.stdout).into_owned();
    assert!(table.contains("mass 241.0 g and gap 10.9 mm of frame cognifly-v8"), "{table}");
}

#[test]
fn analytic_the_folder_is_whole_and_the_same_twice() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("drops.csv"), drops::csv(&drops::model(6000.0, 30.0), 5, Seen::Varied)).expect("can be written");
    let read = |name: &str| fs::read(folder.path().join("out/measure").join(name)).expect("was written");
    let names: Vec<String> = ["peak", "waves-0.5-m", "waves-1-m", "waves-1.5-m"]
        .iter()
        .flat_map(|chart| [format!("{chart}.svg"), format!("{chart}.png")])
        .chain(["heights.csv", "drops.csv", "measure.json"].map(String::from))
        .collect();
    let mut before: Vec<Vec<u8>> = Vec::new();
    for turn in 0..2 {
        let output = run("measure", folder.path(), &["drops.csv", "-q"]);
        assert_eq!((output.status.code(), output.stdout.len(), output.stderr.len()), (Some(0), 0, 0));
        assert_eq!(fs::read_dir(folder.path().join("out/measure")).expect("a folder").count(), names.len() + 1, "and the record");
        let now: Vec<Vec<u8>> = names.iter().map(|name| read(name)).collect();
        assert!(turn == 0 || now == before);
        before = now;
    }
}

#[test]
fn planted_bad_records_are_flagged_with_the_reason() {
    let folder = tempfile::tempdir().expect("a folder");
    let head = "trial,height_m,t_s,accel_g\n";
    let pulse = |trial: &str, height_m: f64, step_s: f64, samples: usize, top: f64, limit: f64| {
        let rows = (0..samples).map(|at| {
            let ms = at as f64 - 10.0;
            let accel =
                if (0.0..=10.0).contains(&ms) { (top * libm::sin(ms * std::f64::consts::PI / 10.0)).min(limit) } else { 0.001 * ms };
            format!("{trial},{height_m},{:.4},{accel:.3}\n", at as f64 * step_s)
        });
        rows.collect::<String>()
    };
    let mut text = head.to_string();
    text += &pulse("good", 1.0, 1e-3, 40, 90.0, 1e3);
    text += &pulse("weak", 1.0, 1e-3, 40, 20.0, 1e3);
    text += &pulse("strong", 1.0, 1e-3, 40, 180.0, 1e3);
    text += &pulse("flat", 1.0, 1e-3, 40, 110.0, 80.0);
    text += &pulse("short", 1.0, 1e-3, 25, 90.0, 1e3);
    text += &pulse("fast", 1.0, 5e-4, 80, 180.0, 1e3);
    text += &pulse("slow", 1.0, 3e-3, 40, 90.0, 1e3);
    text += &pulse("still", 1.0, 1e-3, 40, 1.0, 1e3);
    text += &pulse("twice", 1.0, 1e-3, 50, 90.0, 1e3)
        .replace("twice,1,0.0450,", "twice,1,0.0450,12")
        .replace("twice,1,0.0460,", "twice,1,0.0460,12");
    text += &pulse("full", 1.0, 1e-3, 40, 300.0, 230.0);
    text += &pulse("gap", 1.0, 1e-3, 40, 90.0, 1e3)
        .replace("gap,1,0.0300,", "#")
        .lines()
        .filter(|l| !l.starts_with('#'))
        .map(|l| format!("{l}\n"))
        .collect::<String>();
    fs::write(folder.path().join("drops.csv"), text).expect("can be written");
    let read = json("measure", folder.path(), &["drops.csv"]);
    let flags = |trial: &str| -> Vec<String> {
        let drops = read["drops"].as_array().expect("a list");
        let drop = drops.iter().find(|drop| drop["trial"] == trial).expect("was read");
        drop["flags"].as_array().expect("a list").iter().map(|flag| flag["flag"].as_str().expect("text").to_string()).collect()
    };
    for (trial, expected) in [
        ("good", &[][..]),
        ("weak", &["impossible_impulse"]),
        ("strong", &["impossible_impulse"]),
        ("flat", &["saturation"]),
        ("short", &["too_short"]),
        ("still", &["no_impact"]),
        ("twice", &["double_hit"]),
        ("gap", &["wrong_sample_rate"]),
    ] {
        assert_eq!(flags(trial), expected, "{trial}: {read:#}");
    }
    assert!(!flags("fast").contains(&"wrong_sample_rate".to_string()) && flags("slow").contains(&"wrong_sample_rate".to_string()));
    assert!(flags("full").contains(&"saturation".to_string()));
    let table = run("measure", folder.path(), &["drops.csv"]);
    let table = String::from_utf8_lossy(&table.stdout).into_owned();
    assert!(table.contains("twice: double hit: the peak comes") && table.contains("short: too short"), "{table}");
}

#[test]
fn planted_unreadable_drops_exit_2_with_file_line_and_remedy() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path();
    let head = "trial,height_m,t_s,accel_g\n";
    fs::create_dir_all(place.join("soft_050cm")).expect("a folder");
    fs::create_dir_all(place.join("elsewhere")).expect("a folder");
    fs::create_dir_all(place.join("nothing")).expect("a folder");
    let files: [(&str, &[u8]); 12] = [
        ("soft_050cm/cut.bin", &[0; 37]),
        ("soft_050cm/empty.bin", &[]),
        ("soft_050cm/text.bin", b"this is text, 40 bytes long, no record.."),
        ("elsewhere/a.bin", &[0; 10]),
        ("nothing/notes.txt", b"no record"),
        ("empty.csv", b""),
        ("foreign.csv", b"name;value\nx;1\n"),
        ("nan.csv", b"trial,height_m,t_s,accel_g\n1,0.5,0.000,0\n1,0.5,0.001,NaN\n"),
        ("unsorted.csv", b"trial,height_m,t_s,accel_g\n1,0.5,0.002,0\n1,0.5,0.001,0\n"),
        ("mixed.csv", b"trial,height_m,t_s,accel_g\n1,0.5,0.000,0\n1,1.0,0.001,0\n"),
        ("cut.csv", b"trial,height_m,t_s,accel_g\n1,0.5,0.000,0\n1,0.5,0.0"),
        ("huge.csv", b"trial,height_m,t_s,accel_g\n1,0.5,0.000,1e300\n"),
    ];
    for (name, bytes) in files {
        fs::write(place.join(name), bytes).expect("can be written");
    }
    fs::write(place.join("good.csv"), format!("{head}1,0.5,0,0\n")).expect("can be written");
    for (path, says, remedy) in [
        ("soft_050cm/cut.bin", "cut.bin ends in the middle of a sample: 37 bytes", "copy it again"),
        ("soft_050cm/empty.bin", "empty.bin is empty", "leave it out"),
        ("soft_050cm/text.bin", "text.bin, sample 1: `x` is", "is it one?"),
        ("elsewhere", "lies in the folder `elsewhere`, whose name does not say the height", "soft_050cm"),
        ("nothing", "nothing holds no record: one other file", ".csv tables"),
        ("nothing/notes.txt", "of no kind that is identified by its ending", ".csv tables"),
        ("absent.csv", "absent.csv cannot be read", "are there"),
        ("empty.csv", "empty.csv is empty", "leave it out"),
        (
            "foreign.csv",
            "foreign.csv, line 1: lacks the columns `trial`, `height_m` or `speed_m_s`, `t_s`, `accel_g` or `z`; it has `name`, `value`",
            "trial,height_m,t_s,accel_g",
        ),
        ("nan.csv", "nan.csv, line 3: `accel_g` is `NaN`, no number", "finite"),
        (
            "unsorted.csv",
            "unsorted.csv, line 3: time does not ascend in trial `1`: 0.001 s after 0.002 s",
            "sort those of each trial by t_s",
        ),
        ("mixed.csv", "mixed.csv, line 3: trial `1` has two heights: 0.5 m and 1 m", "one height"),
        ("cut.csv", "cut.csv, line 3: has 3 fields, the header has 4", "cut short"),
        ("huge.csv", "huge.csv, line 2: `accel_g` = 1", "look at the unit"),
    ] {
        for command in ["measure", "fit"] {
            let output = run(command, place, &["good.csv", path]);
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(2), "{path}: {said}");
            assert!(said.contains(says) && said.contains(remedy), "{says:?} and {remedy:?} are not in:\n{said}");
        }
    }
    for (arguments, says) in [
        (&["good.csv"][..], "none of the 1 drops can be fitted; the first is `1`: no impact"),
        (&["good.csv", "--free", "k_m"], "write its table [effects.maxwell_branch] into the model file"),
        (&["good.csv", "--free", "k,x1_mm"], "the model has no parameter `x1_mm`; it has k, c"),
        (&["good.csv", "--free", "k,c,k"], "--free: k stands there twice"),
        (&["cognifly"], "name the drops"),
        (&["cognifly", "cognifly-v8", "good.csv"], "name one frame"),
        (&["good.csv", "--counts-per-g", "1,2"], "--counts-per-g takes three numbers"),
        (&["good.csv", "--bootstrap", "1000000"], "out of bounds: give 19 to 100000; or 0 for none"),
        (&["good.csv", "--bootstrap", "5"], "out of bounds: give 19 to 100000; or 0 for none"),
        (&["good.csv", "--objective", "best"], "possible values: ml, paper"),
    ] {
        let output = run("fit", place, arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(says), "{says:?} is not in:\n{said}");
    }
    assert!(!place.join("out").exists());
}

#[cfg(unix)]
#[test]
fn planted_a_device_that_never_ends_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("soft_050cm")).expect("a folder");
    std::os::unix::fs::symlink("/dev/zero", folder.path().join("soft_050cm/a.bin")).expect("can be linked");
    let output = run("measure", folder.path(), &["soft_050cm"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("a.bin is no file"), "{said}");
}
