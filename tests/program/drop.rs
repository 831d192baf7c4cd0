//! `flexframe drop` from outside.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use assert_cmd::cargo::cargo_bin;
use serde_json::Value;

fn drop(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(cargo_bin("flexframe"));
    command.arg("drop").args(arguments).arg("-o").arg(folder).env("NO_COLOR", "1");
    command.output().expect("the program starts")
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let output = drop(folder, &[arguments, &["--json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

#[test]
fn analytic_json_has_the_keys_that_others_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let result = json(folder.path(), &["--height", "0.3,2.62", "--trace"]);
    let heights = result["heights"].as_array().expect("a list");
    assert_eq!(heights.len(), 2);
    for height in heights {
        let keys: BTreeSet<&str> = height.as_object().expect("an object").keys().map(String::as_str).collect();
        let expected = ["height_m", "peak_coordinate_g", "peak_proper_g", "peak_sensor_g", "contact_time_ms", "max_displacement_mm"];
        assert_eq!(keys, expected.into_iter().chain(["energy", "t_s", "accel_g", "x_mm", "ground_n"]).collect());
        let t_s = height["t_s"].as_array().expect("a list");
        for series in ["t_s", "accel_g", "x_mm", "ground_n"] {
            assert_eq!(height[series].as_array().expect("a list").len(), 1201, "{series}");
        }
        assert!((t_s[1200].as_f64().expect("a number") - 0.06).abs() < 1e-12 && t_s[0] == 0.0 && height["accel_g"][0] == 0.0);
    }
    assert_eq!(result["body"]["from"], "model paper");
    assert_eq!((&result["body"]["mass_kg"], &result["body"]["gap_mm"]), (&Value::from(0.241), &Value::from(16.0)));
    let plain = json(folder.path(), &["--height", "1"]);
    assert!(plain["heights"][0].get("t_s").is_none());
}

#[test]
fn measured_a_frame_brings_its_mass_and_gap() {
    let folder = tempfile::tempdir().expect("a folder");
    let result = json(folder.path(), &["cognifly-v8", "--model", "paper-corrected", "--height", "1"]);
    assert_eq!(result["body"]["from"], "frame cognifly-v8");
    assert!((result["body"]["gap_mm"].as_f64().expect("a number") - 10.9).abs() < 0.05);
    assert!(folder.path().join("drop-paper-corrected-cognifly-v8/model.toml").exists());
    let table = drop(folder.path(), &["cognifly-v8", "--height", "1"]);
    let table = String::from_utf8_lossy(&table.stdout).into_owned();
    assert!(table.contains("mass 241.0 g and gap 10.9 mm of frame cognifly-v8"), "{table}");
    assert!(table.contains("the gap of 10.9 mm is used up"), "{table}");
}

#[test]
fn analytic_the_folder_is_whole_and_the_same_twice() {
    let folder = tempfile::tempdir().expect("a folder");
    let [once, again] = ["once", "again"].map(|name| folder.path().join(name));
    for place in [&once, &again] {
        let output = drop(place, &["--height", "0.5,1.5", "-q"]);
        assert_eq!((output.status.code(), output.stdout.len(), output.stderr.len()), (Some(0), 0, 0));
    }
    let charts = ["acceleration", "displacement", "energy", "peak"];
    let mut names: Vec<String> = charts.iter().flat_map(|chart| [format!("{chart}.svg"), format!("{chart}.png")]).collect();
    names.extend(["results.csv", "trace.csv", "samples.csv", "model.toml", "drop.json"].map(String::from));
    for name in &names {
        let read = |place: &Path| fs::read(place.join("drop-paper").join(name)).expect("was written");
        assert!(read(&once).len() > 100, "{name}");
        assert_eq!(read(&once), read(&again), "{name}");
    }
    assert_eq!(fs::read_dir(once.join("drop-paper")).expect("a folder").count(), names.len() + 1, "and the record of what was written");
    // The model that was written drops the same.
    let model = once.join("drop-paper/model.toml").display().to_string();
    let repeated = json(&again, &["--height", "0.5,1.5", "--model", &model]);
    let first: Value = serde_json::from_slice(&fs::read(once.join("drop-paper/drop.json")).expect("is there")).expect("JSON");
    assert_eq!(repeated["heights"], first["heights"]);
}

#[test]
fn planted_mistakes_exit_2_and_write_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path().join("out");
    let model = folder.path().join("model.toml").display().to_string();
    let paper = include_str!("../../params/impact/paper.toml");
    let cases: [(&str, &str); 3] = [
        (&paper.replace("7040.0", "1e9"), "the nearest allowed value is 1000000 N/m"),
        (&format!("{paper}\n[effects.sensor_gian]\ngain = 1.1\n"), "did you mean `sensor_gain`"),
        ("", "`sensor.order` is not stated"),
    ];
    for (text, says) in cases {
        fs::write(&model, text).expect("can be written");
        let output = drop(&place, &["--model", &model]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(says), "{says:?} is not in:\n{said}");
    }
    for (arguments, says) in [
        (&["--height", "nan"][..], "out of bounds: give 0.01 to 100 m"),
        (&["--height", "-1"], "unexpected argument"),
        (&["--height", "1,x"], "invalid"),
        (&["--model", "papr"], "there is no model `papr`"),
        (&["--model", "absent.toml"], "cannot read absent.toml"),
        (&["--rigid", "pla"], "required"),
        (&["--fit", "drops.csv"], "--fit goes with --model frame"),
        (&["--tilt", "5,0"], "--tilt goes with --model frame"),
        (&["--model", "frame"], "--model frame needs a frame"),
        (&["cognifly", "--model", "frame", "--tilt", "40,0"], "out of bounds: give -30 to 30 °"),
        (&["cognifly", "--model", "frame", "--tilt", "5"], "two angles"),
        (&["cognifly", "--model", "frame", "--fit", "absent.csv"], "absent.csv"),
    ] {
        let output = drop(&place, arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(says), "{says:?} is not in:\n{said}");
    }
    assert!(!place.exists());
}

/// What hangs lower than the feet hits the ground first: its gap is none, not one that is used up on the way back.
#[test]
fn planted_a_battery_below_the_feet_hits_the_ground_with_the_first_touch() {
    let folder = tempfile::tempdir().expect("a folder");
    let own = folder.path().join("hanging.toml");
    for (height_mm, gap) in [(28.0, "0.0 mm"), (30.0, "0.0 mm")] {
        fs::write(&own, format!("base = \"cognifly\"\nbattery.battery_height_mm = {height_mm:?}\n")).expect("can be written");
        let output = drop(folder.path(), &[own.to_str().expect("UTF-8"), "--model", "paper-corrected", "--height", "1.5"]);
        let told = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
        assert!(told.contains(&format!("gap of {gap} is used up after 0.00 ms at 5.4")), "{height_mm}: {told}");
    }
}
