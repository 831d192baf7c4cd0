//! Studies through the program: rows that survive a kill, refusals, the page, a row as a frame.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use assert_cmd::cargo::cargo_bin;
use serde_json::Value;
use tempfile::TempDir;

/// A row of this plan is made in under a second; arms of 56 and of 66 mm close to no frame.
const PLAN: &str = "base = \"cognifly\"\nsampling = \"grid\"\npoints = 4\nmeasures = [\"mass\", \"envelope.width\", \"margin.envelope\", \"violations\"]\n\
                    [vary]\narm_rod = [56, 86]\n[choose]\nbought.rod = [\"rod-carbon-3\", \"rod-bamboo-3\"]\n";

struct Desk(TempDir);

impl Desk {
    fn new(plan: &str) -> Self {
        let desk = Self(tempfile::tempdir().expect("a folder"));
        fs::write(desk.path().join("s.toml"), plan).expect("can be written");
        desk
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(cargo_bin("flexframe"));
        command.arg("study").args(arguments).current_dir(self.path()).env("NO_COLOR", "1");
        command
    }

    fn run(&self, arguments: &[&str]) -> (i32, String, String) {
        let done = self.command(arguments).output().expect("the program starts");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        (done.status.code().expect("ends"), text(done.stdout), text(done.stderr))
    }

    fn good(&self, arguments: &[&str]) -> String {
        let (code, out, err) = self.run(arguments);
        assert_eq!(code, 0, "{arguments:?}: {out}{err}");
        out
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    fn table(&self, out: &str) -> Vec<Vec<String>> {
        let text = self.read(&format!("{out}/study-s/study.csv"));
        let rows = csv_rows(&text);
        assert_eq!(rows[0][0], "row");
        rows
    }
}

fn csv_rows(text: &str) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
    reader.records().map(|record| record.expect("a row").iter().map(String::from).collect()).collect()
}

#[test]
fn planted_a_killed_study_goes_on_and_its_table_is_that_of_an_undisturbed_one() {
    let desk = Desk::new(PLAN);
    desk.good(&["run", "s.toml", "-o", "whole", "-q"]);
    let journal = desk.path().join("out/study-s/rows.jsonl");
    let mut run = desk.command(&["run", "s.toml", "--cores", "1"]).stdout(Stdio::null()).spawn().expect("starts");
    let rows = || fs::read_to_string(&journal).unwrap_or_default().lines().count();
    let begun = Instant::now();
    while rows() < 5 && begun.elapsed() < Duration::from_secs(120) {
        std::thread::sleep(Duration::from_millis(5));
    }
    run.kill().expect("can be killed");
    run.wait().expect("ends");
    let kept = rows() - 1;
    assert!((4..8).contains(&kept), "{kept} rows were finished when it was killed");
    assert!(!desk.path().join("out/study-s/study.csv").exists(), "half a table is none");
    // What was being written when the machine lost its power.
    fs::write(&journal, fs::read_to_string(&journal).expect("is there") + "{\"row\":7,\"fig").expect("can be written");
    let out: Value = serde_json::from_str(&desk.good(&["run", "s.toml", "--json"])).expect("JSON");
    assert_eq!((out["known"].as_u64(), out["evaluated"].as_u64()), (Some(8), Some(8 - kept as u64)), "{out}");
    assert_eq!(desk.read("out/study-s/study.csv"), desk.read("whole/study-s/study.csv"));

    // A frame that cannot be is a row with its reason; the others have figures that other commands give, too.
    let table = desk.table("out");
    let column = |name: &str| table[0].iter().position(|known| known == name).unwrap_or_else(|| panic!("{name} in {:?}", table[0]));
    let refused: Vec<&Vec<String>> = table[1..].iter().filter(|row| !row[column("refused")].is_empty()).collect();
    assert_eq!(refused.len(), 4, "{table:?}");
    let reasons = ["the way left between motor mount and fork", "the struts would tilt by"];
    let has_reason = |row: &Vec<String>| reasons.iter().any(|reason| row[column("refused")].contains(reason));
    assert!(refused.iter().all(|row| has_reason(row) && row[column("mass")].is_empty()), "{refused:?}");
    let (at, row) = table[1..].iter().enumerate().next_back().expect("rows");
    let picked: Value = serde_json::from_str(&desk.good(&["pick", "s.toml", &at.to_string(), "-o", "mine", "--json"])).expect("JSON");
    assert_eq!((&picked["schema_version"], &picked["file"], &picked["row"]), (&1.into(), &"mine.toml".into(), &at.into()), "{picked}");
    let picked = desk.read("mine.toml");
    assert!(picked.contains("rod = \"rod-bamboo-3\"") && picked.contains("arm_rod_length_mm = 86"), "{picked}");
    let checked =
        Command::new(cargo_bin("flexframe")).args(["check", "mine.toml", "--json"]).current_dir(desk.path()).output().expect("starts");
    let checked: Value = serde_json::from_slice(&checked.stdout).expect("JSON");
    let mass = checked.to_string();
    assert!(mass.contains(&row[column("mass")]), "{} g is not in {mass}", row[column("mass")]);

    let (code, _, err) = desk.run(&["report", "s.toml", "--goals", "mass,envelope.width"]);
    assert_eq!(code, 0, "{err}");
    let page = desk.read("out/study-s/report/report.html");
    assert!(page.contains("the way left between motor mount and fork") && page.contains("<svg") && !page.contains("http://localhost"));
    let report: Value = serde_json::from_str(&desk.read("out/study-s/report/report.json")).expect("JSON");
    assert_eq!((report["rows"].as_u64(), report["refused"].as_u64()), (Some(8), Some(4)));
    let (code, _, err) = desk.run(&["report", "s.toml", "--goals", "mass,peak"]);
    assert!(code == 2 && err.contains("the study has no measure `peak`"), "{err}");
    // One goal: the rows that are best in it.
    desk.good(&["report", "s.toml", "--goals", "mass"]);
    let report: Value = serde_json::from_str(&desk.read("out/study-s/report/report.json")).expect("JSON");
    assert_eq!(report["front"].as_array().map(Vec::len), Some(1), "{report:#}");
}

/// A figure of the bill is a goal as a measure is, and one that nothing explains says why.
#[test]
fn planted_a_printing_time_is_a_goal_and_has_indices() {
    let plan = "samples = 4\nseed = 1\nsampling = \"saltelli\"\nmeasures = [\"mass\", \"print.time\", \"violations\"]\n[vary]\ncage_rod = [188.0, 192.0]\n";
    let desk = Desk::new(plan);
    desk.good(&["run", "s.toml"]);
    for goals in ["print.time", "mass,print.time"] {
        desk.good(&["report", "s.toml", "--goals", goals]);
    }
    let report: Value = serde_json::from_str(&desk.read("out/study-s/report/report.json")).expect("JSON");
    let named = |key: &str| {
        report[key].as_array().expect("a list").iter().map(|one| one["measure"].as_str().expect("a name").to_string()).collect::<Vec<_>>()
    };
    let mut all = [named("indices"), named("without_indices")].concat();
    all.sort();
    assert_eq!(all, ["mass", "print.time", "violations"], "{report:#}");
}

#[test]
fn planted_limits_of_this_machine_are_refused_on_a_server() {
    let desk = Desk::new("samples = 2\nmeasures = [\"mass\"]\n[vary]\ncage_rod = [188.0, 192.0]\n");
    let (code, _, err) = desk.run(&["run", "s.toml", "--engine", "hq", "--budget", "1s"]);
    assert!(code == 2 && err.contains("--budget and --cores are of this machine"), "{err}");
}

/// Somebody's file with the name of a journal is not one, with a line end and without.
#[test]
fn planted_a_file_that_is_no_journal_is_refused_and_kept() {
    let desk = Desk::new("samples = 2\nmeasures = [\"mass\"]\n[vary]\ncage_rod = [188.0, 192.0]\n");
    std::fs::create_dir_all(desk.path().join("out/study-s")).expect("a folder");
    let place = desk.path().join("out/study-s/rows.jsonl");
    for text in ["my notes", "my notes\n"] {
        std::fs::write(&place, text).expect("is written");
        let (code, _, err) = desk.run(&["run", "s.toml"]);
        assert!(code == 2 && err.contains("no row of a study"), "{err}");
        assert_eq!(std::fs::read_to_string(&place).expect("is there"), text);
    }
}

/// A study that was asked to end has kept its rows and not done its work.
#[cfg(unix)]
#[test]
fn planted_an_interrupted_study_ends_with_the_code_of_its_signal_and_keeps_its_rows() {
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let desk = Desk::new(PLAN);
        let journal = desk.path().join("out/study-s/rows.jsonl");
        let rows = || fs::read_to_string(&journal).unwrap_or_default().lines().count();
        let run = desk.command(&["run", "s.toml", "--cores", "1", "--json"]).stdout(Stdio::piped()).spawn().expect("starts");
        let begun = Instant::now();
        while rows() < 3 && begun.elapsed() < Duration::from_secs(120) {
            std::thread::sleep(Duration::from_millis(5));
        }
        Command::new("kill").args([signal, &run.id().to_string()]).status().expect("is there");
        let done = run.wait_with_output().expect("ends");
        let told: Value = serde_json::from_slice(&done.stdout).expect("JSON");
        assert_eq!((done.status.code(), &told["table"]), (Some(code), &Value::Null), "{told}");
        assert_eq!(told["known"].as_u64(), Some(rows() as u64 - 1), "{told}");
        let on: Value = serde_json::from_str(&desk.good(&["run", "s.toml", "--json"])).expect("JSON");
        assert_eq!((on["known"].as_u64(), on["evaluated"].as_u64()), (Some(8), told["known"].as_u64().map(|known| 8 - known)), "{on}");
    }
}

#[test]
fn planted_a_damaged_line_of_the_rows_can_be_deleted_and_its_row_comes_again() {
    let desk = Desk::new("samples = 9\nmeasures = [\"mass\"]\n[vary]\narm_rod = [40, 41]\n");
    desk.good(&["run", "s.toml", "-q"]);
    let (journal, table) = (desk.path().join("out/study-s/rows.jsonl"), desk.read("out/study-s/study.csv"));
    let mut lines: Vec<Vec<u8>> = desk.read("out/study-s/rows.jsonl").lines().map(|line| line.as_bytes().to_vec()).collect();
    let write = |lines: &[Vec<u8>]| fs::write(&journal, [&lines.join(&b'\n')[..], b"\n"].concat()).expect("can be written");
    // A byte of a reason that is no text, and half a line.
    for length in [lines[4].len() - 5, 7] {
        lines[4].truncate(length);
        lines[4].extend(if length == 7 { &b""[..] } else { b"\xff..\"}" });
        write(&lines);
        for action in ["run", "report"] {
            let (code, _, err) = desk.run(&[action, "s.toml"]);
            assert!(code == 2 && err.contains("line 5 is no row of a study; delete that line"), "{action}: {err}");
        }
        assert_eq!(fs::read(&journal).expect("is there"), [&lines.join(&b'\n')[..], b"\n"].concat(), "it stays as it is");
    }
    lines.remove(4);
    write(&lines);
    let out: Value = serde_json::from_str(&desk.good(&["run", "s.toml", "--json"])).expect("JSON");
    assert_eq!((out["known"].as_u64(), out["evaluated"].as_u64()), (Some(9), Some(1)), "{out}");
    assert_eq!(desk.read("out/study-s/study.csv"), table);
    // The first line says of which study the rows are: without it they are none.
    lines[0] = b"nothing".to_vec();
    write(&lines);
    let (code, _, err) = desk.run(&["run", "s.toml"]);
    assert!(code == 2 && err.contains("line 1 is no row of a study; move it away"), "{err}");
}

/// What HyperQueue lacks is wrong usage; blocks of another plan do not go without a word.
#[cfg(unix)]
#[test]
fn planted_hyperqueue_that_is_not_there_is_told_and_so_are_foreign_blocks() {
    use std::os::unix::fs::PermissionsExt;
    let plan = |most: u32| format!("samples = 3\nmeasures = [\"mass\"]\n[vary]\narm_rod = [40, {most}]\n");
    let desk = Desk::new(&plan(41));
    let run = |more: &[&str]| {
        let mut command = desk.command(&[&["run", "s.toml", "--engine", "hq"][..], more].concat());
        let done = command.env("PATH", desk.path().join("bin")).env("HQ_SERVER_DIR", "servers").output().expect("starts");
        (done.status.code(), String::from_utf8(done.stderr).expect("UTF-8"))
    };
    let stand_in = |name: &str, text: &str| {
        let place = desk.path().join("bin").join(name);
        fs::write(&place, format!("#!/bin/sh\n{text}\n")).expect("can be written");
        fs::set_permissions(&place, fs::Permissions::from_mode(0o755)).expect("is ours");
    };
    fs::create_dir(desk.path().join("bin")).expect("can be made");
    let (none, no_server) = ("(pip install hyperqueue)", "answers at servers; start one with `hq server start`");
    let is_refused = |said: &str| {
        let (code, err) = run(&[]);
        assert!(code == Some(2) && err.contains(said) && err.trim_end().lines().count() == 1, "{code:?} {err}");
        assert!(!desk.path().join("out/study-s/blocks.txt").exists(), "{said}");
    };
    is_refused(none);
    stand_in("python3", "exit 67");
    is_refused(none);
    stand_in("python3", "exit 68");
    is_refused(no_server);
    stand_in("hq", "exit 1");
    is_refused(no_server);

    // A task of a plan that was changed meanwhile, and what a run that was killed leaves.
    let folder = desk.path().join("out/study-s");
    fs::create_dir_all(folder.join("blocks")).expect("can be made");
    fs::write(folder.join("blocks.txt"), "0-3\n").expect("can be written");
    desk.good(&["block", "s.toml", "--rows", "0-2", "--into", "out/study-s/blocks"]);
    fs::write(desk.path().join("s.toml"), plan(42)).expect("can be written");
    let (code, _, err) = desk.run(&["run", "s.toml", "--restart"]);
    assert!(code == 0 && err.contains("1 block of rows") && err.contains("of another plan"), "{err}");
    assert!(!folder.join("blocks").exists() && !folder.join("blocks.txt").exists());
    assert!(run(&[]).0 == Some(0), "nothing is left to do");
}

/// The frame of a row that the study refuses is told as such, before the study is run and after.
#[test]
fn planted_a_picked_row_has_the_reason_for_which_the_study_refuses_it() {
    let desk = Desk::new(&PLAN.replace("points = 4", "points = 3"));
    let picked = |name: &str| -> Vec<Value> {
        let pick = |row: usize| desk.good(&["pick", "s.toml", &row.to_string(), "-o", &format!("{name}-{row}"), "--json"]);
        (0..6).map(|row| serde_json::from_str::<Value>(&pick(row)).expect("JSON")["refused"].clone()).collect()
    };
    let before = picked("before");
    desk.good(&["run", "s.toml", "-q"]);
    assert_eq!(picked("after"), before);
    let table = desk.table("out");
    let column = table[0].iter().position(|name| name == "refused").expect("is there");
    let stated: Vec<Value> =
        table[1..].iter().map(|row| if row[column].is_empty() { Value::Null } else { row[column].clone().into() }).collect();
    assert_eq!(before, stated);
    assert!(before.iter().any(Value::is_null) && !before.iter().all(Value::is_null), "{before:?}");
}

/// A table and a report beside a journal are of its rows; what a user wrote into them stays.
#[test]
fn planted_results_of_former_rows_go_and_what_was_changed_by_hand_is_kept() {
    // So many rows that they are not all evaluated before the end of the budget is seen, however busy the machine is.
    let plan = |most: u32| format!("samples = 60\nmeasures = [\"mass\"]\n[vary]\narm_rod = [40, {most}]\n");
    let desk = Desk::new(&plan(41));
    let [table, kept] = ["study.csv", "study.csv.yours"].map(|name| desk.path().join("out/study-s").join(name));
    desk.good(&["run", "s.toml"]);
    desk.good(&["report", "s.toml"]);
    let first = fs::read_to_string(&table).expect("is there");
    let date = fs::metadata(&table).and_then(|is| is.modified()).expect("has one");
    let (code, _, err) = desk.run(&["run", "s.toml"]);
    assert!(code == 0 && err.is_empty() && fs::metadata(&table).and_then(|is| is.modified()).is_ok_and(|now| now == date), "{err}");
    fs::write(&table, "changed by hand").expect("can be written");
    let (code, _, err) = desk.run(&["run", "s.toml"]);
    assert!(code == 0 && err.contains("study.csv was changed since it was written: your text is kept as"), "{err}");
    assert_eq!([&table, &kept].map(|path| fs::read_to_string(path).expect("is there")), [first, "changed by hand".into()]);

    // Begun anew, and not done.
    fs::write(desk.path().join("s.toml"), plan(42)).expect("can be written");
    desk.good(&["run", "s.toml", "--restart", "--cores", "1", "--budget", "0s"]);
    assert!(!table.exists() && !desk.path().join("out/study-s/report").exists(), "they are of the former plan");
    assert_eq!(fs::read_to_string(&kept).expect("is there"), "changed by hand");
    desk.good(&["run", "s.toml"]);
    desk.good(&["report", "s.toml"]);
    fs::write(desk.path().join("out/study-s/report/notes.txt"), "mine").expect("can be written");
    fs::write(&table, "again").expect("can be written");
    let (code, _, err) = desk.run(&["run", "s.toml", "--restart", "--cores", "1", "--budget", "0s"]);
    assert!(code == 0 && err.contains("study.csv.yours-2"), "{err}");
    assert_eq!(fs::read_dir(desk.path().join("out/study-s/report")).expect("is there").count(), 1);
}

#[test]
fn planted_rows_of_another_plan_are_no_rows_of_this_one() {
    let desk = Desk::new("samples = 2\nmeasures = [\"mass\"]\n[vary]\narm_rod = [40, 41]\n");
    desk.good(&["run", "s.toml"]);
    // What it says of itself is no other plan.
    let described = "description = \"short arms\"\nsamples = 2\nmeasures = [\"mass\"]\n[vary]\narm_rod = [40, 41]\n";
    fs::write(desk.path().join("s.toml"), described).expect("can be written");
    desk.good(&["report", "s.toml"]);
    fs::write(desk.path().join("s.toml"), "samples = 2\nmeasures = [\"mass\"]\n[vary]\narm_rod = [40, 42]\n").expect("can be written");
    let (code, _, err) = desk.run(&["run", "s.toml"]);
    assert!(code == 2 && err.contains("--restart"), "{err}");
    desk.good(&["run", "s.toml", "--restart"]);
    let table = desk.table("out");
    assert!(table.len() == 3 && table[1..].iter().all(|row| row[2].is_empty() && !row[3].is_empty()), "{table:?}");
    fs::write(desk.path().join("s.toml"), "samples = 2\nmeasures = [\"mass\"]\n[vary]\narm_rod = [40, 43]\n").expect("can be written");
    let (code, _, err) = desk.run(&["pick", "s.toml", "1", "-o", "other"]);
    assert!(code == 0 && err.contains("are of another plan"), "{err}");
    fs::write(desk.path().join("s.toml"), "samples = 2\nmeasures = [\"mass\"]\n[vary]\narm_rod = [40, 42]\n").expect("can be written");
    let (code, _, err) = desk.run(&["pick", "s.toml", "2", "-o", "mine"]);
    assert!(code == 2 && err.contains("rows 0 to 1"), "{err}");
    // A budget that is spent leaves rows for the next run.
    fs::write(desk.path().join("s.toml"), "samples = 60\nmeasures = [\"mass\"]\n[vary]\narm_rod = [40, 42]\n").expect("can be written");
    let out: Value =
        serde_json::from_str(&desk.good(&["run", "s.toml", "--restart", "--cores", "1", "--budget", "0s", "--json"])).expect("JSON");
    assert!(out["known"].as_u64().is_some_and(|known| (1..60).contains(&known)) && out["table"].is_null(), "{out}");
}

/// A frame whose rods follow from its size.
const SIZED: &str = "base = \"cognifly\"\n[target]\nwidth_mm = 240.0\nheight_mm = 124.0\nstrut_tilt_deg = 24.0\n";

/// However its keys are spelled, a plan has the same rows; and a size may be a column.
#[test]
fn analytic_rows_follow_from_what_varies_and_sizes_may_be_columns() {
    let rows = |vary: &str| {
        let text = format!("samples = 4\nmeasures = [\"mass\"]\n[vary]\n{vary}");
        let files = flexframe::params::files::Memory([("s.toml".into(), text.into_bytes())].into_iter().collect());
        let study = flexframe::study::load("s.toml", &files).expect("is a plan");
        (0..study.rows()).map(|row| study.inputs(row)).collect::<Vec<_>>()
    };
    assert_eq!(rows("cage_rod = [190, 192]\nrods.arm_rod_length_mm = [81, 82]\n"), rows("arm_rod = [81, 82]\ncage_rod = [190, 192]\n"));
    let desk = Desk::new("base = \"sized.toml\"\nmeasures = [\"mass\"]\ntable = \"sizes.csv\"\n");
    fs::write(desk.path().join("sized.toml"), SIZED).expect("can be written");
    fs::write(desk.path().join("sizes.csv"), "target.width_mm\n238\n240\n").expect("can be written");
    let out: Value = serde_json::from_str(&desk.good(&["run", "s.toml", "--json"])).expect("JSON");
    assert_eq!((&out["known"], &out["refused"]), (&serde_json::json!(2), &serde_json::json!(0)), "{out}");
}

/// Whatever its name ends in, and where the program is started in a folder that has a table of the same name.
#[test]
fn planted_a_table_is_the_one_beside_its_plan() {
    let desk = Desk::new("");
    fs::create_dir(desk.path().join("sub")).expect("can be made");
    for name in ["t.txt", "t.CSV", "t.csv"] {
        let plan = format!("measures = [\"mass\"]\ntable = \"{name}\"\n");
        for (path, text) in [("sub/p.toml", &*plan), (&format!("sub/{name}"), "arm_rod\n80\n81\n"), (name, "arm_rod\n70\n71\n72\n")] {
            fs::write(desk.path().join(path), text).expect("can be written");
        }
        assert!(desk.good(&["plan", "sub/p.toml"]).starts_with("p: 2 rows"), "{name}");
    }
    let (code, _, err) = desk.run(&["block", "sub/p.toml", "--rows", "1-1", "--into", "d"]);
    assert!(code == 2 && err.contains("give FIRST-END"), "{code} {err}");
}

#[test]
fn planted_plans_that_cannot_be_are_refused_at_their_line() {
    let vary = "[vary]\narm_rod = [70, 80]\n";
    let cases = [
        (format!("samples = 0\n{vary}"), "samples"),
        (format!("samples = 2.5\n{vary}"), "no whole number"),
        (format!("sampling = \"grid\"\nsamples = 9\n{vary}"), "`samples` does nothing with sampling = \"grid\""),
        (format!("points = 9\n{vary}"), "`points` does nothing with sampling = \"latin_hypercube\""),
        ("samples = 9\ntable = \"rows.csv\"\n".into(), "`samples` does nothing with a table"),
        (format!("sampling = \"halton\"\n{vary}"), "latin_hypercube"),
        (format!("sampling = \"sobol\"\nsamples = 65537\n{vary}"), "65536"),
        (format!("measures = [\"mas\"]\n{vary}"), "`mass`"),
        (format!("measures = [\"mass\", \"peak\", \"mass\"]\n{vary}"), "`mass` is stated twice"),
        (format!("sample = 3\n{vary}"), "`samples`"),
        ("[vary]\narm_rodd = [70, 80]\n".into(), "no parameter `arm_rodd`"),
        ("[vary]\narm_rod = [80, 70]\n".into(), "no range"),
        ("[vary]\narm_rod = [-1, 70]\n".into(), "out of bounds"),
        ("[vary]\narm_rod = [70, 80]\nrods.arm_rod_length_mm = [70, 80]\n".into(), "varies twice"),
        ("[choose]\nbought.battery = [\"battery-2s-850\", \"no-such\"]\n".into(), "no-such"),
        ("[choose]\nbought.batery = [\"battery-2s-850\"]\n".into(), "bought.batery"),
        (format!("[choose]\nprinter = [{}]\n", "\"prusa-mk4\", ".repeat(1001)), "more than 1000 names"),
        ("samples = 3\n".into(), "nothing varies"),
        ("table = \"t.csv\"\n".into(), "cannot read"),
        (format!("base = \"no-such\"\n{vary}"), "no frame `no-such`"),
        (format!("base = \"missing.toml\"\n{vary}"), "cannot read missing.toml"),
        (format!("measures = [\"stiffness\"]\nmechanics = \"none.toml\"\n{vary}"), "cannot read none.toml"),
        (format!("sampling = \"grid\"\nseed = 9\n{vary}"), "`seed` does nothing with sampling = \"grid\""),
        (format!("measures = [\"mass\"]\nmechanics = \"none.toml\"\n{vary}"), "`mechanics` does nothing with measures"),
        ("[choose]\nbought.battery = [\"battery-2s-850\", \"battery-2s-850\"]\n".into(), "has battery-2s-850 twice"),
        (format!("base = \"sized.toml\"\n{vary}"), "`rods.arm_rod_length_mm` cannot vary: it follows from [target]"),
        ("table = \"unknown.csv\"\n".into(), "unknown key `arm_rood`"),
    ];
    let desk = Desk::new("");
    fs::write(desk.path().join("sized.toml"), SIZED).expect("can be written");
    fs::write(desk.path().join("unknown.csv"), "arm_rood\n78\n").expect("can be written");
    for (plan, word) in &cases {
        fs::write(desk.path().join("s.toml"), plan).expect("can be written");
        let (code, _, err) = desk.run(&["run", "s.toml"]);
        assert!(code == 2 && err.contains(word), "{plan}: {code} {err}");
        assert!(err.contains("s.toml:") || *word == "unknown key `arm_rood`", "{plan}: its line is not told: {err}");
        assert!(!desk.path().join("out").exists(), "a plan that is refused writes nothing");
    }
    fs::write(desk.path().join("t.csv"), "arm_rod,bought.rod\n78,rod-carbon-3\nx,rod-carbon-3\n").expect("can be written");
    fs::write(desk.path().join("s.toml"), "table = \"t.csv\"\n").expect("can be written");
    let (code, _, err) = desk.run(&["plan", "s.toml"]);
    assert!(code == 2 && err.contains("t.csv: row 1, as `study.csv` counts: \"x\" is no number for rods.arm_rod_length_mm"), "{err}");
    fs::write(desk.path().join("t.csv"), "arm_rod,rods.arm_rod_length_mm\n78,79\n").expect("can be written");
    let (code, _, err) = desk.run(&["plan", "s.toml"]);
    assert!(code == 2 && err.contains("`rods.arm_rod_length_mm` has two columns"), "{err}");
}

/// Three sets of drops in which nothing is hidden, a wrong height that shows, and one that is larger than a height's error can be.
const HIDDEN: &str = "kind = \"recovery\"\neffects = [\"drop_height_error\"]\nstrengths = [266, 100000]\n[seeds]\nnothing = [5000, 5003]\none = [500, 501]\n";

#[test]
fn planted_hidden_effects_are_found_whatever_interrupts_the_study() {
    let desk = Desk::new(HIDDEN);
    desk.good(&["run", "s.toml", "-o", "whole", "-q"]);
    let journal = desk.path().join("out/study-s/rows.jsonl");
    let mut run = desk.command(&["run", "s.toml", "--cores", "1"]).stdout(Stdio::null()).spawn().expect("starts");
    let rows = || fs::read_to_string(&journal).unwrap_or_default().lines().count();
    let begun = Instant::now();
    while rows() < 3 && begun.elapsed() < Duration::from_secs(300) {
        std::thread::sleep(Duration::from_millis(5));
    }
    run.kill().expect("can be killed");
    run.wait().expect("ends");
    let kept = rows() - 1;
    assert!((2..5).contains(&kept), "{kept} rows were finished when it was killed");
    let out: Value = serde_json::from_str(&desk.good(&["run", "s.toml", "--json"])).expect("JSON");
    assert_eq!((out["evaluated"].as_u64(), out["refused"].as_u64()), (Some(5 - kept as u64), Some(1)), "{out}");
    assert_eq!(desk.read("out/study-s/study.csv"), desk.read("whole/study-s/study.csv"));
    // A task of a cluster writes the same lines.
    fs::create_dir(desk.path().join("blocks")).expect("can be made");
    desk.good(&["block", "s.toml", "--rows", "1-3", "--into", "blocks"]);
    let block = desk.read("blocks/1-3.jsonl");
    assert!(block.lines().count() == 3 && block.lines().all(|line| desk.read("out/study-s/rows.jsonl").contains(line)), "{block}");

    let table = desk.table("out");
    let column = |name: &str| table[0].iter().position(|known| known == name).unwrap_or_else(|| panic!("{name} in {:?}", table[0]));
    let cell = |row: usize, name: &str| table[row + 1][column(name)].as_str();
    assert_eq!(
        (cell(3, "truth"), cell(3, "strength"), cell(3, "law"), cell(3, "seed")),
        ("drop_height_error", "266", "proportional", "500")
    );
    assert_eq!((cell(3, "named"), cell(3, "rank"), cell(3, "right")), ("drop_height_error", "1", "1"));
    assert!(["named", "ambiguous"].contains(&cell(3, "verdict")), "{}", cell(3, "verdict"));
    let number = |name: &str| cell(3, name).parse::<f64>().unwrap_or_else(|_| panic!("{name}: {:?}", cell(3, name)));
    assert!((200.0..300.0).contains(&number("noncentrality")), "{}", number("noncentrality"));
    assert!(number("held_out.after") < 0.5 * number("held_out.before") && number("p.before") < 0.01 && number("p.after") > 0.01);
    let (truth, found) = (number("parameter.1.true"), number("parameter.1.found"));
    assert!((found / truth - 1.0).abs() < 0.5 && (number("parameter.1.least")..number("parameter.1.most")).contains(&found));
    assert_eq!((cell(0, "truth"), cell(0, "strength"), cell(0, "named"), cell(0, "noncentrality")), ("nothing", "", "", ""));
    assert!(cell(4, "refused").contains("drop_height_error does not reach the strength 100000") && cell(4, "verdict").is_empty());

    fs::write(desk.path().join("page.md"), "Above.\n<!-- study s -->\n<!-- end of study s -->\nBelow.\n").expect("can be written");
    desk.good(&["report", "s.toml", "--into", "page.md"]);
    let page = desk.read("page.md");
    assert!(page.starts_with("Above.\n<!-- study s -->\n") && page.ends_with("<!-- end of study s -->\nBelow.\n"), "{page}");
    assert!(page.contains("| named first, of all strengths | 1/1 = 1.00 (0.21 to 1.00) |"), "{page}");
    let facts = csv_rows(&desk.read("out/study-s/report/accuracy.csv"));
    let fact = |line: &str| facts.iter().find(|row| row[1] == line).unwrap_or_else(|| panic!("{line} in {facts:?}"));
    assert_eq!(fact("named first, of all strengths")[4..7], ["1", "1", "1"]);
    assert_eq!((fact("false alarms where nothing is hidden")[5].as_str(), fact("refused")[6].as_str()), ("3", "1"));
    assert!(desk.read("out/study-s/report/report.html").contains("Named first, by effect"));
    fs::write(desk.path().join("page.md"), "No marks.\n").expect("can be written");
    let (code, _, err) = desk.run(&["report", "s.toml", "--into", "page.md"]);
    assert!(code == 2 && err.contains("<!-- study s -->"), "{err}");

    // The drops of a row, for other commands.
    desk.good(&["pick", "s.toml", "3", "-o", "mine"]);
    let program = |arguments: &[&str]| {
        let done = Command::new(cargo_bin("flexframe")).args(arguments).current_dir(desk.path()).output().expect("starts");
        String::from_utf8(done.stdout).expect("UTF-8")
    };
    program(&["synthesize", "mine.toml"]);
    let diagnosis: Value = serde_json::from_str(&program(&["diagnose", "out/synthesize-mine/drops", "--json"])).expect("JSON");
    assert!(diagnosis["verdict"] == cell(3, "verdict") && diagnosis["effects"][0]["id"] == "drop_height_error", "{}", diagnosis["verdict"]);
    let (code, _, err) = desk.run(&["pick", "s.toml", "4", "-o", "other"]);
    assert!(code == 2 && err.contains("does not reach"), "{err}");
}

#[test]
fn planted_plans_of_hidden_effects_that_cannot_be_are_refused_at_their_line() {
    let seeds = "[seeds]\none = [1, 2]\n";
    let cases = [
        (format!("kind = \"recoveries\"\n{seeds}"), "recovery"),
        (format!("kind = \"recovery\"\nlevels = [4]\n{seeds}"), "levels"),
        (format!("kind = \"recovery\"\nlevels = [1.5]\n{seeds}"), "no whole number"),
        (format!("kind = \"recovery\"\nlaws = [\"additiv\"]\n{seeds}"), "`additive`"),
        (format!("kind = \"recovery\"\neffects = [\"preloads\"]\n{seeds}"), "`preload`"),
        (format!("kind = \"recovery\"\nmeasures = [\"verdicts\"]\n{seeds}"), "`verdict`"),
        (format!("kind = \"recovery\"\nstrengths = [0]\n{seeds}"), "strengths"),
        (format!("kind = \"recovery\"\nlevels = [2, 2]\n{seeds}"), "`levels` has 2 twice"),
        (format!("kind = \"recovery\"\nstrengths = [5, 5]\n{seeds}"), "`strengths` has 5 twice"),
        (format!("kind = \"recovery\"\nmost_effects = 4\n{seeds}"), "most_effects"),
        (format!("kind = \"recovery\"\nbase = \"cognifly\"\n{seeds}"), "`base`"),
        ("kind = \"recovery\"\n[seeds]\none = [5, 5]\n".into(), "no range of seeds"),
        ("kind = \"recovery\"\n[seeds]\nthree = [5, 6]\n".into(), "seeds.three"),
        ("kind = \"recovery\"\n".into(), "the plan has 0 rows"),
        ("kind = \"recovery\"\n[seeds]\nnothing = [0, 1000001]\n".into(), "the plan has 1000001 rows"),
    ];
    let desk = Desk::new("");
    for (plan, word) in &cases {
        fs::write(desk.path().join("s.toml"), plan).expect("can be written");
        let (code, _, err) = desk.run(&["run", "s.toml"]);
        assert!(code == 2 && err.contains(word), "{plan}: {code} {err}");
        assert!(!desk.path().join("out").exists(), "a plan that is refused writes nothing");
    }
}

#[test]
fn planted_the_plans_in_the_repository_are_plans() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/studies");
    let mut kinds = [0, 0];
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("is there").path();
        let study = flexframe::study::load(&path.display().to_string(), &flexframe::params::files::Disk);
        let study = study.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        kinds[usize::from(matches!(study.subject, flexframe::study::Subject::Recovery(_)))] += 1;
    }
    assert!(kinds[0] >= 2 && kinds[1] >= 4, "{kinds:?}");
}
