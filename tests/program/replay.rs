//! The inputs that are kept, read again: `fuzz/corpus` holds those that reach much of a reader, `fuzz/regressions` those that a
//! reader once failed on. A watchdog stands beside: an input that takes too long is named, and the test ends.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use crate::readers::{READERS, Reader, prepared};

/// Longest that one input may take, and all of them together: both end what hangs, and measure nothing.
const LONGEST: Duration = Duration::from_secs(30);
const LONGEST_OF_ALL: Duration = Duration::from_secs(600);
/// Most bytes of what is kept for a reader.
const MOST_BYTES: u64 = 100_000;

/// The files of a folder, by name; none where there is no such folder.
pub fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("is there").path()).filter(|path| path.is_file()).collect();
    paths.sort();
    paths
}

/// The inputs of a reader that are kept as `corpus` or as `regressions`.
pub fn inputs(kind: &str, reader: &Reader) -> Vec<PathBuf> {
    files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz").join(kind).join(reader.name))
}

/// Reads every kept input, and says before each which it is.
fn read_all(next: &mpsc::Sender<PathBuf>) {
    for reader in &READERS {
        for path in ["corpus", "regressions"].into_iter().flat_map(|kind| inputs(kind, reader)) {
            let bytes = fs::read(&path).expect("reads");
            if next.send(path).is_err() {
                return;
            }
            (reader.read)(&bytes);
        }
    }
}

#[test]
fn regress_every_kept_input_is_read_in_time() {
    READERS.iter().for_each(|reader| prepared(reader.name));
    let (next, told) = mpsc::channel();
    let reading = thread::spawn(move || read_all(&next));
    let (begun, mut count, mut now) = (Instant::now(), 0, PathBuf::new());
    loop {
        match told.recv_timeout(LONGEST) {
            Ok(path) => (count, now) = (count + 1, path),
            Err(RecvTimeoutError::Timeout) => panic!("{} takes longer than {LONGEST:?}", now.display()),
            Err(RecvTimeoutError::Disconnected) => break,
        }
        assert!(begun.elapsed() < LONGEST_OF_ALL, "the inputs take longer than {LONGEST_OF_ALL:?}; {} was next", now.display());
    }
    assert!(reading.join().is_ok(), "{} is not read as it should be; the panic above says why", now.display());
    println!("{count} inputs in {:?}", begun.elapsed());
    assert!(count > 100, "only {count} inputs");
}

#[test]
fn analytic_every_reader_has_a_target_and_a_small_corpus() {
    let names: BTreeSet<String> = READERS.iter().map(|reader| reader.name.to_string()).collect();
    assert_eq!(names.len(), READERS.len());
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz");
    let stem = |path: &PathBuf| path.file_stem().expect("has a name").to_string_lossy().into_owned();
    assert_eq!(files(&root.join("fuzz_targets")).iter().map(stem).collect::<BTreeSet<_>>(), names);
    let text = fs::read_to_string(root.join("Cargo.toml")).expect("is there");
    let package: toml::Table = toml::from_str(&text).expect("is TOML");
    let bins = package["bin"].as_array().expect("a list").iter().map(|bin| bin["name"].as_str().expect("a name").to_string());
    assert_eq!(bins.collect::<BTreeSet<_>>(), names);
    for reader in &READERS {
        let bytes: u64 = inputs("corpus", reader).iter().map(|path| fs::metadata(path).expect("is there").len()).sum();
        assert!((1..=MOST_BYTES).contains(&bytes), "{}: {bytes} bytes are kept", reader.name);
    }
}
