//! Every reader against input that nobody would write, for a bounded time: it may refuse, it may not panic or hang.
//!
//! `FLEXFRAME_FUZZ_S` says for how many seconds each reader is tried (2 unless set); how many inputs that were is printed.
//! Inputs are made from files that read, by changes of bytes, tokens and lines, and from nothing; the seed is fixed, so a longer
//! run repeats a shorter one and goes on. The targets of `fuzz/` try the same readers, guided by what of the program an input reaches.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use proptest::prelude::Rng;
use proptest::test_runner::{RngAlgorithm, TestRng};
use rayon::prelude::*;

use crate::readers::{READERS, Reader, prepared};
use crate::replay;

/// Longest that one input may take.
const LONGEST: Duration = Duration::from_secs(60);
/// Fewest inputs of a reader, however slow the machine is.
const FEWEST: u64 = 20;

/// What stands in files that read, and what is at the edge of what can be read.
const TOKENS: [&str; 43] = [
    "base",
    "=",
    "\"cognifly\"",
    "[rods]",
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    ",",
    ".",
    "\n",
    "\r\n",
    "#",
    "'''",
    "\"\"\"",
    "\\u0000",
    "\\UFFFFFFFF",
    "nan",
    "-inf",
    "1e999",
    "-0.0",
    "1e-320",
    "9223372036854775807",
    "0x7fffffffffffffff",
    "0b1",
    "1_000",
    "1979-05-27",
    "true",
    "[override.parts.x]",
    "[extras.x]",
    "mass_g",
    "covers",
    "[target]",
    "width_mm",
    "é",
    "\u{0}",
    "\u{feff}",
    "\u{2028}",
    "<=",
    ">=",
    "mass",
];

struct Source {
    rng: TestRng,
}

impl Source {
    fn new(seed: u8) -> Self {
        Self { rng: TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]) }
    }

    fn below(&mut self, most: usize) -> usize {
        (self.rng.next_u64() % most.max(1) as u64) as usize
    }

    /// A file with a few changes, or tokens, or bytes.
    fn input(&mut self, seeds: &[Vec<u8>]) -> Vec<u8> {
        match self.below(8) {
            0 => (0..self.below(200)).map(|_| self.rng.next_u32() as u8).collect(),
            1 => (0..self.below(60)).flat_map(|_| format!("{} ", TOKENS[self.below(TOKENS.len())]).into_bytes()).collect(),
            _ => {
                let mut bytes = seeds[self.below(seeds.len())].clone();
                for _ in 0..=self.below(6) {
                    self.change(&mut bytes);
                }
                bytes
            }
        }
    }

    fn change(&mut self, bytes: &mut Vec<u8>) {
        let at = self.below(bytes.len() + 1);
        match self.below(7) {
            0 if !bytes.is_empty() => {
                let at = at.min(bytes.len() - 1);
                bytes[at] ^= 1 << self.below(8);
            }
            1 => drop(bytes.splice(at..at, TOKENS[self.below(TOKENS.len())].bytes())),
            2 => bytes.truncate(at),
            3 => drop(bytes.drain(at..(at + self.below(40)).min(bytes.len()))),
            4 => {
                let piece: Vec<u8> = bytes[at..(at + self.below(200)).min(bytes.len())].to_vec();
                let to = self.below(bytes.len() + 1);
                bytes.splice(to..to, piece);
            }
            5 => {
                // A number becomes another.
                let digits: Vec<usize> = (0..bytes.len()).filter(|at| bytes[*at].is_ascii_digit()).collect();
                if !digits.is_empty() {
                    let at = digits[self.below(digits.len())];
                    bytes.splice(at..=at, TOKENS[19 + self.below(8)].bytes());
                }
            }
            _ => {
                let line = bytes[at..].iter().position(|b| *b == b'\n').map_or(bytes.len(), |end| at + end + 1);
                let copy = bytes[at..line].to_vec();
                bytes.splice(line..line, copy);
            }
        }
    }
}

/// Tries a reader until its time is over; says how many inputs it was given, and how many of them it took.
fn tried(at: usize, reader: &Reader) {
    let name = reader.name;
    let seconds = std::env::var("FLEXFRAME_FUZZ_S").ok().and_then(|text| text.parse().ok()).unwrap_or(2.0);
    let seeds = seeds(reader);
    prepared(name);
    let (begun, mut source) = (Instant::now(), Source::new(at as u8));
    let (mut inputs, mut taken) = (0_u64, 0_u64);
    while begun.elapsed().as_secs_f64() < seconds || inputs <= FEWEST {
        let input = source.input(&seeds);
        let start = Instant::now();
        let Ok(good) = catch_unwind(AssertUnwindSafe(|| (reader.read)(&input))) else {
            panic!("{name} panics on input {inputs}: {:?}", String::from_utf8_lossy(&input));
        };
        assert!(start.elapsed() < LONGEST, "{name} took {:?} for input {inputs}: {:?}", start.elapsed(), String::from_utf8_lossy(&input));
        inputs += 1;
        taken += u64::from(good);
    }
    println!("{name}: {inputs} inputs, {taken} of them read");
}

/// What is kept of a reader's inputs, and the files of its kind that come with the program.
fn seeds(reader: &Reader) -> Vec<Vec<u8>> {
    let shipped = match reader.name {
        "frame_files" | "amended_frames" => "params/frames",
        "impact_models" => "params/impact",
        "synthetic_plans" => "params/synthetic",
        "study_plans" => "examples/studies",
        _ => "params/static",
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files: Vec<PathBuf> = replay::inputs("corpus", reader);
    files.extend(replay::files(&root.join(shipped)));
    files.iter().map(|path| fs::read(path).expect("reads")).collect()
}

#[test]
fn planted_every_reader_on_random_inputs() {
    READERS.par_iter().enumerate().for_each(|(at, reader)| tried(at + 1, reader));
}
