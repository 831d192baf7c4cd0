//! Whether a search finds what is known to exist, and how long it takes: `cargo bench --bench search [-- TASKS]`.
//!
//! A task hides a frame that keeps every limit: a preset with the bought parts of another one and with rods and motors moved at
//! random, seeds fixed. The search gets the preset with these parts and the hidden frame's size and mass, each with hardly any room,
//! and knows nothing of the numbers. What is told: solved or not, frames until the first that keeps the quick rules, frames in all,
//! seconds, seconds of processor time where the system says them, and the mass beside the hidden one.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use flexframe::checks::Verdict;
use flexframe::frame::assembly::Design;
use flexframe::params::frame_file::Value;
use flexframe::params::{Frame, FrameFile, preset};
use flexframe::variant::{Evaluation, Request, create, measure};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// How many tasks without a word on the command line.
const TASKS: usize = 40;
/// Room beside the hidden frame's size, mm, and mass, g.
const ROOM: [f64; 2] = [0.2, 0.3];
/// How many frames the search may look at.
const MOST: usize = 150;
/// What is moved to hide a frame, in shares of its value at the most.
const MOVED: [(&str, f64); 4] = [
    ("rods.cage_rod_length_mm", 0.12),
    ("rods.arm_rod_length_mm", 0.12),
    ("rods.strut_rod_length_mm", 0.08),
    ("motor_mount.motor_position_mm", 0.08),
];

struct Hidden {
    preset: &'static str,
    parts: &'static str,
    file: FrameFile,
    size_mm: [f64; 2],
    mass_g: f64,
}

fn main() {
    let tasks = std::env::args().filter_map(|word| word.parse().ok()).next().unwrap_or(TASKS);
    let mut random = Pcg64::seed_from_u64(18);
    let (mut solved, mut seconds, mut processor) = (0, Vec::new(), Vec::new());
    for task in 0..tasks {
        let hidden = hide(&mut random);
        let from = Frame::resolve(&FrameFile::load(hidden.preset).expect("a preset")).expect("a preset");
        let mut file = hidden.file.clone();
        for (key, value) in
            [("envelope_width_mm", hidden.size_mm[0]), ("envelope_height_mm", hidden.size_mm[1]), ("mass_budget_g", hidden.mass_g)]
        {
            file.set_number(&format!("limits.{key}"), value);
        }
        let (begun, begun_processor_s, first) = (Instant::now(), processor_s(), AtomicUsize::new(0));
        let follows = |progress: &flexframe::variant::SearchProgress| {
            if progress.best.is_some() {
                let _ = first.compare_exchange(0, progress.looked_at, Ordering::SeqCst, Ordering::SeqCst);
            }
            ControlFlow::Continue(())
        };
        let [width_mm, height_mm] = hidden.size_mm;
        let found = create(&Request {
            file: &file,
            from: &from,
            envelope_mm: Some([width_mm, width_mm, height_mm]),
            vary: &[],
            most: MOST,
            follows: &follows,
        });
        let (took_s, took_processor_s) = (begun.elapsed().as_secs_f64(), processor_s() - begun_processor_s);
        let task = format!("{task:3} {:<16} with parts of {:<16}", hidden.preset, hidden.parts);
        match found {
            Ok(found) => {
                solved += 1;
                let first = first.load(Ordering::SeqCst);
                println!(
                    "{task} first after {first:3}, {:3} frames, {took_s:6.1} s, {took_processor_s:6.1} processor s, {:.2} of {:.2} g",
                    found.looked_at, found.evaluation.masses.total_g, hidden.mass_g
                );
            }
            Err(error) => println!("{task} {took_s:6.1} s: {error}"),
        }
        seconds.push(took_s);
        processor.push(took_processor_s);
    }
    println!("{solved} of {tasks} solved, {}, {} of processor time", middle_and_most(seconds), middle_and_most(processor));
}

/// The median and the most of some seconds.
fn middle_and_most(mut seconds: Vec<f64>) -> String {
    seconds.sort_by(f64::total_cmp);
    format!("median {:.1} s, longest {:.1} s", seconds[seconds.len() / 2], seconds[seconds.len() - 1])
}

/// Processor time of this process so far, s, to a hundredth; NaN where the system is not Linux.
fn processor_s() -> f64 {
    let said = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // After the program's name in brackets the 12th and 13th figures are hundredths of a second, of the program's and of the system's code.
    let figures = said.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11).take(2);
    let hundredths: Vec<f64> = figures.filter_map(|figure| figure.parse().ok()).collect();
    if hundredths.len() == 2 { 0.01 * hundredths.iter().sum::<f64>() } else { f64::NAN }
}

/// A frame that keeps every limit, and its size and mass with hardly any room.
fn hide(random: &mut Pcg64) -> Hidden {
    let names: Vec<&'static str> = preset::names().collect();
    loop {
        let [preset, parts] = [(); 2].map(|()| names[random.random_range(0..names.len())]);
        let mut file = FrameFile::load(preset).expect("a preset");
        let other = Frame::resolve(&FrameFile::load(parts).expect("a preset")).expect("a preset");
        for role in ["battery", "propeller", "motor"] {
            if let Some(item) = other.bought.get(role) {
                file.ask(&format!("bought.{role}"), Value::Text(item.name.clone()), "the task".into());
            }
        }
        let own = Frame::resolve(&FrameFile::load(preset).expect("a preset")).expect("a preset");
        let mut moved = file.clone();
        for (key, reach) in MOVED {
            let (table, name) = key.split_once('.').expect("a key with its table");
            let value = own.value(table, name).expect("a number") * (1.0 + random.random_range(-reach..reach));
            moved.set_number(key, (value * 1000.0).round() / 1000.0);
        }
        for key in ["limits.envelope_width_mm", "limits.envelope_height_mm", "limits.mass_budget_g"] {
            moved.set_number(key, 400.0);
        }
        let evaluation = Frame::resolve(&moved).ok().and_then(|frame| Design::new(frame).ok()).map(Evaluation::of);
        let keeps = |evaluation: &Evaluation| evaluation.findings.iter().all(|finding| finding.verdict != Verdict::Violated);
        let Some(evaluation) = evaluation.filter(keeps) else { continue };
        let of = |name: &str| measure(name).and_then(|measure| measure.of(&evaluation)).expect("a figure");
        let size_mm = [of("envelope.width").max(of("envelope.depth")) + ROOM[0], of("envelope.height") + ROOM[0]];
        return Hidden { preset, parts, file, size_mm, mass_g: of("mass") + ROOM[1] };
    }
}
