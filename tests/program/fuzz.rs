//! Every reader against input that nobody would write, for a bounded time: it may refuse, it may not panic or hang.
//!
//! `FLEXFRAME_FUZZ_S` says for how many seconds each reader is tried (2 unless set); how many inputs that were is printed.
//! Inputs are made from files that read, by changes of bytes, tokens and lines, and from nothing; the seed is fixed, so a longer
//! run repeats a shorter one and goes on.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use flexframe::checks::gate::Baseline;
use flexframe::impact::effects::Model;
use flexframe::impact::measured::{FileFormat, read};
use flexframe::impact::synthetic::Plan;
use flexframe::params::{Frame, FrameFile, ImpactFile};
use flexframe::variant::{Goal, Increase};
use proptest::prelude::Rng;
use proptest::test_runner::{RngAlgorithm, TestRng};

/// Longest that one input may take.
const LONGEST: Duration = Duration::from_secs(5);

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

/// Tries a reader until its time is over; how many inputs it was given, and how many of them it took.
fn tried(name: &str, seed: u8, seeds: &[Vec<u8>], reader: impl Fn(&[u8]) -> bool) {
    let seconds = std::env::var("FLEXFRAME_FUZZ_S").ok().and_then(|text| text.parse().ok()).unwrap_or(2.0);
    let (begun, mut source) = (Instant::now(), Source::new(seed));
    let (mut inputs, mut taken) = (0_u64, 0_u64);
    while begun.elapsed().as_secs_f64() < seconds {
        let input = source.input(seeds);
        let start = Instant::now();
        let Ok(good) = catch_unwind(AssertUnwindSafe(|| reader(&input))) else {
            panic!("{name} panics on input {inputs}: {:?}", String::from_utf8_lossy(&input));
        };
        assert!(start.elapsed() < LONGEST, "{name} took {:?} for input {inputs}: {:?}", start.elapsed(), String::from_utf8_lossy(&input));
        inputs += 1;
        taken += u64::from(good);
    }
    println!("{name}: {inputs} inputs, {taken} of them read");
    assert!(inputs > 20, "{name}: only {inputs} inputs");
}

fn files(folder: &str) -> Vec<Vec<u8>> {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut paths: Vec<_> = fs::read_dir(root).expect("is there").map(|entry| entry.expect("is there").path()).collect();
    paths.sort();
    paths.into_iter().filter(|path| path.is_file()).map(|path| fs::read(path).expect("reads")).collect()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn planted_frame_files() {
    let mut seeds = files("params/frames");
    seeds.push(b"base = \"cognifly\"\n[override.parts.mine]\nkind = \"battery\"\nsize_mm = [1.0, 2.0, 3.0]\nmass_g = 3\nmass_basis = \"measured\"\nsource = \"s\"\n[bought]\nbattery = \"mine\"\n[extras.x]\nmass_g = 1\nmass_basis = \"estimate\"\nsource = \"s\"\nposition_mm = [0, 0, 0]\ncovers = [\"tie\"]\n".to_vec());
    tried("frame files", 1, &seeds, |bytes| match FrameFile::parse("fuzz.toml", &text(bytes)) {
        Ok(file) => Frame::resolve(&file).map_err(|refusal| refusal.render()).is_ok(),
        Err(error) => {
            let _ = error.to_string();
            false
        }
    });
}

#[test]
fn planted_models_and_plans() {
    tried("impact models", 2, &files("params/impact"), |bytes| {
        ImpactFile::parse("fuzz.toml", &text(bytes)).and_then(|file| Model::resolve(&file)).map_err(|refusal| refusal.render()).is_ok()
    });
    tried("plans", 3, &files("params/synthetic"), |bytes| {
        ImpactFile::parse("fuzz.toml", &text(bytes)).and_then(|file| Plan::resolve(&file)).map_err(|refusal| refusal.render()).is_ok()
    });
}

#[test]
fn planted_lists_and_goals() {
    let list = b"{\n  \"schema_version\": 1,\n  \"accepted\": [{\"frame\": \"a\", \"rule\": \"r\", \"subject\": \"s\", \"margin\": -1.5, \"unit\": \"g\"}]\n}\n";
    tried("lists of accepted findings", 4, &[list.to_vec()], |bytes| Baseline::parse(&text(bytes)).is_ok());
    let goals = [b"clearance.propeller>=3mm".to_vec(), b"mass<=240g".to_vec(), b"mass=2g".to_vec()];
    tried("goals", 5, &goals, |bytes| Goal::parse(&text(bytes)).is_ok() | Increase::parse(&text(bytes)).is_ok());
}

#[test]
fn planted_records_of_drops() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = folder.path().join("soft_050cm");
    fs::create_dir(&place).expect("can be made");
    let reader = |name: &str| {
        let path = place.join(name);
        move |bytes: &[u8]| {
            fs::write(&path, bytes).expect("can be written");
            read(std::slice::from_ref(&path), &FileFormat::default()).map_err(|malformed| malformed.to_string()).is_ok()
        }
    };
    let rows: String = (0..60).map(|at| format!("1,0.5,{:.3},{:.2}\n", f64::from(at) * 1e-3, 1.0 + f64::from(at % 7))).collect();
    tried("tables of drops", 6, &[format!("trial,height_m,t_s,accel_g\n{rows}").into_bytes()], reader("a.csv"));
    let counts: Vec<u8> = (0..60_u32).flat_map(|at| [&(1000 * at).to_le_bytes()[..], &[0, 8, 0, 8, 0, 8]].concat()).collect();
    tried("files of the logger", 7, &[counts], reader("a.bin"));
}
