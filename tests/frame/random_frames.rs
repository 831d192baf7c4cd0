//! Random parameter sets, valid and invalid, with fixed seeds.

use crate::common;
use crate::simulators;
use std::collections::BTreeMap;
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};

use assert_cmd::cargo::cargo_bin;
use flexframe::checks::{self, Verdict};
use flexframe::frame::assembly::{Design, mass};
use flexframe::frame::skeleton::Skeleton;
use flexframe::params::{Frame, LoadError, parameters};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use rayon::prelude::*;

/// How many of each.
const FRAMES: usize = 200;

/// Presets that the sets start from.
pub(crate) const BASES: [&str; 6] = ["cognifly", "cognifly-v8", "cognifly-1106", "cognifly-bamboo", "cognifly-mini", "cognifly-2s2000"];

/// A source of numbers that are the same in every run.
fn runner(seed: u8) -> TestRunner {
    TestRunner::new_with_rng(Config::default(), TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]))
}

pub(crate) fn drawn<S: Strategy>(strategy: S, runner: &mut TestRunner) -> S::Value {
    strategy.new_tree(runner).expect("a strategy without a filter").current()
}

/// Changes about one parameter in so many, by up to `reach` of the way from the base's value to its bounds. Limits stay.
pub(crate) fn changes(base: &Frame, one_in: u32, reach: f64, runner: &mut TestRunner) -> Vec<(String, f64)> {
    let mut changed = Vec::new();
    for p in parameters().filter(|p| p.table != "limits") {
        let (lot, way) = drawn((0..one_in, -reach..reach), runner);
        let Some(value) = base.value(p.table, p.key).filter(|_| lot == 0) else { continue };
        let room = if way > 0.0 { p.max - value } else { value - p.min };
        changed.push((format!("{}.{}", p.table, p.key), ((value + way * room) * 1000.0).round() / 1000.0));
    }
    changed
}

/// Draws sets until enough of them are frames that are not refused and whose rods close; counts why others were.
fn valid_frames() -> (Vec<(String, Frame)>, BTreeMap<String, usize>) {
    let mut runner = runner(1);
    let (mut frames, mut refused) = (Vec::new(), BTreeMap::new());
    for base in BASES.iter().cycle() {
        let text = common::toml(base, &changes(&common::resolve(&common::toml(base, &[])).expect("a preset"), 6, 0.5, &mut runner));
        let remedy = match common::resolve(&text) {
            Ok(frame) => match Skeleton::new(&frame) {
                Ok(_) => {
                    frames.push((text, frame));
                    None
                }
                Err(error) => Some(error.remedy()),
            },
            Err(LoadError::Refused(refusal)) => Some(refusal.reason.remedy()),
            Err(other) => panic!("{other}\n{text}"),
        };
        if let Some(remedy) = remedy {
            *refused.entry(remedy).or_insert(0) += 1;
        }
        if frames.len() == FRAMES {
            break;
        }
    }
    (frames, refused)
}

/// What is wrong with a frame that was accepted. A design exists only when every part has passed the export gate, flat
/// and folded: closed, one body, no facets that cross. Its model for simulators has its masses and shapes.
fn faults(frame: &Frame, opened: &AtomicUsize) -> Vec<String> {
    let design = match Design::new(frame.clone()) {
        Ok(design) => design,
        Err(error) => return vec![error.to_string()],
    };
    let seating: Vec<_> = checks::CATALOGUE.into_iter().filter(|rule| rule.id == "socket_seating").collect();
    let seats = checks::check_by(&seating, checks::Cost::Slow, &design, &mass::table(&design));
    assert!(seats.len() >= 56, "every rod end is looked at");
    // How far a rod has to reach in is a limit of the frame file, not a matter of being seated; walls that notch and window open are looked at apart.
    let is_told = |f: &&checks::Finding| ["engagement", "wall"].iter().any(|what| f.subject.ends_with(what));
    let unseated = seats.iter().filter(|f| f.verdict == Verdict::Violated && !is_told(f));
    let is_open = |f: &checks::Finding| f.verdict == Verdict::Violated && f.subject.ends_with("wall");
    opened.fetch_add(usize::from(seats.iter().any(is_open)), Ordering::Relaxed);
    unseated.map(|f| f.message.clone()).chain(simulators::faults_of(&design)).collect()
}

/// As many of the frames as `FLEXFRAME_SOUND_FRAMES` says: a design takes one to two seconds of processor time.
#[test]
fn analytic_random_frames_are_sound_and_seated() {
    let wanted = std::env::var("FLEXFRAME_SOUND_FRAMES").ok().and_then(|text| text.parse().ok()).unwrap_or(60);
    let (mut frames, refused) = valid_frames();
    frames.truncate(wanted);
    println!("{} accepted; refused meanwhile: {refused:#?}", frames.len());
    let opened = AtomicUsize::new(0);
    let bad: Vec<String> = frames
        .par_iter()
        .map(|(text, frame)| (faults(frame, &opened), text))
        .filter(|(faults, _)| !faults.is_empty())
        .map(|(faults, text)| format!("{}\n{text}", faults.join("\n")))
        .collect();
    assert!(bad.is_empty(), "{} of {} frames are faulty:\n{}", bad.len(), frames.len(), bad.join("\n"));
    // A window near the struts' axes opens their bores, which the rule tells; of sixty frames one.
    let opened = opened.into_inner();
    assert!(20 * opened <= frames.len().max(20), "{opened} of {} frames have bores that are open at the side", frames.len());
}

/// Moves nearly every parameter by up to this share of its value: as harmless as a change can be.
const NUDGE: f64 = 0.03;

/// Nudges all but one parameter in sixteen, within its bounds. Limits stay.
fn nudges(base: &Frame, runner: &mut TestRunner) -> Vec<(String, f64)> {
    let mut changed = Vec::new();
    for p in parameters().filter(|p| p.table != "limits") {
        let (lot, way) = drawn((0..16u32, -NUDGE..NUDGE), runner);
        let Some(value) = base.value(p.table, p.key).filter(|_| lot > 0) else { continue };
        changed.push((format!("{}.{}", p.table, p.key), ((value * (1.0 + way)).clamp(p.min, p.max) * 1e4).round() / 1e4));
    }
    changed
}

/// Frames a little beside the presets, as many as `FLEXFRAME_NUDGED` says: each that the relations of the parameters allow, and
/// whose rods close, can be made.
#[test]
fn analytic_nudged_frames_can_be_made() {
    let wanted: usize = std::env::var("FLEXFRAME_NUDGED").ok().and_then(|text| text.parse().ok()).unwrap_or(8);
    let mut runner = runner(3);
    let (mut frames, mut refused) = (Vec::new(), BTreeMap::new());
    for base in BASES.iter().cycle() {
        let text = common::toml(base, &nudges(&common::resolve(&common::toml(base, &[])).expect("a preset"), &mut runner));
        match common::resolve(&text) {
            Ok(frame) if Skeleton::new(&frame).is_ok() => frames.push((text, frame)),
            Ok(_) => *refused.entry("the rods do not close".to_string()).or_insert(0) += 1,
            Err(error) => *refused.entry(error.to_string()).or_insert(0) += 1,
        }
        if frames.len() >= wanted {
            break;
        }
    }
    println!("{} accepted; refused meanwhile: {refused:#?}", frames.len());
    let made = |(text, frame): &(String, Frame)| Design::new(frame.clone()).err().map(|error| format!("{error}\n{text}"));
    let bad: Vec<String> = frames.par_iter().filter_map(made).collect();
    assert!(bad.is_empty(), "{} of {} frames cannot be made:\n{}", bad.len(), frames.len(), bad.join("\n"));
}

/// A frame file with one mistake in it, and what the answer has to contain.
struct Mistake {
    text: String,
    says: String,
}

/// One of a list.
fn pick<'a, T>(from: &'a [T], runner: &mut TestRunner) -> &'a T {
    &from[drawn(0..from.len(), runner)]
}

/// A key with a letter lost, doubled, or two swapped.
fn misspelt(key: &str, runner: &mut TestRunner) -> String {
    let mut letters: Vec<char> = key.chars().collect();
    let at = drawn(0..letters.len() - 1, runner);
    match drawn(0..3u32, runner) {
        0 => drop(letters.remove(at)),
        1 => letters.insert(at, letters[at]),
        _ if letters[at] != letters[at + 1] => letters.swap(at, at + 1),
        _ => letters.push('s'),
    }
    letters.into_iter().collect()
}

/// What may be wrong with a number.
fn wrong_number(runner: &mut TestRunner) -> Mistake {
    let all: Vec<_> = parameters().collect();
    let p = pick(&all, runner);
    let base = pick(&BASES, runner);
    let key = format!("{}.{}", p.table, p.key);
    let beyond = drawn(0.001..10.0, runner) * (1.0 + p.max - p.min);
    let (line, says) = match drawn(0..9u32, runner) {
        0 => {
            let wrong = misspelt(p.key, runner);
            (format!("{}.{wrong} = {:?}", p.table, p.min), wrong)
        }
        1 => (format!("{}.{} = 1.0", misspelt(p.table, runner), p.key), "unknown".into()),
        2 => (format!("{key} = {}", pick(&["\"3\"", "true", "[1.0]", "1979-05-27"], runner)), "must be a number".into()),
        3 => (format!("{key} = {}", pick(&["nan", "inf", "-inf", "-nan"], runner)), p.key.into()),
        4 => (format!("{key} = {:?}", p.max + beyond), format!("{}", p.max)),
        5 => (format!("{key} = {:?}", p.min - beyond), format!("{}", p.min)),
        6 => (format!("{key} = {:?}\n{key} = {:?}", p.min, p.max), "duplicate".into()),
        7 => (format!("{key} = {{ mm = 3.0 }}"), format!("unknown key `{key}.mm`")),
        _ => (format!("{key} = {}", pick(&["", "3,5", "3 mm", "= 3", "3.", "0x", "\"3"], runner)), "frame.toml:2".into()),
    };
    Mistake { text: format!("base = \"{base}\"\n{line}\n"), says }
}

/// What may be wrong with a name.
fn wrong_name(runner: &mut TestRunner) -> Mistake {
    let (key, right) = *pick(
        &[
            ("printer", "generic-0.4"),
            ("materials.flexible", "tpu-95a"),
            ("materials.rigid", "abs"),
            ("bought.motor", "motor-1104"),
            ("bought.battery", "battery-2s-2000"),
            ("bought.rod", "rod-carbon-3"),
            ("bought.propeller", "propeller-3-inch"),
        ],
        runner,
    );
    let wrong = misspelt(right, runner);
    Mistake { text: format!("base = \"{}\"\n{key} = \"{wrong}\"\n", pick(&BASES, runner)), says: wrong }
}

/// Numbers each of which may be as it is, but not together: rods too short to close.
fn does_not_close(runner: &mut TestRunner) -> Mistake {
    let cage_rod = drawn(250.0..320.0, runner);
    let strut_rod = drawn(20.0..40.0, runner);
    let text = format!("base = \"cognifly\"\nrods.cage_rod_length_mm = {cage_rod:.3}\nrods.strut_rod_length_mm = {strut_rod:.3}\n");
    Mistake { text, says: "rod".into() }
}

fn mistake(runner: &mut TestRunner) -> Mistake {
    match drawn(0..10u32, runner) {
        0 | 1 => wrong_name(runner),
        2 => does_not_close(runner),
        3 => {
            let wrong = misspelt(pick::<&str>(&BASES, runner), runner);
            Mistake { text: format!("base = \"{wrong}\"\n"), says: wrong }
        }
        _ => wrong_number(runner),
    }
}

/// What is wrong with the program's answer to a mistake; nothing when it is as it should be.
fn answer(mistake: &Mistake) -> Option<String> {
    let folder = tempfile::tempdir().expect("a folder");
    let (frame, out) = (folder.path().join("frame.toml"), folder.path().join("out"));
    std::fs::write(&frame, &mistake.text).expect("can be written");
    let answer = Command::new(cargo_bin("flexframe")).arg("build").arg(&frame).arg("-o").arg(&out).output().expect("the program starts");
    let said = String::from_utf8_lossy(&answer.stderr);
    let right = answer.status.code() == Some(2)
        && answer.stdout.is_empty()
        && !out.exists()
        && said.contains("frame.toml")
        && said.contains(&mistake.says)
        && !said.contains("panicked");
    (!right).then(|| format!("exit {:?}, should say {:?}:\n{}{said}", answer.status.code(), mistake.says, mistake.text))
}

#[test]
fn planted_random_mistakes_are_refused_with_a_diagnostic() {
    let mut runner = runner(2);
    let mistakes: Vec<Mistake> = (0..FRAMES).map(|_| mistake(&mut runner)).collect();
    let wrong: Vec<String> = mistakes.par_iter().filter_map(answer).collect();
    assert!(wrong.is_empty(), "{} of {FRAMES} answers are wrong:\n{}", wrong.len(), wrong.join("\n"));
}
