//! Same input, same bytes; and a result folder is always a whole one.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use assert_cmd::cargo::cargo_bin;
use sha2::Digest;
use tempfile::TempDir;

/// Two frames of one name that differ.
const FRAMES: [&str; 2] = ["base = \"cognifly\"\n", "base = \"cognifly\"\n[corner]\ncorner_wall_mm = 1.8\n"];

fn builder(frame: &Path, out: &Path, more: &[&str]) -> Command {
    let mut command = Command::new(cargo_bin("flexframe"));
    command.arg("build").arg(frame).arg("-o").arg(out).args(more).stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// Every file of a folder, by its path below it.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    fn walk(root: &Path, folder: &Path, found: &mut BTreeMap<String, Vec<u8>>) {
        for entry in fs::read_dir(folder).expect("can be read") {
            let path = entry.expect("can be read").path();
            if path.is_dir() {
                walk(root, &path, found);
            } else {
                let below = path.strip_prefix(root).expect("is below").to_string_lossy().into_owned();
                found.insert(below, fs::read(&path).expect("can be read"));
            }
        }
    }
    let mut found = BTreeMap::new();
    walk(folder, folder, &mut found);
    found
}

fn sha256(bytes: &[u8]) -> String {
    sha2::Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Whether the files are those that their manifest lists, each with its hash.
fn is_whole(files: &BTreeMap<String, Vec<u8>>) -> bool {
    let Some(Ok(manifest)) = files.get("manifest.json").map(|bytes| serde_json::from_slice::<serde_json::Value>(bytes)) else {
        return false;
    };
    let Some(listed) = manifest["files"].as_array() else { return false };
    let right =
        |file: &serde_json::Value| files.get(file["path"].as_str()?).map(|bytes| Some(sha256(bytes).as_str()) == file["sha256"].as_str());
    listed.len() + 1 == files.len() && listed.iter().all(|file| right(file) == Some(true))
}

/// A folder with a frame file and a place for its result.
struct Bench(TempDir);

impl Bench {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder"))
    }

    /// The command that builds a frame file of this text.
    fn build(&self, text: &str, more: &[&str]) -> Command {
        let frame = self.0.path().join("frame.toml");
        fs::write(&frame, text).expect("can be written");
        builder(&frame, &self.0.path().join("out"), more)
    }

    fn result(&self) -> BTreeMap<String, Vec<u8>> {
        files(&self.0.path().join("out/frame"))
    }

    /// What lies beside the result: what a run writes before it is whole.
    fn beside(&self) -> usize {
        let entries = fs::read_dir(self.0.path().join("out")).expect("was made");
        entries.filter(|entry| entry.as_ref().is_ok_and(|entry| entry.file_name() != "frame")).count()
    }
}

#[test]
fn analytic_the_same_frame_gives_the_same_bytes_on_one_thread_and_on_two() {
    let results = ["1", "2"].map(|threads| {
        let bench = Bench::new();
        let status = bench.build(FRAMES[1], &[]).env("RAYON_NUM_THREADS", threads).status();
        assert!(status.expect("starts").success());
        bench.result()
    });
    let [one, two] = &results;
    assert!(is_whole(one) && one.len() > 30, "{} files", one.len());
    assert_eq!(one.keys().collect::<Vec<_>>(), two.keys().collect::<Vec<_>>());
    let differing: Vec<&String> = one.iter().filter(|(path, bytes)| two[*path] != **bytes).map(|(path, _)| path).collect();
    assert!(differing.is_empty(), "{differing:?}");
}

#[test]
fn planted_refused_frames_leave_the_last_result_and_nothing_else() {
    let bench = Bench::new();
    assert!(bench.build(FRAMES[0], &["--no-pictures"]).status().expect("starts").success());
    let before = bench.result();
    assert!(is_whole(&before));
    for refused in [
        "base = \"cognifly\"\n[rods]\ncage_rod_length_mm = 1.0\n",
        "base = \"cognifly\"\n[rods]\narm_rod_length_mm = 150.0\n",
        "base = \"cognifly\"\n[motor_mount]\nmotor_position_mm = 31.0\n",
        "not toml",
    ] {
        assert_eq!(bench.build(refused, &[]).status().expect("starts").code(), Some(2));
        assert!(bench.result() == before, "{refused}");
        assert_eq!(bench.beside(), 0, "{refused}");
    }
}

/// When a run is killed.
enum Kill {
    /// This long after its start.
    AfterStart(Duration),
    /// This long after it began to write.
    AfterFirstByte(Duration),
}

fn kill(mut child: Child, bench: &Bench, beside: usize, when: &Kill) {
    match when {
        Kill::AfterStart(wait) => sleep(*wait),
        Kill::AfterFirstByte(wait) => {
            let deadline = Instant::now() + Duration::from_secs(60);
            while bench.beside() == beside && child.try_wait().expect("is ours").is_none() && Instant::now() < deadline {
                sleep(Duration::from_micros(50));
            }
            sleep(*wait);
        }
    }
    // It may be through already.
    let _ = child.kill();
    child.wait().expect("ends");
}

#[test]
fn planted_killed_runs_leave_a_whole_result() {
    let bench = Bench::new();
    let good = FRAMES.map(|frame| {
        assert!(bench.build(frame, &["--no-pictures"]).status().expect("starts").success());
        bench.result()
    });
    assert!(is_whole(&good[0]) && is_whole(&good[1]) && good[0] != good[1]);
    // What the user puts there is there after every kill, and only there.
    fs::write(bench.0.path().join("out/frame/mine.txt"), "mine").expect("can be written");
    fs::create_dir_all(bench.0.path().join("out/frame/parts/mine")).expect("can be made");
    fs::write(bench.0.path().join("out/frame/parts/mine/deep.txt"), "deep").expect("can be written");
    let of_ours = || {
        let mut left = bench.result();
        let mine = ["mine.txt", "parts/mine/deep.txt"].map(|path| left.remove(path));
        assert_eq!(mine, [Some(b"mine".to_vec()), Some(b"deep".to_vec())]);
        left
    };
    let after_start = [1, 100].map(|ms| Kill::AfterStart(Duration::from_millis(ms)));
    let writing = [0, 300, 1000, 2000, 3000, 5000, 10_000, 30_000].map(|us| Kill::AfterFirstByte(Duration::from_micros(us)));
    for (run, when) in after_start.iter().chain(&writing).enumerate() {
        let beside = bench.beside();
        let child = bench.build(FRAMES[run % 2], &["--no-pictures"]).spawn().expect("starts");
        kill(child, &bench, beside, when);
        let left = of_ours();
        assert!(good.contains(&left), "run {run}: the folder holds {:?}", left.keys().collect::<Vec<_>>());
    }
    assert!(bench.build(FRAMES[0], &["--no-pictures"]).status().expect("starts").success());
    assert!(is_whole(&of_ours()));
    assert_eq!(bench.beside(), 0, "the next run removes what killed runs have left");
}
