//! What other programs read of measured and simulated drops: the keys of each document.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use assert_cmd::cargo::cargo_bin;
use serde_json::Value;

/// Nine drops each from two heights, three axes, whole records.
const PLAN: &str = "mass_kg = 0.241\ngap_mm = 16.0\n[sensor]\ncutoff_hz = 500.0\norder = 1\nlimit_g = 230.0\nchannel = \"axial\"\n\
    [effects.linear_spring]\nk = 7040.0\n[effects.linear_damper]\nc = 25.0\n[drops]\nheights_m = [0.5, 1.0]\ncount = 9\nseed = 3\n\
    [logger]\nrecord_s = 1.2\n[landing]\ntouch_g = 70.0\n";

/// Every path to a value, with `[]` for the members of a list.
fn paths(value: &Value, at: &str, all: &mut BTreeSet<String>) {
    match value {
        Value::Object(members) => members.iter().for_each(|(key, value)| paths(value, &format!("{at}.{key}"), all)),
        Value::Array(members) if !members.is_empty() => members.iter().for_each(|value| paths(value, &format!("{at}[]"), all)),
        _ => {
            all.insert(at.trim_start_matches('.').to_string());
        }
    }
}

/// What a command prints with `--json`, exit codes 0 and 1 being good.
fn keys(folder: &Path, arguments: &[&str]) -> String {
    let output = Command::new(cargo_bin("flexframe"))
        .current_dir(folder)
        .args(arguments)
        .args(["--json", "-o", "out"])
        .output()
        .expect("the program starts");
    assert!(output.status.code().is_some_and(|code| code < 2), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    let mut all = BTreeSet::new();
    paths(&serde_json::from_slice(&output.stdout).expect("JSON"), "", &mut all);
    all.into_iter().collect::<Vec<_>>().join("\n")
}

#[test]
fn regress_json_keeps_its_keys() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::write(folder.join("plan.toml"), PLAN).expect("can be written");
    let synthesize = Command::new(cargo_bin("flexframe")).current_dir(folder).args(["synthesize", "plan.toml", "-o", "."]).output();
    assert!(synthesize.expect("the program starts").status.success());
    let drops = "synthesize-plan/drops";
    insta::assert_snapshot!("measure_keys", keys(folder, &["measure", drops]));
    insta::assert_snapshot!("fit_keys", keys(folder, &["fit", "--model", "paper-corrected", "--bootstrap", "0", drops]));
    insta::assert_snapshot!("diagnose_keys", keys(folder, &["diagnose", "--max-effects", "1", drops]));
    // Drops with lateral axes are compared with the model of the axis.
    assert!(folder.join("out/diagnose-paper-corrected/model.toml").exists());
    insta::assert_snapshot!("drop_frame_keys", keys(folder, &["drop", "cognifly-v8", "--model", "frame", "--height", "0.5"]));
    insta::assert_snapshot!("stiffness_keys", keys(folder, &["stiffness", "cognifly-v8"]));
}
