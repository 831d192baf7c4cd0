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

/// Notes of `measure` about a table, in lines.
fn notes(text: &str, arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.csv"), text).expect("can be written");
    let read = measured(folder.path(), &[arguments, &["a.csv"]].concat());
    read["notes"].as_array().expect("a list").iter().filter_map(Value::as_str).collect::<Vec<_>>().join("\n")
}

#[test]
fn planted_a_slow_logger_is_told_and_no_unit_is_blamed() {
    for rate_hz in [200.0, 100.0, 50.0] {
        let text = table(HEAD, 1.0 / rate_hz, plain);
        let told = format!("the drops are sampled at {rate_hz}");
        let said = notes(&text, &[]);
        assert!(said.contains(&told) && said.contains("from 400 Hz on: use a faster sensor") && !said.contains("--units"), "{said}");
        assert!(refused(&text, "a.csv").contains(&told));
    }
    let text = table(HEAD, 1e-3, |sample| plain(&Sample { t_s: 1e3 * sample.t_s, ..*sample }));
    mended(text.as_bytes(), "a.csv", &["the times look like ms, not s: samples are 1.00 s apart"], "--units ms");
}

#[test]
fn planted_counts_of_a_sensor_are_told_and_read() {
    let text = table(HEAD, 1e-3, |sample| plain(&Sample { along_g: (20.5 * sample.along_g).round(), ..*sample }));
    let said = notes(&text, &[]);
    assert!(said.contains("the readings are too large") && said.contains("--units N/g"), "{said}");
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.csv"), text).expect("can be written");
    let read = measured(folder.path(), &["--units", "20.5/g", "a.csv"]);
    assert_eq!((&read["heights"][0]["clean"], &read["notes"]), (&Value::from(DROPS), &Value::Array(Vec::new())), "{read:#}");
    let refused = run("measure", folder.path(), &["--units", "0/g", "a.csv"]);
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(
        refused.status.code() == Some(2) && said.contains("--units `0/g`: the counts of a g are a number from 0.01 to 10000000"),
        "{said}"
    );
}

#[test]
fn planted_drops_at_another_rate_are_told_where_they_are_measured_and_left_out_of_a_fit() {
    let folder = tempfile::tempdir().expect("a folder");
    let slow = table(HEAD, 2e-3, |sample| plain(&Sample { trial: sample.trial + 100, ..*sample }));
    fs::write(folder.path().join("fast.csv"), table(HEAD, 1e-3, plain)).expect("can be written");
    fs::write(folder.path().join("slow.csv"), slow).expect("can be written");
    let read = measured(folder.path(), &["fast.csv", "slow.csv"]);
    let told = "5 of 10 drops from 0.5 m are sampled at another rate, 500 Hz instead of 1000 Hz";
    assert!(read["notes"].to_string().contains(told), "{:#}", read["notes"]);
    let fit = run("fit", folder.path(), &["--bootstrap", "0", "--json", "fast.csv", "slow.csv"]);
    let fit: Value = serde_json::from_slice(&fit.stdout).expect("JSON");
    assert_eq!((&fit["drops"], fit["left_out"].as_array().map(Vec::len)), (&Value::from(2 * DROPS), Some(2 * DROPS as usize)), "{fit:#}");
}

/// Drops from half a metre and from a metre in folders of other heights: each is told by `measure` and by `fit`, with the height of the falls.
#[test]
fn planted_drops_in_the_folder_of_another_height_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = table(HEAD, 1e-3, plain);
    let of = |height: &str, trial: u32| {
        let rows = text.lines().filter(|line| line.starts_with(&format!("{trial},{height},")));
        rows.map(|line| line.splitn(3, ',').nth(2).expect("has more").to_string() + "\n").collect::<String>()
    };
    for (height, place) in [("0.5", "soft_080cm"), ("1", "soft_130cm")] {
        fs::create_dir(folder.path().join(place)).expect("a folder");
        for trial in 0..DROPS {
            let rows = format!("t_s,accel_g\n{}", of(height, trial));
            fs::write(folder.path().join(place).join(format!("{trial}.csv")), rows).expect("can be written");
        }
    }
    for command in ["measure", "fit"] {
        let output = run(command, folder.path(), &["soft_080cm", "soft_130cm"]);
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        for told in
            ["from a stated 0.8 m lasted", "from a stated 1.3 m lasted", "it belongs to 0.49 m", "it belongs to 0.99 m", "wrong folder"]
        {
            assert!(said.contains(told), "{told} is not in:\n{said}{}", String::from_utf8_lossy(&output.stderr));
        }
    }
}

/// A person reads what mends a table before the list of all that is wrong with it; what many files have is said once.
#[test]
fn regress_notes_stand_before_flagged_records() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = table(&format!("{HEAD},volt"), 1e-3, |sample| plain(&Sample { along_g: -sample.along_g, ..*sample }).replace('\n', ",5\n"));
    for name in ["a.csv", "b.csv"] {
        let own = text.replace("\n0,", &format!("\n{name}0,"));
        fs::write(folder.path().join(name), own).expect("can be written");
    }
    let output = run("measure", folder.path(), &["a.csv", "b.csv"]);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let place = |part: &str| said.find(part).unwrap_or_else(|| panic!("{part} is not in:\n{said}"));
    assert!(place("note: the axis is inverted") < place("flagged  "), "{said}");
    assert_eq!(said.matches("columns left aside").count(), 1, "{said}");
    assert!(said.contains("note: 2 files, a.csv the first: columns left aside: volt"), "{said}");
}

#[test]
fn planted_stray_readings_are_told_and_change_no_fit() {
    let with = |stray: &dyn Fn(&Sample) -> Option<f64>| {
        let text = table(HEAD, 1e-3, |sample| plain(&Sample { along_g: stray(sample).unwrap_or(sample.along_g), ..*sample }));
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("a.csv"), text).expect("can be written");
        let notes = measured(folder.path(), &["a.csv"])["notes"].to_string();
        let fit = run("fit", folder.path(), &["--bootstrap", "0", "--json", "a.csv"]);
        assert_eq!(fit.status.code(), Some(0), "{}", String::from_utf8_lossy(&fit.stderr));
        let fit: Value = serde_json::from_slice(&fit.stdout).expect("JSON");
        (notes, fit["parameters"].clone())
    };
    let numbers = |parameters: &Value| -> Vec<f64> {
        parameters.as_object().expect("parameters").values().map(|parameter| parameter["value"].as_f64().expect("a number")).collect()
    };
    let (notes, plain) = with(&|_| None);
    assert_eq!(notes, "[]");
    let (notes, stray) = with(&|sample| (sample.at == 200).then_some(30.0));
    assert!(notes.contains("in 10 of 10 drops readings above 3 g are of no hit"), "{notes}");
    for (a, b) in numbers(&plain).iter().zip(numbers(&stray)) {
        assert!((a - b).abs() <= 0.02 * a.abs(), "{plain:#} {stray:#}");
    }
}
