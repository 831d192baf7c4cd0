//! Random parameter sets, valid and invalid, with fixed seeds.

mod common;

use std::collections::BTreeMap;

use flexframe::assembly::{Design, DesignError, mass};
use flexframe::checks::{self, Verdict};
use flexframe::params::{Frame, LoadError, parameters};
use flexframe::solid::gate;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use rayon::prelude::*;

/// How many of each.
const FRAMES: usize = 200;

/// Presets that the sets start from.
const BASES: [&str; 6] = ["cognifly", "cognifly-v8", "cognifly-1106", "cognifly-bamboo", "cognifly-mini", "cognifly-2s2000"];

/// A source of numbers that are the same in every run.
fn runner(seed: u8) -> TestRunner {
    TestRunner::new_with_rng(Config::default(), TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]))
}

fn drawn<S: Strategy>(strategy: S, runner: &mut TestRunner) -> S::Value {
    strategy.new_tree(runner).expect("a strategy without a filter").current()
}

/// Changes about one parameter in six, by up to `reach` of the way from the base's value to its bounds. Limits stay.
fn changes(base: &Frame, reach: f64, runner: &mut TestRunner) -> Vec<(String, f64)> {
    let mut changed = Vec::new();
    for p in parameters().filter(|p| p.table != "limits") {
        let (lot, way) = drawn((0..6u32, -reach..reach), runner);
        let Some(value) = base.value(p.table, p.key).filter(|_| lot == 0) else { continue };
        let room = if way > 0.0 { p.max - value } else { value - p.min };
        changed.push((format!("{}.{}", p.table, p.key), ((value + way * room) * 1000.0).round() / 1000.0));
    }
    changed
}

/// Draws sets until enough of them are frames that are not refused; counts why others were.
fn valid_frames() -> (Vec<(String, Frame)>, BTreeMap<String, usize>) {
    let mut runner = runner(1);
    let (mut frames, mut refused) = (Vec::new(), BTreeMap::new());
    for base in BASES.iter().cycle() {
        let text = common::toml(base, &changes(&common::resolve(&common::toml(base, &[])).expect("a preset"), 0.5, &mut runner));
        match common::resolve(&text) {
            Ok(frame) => frames.push((text, frame)),
            Err(LoadError::Refused(refusal)) => *refused.entry(refusal.reason.remedy()).or_insert(0) += 1,
            Err(other) => panic!("{other}\n{text}"),
        }
        if frames.len() == 2 * FRAMES {
            break;
        }
    }
    (frames, refused)
}

/// What is wrong with a frame that was accepted; `None` when its rods do not close, which is a refusal.
fn faults(frame: &Frame) -> Option<Vec<String>> {
    let design = match Design::new(frame.clone()) {
        Ok(design) => design,
        Err(DesignError::Closure(_)) => return None,
        Err(other) => return Some(vec![other.to_string()]),
    };
    let mut faults = Vec::new();
    for part in &design.printed {
        if let Err(error) = gate::pass(&part.mesh) {
            faults.push(format!("{}: {error}", part.name));
        }
        if let Err(error) = gate::pass(&part.folded.to_mesh()) {
            faults.push(format!("{} folded: {error}", part.name));
        }
    }
    let findings = checks::check(&design, &mass::table(&design));
    let seats: Vec<_> = findings.iter().filter(|f| f.rule == "socket_seating").collect();
    assert!(seats.len() >= 56, "every rod end is looked at");
    // How far a rod has to reach in is a limit of the frame file, not a matter of being seated.
    let unseated = seats.iter().filter(|f| f.verdict == Verdict::Violated && !f.subject.ends_with("engagement"));
    faults.extend(unseated.map(|f| f.message.clone()));
    Some(faults)
}

#[test]
fn analytic_random_frames_are_sound_and_seated() {
    let (frames, refused) = valid_frames();
    let found: Vec<(usize, Vec<String>)> =
        frames.par_iter().enumerate().filter_map(|(index, (_, frame))| faults(frame).map(|faults| (index, faults))).collect();
    let closing = found.iter().take(FRAMES).count();
    println!("{closing} of {} accepted sets close; refused before: {refused:#?}", frames.len());
    assert_eq!(closing, FRAMES, "too few of the drawn sets close");
    let bad: Vec<String> = found
        .iter()
        .filter(|(_, faults)| !faults.is_empty())
        .map(|(index, faults)| format!("{}\n{}", faults.join("\n"), frames[*index].0))
        .collect();
    assert!(bad.is_empty(), "{} of {} frames are faulty:\n{}", bad.len(), found.len(), bad.join("\n"));
}
