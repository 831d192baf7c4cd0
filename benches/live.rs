//! How long one changed parameter takes in memory: `cargo bench --bench live`.
//!
//! Each parameter of the default frame is moved by a twentieth of its value, a twentieth of its bounds where it is 0, and back; what
//! is timed is the changed frame's design with every quick rule, on one thread. Parameters whose change is refused are counted.

use std::sync::Arc;
use std::time::Instant;

use flexframe::memo::Memo;
use flexframe::params::{Frame, FrameFile, parameters};
use flexframe::variant::Evaluation;

/// How far a parameter is moved.
const SHARE: f64 = 0.05;

/// One change: its key, whether it drives a flexible part, milliseconds, and how many steps were carried out.
struct Change {
    key: String,
    milliseconds: f64,
    steps: usize,
}

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the pool is not there yet");
    let file = FrameFile::load("cognifly").expect("a preset");
    let frame = Frame::resolve(&file).expect("a preset");
    let memo = Arc::new(Memo::default());
    let evaluate = |frame: Frame| Evaluation::quick(frame, &memo);
    let begun = Instant::now();
    evaluate(frame.clone()).expect("a preset is designed");
    println!("from nothing: {:.0} ms", milliseconds(begun));
    let (mut changes, mut refused) = (Vec::new(), 0);
    for parameter in parameters() {
        let key = format!("{}.{}", parameter.table, parameter.key);
        let Some(value) = frame.value(parameter.table, parameter.key) else { continue };
        let step = if value == 0.0 { SHARE * (parameter.max - parameter.min) } else { SHARE * value.abs() };
        let wanted = if value + step <= parameter.max { value + step } else { value - step };
        let mut changed = file.clone();
        changed.set_number(&key, wanted);
        let _ = memo.made();
        let begun = Instant::now();
        match Frame::resolve(&changed).map_err(drop).and_then(|frame| evaluate(frame).map_err(drop)) {
            Ok(_) => changes.push(Change { key, milliseconds: milliseconds(begun), steps: memo.made().values().sum() }),
            Err(()) => refused += 1,
        }
        evaluate(frame.clone()).expect("a preset is designed");
    }
    changes.sort_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds));
    let at = |share: f64| changes[((changes.len() - 1) as f64 * share).round() as usize].milliseconds;
    println!("{} parameters, {refused} refused: median {:.0} ms, 95 % below {:.0} ms", changes.len(), at(0.5), at(0.95));
    for Change { key, milliseconds, steps } in changes.iter().rev().take(SHOWN) {
        println!("{milliseconds:8.0} ms {steps:4} steps  {key}");
    }
}

/// How many of the slowest are listed.
const SHOWN: usize = 40;

fn milliseconds(begun: Instant) -> f64 {
    1e3 * begun.elapsed().as_secs_f64()
}
