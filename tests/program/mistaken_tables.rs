//! Tables with a mistake that the program recognises: it is told with an option, and the option mends it.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use assert_cmd::cargo::cargo_bin;
use serde_json::Value;

/// Drops of a height.
const DROPS: u32 = 5;
/// The frame is held so long before the fall, and recorded so long from first touch on, s.
const HELD_S: f64 = 0.06;
const BEHIND_S: f64 = 0.08;
/// The impact is half a sine of this length, s, with an impulse of so many v0.
const IMPACT_S: f64 = 0.012;
const OVER_V0: f64 = 1.3;
const GRAVITY_M_S2: f64 = 9.81;

/// A sample of a drop as a good sensor measures it.
struct Sample {
    trial: u32,
    height_m: f64,
    at: u32,
    t_s: f64,
    /// Along the axis, and across it, g.
    along_g: f64,
    across_g: f64,
}

/// The rows of drops from 0.5 and 1 m, each sample as it is written.
fn table(head: &str, step_s: f64, row: impl Fn(&Sample) -> String) -> String {
    let mut text = format!("{head}\n");
    for (height_m, trial) in [0.5_f64, 1.0].into_iter().flat_map(|height_m| (0..DROPS).map(move |trial| (height_m, trial))) {
        let fall_s = (2.0 * height_m / GRAVITY_M_S2).sqrt();
        let touch_s = HELD_S + fall_s;
        let top_g = OVER_V0 * (1.0 + 0.01 * f64::from(trial)) * fall_s * std::f64::consts::FRAC_PI_2 / IMPACT_S;
        for at in 0..((touch_s + BEHIND_S) / step_s) as u32 {
            let t_s = f64::from(at) * step_s;
            let angle = (t_s - touch_s) / IMPACT_S * std::f64::consts::PI;
            let hits = (0.0..std::f64::consts::PI).contains(&angle);
            let rests_g = if (HELD_S..touch_s + IMPACT_S).contains(&t_s) { 0.0 } else { 1.0 };
            let noise_g = 0.1 * (f64::from((7 * at + 3 * trial) % 11) - 5.0) / 5.0;
            let (along_g, across_g) = if hits { (top_g * libm::sin(angle), 20.0 * libm::sin(2.0 * angle)) } else { (rests_g, 0.0) };
            text += &row(&Sample { trial, height_m, at, t_s, along_g: along_g + noise_g, across_g: across_g + noise_g });
        }
    }
    text
}

fn run(command: &str, folder: &Path, arguments: &[&str]) -> Output {
    let mut program = Command::new(cargo_bin("flexframe"));
    program.arg(command).args(arguments).arg("-o").arg(folder.join("out")).current_dir(folder).env("NO_COLOR", "1");
    program.output().expect("the program starts")
}

fn measured(folder: &Path, arguments: &[&str]) -> Value {
    let output = run("measure", folder, &[arguments, &["--json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// A table is measured with a note that has every part of `told`, in which the option stands, and with the option all is clean and
/// fitted, and the note is gone.
fn mended(text: &[u8], name: &str, told: &[&str], option: &str) -> Value {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::write(folder.join(name), text).expect("can be written");
    let before = measured(folder, &[name]);
    let notes = before["notes"].as_array().expect("a list").iter().filter_map(Value::as_str).collect::<Vec<_>>().join("\n");
    for part in told.iter().chain([&option]) {
        assert!(notes.contains(part), "{part:?} is not in:\n{notes}\n{:#}", before["drops"]);
    }
    let options: Vec<&str> = option.split(' ').chain(["--bootstrap", "0", name]).collect();
    let after = measured(folder, &[&options[..options.len() - 3], &[name]].concat());
    for height in after["heights"].as_array().expect("a list") {
        assert_eq!((&height["clean"], &height["drops"]), (&Value::from(DROPS), &Value::from(DROPS)), "{after:#}");
        let fall_s = (2.0 * height["height_m"].as_f64().expect("a number") / GRAVITY_M_S2).sqrt();
        assert!((height["fall_s"]["median"].as_f64().expect("a number") - fall_s).abs() < 0.01, "{height:#}");
        assert!((height["impulse_over_v0"]["median"].as_f64().expect("a number") - 1.35).abs() < 0.05, "{height:#}");
    }
    assert!(!after["notes"].to_string().contains(told[0]), "{:#}", after["notes"]);
    let fit = run("fit", folder, &options);
    assert_eq!(fit.status.code(), Some(0), "{}", String::from_utf8_lossy(&fit.stderr));
    before
}

/// What `fit` says where it refuses a table.
fn refused(text: &str, name: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join(name), text).expect("can be written");
    let output = run("fit", folder.path(), &[name]);
    assert_eq!(output.status.code(), Some(2), "{}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn plain(sample: &Sample) -> String {
    let Sample { trial, height_m, t_s, along_g, .. } = sample;
    format!("{trial},{height_m},{t_s:.6},{along_g:.3}\n")
}

const HEAD: &str = "trial,height_m,t_s,accel_g";

#[test]
fn planted_an_exchanged_axis_is_told_with_its_columns() {
    for (sign, option) in [(1.0, "--columns a=x,x=z,z=x"), (-1.0, "--columns a=-x,x=z,z=-x")] {
        let text = table(&format!("{HEAD},x,y,z"), 1e-3, |sample| {
            let Sample { trial, height_m, t_s, along_g, across_g, .. } = sample;
            format!("{trial},{height_m},{t_s:.6},{across_g:.3},{:.3},0,{across_g:.3}\n", sign * along_g)
        });
        mended(text.as_bytes(), "a.csv", &["the axis carries no impulse"], option);
        assert!(refused(&text, "a.csv").contains(option));
    }
}

#[test]
fn planted_an_offset_in_free_fall_is_told_and_taken_off() {
    let moved = |[x, y, along]: [f64; 3]| {
        table(&format!("{HEAD},x,y"), 1e-3, |sample| {
            let Sample { trial, height_m, t_s, along_g, across_g, .. } = sample;
            format!("{trial},{height_m},{t_s:.6},{:.3},{:.3},{:.3}\n", along_g + along, across_g + x, 0.5 * across_g + y)
        })
    };
    let lone = table(HEAD, 1e-3, |sample| plain(&Sample { along_g: sample.along_g - 1.0, ..*sample }));
    mended(lone.as_bytes(), "a.csv", &["0.5 m: the reading in free fall is -1.00 g", "gravity was taken off"], "--zero=-1.00");
    let text = moved([0.4, -0.3, 2.0]);
    mended(text.as_bytes(), "a.csv", &["1 m: the reading in free fall is 2.00 g", "the sensor's zero is off"], "--zero=0.40,-0.30,2.00");
    let said = refused(&text, "a.csv");
    assert!(said.contains("none of the 10 drops can be fitted") && said.contains("--zero=0.40,-0.30,2.00"), "{said}");
    // What a sensor's zero drifts by is reported, and is no note.
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.csv"), moved([-0.2, 0.1, 0.2])).expect("can be written");
    assert_eq!(measured(folder.path(), &["a.csv"])["notes"], Value::Array(Vec::new()));
    let output = run("measure", folder.path(), &["--zero", "1,2", "a.csv"]);
    assert!(output.status.code() == Some(2) && String::from_utf8_lossy(&output.stderr).contains("--zero takes one number"));
}

#[test]
fn planted_rounded_and_jittering_stamps_are_told_with_the_rate() {
    let rounded = table(HEAD, 1.0 / 3200.0, |sample| plain(&Sample { t_s: (sample.t_s * 1e3).round() * 1e-3, ..*sample }));
    let said = refused(&rounded, "a.csv");
    assert!(said.contains("time does not ascend") && said.contains("--rate HZ") && !said.contains("sort the rows"), "{said}");
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.csv"), rounded).expect("can be written");
    let clean = measured(folder.path(), &["--rate", "3200", "a.csv"])["heights"][0]["clean"].clone();
    assert_eq!(clean, Value::from(DROPS));

    let late_s = |at: u32| if at % 50 == 20 { 0.6e-3 } else { 0.0 };
    let jitters = table(HEAD, 1e-3, |sample| plain(&Sample { t_s: sample.t_s + late_s(sample.at), ..*sample }));
    let before = mended(jitters.as_bytes(), "a.csv", &["the time stamps of 10 of 10 drops jitter"], "--rate 1000");
    assert_eq!(before["heights"][0]["flags"]["wrong_sample_rate"], DROPS, "{before:#}");
    assert!(refused(&jitters, "a.csv").contains("--rate 1000"));
}

#[test]
fn planted_heights_in_centimetres_are_told_and_no_clock_is_blamed() {
    let text = table(HEAD, 1e-3, |sample| plain(&Sample { height_m: 100.0 * sample.height_m, ..*sample }));
    let before = mended(text.as_bytes(), "a.csv", &["the heights look like cm"], "--units cm");
    let flags = before["drops"].to_string();
    assert!(!flags.contains("clock_stall") && !flags.contains("usual"), "{flags}");
    assert!(refused(&text, "a.csv").contains("--units cm"));
    let millimetres = table(HEAD, 1e-3, |sample| plain(&Sample { height_m: 1e3 * sample.height_m, ..*sample }));
    assert!(refused(&millimetres, "a.csv").contains("--units mm"));
}

/// Readings that were divided by 9.81 once too often are neither a drop nor evidence for an effect; a saturated sensor shows little, too.
#[test]
fn planted_readings_that_are_far_too_small_are_told_and_refused() {
    let small = table(HEAD, 1e-3, |sample| plain(&Sample { along_g: sample.along_g / 9.81, ..*sample }));
    assert!(refused(&small, "a.csv").contains("the readings are too small, or the heights too large: the impulse is 0.1"));
    let cut_off = table(HEAD, 1e-3, |sample| plain(&Sample { along_g: sample.along_g.min(4.0), ..*sample }));
    assert!(!refused(&cut_off, "a.csv").contains("too small"));
}

#[test]
fn planted_one_axis_is_no_magnitude() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.csv"), table(HEAD, 1e-3, plain)).expect("can be written");
    for options in [&["--channel", "magnitude"][..], &["--objective", "paper", "--model", "paper"]] {
        let output = run("fit", folder.path(), &[options, &["--bootstrap", "0", "a.csv"]].concat());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && said.contains("10 of the 10 drops have one axis only: give --channel axial"), "{said}");
    }
}

#[test]
fn planted_tables_of_spreadsheets_are_named_or_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = table(HEAD, 1e-3, plain);
    let bytes: Vec<u8> = format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    fs::write(folder.path().join("a.csv"), bytes).expect("can be written");
    for command in ["measure", "fit"] {
        let output = run(command, folder.path(), &["a.csv"]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && said.contains("a.csv is UTF-16 (little-endian) text"), "{said}");
        assert!(said.contains("save it as UTF-8"), "{said}");
    }
    let tabs = text.replace(',', "\t").replace('.', ",");
    fs::create_dir(folder.path().join("drops")).expect("a folder");
    fs::write(folder.path().join("drops/a.tsv"), tabs).expect("can be written");
    for path in ["drops", "drops/a.tsv"] {
        assert_eq!(measured(folder.path(), &[path])["heights"][1]["clean"], Value::from(DROPS));
    }
}
