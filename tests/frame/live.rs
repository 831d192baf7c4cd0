//! A frame that is changed again and again with what was computed before, against the same frame made from nothing.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use flexframe::checks::{CATALOGUE, Cost, Finding};
use flexframe::frame::assembly::mass::{self, MassTable};
use flexframe::frame::assembly::{Design, DesignError};
use flexframe::memo::{Key, Memo, Storage};
use flexframe::params::frame_file::Value;
use flexframe::params::parameter::Parameter;
use flexframe::params::{Frame, FrameFile, parameters, preset};
use flexframe::{checks, solid::Mesh};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use rayon::prelude::*;

/// Changes, over all walks.
const STEPS: usize = 500;
/// Walks, each from another preset or another seed.
const WALKS: usize = 10;
/// Every so many steps the frame is made from nothing, too; `FLEXFRAME_LIVE_EVERY=1` does it at each. What a step takes wrongly from
/// before stays wrong until its inputs change again, so most faults outlive some steps.
const EVERY: usize = 20;
/// Every so many steps memory is emptied, and only the storage is left.
const FORGOTTEN: usize = 24;
/// How far from its value towards a bound a parameter is moved at most.
const REACH: f64 = 0.2;

/// How many of a hundred changes are of a word instead of a number.
const WORDED: f64 = 25.0;
/// Words that keys take; one that a frame cannot have is refused there.
const CHOICES: [(&str, &[&str]); 11] = [
    ("printer", &["prusa-mini", "ender-3", "generic-0.4"]),
    ("materials.flexible", &["tpu-85a", "tpu-95a", "tpu-98a"]),
    ("materials.rigid", &["abs", "petg", "pla"]),
    ("sleeve.sleeve_direction", &["along", "across"]),
    ("bought.rod", &["rod-carbon-2", "rod-carbon-3", "rod-bamboo-3"]),
    ("bought.motor", &["motor-1104", "motor-1106", "motor-1404"]),
    ("bought.battery", &["battery-3s-450", "battery-3s-650", "battery-2s-850"]),
    ("bought.propeller", &["propeller-3-inch", "propeller-65mm"]),
    ("bought.computer", &["none", "pi-zero-w"]),
    ("bought.gps", &["none", "gps-22x20"]),
    ("bought.receiver", &["none", "receiver-nano"]),
];

/// A storage in memory.
#[derive(Clone, Default)]
struct InMemory(Arc<Mutex<BTreeMap<Key, Vec<u8>>>>);

impl Storage for InMemory {
    fn read(&self, key: &Key) -> Option<Vec<u8>> {
        self.0.lock().expect("no thread ended").get(key).cloned()
    }

    fn write(&self, key: &Key, bytes: &[u8]) {
        self.0.lock().expect("no thread ended").insert(*key, bytes.to_vec());
    }
}

/// All that follows from a frame: every finding, every mass, every mesh, flat and in its place.
#[derive(PartialEq)]
struct Whole {
    findings: Vec<Finding>,
    masses: MassTable,
    printed: Vec<Arc<Mesh>>,
    placed: Vec<Arc<Mesh>>,
}

fn whole(frame: Frame, memo: &Arc<Memo>, dearest: Cost) -> Result<Whole, DesignError> {
    let design = Design::with(frame, memo)?;
    let masses = mass::table(&design);
    let findings = checks::check_by(&CATALOGUE, dearest, &design, &masses);
    let printed = design.printed.iter().map(|part| part.mesh.clone()).collect();
    let placed = design.shapes.iter().map(|shape| shape.mesh.clone()).collect();
    Ok(Whole { findings, masses, printed, placed })
}

/// A key and another value for it, a word or a number; none where the number has no room.
fn change(frame: &Frame, drawn: &mut dyn FnMut(f64, f64) -> f64) -> Option<(String, Value)> {
    let mut among = |count: usize| drawn(0.0, count as f64) as usize;
    if (among(100) as f64) < WORDED {
        let (key, words) = CHOICES[among(CHOICES.len())];
        return Some((key.into(), Value::Text(words[among(words.len())].into())));
    }
    let all: Vec<&Parameter> = parameters().collect();
    let parameter = all[among(all.len())];
    let value = moved(parameter, frame, drawn(-1.0, 1.0))?;
    Some((format!("{}.{}", parameter.table, parameter.key), Value::Number(value)))
}

/// A parameter's new value.
fn moved(parameter: &Parameter, frame: &Frame, way: f64) -> Option<f64> {
    let value = frame.value(parameter.table, parameter.key)?;
    let room = if way > 0.0 { parameter.max - value } else { value - parameter.min };
    Some(((value + REACH * way * room) * 1000.0).round() / 1000.0)
}

/// Walks from a preset; what differed.
fn walk(seed: u8, every: usize) -> Vec<String> {
    let names: Vec<&str> = preset::names().collect();
    let mut file = FrameFile::load(names[usize::from(seed) % names.len()]).expect("a preset");
    let mut runner = TestRunner::new_with_rng(Config::default(), TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]));
    let mut drawn = |low: f64, high: f64| (low..high).new_tree(&mut runner).expect("a range").current();
    let storage = InMemory::default();
    let memo = || Arc::new(Memo::on(Box::new(storage.clone())));
    let mut hot = memo();
    let mut wrong = Vec::new();
    for step in 1..=STEPS / WALKS {
        let frame = Frame::resolve(&file).expect("was accepted");
        let Some((key, value)) = change(&frame, &mut drawn) else { continue };
        let mut changed = file.clone();
        changed.set(&key, value);
        let Ok(frame) = Frame::resolve(&changed) else { continue };
        if step % FORGOTTEN == 0 {
            hot = memo();
        }
        // The slow rules are part of half of the walks, before what is compared, too.
        let dearest = if seed.is_multiple_of(2) && step.is_multiple_of((every / 2).max(1)) { Cost::Slow } else { Cost::Quick };
        let warm = whole(frame.clone(), &hot, dearest);
        if step % every == 0 {
            match (&warm, &whole(frame, &Arc::default(), dearest)) {
                (Ok(warm), Ok(cold)) if warm == cold => {}
                (Err(warm), Err(cold)) if warm.to_string() == cold.to_string() => {}
                (Ok(warm), Ok(cold)) => {
                    let findings = warm.findings.iter().zip(&cold.findings).filter(|(a, b)| a != b).map(|(a, b)| format!("{a:?}\n{b:?}"));
                    wrong.push(format!("seed {seed}, step {step}, {key}:\n{}", findings.take(3).collect::<Vec<_>>().join("\n")));
                }
                (warm, cold) => {
                    let [warm, cold] = [warm, cold].map(|result| result.as_ref().err().map(ToString::to_string));
                    wrong.push(format!("seed {seed}, step {step}, {key}: {warm:?} and {cold:?}"));
                }
            }
        }
        if warm.is_ok() {
            file = changed;
        }
    }
    wrong
}

#[test]
fn analytic_a_changed_frame_is_that_made_from_nothing() {
    let every = std::env::var("FLEXFRAME_LIVE_EVERY").ok().and_then(|every| every.parse().ok()).unwrap_or(EVERY);
    let wrong: Vec<String> = (0..WALKS as u8).into_par_iter().flat_map_iter(|seed| walk(seed, every)).collect();
    assert!(wrong.is_empty(), "{} differ:\n{}", wrong.len(), wrong.join("\n"));
}
