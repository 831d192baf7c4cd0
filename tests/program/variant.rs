//! Comparing, explaining, searching and making variants, through the program.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

use assert_cmd::cargo::cargo_bin;
use serde_json::Value;
use tempfile::TempDir;

struct Bench {
    folder: TempDir,
}

impl Bench {
    fn new(frames: &[(&str, &str)]) -> Self {
        let bench = Self { folder: tempfile::tempdir().expect("a folder") };
        frames.iter().for_each(|(name, text)| bench.write(name, text));
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("can be written");
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(cargo_bin("flexframe"));
        command
            .args(arguments)
            .current_dir(self.folder.path())
            .env("NO_COLOR", "1")
            .env("FLEXFRAME_CACHE", concat!(env!("CARGO_TARGET_TMPDIR"), "/kept"));
        command
    }

    fn run(&self, arguments: &[&str]) -> (i32, String, String) {
        let Output { status, stdout, stderr } = self.command(arguments).output().expect("the program starts");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        (status.code().expect("ends"), text(stdout), text(stderr))
    }

    fn json(&self, arguments: &[&str]) -> Value {
        let (_, out, err) = self.run(arguments);
        serde_json::from_str(&out).unwrap_or_else(|error| panic!("{error}: {out}{err}"))
    }

    fn git(&self, arguments: &[&str]) {
        let identity = ["-c", "user.name=a", "-c", "user.email=a@example.com", "-c", "init.defaultBranch=main"];
        let done = Command::new("git").args(identity).args(arguments).current_dir(self.folder.path()).output().expect("git is there");
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    }
}

const LIGHT: &str = "base = \"cognifly\"\nname = \"light\"\n[bought]\nbattery = \"battery-2s-850\"\n";

#[test]
fn analytic_a_frame_does_not_differ_from_itself() {
    let bench = Bench::new(&[("same.toml", "base = \"cognifly\"\n")]);
    let (code, out, _) = bench.run(&["diff", "cognifly", "same.toml", "--fail-on-increase", "mass=0"]);
    assert_eq!(code, 0);
    assert!(out.contains("no difference") && !out.contains("worse") && !out.contains("better"), "{out}");
    let json = bench.json(&["diff", "cognifly", "same.toml", "--json"]);
    for list in ["parameters", "masses", "volumes", "not_compared", "broken", "mended"] {
        assert_eq!(json[list], serde_json::json!([]), "{list}");
    }
    assert!(json["measures"].as_array().expect("a list").iter().all(|m| m["values"][0] == m["values"][1] && m["values"][0].is_number()));
}

#[test]
fn planted_a_lighter_battery_shows_where_it_acts_and_nowhere_else() {
    let bench = Bench::new(&[("light.toml", LIGHT)]);
    let json = bench.json(&["diff", "cognifly", "light.toml", "--json"]);
    let names = |list: &str| -> Vec<String> {
        json[list].as_array().expect("a list").iter().map(|c| c["name"].as_str().expect("a name").to_string()).collect()
    };
    assert!(
        names("parameters").contains(&"bought.battery".to_string()) && names("parameters").contains(&"battery.battery_mass_g".to_string())
    );
    assert!(names("masses").contains(&"battery".to_string()) && !names("masses").contains(&"knee".to_string()), "{:?}", names("masses"));
    let measure = |name: &str| json["measures"].as_array().expect("a list").iter().find(|m| m["name"] == name).expect("is there").clone();
    assert_eq!(measure("mass")["trend"], "better");
    // Less mass on the same spring peaks higher, and its battery hits the ground slower: neither is better. What the peak is is said too.
    assert_eq!(measure("peak")["trend"], "neither");
    let why = json["not_compared"][0].as_str().expect("text");
    assert!(why.starts_with("peak: not compared") && why.contains("cognifly hits the ground at"), "{why}");
    assert!(json["peak"].as_str().expect("text").contains("reacts to mass and gap only"));
    let strikes: Vec<f64> =
        measure("peak.strike")["values"].as_array().expect("two").iter().filter_map(serde_json::Value::as_f64).collect();
    assert!(strikes.len() == 2 && strikes[1] < strikes[0] && measure("peak.strike")["trend"] == "better", "{strikes:?}");
    assert_eq!(measure("envelope.width")["trend"], "neither");

    let (code, _, err) =
        bench.run(&["diff", "light.toml", "cognifly", "--fail-on-increase", "mass=2g", "--fail-on-increase", "wall=0.1mm"]);
    assert_eq!(code, 1);
    assert!(err.starts_with("mass grew by ") && err.contains("; 2 g are allowed") && err.lines().count() == 1, "{err}");
    let increases = ["--fail-on-increase", "mass=2g", "--fail-on-increase", "wall=0.1mm", "--json"];
    let json = bench.json(&[&["diff", "light.toml", "cognifly"][..], &increases].concat());
    let [increased] = &json["increased"].as_array().expect("a list")[..] else { panic!("{json:#}") };
    assert_eq!([&increased["measure"], &increased["unit"], &increased["allowed"]], [&Value::from("mass"), &"g".into(), &2.0.into()]);
    let values = &json["measures"].as_array().expect("a list").iter().find(|m| m["name"] == "mass").expect("is there")["values"];
    let grown = values[1].as_f64().expect("a number") - values[0].as_f64().expect("a number");
    assert!((increased["found"].as_f64().expect("a number") - grown).abs() < 1e-9 && grown > 2.0, "{increased}");
    let kept = bench.json(&["diff", "cognifly", "light.toml", "--fail-on-increase", "mass=2g", "--json"]);
    assert!(kept.get("increased").is_none(), "{kept:#}");
    for (wrong, says) in
        [("mas=2g", "did you mean `mass`"), ("mass=2mm", "mass is measured in g"), ("mass", "does not read"), ("mass=-1", "does not read")]
    {
        let (code, out, err) = bench.run(&["diff", "cognifly", "light.toml", "--fail-on-increase", wrong]);
        assert!(code == 2 && out.is_empty() && err.contains(says), "{wrong}: {err}");
    }
}

#[test]
fn analytic_a_difference_that_is_told_as_zero_is_none() {
    let bench = Bench::new(&[("hair.toml", "base = \"cognifly\"\n[rods]\ncage_rod_length_mm = 192.00001\n")]);
    let (code, _, err) = bench.run(&["diff", "cognifly", "hair.toml", "--fail-on-increase", "envelope.width=0"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let json = bench.json(&["diff", "cognifly", "hair.toml", "--json"]);
    assert!(json["measures"].as_array().expect("a list").iter().all(|m| m["trend"] == "neither"), "{json:#}");
    assert_eq!([&json["masses"], &json["volumes"]], [&serde_json::json!([]); 2]);
    // What was typed differs, and is told with the decimals that show it.
    assert_eq!(json["parameters"][0]["reported"], serde_json::json!(["192.00000", "192.00001"]));
    bench.write("wide.toml", "base = \"cognifly\"\n[rods]\ncage_rod_length_mm = 192.1\n");
    let (code, _, err) = bench.run(&["diff", "cognifly", "wide.toml", "--fail-on-increase", "envelope.width=0"]);
    assert!(code == 1 && err.starts_with("envelope.width grew by 0.") && !err.contains("by 0.00 "), "{err}");
}

#[test]
fn analytic_diff_writes_page_and_picture() {
    let bench = Bench::new(&[]);
    let (code, out, err) = bench.run(&["diff", "cognifly", "cognifly-mini", "-o", "out"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.ends_with("diff.md, diff.json, diff.png\n"), "{out}");
    let folder = bench.path("out/diff-cognifly-cognifly-mini");
    let page = fs::read_to_string(folder.join("diff.md")).expect("is there");
    assert!(
        page.starts_with("## cognifly to cognifly-mini\n")
            && page.contains("| envelope.width mm | 209.49 | 182.")
            && page.contains("(diff.png)")
    );
    let rows = page.lines().filter(|line| line.starts_with('|'));
    assert!(rows.clone().all(|row| row.matches('|').count() == 6), "{:?}", rows.collect::<Vec<_>>());
    let picture = fs::read(folder.join("diff.png")).expect("is there");
    assert!(picture.starts_with(b"\x89PNG") && picture.len() > 50_000);
    let again = bench.run(&["diff", "cognifly", "cognifly-mini", "-o", "again"]);
    assert_eq!(again.0, 0);
    assert!(fs::read(bench.path("again/diff-cognifly-cognifly-mini/diff.png")).expect("is there") == picture, "the same bytes");
}

/// A repository that git refuses is not the same as none.
#[test]
fn planted_why_git_reads_no_repository_is_told() {
    let bench = Bench::new(&[("mine.toml", "base = \"cognifly\"\n")]);
    bench.git(&["init", "--quiet"]);
    bench.write(".git/config", "no line of a configuration\n");
    let (code, _, err) = bench.run(&["diff", "--git", "HEAD", "mine.toml"]);
    assert_eq!(code, 2, "{err}");
    assert!(err.contains("mine.toml lies in no git repository that git reads; git says: ") && err.contains("bad config line 1"), "{err}");
}

#[test]
fn planted_a_file_against_its_former_self() {
    let bench = Bench::new(&[("base.toml", "base = \"cognifly\"\n[limits]\nmass_budget_g = 240.0\n"), ("mine.toml", "base = \"base\"\n")]);
    bench.git(&["init", "--quiet"]);
    bench.git(&["add", "."]);
    bench.git(&["commit", "--quiet", "-m", "one"]);
    // The base changes, not the file itself: the former self has the former base.
    bench.write("base.toml", "base = \"cognifly\"\n[limits]\nmass_budget_g = 235.0\n[bought]\nbattery = \"battery-2s-850\"\n");
    let (code, out, err) = bench.run(&["diff", "--git", "HEAD", "mine.toml"]);
    assert_eq!(code, 0, "{err}");
    assert!(out.starts_with("a: mine@") && out.contains("limits.mass_budget_g") && out.contains("battery-2s-850"), "{out}");
    for (arguments, says) in [
        (
            &["diff", "--git", "nowhere", "mine.toml"][..],
            "this repository has no revision `nowhere`; git says: fatal: Needed a single revision",
        ),
        (&["diff", "--git=--output=x", "mine.toml"], "this repository has no revision `--output=x`"),
        (&["diff", "--git", "HEAD", "cognifly"], "cognifly is a preset"),
        (&["diff", "--git", "HEAD", "frames/mine"], "frames/mine is neither a file nor a preset: the name of a frame's file ends in .toml"),
        (&["diff", "mine.toml"], "give two frames"),
        (&["diff", "--git", "HEAD", "mine.toml", "base.toml"], "give one frame with --git"),
    ] {
        let (code, _, err) = bench.run(arguments);
        assert!(code == 2 && err.contains(says), "{arguments:?}: {err}");
    }
    // As in a hook, whose GIT_DIR means another folder's repository, or none.
    fs::create_dir(bench.path("sub")).expect("can be made");
    bench.write("sub/deep.toml", "base = \"../base\"\n");
    bench.git(&["add", "sub"]);
    bench.git(&["commit", "--quiet", "-m", "two"]);
    for variables in [&[("GIT_DIR", ".git")][..], &[("GIT_DIR", "/nowhere"), ("GIT_WORK_TREE", "/")]] {
        let done = bench.command(&["diff", "--git", "HEAD", "sub/deep.toml"]).envs(variables.iter().copied()).output().expect("starts");
        assert_eq!(done.status.code(), Some(0), "{variables:?}: {}", String::from_utf8_lossy(&done.stderr));
        assert!(String::from_utf8_lossy(&done.stdout).contains("limits.mass_budget_g"), "{variables:?}");
    }
    // A work tree whose repository lies elsewhere is known by these variables only.
    let apart = Bench::new(&[("far.toml", "base = \"cognifly\"\n")]);
    let (repository, tree) = (apart.path("elsewhere.git"), apart.folder.path());
    let [repository, tree] = [repository.as_path(), tree].map(|path| path.to_str().expect("UTF-8").to_string());
    apart.git(&["init", "--quiet", "--bare", &repository]);
    let of = [format!("--git-dir={repository}"), format!("--work-tree={tree}")];
    apart.git(&[&of[0], &of[1], "add", "far.toml"]);
    apart.git(&[&of[0], &of[1], "commit", "--quiet", "-m", "one"]);
    let variables = [("GIT_DIR", repository), ("GIT_WORK_TREE", tree)];
    let done = apart.command(&["diff", "--git", "HEAD", "far.toml"]).envs(variables).output().expect("starts");
    assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    // A link is what it leads to.
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("deep.toml", bench.path("sub/link.toml")).expect("can be made");
        bench.git(&["add", "sub"]);
        bench.git(&["commit", "--quiet", "-m", "three"]);
        let (code, out, err) = bench.run(&["diff", "--git", "HEAD", "sub/link.toml"]);
        assert!(code == 0 && out.contains("limits.mass_budget_g"), "{out} {err}");
    }
    bench.write("new.toml", "base = \"cognifly\"\n");
    let (code, _, err) = bench.run(&["diff", "--git", "HEAD", "new.toml"]);
    assert!(code == 2 && err.contains("it is not in "), "{err}");
    assert!(!bench.path("x").exists());
}

#[test]
fn analytic_explain_says_what_follows_from_five_percent() {
    let bench = Bench::new(&[("mine.toml", "base = \"cognifly\"\n[hub_joint]\narm_pitch_mm = 26.0\n")]);
    let (code, out, err) = bench.run(&["explain", "arm_pitch_mm", "mine.toml"]);
    assert_eq!(code, 0, "{err}");
    for part in [
        "hub_joint.arm_pitch_mm",
        "Distance between the two parallel arm rods.",
        "26 mm (mine.toml:3)",
        "18 to 34 mm",
        "hub_joint, fork, motor_mount",
        "24.7",
        "27.3",
        "peak",
    ] {
        assert!(out.contains(part), "{part}: {out}");
    }
    // A battery's mass is a mass: 5 % of 58 g more is 2.9 g more, and nothing else moves.
    let json = bench.json(&["explain", "battery_mass_g", "--json"]);
    let mass = |at: usize| json["responses"][at]["measures"]["mass"].as_f64().expect("a number");
    assert!((mass(2) - mass(1) - 2.9).abs() < 1e-6 && (mass(1) - mass(0) - 2.9).abs() < 1e-6, "{json:#}");
    assert_eq!(json["responses"][0]["measures"]["envelope.width"], json["responses"][2]["measures"]["envelope.width"]);
    assert_eq!(json["follows"], "battery");
    // The arm rods push the knees out; too long they do not close, which is said.
    let (_, out, _) = bench.run(&["explain", "cage_rod"]);
    assert!(out.contains("rods.cage_rod_length_mm") && out.contains("envelope.width"), "{out}");
    for (wrong, says) in [("arm_pitsch_mm", "did you mean `arm_pitch_mm`"), ("corner", "may be any of"), ("", "there is no parameter")] {
        let (code, _, err) = bench.run(&["explain", wrong]);
        assert!(code == 2 && err.contains(says), "{wrong}: {err}");
    }
}

#[test]
fn analytic_explain_labels_its_columns() {
    let bench = Bench::new(&[]);
    let (_, out, _) = bench.run(&["explain", "battery_mass_g"]);
    let words = |start: &str| -> Vec<String> {
        let line = out.lines().find(|line| line.trim_start().starts_with(start)).unwrap_or_else(|| panic!("no {start}: {out}"));
        line.split_whitespace().map(String::from).collect()
    };
    assert_eq!(words("5 % less").join(" "), "5 % less as it is 5 % more");
    assert_eq!(words("value    "), ["value", "58", "g", "(follows", "from", "bought.battery)"]);
    assert_eq!(words("mass "), ["mass", "g", "-2.90", "233.32", "+2.90"]);
    assert!(out.contains("left and right of the middle stands the change"), "{out}");
    // At a bound there is no 5 % more.
    bench.write("most.toml", "base = \"cognifly\"\n[limits]\nground_clearance_mm = 60.0\n");
    let (_, out, _) = bench.run(&["explain", "ground_clearance_mm", "most.toml"]);
    assert!(out.contains("at its most") && !out.contains("5 % more"), "{out}");
}

#[test]
fn analytic_explain_says_what_a_name_chooses() {
    let own = "base = \"cognifly\"\n[battery]\nbattery_mass_g = 70.0\n[bought]\nbattery = \"fat\"\n[override.parts.fat]\nkind = \"battery\"\n\
               mass_g = 60.0\nmass_basis = \"measured\"\nsize_mm = [56.0, 30.0, 16.0]\nsource = \"a scale\"\n";
    let bench = Bench::new(&[("mine.toml", own)]);
    let (code, out, err) = bench.run(&["explain", "bought.battery", "mine.toml"]);
    assert_eq!(code, 0, "{err}");
    for part in [
        "value    fat (mine.toml:5)",
        "battery-2s-850",
        ", fat",
        "battery.battery_height_mm = 16 mm\n",
        "(stated, does not follow: mine.toml:3)",
    ] {
        assert!(out.contains(part), "{part}: {out}");
    }
    assert!(!out.contains("\"none\"") && !out.contains("motor-1104"), "no frame flies without a battery: {out}");
    assert!(bench.run(&["explain", "bought.camera"]).1.contains("or \"none\" for a frame without"));
    for (key, value, name) in [
        ("printer", "generic-0.4", "prusa-mk4"),
        ("base", "cognifly", "cognifly-mini"),
        ("materials.flexible", "tpu-95a", "pla"),
        ("bought.motor_screw", "screw-m2x4", "screw-m2x6"),
    ] {
        let json = bench.json(&["explain", key, "mine.toml", "--json"]);
        assert_eq!(json["value"], value, "{key}");
        assert!(json["names"].as_array().expect("a list").iter().any(|known| known == name), "{json:#}");
    }
    let (code, _, err) = bench.run(&["explain", "bought.batery"]);
    assert!(code == 2 && err.contains("did you mean `bought.battery`"), "{err}");
    let (code, _, err) = bench.run(&["solve", "--minimise", "mass", "--vary", "bought.battery"]);
    assert!(code == 2 && err.contains("is a name, not a number; `flexframe explain bought.battery` lists the names"), "{err}");
}

/// A goal of the value of a limit gave the solver of the planes two equal constraints, with which it never ended.
#[test]
fn regress_a_goal_that_is_also_a_limit_ends() {
    let bench = Bench::new(&[]);
    let vary = "cage_rod,arm_rod,strut_rod,motor_position";
    let arguments =
        ["solve", "cognifly", "--minimise", "mass", "--vary", vary, "--subject-to", "clearance.propeller>=3mm", "--frames", "40"];
    let (code, out, err) = bench.run(&arguments);
    assert!(code == 0 && out.contains("looked at 40 frames") || out.contains("what holds it back"), "{out}{err}");
}

#[test]
fn planted_solve_finds_a_lighter_frame_that_keeps_every_limit() {
    let bench = Bench::new(&[]);
    let arguments = [
        "solve",
        "--minimise",
        "mass",
        "--vary",
        "arm_rod=78..86,cage_rod=180..195",
        "--subject-to",
        "clearance.propeller>=3.5mm",
        "--frames",
        "24",
        "-o",
        "light",
    ];
    let (code, out, err) = bench.run(&arguments);
    assert_eq!(code, 0, "{out}{err}");
    assert!(out.contains("what holds it back") && out.ends_with("light.toml: written\n"), "{out}");
    assert_eq!(bench.run(&["check", "-q", "light.toml"]).0, 0, "{out}");
    let json = bench.json(&["diff", "cognifly", "light.toml", "--json"]);
    let measure =
        |name: &str| json["measures"].as_array().expect("a list").iter().find(|m| m["name"] == name).expect("is there")["values"].clone();
    assert!(measure("mass")[1].as_f64() < measure("mass")[0].as_f64(), "{json:#}");
    assert!(measure("clearance.propeller")[1].as_f64().expect("a number") >= 3.5);
    let (code, _, err) = bench.run(&arguments);
    assert!(code == 2 && err.contains("light.toml is there already"), "{err}");
    // What cannot be is said, with what it misses.
    let (code, out, err) = bench.run(&["solve", "--minimise", "mass", "--vary", "arm_rod", "--subject-to", "mass<=100", "--frames", "10"]);
    assert!(code == 1 && out.is_empty() && err.contains("mass<=100g is 2"), "{err}");
    for (more, says) in [
        (["--minimise", "mass", "--vary", "arm_rod,arm_rod_length_mm=80..81"], "rods.arm_rod_length_mm stands there twice"),
        (["--minimise", "weight", "--vary", "arm_rod"], "there is no measure `weight`"),
        (["--minimise", "mass", "--vary", "arm_rod=90..70"], "give bounds as"),
        (["--minimise", "mass", "--vary", "arm_rod=1..70"], "within 40 to 180"),
    ] {
        let (code, _, err) = bench.run(&[&["solve"][..], &more].concat());
        assert!(code == 2 && err.contains(says), "{more:?}: {err}");
    }
}

#[test]
fn planted_new_writes_what_was_asked_for_and_what_had_to_move() {
    let bench = Bench::new(&[]);
    let (code, out, err) = bench.run(&["new", "easy", "--battery", "battery-2s-850"]);
    assert_eq!(code, 0, "{out}{err}");
    let text = fs::read_to_string(bench.path("easy.toml")).expect("is there");
    assert!(text.contains("[bought]\nbattery = \"battery-2s-850\" # asked for\n") && !text.contains("[rods]"), "{text}");
    // Smaller propellers and a smaller box: rods and motors have to move.
    let (code, out, err) = bench.run(&[
        "new",
        "small",
        "--propeller",
        "propeller-65mm",
        "--motor",
        "motor-1103",
        "--envelope",
        "195x195x112",
        "--frames",
        "40",
    ]);
    assert_eq!(code, 0, "{out}{err}");
    assert!(out.contains("as asked for: the frame's width without propellers is 209.49 mm, the envelope 195.00 mm"), "{out}");
    let text = fs::read_to_string(bench.path("small.toml")).expect("is there");
    assert!(text.contains("envelope_width_mm = 195.0 # asked for") && text.contains("moved to keep every limit"), "{text}");
    assert_eq!(bench.run(&["check", "-q", "small.toml"]).0, 0);
    // A base's own battery may be replaced, and the base is named by the way to it.
    let own = "base = \"cognifly\"\n[bought]\nbattery = \"fat\"\n[override.parts.fat]\nkind = \"battery\"\nmass_g = 60.0\nmass_basis = \"measured\"\n\
               size_mm = [56.0, 30.0, 16.0]\nsource = \"a scale\"\n";
    fs::create_dir(bench.path("sub")).expect("can be made");
    bench.write("sub/own.toml", own);
    let (code, out, err) = bench.run(&["new", "slim", "--from", "sub/own.toml", "--battery", "battery-2s-850"]);
    assert_eq!(code, 0, "{out}{err}");
    assert!(fs::read_to_string(bench.path("slim.toml")).expect("is there").contains("\nbase = \"sub/own.toml\"\n"));
    assert_eq!(bench.run(&["check", "-q", "slim.toml"]).0, 0);
    bench.write("cognifly-mini.toml", "base = \"cognifly\"\n");
    for (arguments, code, says) in [
        (&["new", "y", "--from", "cognifly-mini", "--mass", "250"][..], 2, "is hidden by"),
        (&["new", "cognifly", "--mass", "250"], 2, "cognifly is a preset"),
        (&["new", "y", "--propeller", "motor-1104"], 2, "--propeller \"motor-1104\""),
        (&["new", "x"][..], 2, "say what is to be different"),
        (&["new", "../x", "--mass", "250", "--battery", "battery-of-nobody"], 2, "there is no bought part called `battery-of-nobody`"),
        (&["new", "a b", "--mass", "250"], 2, "cannot be a folder's name"),
        (&["new", "x", "--envelope", "180x170"], 2, "give width x depth x height"),
        (&["new", "easy", "--mass", "250"], 2, "easy.toml is there already"),
        (&["new", "x", "--mass", "150", "--frames", "8"], 1, "no such variant was found"),
    ] {
        let (told, _, err) = bench.run(arguments);
        assert!(told == code && err.contains(says), "{arguments:?}: {told} {err}");
        assert!(!bench.path("x.toml").exists());
    }
}

#[test]
fn planted_solve_chooses_by_name_comes_near_and_finds_a_front() {
    let bench = Bench::new(&[]);
    // The lighter of two batteries, by name alone.
    let arguments = ["solve", "--minimise", "mass", "--choose", "bought.battery=battery-3s-650|battery-2s-850", "--json"];
    let found = bench.json(&[&arguments[..], &["-o", "small"]].concat());
    assert_eq!(found["chosen"], serde_json::json!({ "bought.battery": "battery-2s-850" }), "{found}");
    assert!(fs::read_to_string(bench.path("small.toml")).expect("is there").contains("battery = \"battery-2s-850\" # chosen"));
    // A height between that of the frame and what its struts can give.
    let near = bench.json(&["solve", "--aim", "envelope.height=112", "--vary", "strut_rod", "--frames", "14", "--json"]);
    assert!((near["measures"]["envelope.height"].as_f64().expect("a number") - 112.0).abs() < 0.1, "{near}");
    // Of a front no frame is better than another in both, and each is checked whole.
    let front = ["solve", "--pareto", "mass,clearance.propeller", "--vary", "arm_rod,cage_rod", "--frames", "24", "-o", "out", "--json"];
    let front = bench.json(&front);
    let points: Vec<[f64; 2]> = front["points"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|point| ["mass", "clearance.propeller"].map(|goal| point["measures"][goal].as_f64().expect("a number")))
        .collect();
    assert!(points.len() >= 3, "{front}");
    assert!(points.windows(2).all(|pair| pair[0][0] < pair[1][0] && pair[0][1] < pair[1][1]), "{points:?}");
    let csv = fs::read_to_string(bench.path("out/pareto-cognifly/pareto.csv")).expect("is there");
    assert!(csv.starts_with("mass (g),clearance.propeller (mm),rods.arm_rod_length_mm,rods.cage_rod_length_mm\n"), "{csv}");
    assert_eq!(csv.lines().count(), points.len() + 1);
    assert!(front.get("peak").is_none(), "{front}");
    let peaks = bench.json(&["solve", "--pareto", "mass,peak", "--vary", "arm_rod", "--frames", "4", "--json"]);
    assert!(peaks["peak"].as_str().is_some_and(|said| said.starts_with("peak: of a mass on a spring")), "{peaks}");
    for (arguments, says) in [
        (&["solve", "--pareto", "mass", "--vary", "arm_rod"][..], "give two or three measures"),
        (&["solve", "--pareto", "mass,mass", "--vary", "arm_rod"], "mass stands there twice"),
        (&["solve", "--aim", "mass", "--vary", "arm_rod"], "give a measure and its value"),
        (&["solve", "--aim", "mass=heavy", "--vary", "arm_rod"], "`mass=heavy` does not read: write a measure, = and its value"),
        (&["solve", "--aim", "mass=235kg", "--vary", "arm_rod"], "`mass=235kg` is in kg, mass is measured in g"),
        (&["solve", "--minimise", "mass", "--aim", "mass=200", "--vary", "arm_rod"], "cannot be used with"),
        (&["solve", "--minimise", "mass", "--choose", "rods.arm_rod_length_mm"], "by name, such as bought.battery"),
        (&["solve", "--minimise", "mass", "--choose", "bought.battery,bought.motor,bought.propeller", "--frames", "10"], "raise --frames"),
        (&["solve", "--minimise", "mass", "--choose", "bought.battery=battery-2s-85|battery-3s-450"], "did you mean `battery-2s-850`"),
        (&["solve", "--minimise", "mass", "--choose", "bought.battery=battery-2s-850|battery-2s-850"], "stands there twice"),
        (&["solve", "--minimise", "mass", "--vary", "arm_rod,envelope_height"], "a limit is what the search keeps"),
    ] {
        let (code, _, err) = bench.run(arguments);
        assert!(code == 2 && err.contains(says), "{arguments:?}: {code} {err}");
    }
}

/// A search that is asked to end answers with what it has; another command leaves nothing behind.
#[cfg(unix)]
#[test]
fn planted_ctrl_c_ends_a_search_with_its_best_and_leaves_no_hidden_folder() {
    let bench = Bench::new(&[]);
    let interrupted = |arguments: &[&str], ready: &dyn Fn() -> bool| {
        let child = bench.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("starts");
        while !ready() {
            std::thread::sleep(Duration::from_millis(2));
        }
        Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("is there");
        child.wait_with_output().expect("ends")
    };
    let begun = Instant::now();
    let search = ["solve", "--minimise", "mass", "--vary", "arm_rod,cage_rod", "--frames", "5000", "--json"];
    let done = interrupted(&search, &|| begun.elapsed() > Duration::from_secs(4));
    let answer: serde_json::Value = serde_json::from_slice(&done.stdout).expect("JSON");
    assert_eq!((done.status.code(), answer["ended"].as_str()), (Some(0), Some("stopped")), "{answer}");
    let spent = bench.json(&["solve", "--minimise", "mass", "--vary", "arm_rod,cage_rod", "--frames", "5000", "--budget", "2s", "--json"]);
    assert_eq!(spent["ended"], "stopped", "{spent}");
    // A build has its hidden folder only while it writes; a result that is there already is not yet.
    let hidden =
        || fs::read_dir(bench.path("o")).is_ok_and(|list| list.flatten().any(|e| e.file_name().to_string_lossy().starts_with('.')));
    let done = interrupted(&["build", "--step", "--no-cache", "-q", "-o", "o"], &|| hidden() || bench.path("o/cognifly").exists());
    assert!(!hidden() || done.status.success(), "a hidden folder is left");
    assert!(matches!(done.status.code(), Some(0 | 130)), "{:?}", done.status);
}

#[test]
fn planted_new_finds_the_rods_of_a_preset() {
    let bench = Bench::new(&[]);
    let wanted = ["--propeller", "propeller-4-inch", "--motor", "motor-1404", "--envelope", "260x260x130", "--mass", "290"];
    let (code, out, err) = bench.run(&[&["new", "four"][..], &wanted, &["--frames", "12"]].concat());
    assert_eq!(code, 0, "{out}{err}");
    assert_eq!(bench.run(&["check", "-q", "four.toml"]).0, 0, "{out}");
}

#[test]
fn planted_new_begins_within_the_bounds_that_it_is_given() {
    let five = "base = \"cognifly\"\n[bought]\npropeller = \"five\"\n[override.parts.five]\nkind = \"propeller\"\ndiameter_mm = 127\n\
                size_mm = [127, 127, 7]\nmass_g = 4.0\nmass_basis = \"estimate\"\nsource = \"x\"\n";
    let bench = Bench::new(&[("five.toml", five)]);
    let bounds = "cage_rod=250..300,arm_rod=120..150,strut_rod=50..80,motor_position=90..130";
    let wanted = ["--from", "five.toml", "--envelope", "305x305x150", "--mass", "500", "--vary", bounds];
    let (code, out, err) = bench.run(&[&["new", "large"][..], &wanted].concat());
    assert_eq!(code, 0, "{out}{err}");
    assert_eq!(bench.run(&["check", "-q", "large.toml"]).0, 0, "{out}");
}

/// Between struts outside of a larger propeller and the camera inside of it little room is left, and the motors stand in its middle.
#[test]
fn planted_new_finds_the_room_of_a_larger_propeller() {
    let bench = Bench::new(&[]);
    let wanted = ["--propeller", "propeller-4-inch", "--motor", "motor-1404", "--mass", "300", "--envelope", "240x240x125"];
    let (code, out, err) = bench.run(&[&["new", "four"][..], &wanted].concat());
    assert_eq!(code, 0, "{out}{err}");
    assert_eq!(bench.run(&["check", "-q", "four.toml"]).0, 0, "{out}");
}

/// Spares, search words, wires and ranges of prices, in each form.
fn bill_to_buy_from(bench: &Bench, page: &str, csv: &str) {
    for part in [
        "| motor_screw | screw-m2x4 (M2 x 4 mm) | 16 | 18 | M2x4 socket head screw DIN 912 |",
        "| propeller | propeller-3-inch | 4 | 8 | propeller 3.0 inch 76 mm |",
        "| motor_wire | - | 12 x ",
        "| rod_glue | - | 1 | 1 | cyanoacrylate glue |",
        "| receiver | - | 1 | 1 |",
        "one for every ten begun; of propellers a second set",
        "No threaded inserts",
    ] {
        assert!(page.contains(part), "{part}: {page}");
    }
    assert!(csv.contains(",18,,,M2x4 socket head screw DIN 912,\n") && csv.contains("\nsupply,rod_glue,1,"), "{csv}");
    let priced = |range: &str| {
        let text = format!("base = \"cognifly\"\n[override.parts.propeller-3-inch]\n{range}\n");
        bench.write("range.toml", &text);
        bench.run(&["bom", "range.toml"])
    };
    let price = "price = 0.5\ncurrency = \"EUR\"\nprice_source = \"an invoice\"\n";
    let (code, page, _) = priced(&format!("{price}price_most = 0.75\nprice_date = \"2026-11\""));
    assert_eq!(code, 0);
    assert!(page.contains("| 0.50 to 0.75 EUR (an invoice, 2026-11) |"), "{page}");
    assert!(page.contains("4.00 to 6.00 EUR with spares; "), "{page}");
    let bill = bench.json(&["bom", "range.toml", "--json"]);
    assert_eq!(bill["prices"], serde_json::json!([["EUR", 2.0]]));
    assert_eq!(bill["prices_with_spares"], serde_json::json!([["EUR", 4.0, 6.0]]));
    for (wrong, said) in [
        (format!("{price}price_most = 0.25"), "`price_most` = 0.25 is less than `price` = 0.5"),
        (format!("{price}price_date = \"yesterday\""), "`price_date` is no date"),
        (format!("{price}price_date = \"2026-13\""), "`price_date` is no date"),
        ("price_most = 0.75".into(), "lacks currency or price_source"),
    ] {
        let (code, _, err) = priced(&wrong);
        assert!(code == 2 && err.contains(said), "{wrong}: {err}");
    }
}

#[test]
fn analytic_spare_parts_are_listed_as_json() {
    let bench = Bench::new(&[]);
    let spare = bench.json(&["build", "--part", "knee", "--quantity", "3", "--json", "-o", "frames"]);
    assert_eq!([&spare["part"], &spare["quantity"], &spare["plates"]], [&serde_json::json!("knee"), &3.into(), &1.into()]);
    let folder = bench.path(spare["folder"].as_str().expect("a path"));
    let files = spare["files"].as_array().expect("a list").iter().map(|file| file.as_str().expect("a path"));
    assert!(files.clone().count() >= 2 && files.clone().all(|file| folder.join(file).is_file()), "{spare}");
}

/// What is asked for in the wrong place is told where it belongs.
#[test]
fn planted_a_target_is_no_parameter_and_the_frames_model_is_fitted_by_drop() {
    let bench = Bench::new(&[]);
    let (code, _, err) = bench.run(&["params", "--filter", "target"]);
    assert!(code == 2 && err.contains("`target.height_mm`, 40 to 400 mm"), "{err}");
    for command in ["fit", "diagnose"] {
        let (code, _, err) = bench.run(&[command, "--model", "frame", "drops.csv"]);
        assert!(code == 2 && err.contains("drop --model frame --fit DROPS"), "{command}: {err}");
    }
}

/// A frame that cannot close says with which lengths it would, and with these it does.
#[test]
fn planted_a_frame_that_cannot_close_is_told_what_closes_it() {
    let bench = Bench::new(&[("long.toml", "base = \"cognifly\"\n[rods]\ncage_rod_length_mm = 230\n")]);
    let (code, _, err) = bench.run(&["check", "long.toml"]);
    assert!(code == 2 && err.contains("it closes with"), "{err}");
    let told = err.split_once("it closes with").map_or("", |(_, told)| told).replace('\n', " ");
    for key in ["arm_rod_length_mm", "cage_rod_length_mm"] {
        let after = told.split_once(&format!("{key} = ")).unwrap_or_else(|| panic!("no {key}: {err}")).1;
        let number: String = after.chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect();
        let cage = if key == "cage_rod_length_mm" { String::new() } else { "cage_rod_length_mm = 230\n".into() };
        bench.write("closed.toml", &format!("base = \"cognifly\"\n[rods]\n{cage}{key} = {number}\n"));
        let (code, _, err) = bench.run(&["check", "closed.toml"]);
        assert!(code != 2, "{key} = {number}: {err}");
    }
}

#[test]
fn analytic_bill_in_every_form() {
    let bench = Bench::new(&[(
        "priced.toml",
        "base = \"cognifly\"\n[override.parts.motor-1104]\nprice = 9.5\ncurrency = \"EUR\"\nprice_source = \"an invoice\"\n\
         [override.materials.tpu-95a]\nprice_per_kg = 40.0\ncurrency = \"EUR\"\nprice_source = \"an invoice\"\n",
    )]);
    let (code, page, _) = bench.run(&["bom"]);
    assert_eq!(code, 0);
    for part in [
        "# Bill of materials: cognifly",
        "| knee | 4 | tpu-95a |",
        "h by an estimate within 15 % of PrusaSlicer's",
        "A stock length is saved by `cage` rods of 185.4 mm instead of 192.0 mm.",
        "(M2 x 4 mm)",
        "no price with a source",
        "| 1 | cage ",
        "no plan needs fewer",
    ] {
        assert!(page.contains(part), "{part}: {page}");
    }
    let (code, _, err) = bench.run(&["bom", "--format", "csv", "--json"]);
    assert!(code == 2 && err.contains("--json contradicts --format"), "{err}");
    let bill = bench.json(&["bom", "priced.toml", "--json"]);
    assert_eq!(bill["prices"], serde_json::json!([["EUR", 38.0]]));
    let lines = bill["print"].as_array().expect("a list").iter();
    let tpu_g: f64 = lines.filter(|line| line["material"] == "tpu-95a").map(|line| line["mass_g"].as_f64().expect("a mass")).sum();
    let paid = bill["filament_prices"][0][1].as_f64().expect("a sum");
    assert!((paid - 0.04 * tpu_g).abs() < 1e-9, "{paid} {tpu_g}");
    let pieces: usize = bill["cut"].as_array().expect("a list").iter().map(|stock| stock["pieces"].as_array().expect("a list").len()).sum();
    assert_eq!(pieces, 28);
    let (_, csv, _) = bench.run(&["bom", "--format", "csv"]);
    assert!(csv.starts_with("kind,name,quantity,") && csv.contains("\nstock,rod-carbon-3-1,1,carbon,"), "{csv}");
    // The three forms carry the same facts.
    let (_, csv, _) = bench.run(&["bom", "priced.toml", "--format", "csv"]);
    let columns: Vec<&str> = csv.lines().next().expect("a head").split(',').collect();
    let field = |start: &str, column: &str| -> String {
        let row = csv.lines().find(|row| row.starts_with(start)).unwrap_or_else(|| panic!("no {start}: {csv}"));
        // Of these rows none has a quoted field before the column that is looked at.
        let at = columns.iter().position(|known| *known == column).unwrap_or_else(|| panic!("no {column}: {csv}"));
        let fields: Vec<&str> = if at > 8 { row.rsplitn(columns.len() - 8, ',').collect() } else { row.splitn(9, ',').collect() };
        let at = if at > 8 { columns.len() - 1 - at } else { at };
        fields[at].to_string()
    };
    let motor = ["price_each", "currency", "price_source"].map(|column| field("bought,motor,", column));
    assert_eq!(motor, ["9.5", "EUR", "an invoice"]);
    let knee_g: f64 = field("printed,knee,", "mass_each_g").parse().expect("a number");
    let knee: f64 = field("printed,knee,", "price_each").parse().expect("a number");
    assert!((knee - 0.04 * knee_g).abs() < 1e-4 && field("printed,hub,", "price_each").is_empty(), "{knee} {knee_g}");
    let screw = ["screw_thread_mm", "screw_length_mm"].map(|column| field("bought,motor_screw,", column));
    assert_eq!(screw, ["2", "4"]);
    let minutes: f64 = field("printed,knee,", "print_min").parse().expect("a number");
    let knee = bill["print"].as_array().expect("a list").iter().find(|line| line["part"] == "knee").expect("is there");
    assert!((minutes - knee["print_min"].as_f64().expect("a number")).abs() <= 0.0501, "{minutes} {knee}");
    assert_eq!([field("extra,wiring,", "mass_total_g"), field("extra,wiring,", "mass_basis")], ["8.000", "estimate"]);
    let wiring = bill["buy"].as_array().expect("a list").iter().find(|line| line["role"] == "wiring").expect("is there");
    assert_eq!((wiring["mass_g"].as_f64(), wiring["kind"].as_str()), (Some(8.0), Some("extra")));
    assert!(page.contains("| wiring | - | 1 | 8.00 | estimate |"), "{page}");
    assert!(page.contains("| cage_rod | 8 | 192.0 | 192.00 | carbon |") && field("rod,cage_rod,", "length_mm") == "192.00", "{page}");
    assert_eq!(bill["rods"].as_array().expect("a list").len(), 4);
    bench.write("half.toml", "base = \"cognifly\"\n[override.parts.motor-1104]\nprice = 9.5\n");
    let (code, _, err) = bench.run(&["bom", "half.toml"]);
    assert!(code == 2 && err.contains("lacks currency or price_source"), "{err}");
    bench.write("half.toml", "base = \"cognifly\"\n[override.materials.abs]\ncurrency = \"EUR\"\n");
    let (code, _, err) = bench.run(&["bom", "half.toml"]);
    assert!(code == 2 && err.contains("lacks price_per_kg, currency or price_source") && err.contains("half.toml:3"), "{err}");
    bill_to_buy_from(&bench, &page, &csv);
    assert_eq!(bench.run(&["bom", "--kerf", "-1"]).0, 2);
    bench.write("short.toml", "base = \"cognifly\"\n[override.parts.rod-carbon-3]\nstock_length_mm = 150.0\n");
    let (code, out, err) = bench.run(&["bom", "short.toml"]);
    assert!(code == 1 && out.contains("is longer than the stock of 150 mm") && err.contains("longer than the stock"), "{err}");
}

#[test]
fn planted_a_thicker_hinge_is_stiffer_hits_harder_and_is_held_to_it() {
    let bench = Bench::new(&[("thick.toml", "base = \"cognifly\"\nname = \"thick\"\n[corner]\ncorner_hinge_thickness_mm = 3.3\n")]);
    let plain = bench.json(&["diff", "cognifly", "thick.toml", "--json"]);
    let names = |difference: &serde_json::Value| -> Vec<String> {
        let measures = difference["measures"].as_array().expect("a list").iter();
        measures.map(|m| m["name"].as_str().expect("a name").to_string()).collect()
    };
    assert!(names(&plain).iter().all(|name| name != "stiffness"));
    let found = bench.json(&["diff", "cognifly", "thick.toml", "--strength", "--json"]);
    let grown = |name: &str| {
        let at = names(&found).iter().position(|known| known == name).unwrap_or_else(|| panic!("no {name}: {found}"));
        let [a, b] = [0, 1].map(|side| found["measures"][at]["values"][side].as_f64().expect("a number"));
        b / a
    };
    // The webs bend: their stiffness grows with the cube of the thickness, that of the frame with a part of it.
    assert!((1.03..1.3).contains(&grown("stiffness")), "{}", grown("stiffness"));
    assert!(grown("design_drop.peak") > 1.0 && grown("design_drop.travel") < 1.0);
    let (code, _, err) = bench.run(&["diff", "cognifly", "thick.toml", "--strength", "--fail-on-increase", "design_drop.peak=0.1g"]);
    assert!(code == 1 && err.contains("design_drop.peak grew by"), "{code} {err}");
    let (code, _, err) = bench.run(&["diff", "cognifly", "thick.toml", "--fail-on-increase", "stiffness=1"]);
    assert!(code == 2 && err.contains("only known with --strength"), "{code} {err}");
}

#[test]
fn planted_solve_keeps_a_goal_of_the_mechanics() {
    let bench = Bench::new(&[]);
    let before = bench.json(&["explain", "strut_rod", "--strength", "--json"]);
    let own = before["responses"][1]["measures"]["stiffness"].as_f64().expect("a number");
    let goal = format!("stiffness>={}", 1.02 * own);
    let solve = ["solve", "--minimise", "mass", "--vary", "strut_rod=49..54", "--frames", "12", "--json"];
    let found = bench.json(&[&solve[..], &["--subject-to", &goal]].concat());
    assert!(found["measures"]["stiffness"].as_f64().expect("a number") >= 1.02 * own, "{found}");
    // A longer strut is stiffer and heavier: the least that does is not the longest.
    let strut = found["values"][0]["after"].as_f64().expect("a number");
    assert!((50.1..53.0).contains(&strut), "{strut}");
    // The drop's peak falls with the strut down to the bound: with few frames the search has not come there, and says so.
    let few = bench.json(&["solve", "--minimise", "design_drop.peak", "--vary", "strut_rod=48..52", "--frames", "4", "--json"]);
    assert_eq!((few["ended"].as_str(), few["looked_at"].as_u64()), (Some("frames_spent"), Some(4)), "{few}");
    let (code, _, err) = bench.run(&["solve", "--minimise", "stiffness", "--vary", "strut_rod", "--mechanics", "absent.toml"]);
    assert!(code == 2 && err.contains("absent.toml"), "{err}");
    let (code, _, err) = bench.run(&["solve", "--minimise", "mass", "--vary", "strut_rod", "--mechanics", "x.toml"]);
    assert!(code == 2 && err.contains("neither aim nor goal"), "{err}");
}

#[test]
fn analytic_schemas_name_every_parameter_and_its_bounds() {
    let bench = Bench::new(&[]);
    let schema = bench.json(&["schema"]);
    assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
    for p in flexframe::params::parameters() {
        let entry = &schema["properties"][p.table]["properties"][p.key];
        assert_eq!((entry["minimum"].as_f64(), entry["maximum"].as_f64()), (Some(p.min), Some(p.max)), "{}.{}", p.table, p.key);
        let text = entry["description"].as_str().expect("text");
        assert!(text.starts_with(p.doc.trim()) && text.contains(p.unit()), "{text}");
    }
    for kind in ["frame", "model", "plan", "study", "mechanics", "bought", "materials", "printer", "baseline"] {
        assert_eq!(bench.json(&["schema", kind])["type"], "object", "{kind}");
    }
    let study = bench.json(&["schema", "study"]);
    assert_eq!(study["properties"]["vary"]["properties"]["rods"]["properties"]["arm_rod_length_mm"]["items"]["type"], "number");
    assert_eq!(study["then"]["required"], serde_json::json!(["seeds"]));
    assert_eq!(bench.json(&["schema", "mechanics"])["properties"]["ground"]["properties"]["friction"]["maximum"], 1.0);
    let part = &bench.json(&["schema", "bought"])["properties"]["parts"]["additionalProperties"];
    assert_eq!(
        (part["additionalProperties"].clone(), part["properties"]["mass_g"]["description"].clone()),
        (false.into(), "Mass of one, g. 0 to 5000 g.".into())
    );
}

#[test]
fn analytic_watch_says_what_a_save_changes() {
    let bench = Bench::new(&[("mine.toml", LIGHT)]);
    let mut child =
        bench.command(&["watch", "mine.toml", "--saves", "3"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("starts");
    let out = BufReader::new(child.stdout.take().expect("is piped"));
    let (told, lines) = channel();
    std::thread::spawn(move || out.lines().map_while(Result::ok).try_for_each(|line| told.send(line)));
    let until = |words: &str| -> Vec<String> {
        let mut seen = Vec::new();
        loop {
            let line = lines.recv_timeout(Duration::from_secs(120)).unwrap_or_else(|_| panic!("no {words:?} after {seen:#?}"));
            seen.push(line);
            if seen.last().is_some_and(|line| line.contains(words)) {
                return seen;
            }
        }
    };
    until("watching mine.toml");
    bench.write("mine.toml", &format!("{LIGHT}[limits]\nmass_budget_g = 200.0\n"));
    let seen = until("after the save").join("\n");
    assert!(seen.contains("limits.mass_budget_g 250.00 -> 200.00 g") && seen.contains("broken: the frame takes off with"), "{seen}");
    bench.write("mine.toml", "base = \"cognifly\"\n[rods]\nlength = 3\n");
    until("refused after");
    // As editors do it: another file, renamed into place.
    bench.write("mine.toml~", &LIGHT.replace("battery-2s-850", "battery-3s-450"));
    fs::rename(bench.path("mine.toml~"), bench.path("mine.toml")).expect("can be renamed");
    let seen = until("after the save").join("\n");
    assert!(seen.contains("bought.battery battery-2s-850 -> battery-3s-450") && seen.contains("mended:"), "{seen}");
    assert!(seen.contains("peak ") && seen.contains("reacts to mass and gap only"), "{seen}");
    assert_eq!(child.wait().expect("ends").code(), Some(0));
    let (code, _, err) = bench.run(&["watch", "cognifly"]);
    assert!(code == 2 && err.contains("watch a file"), "{err}");
    assert_eq!(bench.run(&["watch", "nowhere.toml"]).0, 2);
}

#[test]
fn planted_new_moves_the_side_rods_where_it_helps_and_where_it_is_asked_for() {
    let bench = Bench::new(&[]);
    let ratio = |file: &str| {
        let text = fs::read_to_string(bench.path(file)).expect("is there");
        let line = text.lines().find(|line| line.starts_with("cage_side_ratio = ")).expect("is moved").to_string();
        line.split(' ').nth(2).and_then(|value| value.parse::<f64>().ok()).expect("a number")
    };
    // The front rods stay: only shorter sides make the frame less deep.
    bench.write("long.toml", "base = \"cognifly\"\nrods.cage_side_ratio = 1.14\nlimits.envelope_depth_mm = 240.0\n");
    let shorter = ["new", "shorter", "--from", "long.toml", "--envelope", "210x225x120", "--vary", "cage_rod=191.5..192"];
    let (code, out, err) = bench.run(&shorter);
    assert_eq!(code, 0, "{out}{err}");
    assert!((1.0..1.09).contains(&ratio("shorter.toml")), "{out}");
    assert_eq!(bench.run(&["check", "-q", "shorter.toml"]).0, 0, "{out}");
    // A frame that keeps every limit moves, too, where it is outside of the bounds that are asked for.
    let (code, out, err) = bench.run(&["new", "longer", "--envelope", "210x240x120", "--vary", "cage_side_ratio=1.1..1.14"]);
    assert_eq!(code, 0, "{out}{err}");
    assert!((1.1..=1.14).contains(&ratio("longer.toml")), "{out}");
    assert_eq!(bench.run(&["check", "-q", "longer.toml"]).0, 0, "{out}");
    let (code, _, err) = bench.run(&["new", "x", "--mass", "250", "--vary", "side_ratio"]);
    assert!(code == 2 && err.contains("there is no parameter `side_ratio`"), "{err}");
}
