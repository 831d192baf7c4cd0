//! Input that means harm, and machines that fail: a clear message, the right exit code, nothing written where it should not.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::{Duration, Instant};

use assert_cmd::cargo::cargo_bin;
use tempfile::TempDir;

/// What ends a command that hangs, or takes as long as its input wants; a check takes some seconds, and ten times as long on a busy machine.
const PATIENCE: Duration = Duration::from_secs(600);

struct Bench {
    folder: TempDir,
}

impl Bench {
    fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a folder") }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.path(name), bytes).expect("can be written");
    }

    fn run(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(cargo_bin("flexframe"));
        command
            .args(arguments)
            .current_dir(self.folder.path())
            .env("NO_COLOR", "1")
            .env("FLEXFRAME_CACHE", concat!(env!("CARGO_TARGET_TMPDIR"), "/kept"));
        command.output().expect("the program starts")
    }

    /// Runs what has to end with a code and a message, soon, without a panic, and with nothing new in the folder.
    fn ends(&self, arguments: &[&str], code: i32, says: &str) {
        let before = self.names();
        let begun = Instant::now();
        let output = self.run(arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {said}");
        // The renderer breaks long lines.
        let flat = said.replace(['│', '·', '╰', '├', '─', '▶', '×'], " ").split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(flat.contains(says) && !flat.contains("panicked"), "{arguments:?}: {says:?} is not in {said}");
        assert!(said.len() < 4000, "{arguments:?}: {} bytes of message", said.len());
        assert!(begun.elapsed() < PATIENCE, "{arguments:?} took {:?}", begun.elapsed());
        assert_eq!(self.names(), before, "{arguments:?} left something behind");
    }

    fn makes(&self, arguments: &[&str]) {
        let output = self.run(arguments);
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    }

    fn names(&self) -> Vec<PathBuf> {
        fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
            for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
                found.push(entry.path());
                if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                    walk(&entry.path(), found);
                }
            }
        }
        let mut found = Vec::new();
        walk(self.folder.path(), &mut found);
        found.sort();
        found
    }
}

/// What is in a folder, in order.
fn listed(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("can be read");
    let mut names: Vec<String> = entries.map(|entry| entry.expect("is there").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn planted_files_that_are_too_large_or_no_text() {
    let bench = Bench::new();
    bench.write("large.toml", format!("base = \"cognifly\"\n#{}\n", "x".repeat(10 << 20)));
    bench.write("latin.toml", b"base = \"cognifly\"\ndescription = \"\xe9\"\n");
    bench.write("zero.toml", [0_u8; 64]);
    bench.write("mark.toml", "\u{feff}base = \"cognifly\"\n");
    fs::create_dir(bench.path("folder.toml")).expect("can be made");
    for command in ["check", "build", "params", "explain", "bom"] {
        let run = |frame: &str, says: &str| {
            let arguments = if command == "explain" { vec![command, "arm_pitch_mm", frame] } else { vec![command, frame] };
            bench.ends(&arguments, 2, says);
        };
        run("large.toml", "a file of parameters has at most");
        run("latin.toml", "latin.toml:2:16");
        run("zero.toml", "this is not TOML");
        run("folder.toml", "folder.toml");
        run("nowhere.toml", "nowhere.toml");
    }
    assert_eq!(bench.run(&["params", "mark.toml"]).status.code(), Some(0), "a byte order mark is harmless");
    // A device never ends; it is no file.
    bench.ends(&["check", "--baseline", "/dev/zero"], 2, "it is no file");
}

#[test]
fn planted_nesting_and_repetition_without_end() {
    let bench = Bench::new();
    bench.write("arrays.toml", format!("base = \"cognifly\"\nx = {}1{}\n", "[".repeat(100_000), "]".repeat(100_000)));
    bench.write("tables.toml", format!("base = \"cognifly\"\nx = {}1{}\n", "{a=".repeat(100_000), "}".repeat(100_000)));
    bench.write("dots.toml", format!("base = \"cognifly\"\n{}x = 1\n", "a.".repeat(100_000)));
    bench.write("head.toml", format!("[{}x]\n", "a.".repeat(100_000)));
    bench.write("key.toml", format!("base = \"cognifly\"\n{} = 1\n", "k".repeat(900_000)));
    bench.write("keys.toml", (0..60_000).map(|n| format!("k{n} = 1\n")).collect::<String>());
    bench.write("value.toml", format!("base = \"{}\"\n", "b".repeat(900_000)));
    bench.write("digits.toml", format!("base = \"cognifly\"\n[rods]\ncage_rod_length_mm = 1{}.0\n", "0".repeat(500_000)));
    for frame in ["arrays", "tables", "dots", "head", "key", "keys", "value", "digits"] {
        for command in ["check", "params"] {
            bench.ends(&[command, &format!("{frame}.toml")], 2, "");
        }
        bench.ends(&["drop", "--model", &format!("{frame}.toml")], 2, "");
    }
    bench.ends(&["check", "key.toml"], 2, "a key of 900000 bytes is too long");
}

#[test]
fn planted_chains_of_bases_that_grow_or_turn() {
    let bench = Bench::new();
    // Sixteen files that each name the next and double their content: nothing is expanded twice.
    for at in 0..15 {
        bench.write(
            &format!("f{at}.toml"),
            format!(
                "base = \"f{}\"\n{}",
                at + 1,
                (0..500)
                    .map(|n| format!("[extras.e{at}x{n}]\nmass_g = 0.0\nmass_basis = \"estimate\"\nsource = \"s\"\n"))
                    .collect::<String>()
            ),
        );
    }
    bench.write("f15.toml", "base = \"cognifly\"\n");
    bench.ends(&["check", "f0.toml"], 2, "the chain of bases does not end within 16 files");
    assert_eq!(bench.run(&["params", "f1.toml"]).status.code(), Some(0), "sixteen are allowed");
    bench.write("self.toml", "base = \"self.toml\"\n");
    bench.ends(&["check", "self.toml"], 2, "the chain of bases does not end within 16 files");
    bench.write("a.toml", "base = \"b\"\n");
    bench.write("b.toml", "base = \"./a.toml\"\n");
    bench.ends(&["check", "a.toml"], 2, "the chain of bases does not end within 16 files");
    // A pipe that nobody writes to never opens.
    #[cfg(unix)]
    {
        let made = Command::new("mkfifo").arg(bench.path("pipe.toml")).status().expect("mkfifo is there");
        assert!(made.success());
        bench.ends(&["check", "pipe.toml"], 2, "it is no file");
    }
    bench.write("etc.toml", "base = \"/etc/passwd\"\n");
    bench.ends(&["check", "etc.toml"], 2, "there is no base called `/etc/passwd`");
}

#[test]
fn planted_names_that_lead_out() {
    let bench = Bench::new();
    for name in ["../up", "/tmp/up", "a/b", "..", ".", "", ".hidden", "a\\b", "nul\u{0}", "é", "a\nb"] {
        bench.write("frame.toml", format!("base = \"cognifly\"\nname = {}\n", serde_json::Value::from(name)));
        for command in ["build", "fold", "render"] {
            bench.ends(&[command, "frame.toml", "-o", "out"], 2, "");
        }
    }
    for name in ["a b", "a:b", ".hidden", "é"] {
        bench.write(&format!("{name}.toml"), "base = \"cognifly\"\n");
        for command in ["check", "build", "params"] {
            bench.ends(&[command, &format!("{name}.toml")], 2, "cannot be a folder's name");
            bench.ends(&[command, &format!("{name}.toml")], 2, "rename the file, or state another name in it");
        }
        bench.write(&format!("{name}.toml"), "base = \"cognifly\"\nname = \"plain\"\n");
        bench.ends(&["params", &format!("{name}.toml")], 0, "");
    }
    let long = "a".repeat(210);
    for (file, text) in [(long.as_str(), String::new()), ("frame", format!("name = \"{long}\"\n"))] {
        bench.write(&format!("{file}.toml"), format!("base = \"cognifly\"\n{text}"));
        bench.ends(&["check", &format!("{file}.toml")], 2, "has 210 letters, a frame's has at most 100");
    }
    bench.ends(&["new", &long, "--mass", "250"], 2, "has 210 letters, a frame's has at most 100");
    for name in ["..", "a b", ".x", "sub/.x", ""] {
        bench.ends(&["new", name, "--mass", "250"], 2, "cannot be a folder's name");
    }
    bench.ends(&["new", "nowhere/x", "--mass", "250"], 3, "cannot write nowhere/x.toml");
}

#[cfg(unix)]
#[test]
fn planted_links_are_not_followed_when_writing() {
    let bench = Bench::new();
    let outside = Bench::new();
    outside.write("precious", "keep");
    std::os::unix::fs::symlink(outside.path("precious"), bench.path("new.toml")).expect("can be linked");
    bench.ends(&["new", "new", "--mass", "250"], 2, "new.toml is there already");
    std::os::unix::fs::symlink(outside.path("gone"), bench.path("gone.toml")).expect("can be linked");
    bench.ends(&["new", "gone", "--mass", "250"], 2, "gone.toml is there already");
    // A list of accepted findings is replaced where it is: the link stays. What is no list is refused when it is read.
    bench.write("frame.toml", "base = \"cognifly\"\nname = \"linked\"\n");
    outside.write("list", "{\"schema_version\": 1, \"accepted\": []}");
    std::os::unix::fs::symlink(outside.path("list"), bench.path("list.json")).expect("can be linked");
    let done = bench.run(&["check", "frame.toml", "--strict", "--baseline", "list.json", "--update-baseline", "-q"]);
    assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    let list = fs::read_to_string(outside.path("list")).expect("is there");
    assert!(bench.path("list.json").is_symlink() && list.contains("\"frame\": \"linked\""), "{list}");
    std::os::unix::fs::symlink(outside.path("precious"), bench.path("no-list.json")).expect("can be linked");
    bench.ends(&["check", "frame.toml", "--baseline", "no-list.json", "--update-baseline"], 2, "is no list of accepted findings");
    // A linked folder in the result's place is the place: nothing in it is replaced that is not the program's.
    fs::create_dir(bench.path("out")).expect("can be made");
    std::os::unix::fs::symlink(outside.folder.path(), bench.path("out/linked")).expect("can be linked");
    let done = bench.run(&["build", "frame.toml", "-o", "out", "--no-pictures", "-q"]);
    assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    assert!(bench.path("out/linked").is_symlink() && outside.path("manifest.json").exists());
    assert_eq!(fs::read_to_string(outside.path("list")).expect("is there"), list);
    assert_eq!(fs::read_to_string(outside.path("precious")).expect("is there"), "keep");
    // A link inside a result is a file of the user's: it makes way, and what it leads to stays as it is.
    let apart = Bench::new();
    apart.write("report.md", "keep");
    fs::remove_file(outside.path("report.md")).expect("is there");
    std::os::unix::fs::symlink(apart.path("report.md"), outside.path("report.md")).expect("can be linked");
    let done = bench.run(&["build", "frame.toml", "-o", "out", "--no-pictures", "-q"]);
    assert!(String::from_utf8_lossy(&done.stderr).contains("report.md.yours"));
    assert!(outside.path("report.md.yours").is_symlink() && !outside.path("report.md").is_symlink());
    assert_eq!(fs::read_to_string(apart.path("report.md")).expect("is there"), "keep");
    assert_eq!(apart.names(), [apart.path("report.md")]);
}

/// Names of own materials are free texts, and plates are named after them.
#[test]
fn planted_materials_whose_names_lead_out() {
    let bench = Bench::new();
    let own = |name: &str| {
        format!(
            "[override.materials.{name:?}]\nkind = \"printed\"\ndensity_g_cm3 = 1.2\nprint_factor = 1.0\ncolour = [0.5, 0.5, 0.5, 1.0]\n\
             source = \"s\"\n"
        )
    };
    for name in ["../../../up", "/tmp/up", "a/b/../../../../up", "..", ".hidden", "a\\b"] {
        let text = format!("base = \"cognifly\"\nname = \"own\"\n[materials]\nrigid = {name:?}\n{}", own(name));
        bench.write("frame.toml", text);
        bench.makes(&["build", "frame.toml", "-o", "a/b/out", "--no-pictures"]);
        bench.makes(&["coupon", "frame.toml", "-o", "a/b/out"]);
        let place = bench.path("a/b/out");
        assert_eq!(listed(&bench.path("a")), ["b"], "{name}");
        assert_eq!(listed(&bench.path("a/b")), ["out"], "{name}");
        assert_eq!(listed(&place), ["own", "own-coupon"], "{name}");
        assert!(!Path::new("/tmp/up_1.3mf").exists());
        let plates = listed(&place.join("own/plates"));
        assert!(plates.len() == 4 && plates.iter().all(|plate| !plate.starts_with('.')), "{name}: {plates:?}");
    }
}

/// Two grades of one material have plates of different names.
#[test]
fn planted_grades_of_one_material_share_no_file() {
    let bench = Bench::new();
    let hard = "[override.materials.tpu-64d]\nkind = \"printed\"\ndensity_g_cm3 = 1.2\nprint_factor = 1.0\ncolour = [0.5, 0.5, 0.5, 1.0]\n\
                source = \"s\"\n";
    bench.write("frame.toml", format!("base = \"cognifly\"\nname = \"own\"\n[materials]\nrigid = \"tpu-64d\"\n{hard}"));
    bench.makes(&["build", "frame.toml", "-o", "out", "--no-pictures"]);
    bench.makes(&["coupon", "frame.toml", "-o", "out"]);
    assert_eq!(listed(&bench.path("out/own/plates")), ["tpu_1.3mf", "tpu_1.png", "tpu_2.3mf", "tpu_2.png"]);
    let coupon = listed(&bench.path("out/own-coupon"));
    assert!(["plate_tpu.3mf", "plate_tpu_2.3mf"].iter().all(|plate| coupon.iter().any(|name| name == plate)), "{coupon:?}");
}

/// A file that cannot grow stands for a disk that fills up.
#[cfg(target_os = "linux")]
#[test]
fn planted_a_disk_that_fills_up_is_exit_3_and_leaves_the_last_result() {
    let bench = Bench::new();
    bench.write("frame.toml", "base = \"cognifly\"\nname = \"own\"\n");
    bench.makes(&["build", "frame.toml", "-o", "out", "--no-pictures"]);
    let before = listed(&bench.path("out/own/parts"));
    let hub = fs::read(bench.path("out/own/parts/hub.stl")).expect("is there");
    bench.write("frame.toml", "base = \"cognifly\"\nname = \"own\"\n[hub]\nhub_plate_thickness_mm = 4.4\n");
    // The hub's file has some 700 kB.
    let limited = "trap '' XFSZ; ulimit -f 300; exec \"$0\" build frame.toml -o out --no-pictures";
    let mut shell = Command::new("bash");
    shell.args(["-c", limited]).arg(cargo_bin("flexframe")).env("FLEXFRAME_CACHE", "off").current_dir(bench.folder.path());
    let output = shell.output().expect("starts");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.code() == Some(3) && said.contains("cannot write"), "{:?}: {said}", output.status);
    assert_eq!(listed(&bench.path("out")), ["own"], "nothing is left beside it");
    assert_eq!(listed(&bench.path("out/own/parts")), before);
    assert!(fs::read(bench.path("out/own/parts/hub.stl")).expect("is there") == hub, "the last result stays");
}

#[cfg(target_os = "linux")]
#[test]
fn planted_places_that_cannot_be_written() {
    let bench = Bench::new();
    bench.write("frame.toml", "base = \"cognifly\"\n");
    // Not even root writes into /proc, and /dev/full is a disk that is full.
    bench.ends(&["build", "frame.toml", "-o", "/proc/out", "--no-pictures"], 3, "cannot make the folder /proc/out");
    bench.ends(&["diff", "cognifly", "frame.toml", "-o", "/proc/out"], 3, "cannot make the folder /proc/out");
    bench.ends(&["check", "frame.toml", "--baseline", "/proc/x.json", "--update-baseline"], 3, "cannot write /proc/x.json");
    for arguments in [
        &["--help"][..],
        &["check", "--help"],
        &["--version"],
        &["schema"],
        &["params"],
        &["check", "--format", "sarif"],
        &["bom"],
        &["explain", "battery_mass_g"],
    ] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("is there");
        let output =
            Command::new(cargo_bin("flexframe")).args(arguments).env("FLEXFRAME_CACHE", "off").stdout(full).output().expect("starts");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(3) && said.contains("cannot print"), "{arguments:?}: {said}");
    }
}

#[test]
fn planted_printers_at_their_bounds_are_checked_without_a_panic() {
    use flexframe::params::catalogue::Printer;
    let bench = Bench::new();
    let value = |key: &str, limit: f64| match key {
        "size_mm" => format!("[{limit:?}, {limit:?}]"),
        "kept_clear_mm" => format!("[[{limit:?}, {limit:?}, {limit:?}, {limit:?}]]"),
        _ => format!("{limit:?}"),
    };
    let head =
        "base = \"cognifly\"\nprinter = \"mine\"\n[override.printers.mine]\nname = \"mine\"\nbed = \"rectangular\"\nsource = \"s\"\n";
    let usual = "nozzle_mm = 0.4\nmin_wall_nozzles = 2.14\nsize_mm = [220.0, 220.0]\nheight_mm = 250.0\n";
    let one = Printer::FIGURES.iter().flat_map(|figure| [figure.min, figure.max].map(|limit| (figure.key, limit)));
    let alone = one.map(|(key, limit)| {
        let rest: String = usual.lines().filter(|line| !line.starts_with(key)).map(|line| format!("{line}\n")).collect();
        format!("{head}{rest}{key} = {}\n", value(key, limit))
    });
    let together = [0, 1].map(|end| {
        let lines =
            Printer::FIGURES.iter().map(|figure| format!("{} = {}\n", figure.key, value(figure.key, [figure.min, figure.max][end])));
        format!("{head}{}", lines.collect::<String>())
    });
    // Of layers that are higher than such a nozzle allows, the frame is refused.
    let thin = "[override.materials.tpu-95a]\nlayer_mm = 0.08\n[override.materials.abs]\nlayer_mm = 0.08\n";
    for text in alone.chain(together) {
        let text = if text.contains("nozzle_mm = 0.1\n") { format!("{text}{thin}") } else { text };
        bench.write("frame.toml", &text);
        let begun = Instant::now();
        let mut command = Command::new(cargo_bin("flexframe"));
        command.args(["check", "frame.toml", "-q"]).current_dir(bench.folder.path()).env("FLEXFRAME_CACHE", bench.path("cache"));
        let output = command.output().expect("the program starts");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(matches!(output.status.code(), Some(0 | 1)) && !said.contains("panicked"), "{text}: {said}");
        assert!(begun.elapsed() < PATIENCE, "{text} took {:?}", begun.elapsed());
    }
}
