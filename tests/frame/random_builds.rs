//! Random frames as a build meets them: each is made, or refused in words of its parameters.
//!
//! `FLEXFRAME_RANDOM_FRAMES` says how many (18 unless set) and `FLEXFRAME_RANDOM_SEED` which. With `FLEXFRAME_RANDOM_STLS`, the
//! meshes of every part, as it is printed and as it is folded, are written below that folder, for `tests/external/random_frames.py`.

use crate::common;
use crate::random_frames::{BASES, changes};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use flexframe::export::stl;
use flexframe::frame::assembly::Design;
use flexframe::params::{FrameFile, LoadError, PartName};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use rayon::prelude::*;

/// One parameter in so many is changed, by up to this share of the way to its bounds: a few by anything, some, nearly all by a little.
const DRAWS: [(u32, f64); 3] = [(24, 1.0), (6, 0.5), (1, 0.05)];

/// Words of a mesh: a frame file has none of them.
const WORDS_OF_MESHES: [&str; 6] = ["facet", "mesh", "edge", "corner near", "B-rep", "volume"];

/// What became of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Fate {
    Made,
    /// Its file is refused: numbers that do not go together.
    Refused,
    /// It cannot be designed: its rods do not close, or a part cannot be.
    NotDesigned,
}

fn setting(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(otherwise)
}

/// The text of a frame, the same whenever it is asked for.
fn text(seed: u64, at: u64) -> String {
    let mut state = [0; 32];
    state[..8].copy_from_slice(&seed.to_le_bytes());
    state[8..16].copy_from_slice(&at.to_le_bytes());
    let mut runner = TestRunner::new_with_rng(Config::default(), TestRng::from_seed(RngAlgorithm::ChaCha, &state));
    let base = BASES[at as usize % BASES.len()];
    let (one_in, reach) = DRAWS[at as usize / BASES.len() % DRAWS.len()];
    common::toml(base, &changes(&common::resolve(&common::toml(base, &[])).expect("a preset"), one_in, reach, &mut runner))
}

/// What becomes of a frame, and what is wrong with that.
fn fate(text: &str, folder: Option<&Path>) -> (Fate, Option<String>) {
    let frame = match common::resolve(text) {
        Ok(frame) => frame,
        Err(LoadError::Refused(refusal)) => return (Fate::Refused, unclear(&refusal.message(), &refusal.remedy())),
        Err(other) => return (Fate::Refused, Some(other.to_string())),
    };
    match Design::new(frame) {
        Ok(design) => {
            let written = folder.map(|folder| write(&design, folder));
            (Fate::Made, written.and_then(Result::err).map(|error| error.to_string()))
        }
        Err(error) => {
            let refusal = error.refusal(&FrameFile::parse("random", text).expect("was read before"));
            (Fate::NotDesigned, unclear(&refusal.message(), &refusal.remedy()))
        }
    }
}

/// A refusal that speaks of meshes, or names no parameter.
fn unclear(message: &str, remedy: &str) -> Option<String> {
    let foreign = WORDS_OF_MESHES.into_iter().find(|word| message.contains(word));
    let names = flexframe::params::parameters().any(|p| message.contains(p.key) || remedy.contains(p.key));
    (foreign.is_some() || !names).then(|| format!("{message}; {remedy}"))
}

fn write(design: &Design, folder: &Path) -> std::io::Result<()> {
    fs::create_dir_all(folder)?;
    let printed = design.printed.iter().map(|part| (format!("{}.stl", part.name), &*part.mesh));
    let folded = design.shapes.iter().filter(|shape| PartName::ALL.iter().any(|name| name.slug() == shape.name));
    let folded = folded.map(|shape| (format!("{}_folded.stl", shape.name), &*shape.mesh));
    printed.chain(folded).try_for_each(|(name, mesh)| fs::write(folder.join(name), stl::binary(mesh)?))
}

#[test]
fn analytic_random_frames_are_made_or_refused_in_words() {
    let (frames, seed) = (setting("FLEXFRAME_RANDOM_FRAMES", 18), setting("FLEXFRAME_RANDOM_SEED", 1));
    let stls = std::env::var_os("FLEXFRAME_RANDOM_STLS").map(PathBuf::from);
    let of = |at: u64| {
        let text = text(seed, at);
        let folder = stls.as_ref().map(|stls| stls.join(format!("{seed}-{at}")));
        let (fate, wrong) = fate(&text, folder.as_deref());
        (fate, wrong.map(|wrong| format!("frame {at} of seed {seed}, {fate:?}: {wrong}\n{text}")))
    };
    let all: Vec<(Fate, Option<String>)> = (0..frames).into_par_iter().map(of).collect();
    let mut fates: BTreeMap<Fate, usize> = BTreeMap::new();
    all.iter().for_each(|(fate, _)| *fates.entry(*fate).or_default() += 1);
    println!("{frames} frames of seed {seed}: {fates:?}");
    let wrong: Vec<&str> = all.iter().filter_map(|(_, wrong)| wrong.as_deref()).collect();
    assert!(wrong.is_empty(), "{} of {frames} frames:\n{}", wrong.len(), wrong.join("\n"));
    assert!(fates.get(&Fate::Made).is_some_and(|made| *made * 6 >= frames as usize), "hardly any can be made: {fates:?}");
}
