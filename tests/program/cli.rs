//! The program from outside: what it prints, writes, and tells the shell.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use assert_cmd::cargo::cargo_bin;
use tempfile::TempDir;

fn flexframe(arguments: &[&str]) -> Output {
    Command::new(cargo_bin("flexframe")).args(arguments).env("NO_COLOR", "1").output().expect("the program starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

/// A folder with one frame file, and where its result goes.
struct Bench {
    folder: TempDir,
}

impl Bench {
    fn new(frame: &str) -> Self {
        let bench = Self { folder: tempfile::tempdir().expect("a folder") };
        bench.write("frame.toml", frame);
        bench
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.folder.path().join(name), text).expect("can be written");
    }

    fn path(&self, name: &str) -> String {
        self.folder.path().join(name).display().to_string()
    }

    fn run(&self, command: &str, more: &[&str]) -> Output {
        let (frame, out) = (self.path("frame.toml"), self.path("out"));
        let mut arguments = vec![command, &frame];
        // What writes nothing takes no folder.
        if command != "check" && (!more.contains(&"--step") || more.contains(&"--png")) {
            arguments.extend(["-o", &out]);
        }
        arguments.extend(more);
        flexframe(&arguments)
    }

    /// Builds a frame that has to be refused: exit code 2, nothing written, nothing on standard output.
    fn refused(&self) -> String {
        let output = self.run("build", &[]);
        assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
        assert!(!Path::new(&self.path("out")).exists(), "something was written");
        assert_eq!(text(&output.stdout), "");
        text(&output.stderr)
    }
}

fn refused(frame: &str) -> String {
    Bench::new(frame).refused()
}

fn assert_says(message: &str, parts: &[&str]) {
    // The renderer breaks long lines; words are compared, not lines.
    let flat = message.replace(['│', '·', '╰', '├', '─', '▶', '×'], " ").split_whitespace().collect::<Vec<_>>().join(" ");
    for part in parts {
        assert!(flat.contains(part), "{part:?} is not in:\n{message}");
    }
}

#[test]
fn planted_typing_error_in_a_key_names_the_nearest_one() {
    let message = refused("base = \"cognifly\"\n\n[rods]\ncage_rod_lenght_mm = 190.0\n");
    assert_says(&message, &["unknown key `rods.cage_rod_lenght_mm`", "frame.toml:4:1", "did you mean `rods.cage_rod_length_mm`"]);
}

#[test]
fn planted_wrong_types() {
    let number = refused("base = \"cognifly\"\n[rods]\ncage_rod_length_mm = \"long\"\n");
    assert_says(&number, &["`rods.cage_rod_length_mm` is a text, it must be a number in mm", "frame.toml:3"]);
    let name = refused("base = \"cognifly\"\nprinter = 3\n");
    assert_says(&name, &["`printer` is a number, it must be a text in quotes", "frame.toml:2"]);
    let date = refused("base = \"cognifly\"\n[rods]\ncage_rod_length_mm = 2026-01-01\n");
    assert_says(&date, &["`rods.cage_rod_length_mm` is a date, it must be a number in mm"]);
}

#[test]
fn planted_out_of_bounds_and_not_a_number() {
    let low = refused("base = \"cognifly\"\n[corner]\ncorner_wall_mm = 0.3\n");
    assert_says(
        &low,
        &["`corner.corner_wall_mm` = 0.3 is out of bounds: 1.2 to 2.5 mm", "the nearest allowed value is 1.2 mm", "frame.toml:3"],
    );
    for odd in ["nan", "inf", "-inf"] {
        let message = refused(&format!("base = \"cognifly\"\n[rods]\narm_rod_length_mm = {odd}\n"));
        assert_says(&message, &["`rods.arm_rod_length_mm`", "give a finite number", "frame.toml:3"]);
    }
}

#[test]
fn planted_missing_reference() {
    let battery = refused("base = \"cognifly\"\n[bought]\nbattery = \"battery-3s-65O\"\n");
    assert_says(&battery, &["there is no bought part called `battery-3s-65O`", "`battery-3s-650`", "frame.toml:3"]);
    let material = refused("base = \"cognifly\"\n[materials]\nflexible = \"tpu\"\n");
    assert_says(&material, &["there is no material called `tpu`", "`tpu-95a`"]);
    let base = refused("base = \"cognifli\"\n");
    assert_says(&base, &["there is no base called `cognifli`", "`cognifly`", "frame.toml:1"]);
    let kind = refused("base = \"cognifly\"\n[bought]\nmotor = \"xt30\"\n");
    assert_says(&kind, &["it must be a motor"]);
    let nothing = refused("name = \"empty\"\n");
    assert_says(&nothing, &["is stated nowhere", "base = \"cognifly\"", "frame.toml:1:1"]);
}

#[test]
fn planted_text_of_another_encoding() {
    let bench = Bench::new("");
    let path = bench.path("frame.toml");
    fs::write(&path, b"base = \"cognifly\"\ndescription = \"f\xfcr\"\n").expect("can be written");
    assert_says(&bench.refused(), &["this is not UTF-8 text", "save the file as UTF-8", "frame.toml:2:17"]);
    let utf_16: Vec<u8> = [0xff, 0xfe].into_iter().chain("base".encode_utf16().flat_map(u16::to_le_bytes)).collect();
    fs::write(&path, utf_16).expect("can be written");
    assert_says(&bench.refused(), &["this is UTF-16 text", "save the file as UTF-8"]);
}

#[test]
fn planted_bases_that_name_each_other() {
    let bench = Bench::new("base = \"other\"\n");
    bench.write("other.toml", "base = \"frame\"\n");
    assert_says(&bench.refused(), &["the chain of bases does not end within 16 files"]);
}

#[test]
fn analytic_a_base_is_looked_up_beside_the_file_that_names_it() {
    let bench = Bench::new("base = \"parts/middle.toml\"\n");
    fs::create_dir(bench.path("parts")).expect("can be made");
    bench.write("parts/middle.toml", "base = \"wide.toml\"\n");
    bench.write("parts/wide.toml", "base = \"cognifly\"\n[limits]\nmass_budget_g = 100.0\n");
    let check = bench.run("check", &["-q"]);
    assert_says(&text(&check.stderr), &["the budget is 100.0 g"]);
    let nowhere = refused("base = \"nowhere.toml\"\n");
    assert_says(&nowhere, &["there is no base called `nowhere.toml`", "whose name ends in .toml, or a preset: cognifly", "frame.toml:1"]);
    // A file may be named as the preset that it changes.
    let bench = Bench::new("");
    bench.write("cognifly.toml", "base = \"cognifly\"\n[limits]\nmass_budget_g = 100.0\n");
    assert_says(&text(&flexframe(&["check", "-q", &bench.path("cognifly.toml")]).stderr), &["the budget is 100.0 g"]);
}

#[test]
fn planted_materials_and_parts_of_the_wrong_kind() {
    let joints = refused("base = \"cognifly\"\n[materials]\nflexible = \"carbon\"\n");
    assert_says(
        &joints,
        &[
            "`materials.flexible` is `carbon`, a material of rods; it must be a material that is printed",
            "these fit: `abs`, `asa`, `pa12`, `petg`, `pla`, `tpu-85a`, `tpu-95a`, `tpu-98a`",
            "frame.toml:3",
        ],
    );
    let rigid = flexframe(&["check", "--rigid", "carbon"]);
    assert_eq!(rigid.status.code(), Some(2));
    assert_says(&text(&rigid.stderr), &["`materials.rigid` is `carbon`, a material of rods", "command line"]);
    let rod = refused("base = \"cognifly\"\n[override.parts.rod-carbon-3]\nmaterial = \"pla\"\n");
    assert_says(&rod, &["`override.parts.rod-carbon-3.material` is `pla`", "these fit: `bamboo`, `carbon`", "frame.toml:3"]);
    let part = refused("base = \"cognifly\"\n[bought]\nmotor = \"xt30\"\n");
    assert_says(&part, &["`bought.motor` is `xt30`, a connector; it must be a motor", "`motor-1104`"]);
}

#[test]
fn planted_mistakes_in_an_entry_of_ones_own() {
    let own = |lines: &str| {
        let entry = "kind = \"board\"\nsize_mm = [30, 30, 6]\nmass_g = 6\nsource = \"x\"\n";
        refused(&format!("base = \"cognifly\"\n[bought]\nflight_controller = \"f\"\n[override.parts.f]\n{entry}{lines}"))
    };
    let lacking = own("mass_basis = \"estimate\"\n");
    let needed = ["the bought part `f` lacks `hole_pattern_mm`, from which `hub.stack_pattern_mm` follows", "in [override.parts.f]"];
    assert_says(&lacking, &needed);
    let basis = own("hole_pattern_mm = [20, 20]\nmass_basis = \"weighed\"\n");
    assert_says(&basis, &["there is no `weighed`, expected one of", "frame.toml:10", "`flexframe schema bought` explains the keys"]);
    let key = own("mass_basis = \"estimate\"\nhole_pattern = [20, 20]\n");
    assert_says(&key, &["unknown key `override.parts.f.hole_pattern`", "`override.parts.f.hole_pattern_mm`", "frame.toml:10"]);
    let kind = refused("base = \"cognifly\"\n[bought]\nbattery = \"b\"\n[override.parts.b]\nkind = \"batery\"\nmass_g = 3.0\n");
    assert_says(
        &kind,
        &["`override.parts.b.kind` is \"batery\"", "did you mean \"battery\"?", "the kinds are battery, board,", "frame.toml:5"],
    );
}

#[test]
fn planted_a_printer_that_is_not_in_the_catalogue() {
    let message = refused("base = \"cognifly\"\nprinter = \"prusa-mk3\"\n");
    let said =
        ["did you mean `prusa-mk4` or `prusa-mini`?", "`flexframe list printers`", "[override.printers.NAME] describes one of your own"];
    assert_says(&message, &said);
}

#[test]
fn planted_a_flexible_material_that_is_not_known_to_stretch() {
    let own = "kind = \"printed\"\ndensity_g_cm3 = 1.2\nprint_factor = 1.0\ncolour = [0.0, 0.0, 0.0, 1.0]\nsource = \"x\"\n";
    let message = refused(&format!("base = \"cognifly\"\n[materials]\nflexible = \"mine\"\n[override.materials.mine]\n{own}"));
    assert_says(
        &message,
        &["does not say its elongation_at_break_percent", "[override.materials.mine], or choose one of `abs`, `petg`, `pla`, `tpu-85a`"],
    );
    let kind = refused("base = \"cognifly\"\n[override.materials.abs]\nkind = \"print\"\n");
    assert_says(
        &kind,
        &["`kind` is \"print\", it is \"printed\" or \"rod\"", "`flexframe schema materials` explains the keys", "frame.toml:3"],
    );
}

#[test]
fn planted_what_cannot_be_left_out() {
    for role in ["motor", "propeller", "battery", "rod"] {
        let message = refused(&format!("base = \"cognifly\"\n[bought]\n{role} = \"none\"\n"));
        let said = format!("`bought.{role}` = \"none\": a frame cannot be without a {role}");
        assert_says(&message, &[&said, "name one: `", "frame.toml:3"]);
    }
    let still = refused("base = \"cognifly\"\n[bought]\nflight_controller = \"aio-20x20\"\nmotor_controller = \"none\"\n");
    assert_says(
        &still,
        &["leaves nothing that drives the motors", "motor_controller = \"aio-20x20\"", "flight_controller = \"none\"", "frame.toml:4"],
    );
    let target = refused("base = \"cognifly\"\n[target]\nwidth_mm = 210.0\nheight_mm = 116.0\n");
    assert_says(&target, &["`target.strut_tilt_deg` is stated nowhere", "needs all three: width_mm, height_mm and strut_tilt_deg"]);
    assert!(!target.contains("base = \"cognifly\"\n  help"), "{target}");
}

#[test]
fn planted_mistyped_tables() {
    let say = |table: &str, what: &str| assert_says(&refused(&format!("base = \"cognifly\"\n[{table}]\nmass_g = 6.0\n")), &[what]);
    say("overide.parts.motor-1104", "did you mean `override.parts.motor-1104.mass_g`?");
    say("override.part.motor-1104", "did you mean `override.parts.motor-1104.mass_g`?");
    say("override.bought.mine", "did you mean `override.parts.mine.mass_g`?");
    say("override.bought.\"mine-0.4\"", "did you mean `override.parts.mine-0.4.mass_g`?");
    say("override.mine", "did you mean `override.parts.mine.mass_g`?");
    say("parts.mine", "did you mean `override.parts.mine.mass_g`?");
    say("extra.receiver", "did you mean `extras.receiver.mass_g`?");
    say("extras", "did you mean `extras.NAME.mass_g`?");
    assert_says(&refused("base = \"cognifly\"\n[rodz]\n"), &["unknown key `rodz`", "did you mean `rods`"]);
    let value = refused("base = \"cognifly\"\nrods = 3\n");
    assert_says(&value, &["`rods` is a number, it must be a table", "[rods]", "frame.toml:2"]);
    assert!(!value.contains("did you mean"), "{value}");
}

#[test]
fn planted_extras_that_do_not_read_are_explained() {
    let extra = |lines: &str| refused(&format!("base = \"cognifly\"\n[extras.receiver]\n{lines}"));
    assert_says(&extra("mass_g = 1.5\n"), &["missing field `mass_basis`", "an extra states mass_g, mass_basis", "docs/frame-files.md"]);
    let basis = extra("mass_g = 1.5\nmass_basis = \"guess\"\nsource = \"x\"\n");
    assert_says(&basis, &["there is no `guess`, expected one of", "docs/frame-files.md"]);
    assert_says(&extra(""), &["missing field `mass_g`", "frame.toml:2"]);
    let flat = extra("mass_g = 1.5\nmass_basis = \"measured\"\nsource = \"x\"\nposition_mm = [0, 0]\n");
    assert_says(&flat, &["`position_mm`: a list of 2, expected three numbers", "frame.toml:6"]);
}

#[test]
fn planted_schema_of_another_version() {
    let message = refused("schema = 2\nbase = \"cognifly\"\n");
    assert_says(&message, &["`schema` is 2, this flexframe reads schema 1", "write schema = 1 if", "frame.toml:1"]);
}

#[test]
fn planted_a_table_where_a_value_belongs() {
    let filled = refused("base = \"cognifly\"\n[rods]\narm_rod_length_mm = { mm = 3.0 }\n");
    assert_says(&filled, &["`rods.arm_rod_length_mm` is a table, it must be a number in mm", "give a number in mm", "frame.toml:3"]);
    let empty = refused("base = \"cognifly\"\n[rods]\narm_rod_length_mm = {}\n");
    assert_says(&empty, &["`rods.arm_rod_length_mm` is a table, it must be a number in mm"]);
}

#[test]
fn planted_a_remedy_is_tried_before_it_is_named() {
    let frame = "base = \"cognifly\"\n[limits]\nenvelope_height_mm = 112.0\n";
    let check = text(&Bench::new(frame).run("check", &["--remedies"]).stdout);
    assert_says(&check, &["VIOLATED envelope", "clears it ("]);
}

#[test]
fn regress_no_figure_is_minus_zero_and_no_limit_is_broken_by_itself() {
    let frame = "base = \"cognifly\"\n[limits]\nmass_budget_g = 231.0\nenvelope_width_mm = 205.0\npropeller_clearance_mm = 4.0\n";
    let bench = Bench::new(frame);
    let check = text(&bench.run("check", &["--all"]).stdout);
    let build = bench.run("build", &["--no-pictures"]);
    let report = fs::read_to_string(bench.path("out/frame/report.md")).expect("was written");
    for text in [&check, &report, &text(&build.stderr)] {
        let minus = text.split_whitespace().find(|word| word.starts_with("-0") && word.trim_matches(['-', '0', '.', ',']).is_empty());
        assert_eq!(minus, None);
    }
    assert_says(&check, &["driven by", "the budget is 231.0 g", "print corners and hub joints flat"]);
}

#[test]
fn analytic_without_a_camera_its_connectors_are_left_out() {
    let bench = Bench::new("base = \"cognifly\"\n[bought]\ncamera = \"none\"\n");
    let check = bench.run("check", &["--all"]);
    assert_eq!(check.status.code(), Some(0));
    assert_eq!(bench.run("build", &[]).status.code(), Some(0));
    for file in ["bom.csv", "report.md", "manifest.json"] {
        let text = fs::read_to_string(bench.path(&format!("out/frame/{file}"))).expect("was written");
        assert!(text.contains("pi_carrier") && !text.contains("camera"), "{file}");
    }
    assert!(!text(&check.stdout).contains("camera"));
    assert!(!Path::new(&bench.path("out/frame/parts/camera_connector_left.stl")).exists());
    assert!(!Path::new(&bench.path("out/frame/pictures/part_camera_connector_left.png")).exists());
}

#[test]
fn planted_frame_that_cannot_close() {
    let message = refused("base = \"cognifly\"\n[rods]\ncage_rod_length_mm = 190.0\narm_rod_length_mm = 150.0\n");
    assert_says(
        &message,
        &[
            "frame.toml:4",
            "the struts would tilt by -51.9°",
            "10° to 35°",
            "it closes with arm_rod_length_mm = 93.5, or with cage_rod_length_mm = 269.9",
        ],
    );
    let inside = refused("base = \"cognifly\"\n[rods]\ncage_rod_length_mm = 98.0\narm_rod_length_mm = 110.0\n");
    assert_says(&inside, &["mm inside the knee", "it closes with cage_rod_length_mm = 213.4"]);
    let outside = refused("base = \"cognifly\"\n[rods]\ncage_rod_length_mm = 300.0\n");
    assert_says(&outside, &["mm outside the knee", "it closes with arm_rod_length_mm = 147.8, or with cage_rod_length_mm = 206.9"]);
}

#[test]
fn planted_walls_that_vanish_and_parts_that_collide() {
    let wall = refused("base = \"cognifly\"\n[hub_joint]\nhub_joint_diameter_mm = 4.5\n[rods]\nrod_diameter_mm = 4.0\n");
    assert_says(
        &wall,
        &["the wall of the hub joint's sockets would be 0.15 mm, it must be at least 0.40 mm", "raise hub_joint_diameter_mm"],
    );
    let rings = refused("base = \"cognifly\"\n[motor_mount]\nmotor_position_mm = 31.0\n");
    assert_says(&rings, &["it must be at least", "the mount's rings would run into the hub joint"]);
    let bores = refused("base = \"cognifly\"\n[hub]\nhub_mouth_mm = 24.0\n");
    assert_says(&bores, &["the bores of neighbouring arms would meet", "frame.toml:3"]);
    let holes = refused("base = \"cognifly\"\n[bought]\nmotor = \"motor-1104\"\n[override.parts.motor-1104]\nhole_count = 2\n");
    assert_says(&holes, &["has 2 screw holes, a motor mount has 3 or 4", "frame.toml:3"]);
}

#[test]
fn planted_overrides_are_held_to_the_catalogue() {
    let typing = refused("base = \"cognifly\"\n[override.parts.motor-1104]\nmass_gram = 6.0\n");
    assert_says(&typing, &["unknown key `override.parts.motor-1104.mass_gram`", "frame.toml:3"]);
    let negative = refused("base = \"cognifly\"\n[override.materials.abs]\ndensity_g_cm3 = -1.0\n");
    assert_says(&negative, &["= -1 is out of bounds: 0.05 to 25 g/cm³", "the nearest allowed value is 0.05 g/cm³", "frame.toml:3"]);
    let printer = refused("base = \"cognifly\"\n[override.printers.\"generic-0.4\"]\nnozzle_mm = 0.0\n");
    assert_says(&printer, &["= 0 is out of bounds: 0.1 to 2 mm", "the nearest allowed value is 0.1 mm", "frame.toml:3"]);
    let name = refused("base = \"cognifly\"\n[override.parts.motor-1140]\nmass_g = 6.0\n");
    assert_says(&name, &["there is no entry of parts called `motor-1140`", "`motor-1104`"]);
}

#[test]
fn planted_not_toml_and_no_file() {
    assert_says(&refused("base = \"cognifly\n"), &["this is not TOML", "frame.toml:1"]);
    let none = flexframe(&["build", "no-such-frame"]);
    assert_eq!(none.status.code(), Some(2));
    assert_says(&text(&none.stderr), &["there is no frame `no-such-frame`", "cognifly-mini"]);
    let missing = flexframe(&["check", "no/such/frame.toml"]);
    assert_eq!(missing.status.code(), Some(2));
    assert_says(&text(&missing.stderr), &["cannot read no/such/frame.toml"]);
}

#[test]
fn analytic_check_gates_and_build_does_not() {
    assert_eq!(flexframe(&["check"]).status.code(), Some(0));
    let heavy = Bench::new("base = \"cognifly\"\n[override.parts.battery-3s-650]\nmass_g = 90.0\n");
    let check = heavy.run("check", &["-q"]);
    assert_eq!(check.status.code(), Some(1));
    assert_eq!(text(&check.stdout), "");
    assert_says(&text(&check.stderr), &["takes off with 265.3 g", "250.0 g"]);
    let build = heavy.run("build", &["--no-pictures"]);
    assert_eq!(build.status.code(), Some(0));
    assert_says(&text(&build.stderr), &["warning:", "takes off with"]);
    assert!(Path::new(&heavy.path("out/frame/manifest.json")).exists());
}

#[test]
fn analytic_json_is_json_and_holds_the_findings() {
    let check = flexframe(&["check", "cognifly-v8", "--json"]);
    assert_eq!(check.status.code(), Some(1));
    let report: serde_json::Value = serde_json::from_slice(&check.stdout).expect("JSON");
    assert_eq!(report["schema_version"], 2);
    let findings = report["frames"][0]["findings"].as_array().expect("a list");
    let broken = findings.iter().filter(|f| f["verdict"] == "violated").count();
    assert_eq!(report["frames"][0]["violations"].as_u64(), Some(broken as u64));
    let width = findings.iter().find(|f| f["subject"] == "width without propellers").expect("is measured");
    assert!((width["margin"].as_f64().expect("a number") + 1.93).abs() < 0.02);
    let total = report["frames"][0]["masses"]["total_g"].as_f64().expect("a number");
    assert!((total - 241.0).abs() < 0.05, "{total}");
    let params: serde_json::Value = serde_json::from_slice(&flexframe(&["params", "--json"]).stdout).expect("JSON");
    assert!(params.as_array().expect("a list").len() > 150);
}

#[test]
fn regress_build_writes_the_whole_folder_and_nothing_else() {
    let bench = Bench::new("base = \"cognifly\"\nname = \"mine\"\n");
    let output = bench.run("build", &[]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let mut names: Vec<String> = fs::read_dir(bench.path("out"))
        .expect("was made")
        .map(|entry| entry.expect("is there").file_name().into_string().expect("UTF-8"))
        .collect();
    names.sort();
    assert_eq!(names, ["mine"]);
    let manifest: serde_json::Value =
        serde_json::from_slice(&fs::read(bench.path("out/mine/manifest.json")).expect("is there")).expect("JSON");
    for file in manifest["files"].as_array().expect("a list") {
        let path = bench.path("out/mine") + "/" + file["path"].as_str().expect("a path");
        let bytes = fs::read(&path).expect("every file named is there");
        assert_eq!(sha256(&bytes), file["sha256"].as_str().expect("a hash"), "{path}");
    }
    let report = fs::read_to_string(bench.path("out/mine/report.md")).expect("is there");
    for link in report.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
        assert!(Path::new(&(bench.path("out/mine") + "/" + link)).exists(), "{link} in report.md leads nowhere");
    }
}

fn sha256(bytes: &[u8]) -> String {
    use sha2::Digest;
    sha2::Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[test]
fn planted_folder_that_cannot_be_written_is_exit_3_and_the_last_result_stays() {
    let bench = Bench::new("base = \"cognifly\"\n");
    bench.write("taken", "a file where a folder should be");
    let output = flexframe(&["build", &bench.path("frame.toml"), "--no-pictures", "-o", &bench.path("taken")]);
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
    assert_says(&text(&output.stderr), &["cannot make the folder"]);

    assert_eq!(bench.run("build", &["--no-pictures"]).status.code(), Some(0));
    let before = fs::read(bench.path("out/frame/frame.glb")).expect("was built");
    bench.write("frame.toml", "base = \"cognifly\"\n[rods]\ncage_rod_length_mm = 1.0\n");
    assert_eq!(bench.run("build", &[]).status.code(), Some(2));
    assert_eq!(fs::read(bench.path("out/frame/frame.glb")).expect("is still there"), before);
}

#[test]
fn analytic_another_material_changes_the_mass() {
    let mass = |arguments: &[&str]| {
        let report: serde_json::Value = serde_json::from_slice(&flexframe(arguments).stdout).expect("JSON");
        report["frames"][0]["masses"]["total_g"].as_f64().expect("a number")
    };
    let (abs, pla) = (mass(&["check", "--json"]), mass(&["check", "--json", "--rigid", "pla"]));
    // 27 cm³ of rigid parts at 1.24 instead of 1.04 g/cm³.
    assert!((pla - abs - 5.5).abs() < 0.6, "{abs} {pla}");
    let wrong = flexframe(&["check", "--rigid", "plaa"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert_says(&text(&wrong.stderr), &["there is no material called `plaa`", "command line"]);
}

#[test]
fn analytic_usage_errors_are_exit_2_and_help_is_0() {
    assert_eq!(flexframe(&["biuld"]).status.code(), Some(2));
    assert_eq!(flexframe(&["params", "--filter", "no such key"]).status.code(), Some(2));
    let of_a_name = flexframe(&["params", "--filter", "sleeve_direction"]);
    assert!(of_a_name.status.code() == Some(2) && text(&of_a_name.stderr).contains("keys that hold a name: `sleeve.sleeve_direction`"));
    let direction = flexframe(&["explain", "sleeve_direction"]);
    assert!(
        text(&direction.stdout).starts_with("sleeve.sleeve_direction\n") && text(&direction.stdout).contains("along, across"),
        "{}",
        text(&direction.stdout)
    );
    for command in ["build", "check", "render", "params"] {
        let help = flexframe(&[command, "--help"]);
        assert_eq!(help.status.code(), Some(0));
        assert!(text(&help.stdout).contains("Example"), "{command}");
    }
    assert!(text(&flexframe(&["man"]).stdout).contains(".TH flexframe"));
    assert!(text(&flexframe(&["man", "study", "run"]).stdout).contains(".TH flexframe-study-run"));
    assert_eq!(flexframe(&["man", "stdy"]).status.code(), Some(2));
    assert!(text(&flexframe(&["weigh", "--help"]).stdout).contains("[FRAME] [READINGS.csv]\n"));
}

#[test]
fn planted_options_that_would_say_nothing_are_refused() {
    let bench = Bench::new("base = \"cognifly\"\n");
    let row = |ms: i32| format!("1,0.5,{},0\n", f64::from(ms) * 1e-3);
    bench.write("drops.csv", &format!("trial,height_m,t_s,accel_g\n{}", (0..50).map(row).collect::<String>()));
    let table = bench.path("drops.csv");
    for (arguments, said) in [
        (
            &["measure", &table, "--counts-per-g", "1,1,1"][..],
            "--counts-per-g is about the logger's .bin files, and none of the drops is in one; for a table give --units N/g",
        ),
        (&["diagnose", "--model", "paper", &table, "--offset-counts", "1,1,1"], "none of the drops is in one; for a table give --zero G"),
        (&["diagnose", &table, "--hold-out-heights", "50cm"], "give a number in m from 0.01 to 100, such as 0.5"),
        (&["drop", "--model", "paper", "--rate", "500"], "--rate says how measured drops are written: it goes with --fit"),
        (&["drop", "--model", "paper", "--trace", "-o", &bench.path("o")], "--trace goes with --json"),
    ] {
        let output = flexframe(arguments);
        let message = text(&output.stderr);
        assert!(output.status.code() == Some(2) && message.contains(said), "{arguments:?}: {message}");
    }
}

#[test]
fn regress_a_command_line_that_does_not_parse_is_an_error_in_json_too() {
    for arguments in [
        &["check", "--json", "--nosuchopt"][..],
        &["check", "--format", "json", "--nosuchopt"],
        &["check", "--nosuchopt", "--format=json"],
        &["--json", "biuld"],
        &["fold", "--step", "x", "--json"],
    ] {
        let output = flexframe(arguments);
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{arguments:?}: {error}"));
        let message = report["error"]["message"].as_str().expect("a message");
        assert!(report["error"]["exit_code"] == 2 && !message.starts_with("error") && !message.contains('\n'), "{report}");
        assert_eq!(output.status.code(), Some(2));
    }
    assert_eq!(text(&flexframe(&["check", "--nosuchopt"]).stdout), "");
    assert_eq!(text(&flexframe(&["check", "--format", "sarif", "--nosuchopt"]).stdout), "");
}

/// What bash offers for the last of some words, by the script that the program prints.
fn offered_by_bash(folder: &std::path::Path, words: &[&str]) -> Vec<String> {
    let program = cargo_bin("flexframe");
    let path = format!("{}:{}", program.parent().expect("a folder").display(), std::env::var("PATH").unwrap_or_default());
    let typed: Vec<String> = words.iter().map(|word| format!("'{word}'")).collect();
    let script = format!(
        "source <(flexframe completions bash)
         COMP_WORDS=(flexframe {}); COMP_CWORD={}
         _clap_complete_flexframe flexframe \"${{COMP_WORDS[COMP_CWORD]}}\"
         printf '%s\\n' \"${{COMPREPLY[@]}}\"",
        typed.join(" "),
        words.len()
    );
    let out = Command::new("bash").args(["-c", &script]).env("PATH", path).current_dir(folder).output().expect("bash");
    assert!(out.status.success(), "{}", text(&out.stderr));
    text(&out.stdout).lines().map(String::from).collect()
}

#[test]
fn analytic_a_shell_completes_names() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("cognifly-mine.toml"), "base = \"cognifly\"\n").expect("can be written");
    std::fs::write(folder.path().join("cognifly.txt"), "").expect("can be written");
    let offered = |words: &[&str]| offered_by_bash(folder.path(), words);
    let frames = offered(&["check", "cognifly-m"]);
    assert_eq!(frames, ["cognifly-mini", "cognifly-mine.toml"]);
    assert!(offered(&["build", "cognifly"]).iter().all(|name| !name.ends_with(".txt")));
    assert_eq!(offered(&["new", "light", "--rod", "rod-b"]), ["rod-bamboo-3"]);
    assert!(offered(&["new", "light", "--battery", ""]).iter().all(|name| name.starts_with("battery-")));
    assert_eq!(offered(&["check", "--rigid", "pet"]), ["petg"]);
    assert_eq!(offered(&["build", "--part", "kn"]), ["knee"]);
    assert_eq!(offered(&["explain", "bought.ba"]), ["bought.battery"]);
    let second = offered(&["solve", "--minimise", "mass", "--vary", "rods.arm_rod_length_mm,rods.st"]);
    assert_eq!(second, ["rods.arm_rod_length_mm,rods.strut_rod_length_mm"]);
    assert_eq!(offered(&["drop", "--model", "paper-"]), ["paper-corrected"]);
    // Keys without their tables, once something is typed.
    let arms = offered(&["explain", "arm_"]);
    assert!(arms.iter().any(|key| key == "arm_pitch_mm") && arms.iter().all(|key| key.starts_with("arm_")), "{arms:?}");
    assert_eq!(offered(&["solve", "--vary", "arm_pitch_mm,strut_rod_l"]), ["arm_pitch_mm,strut_rod_length_mm"]);
    let all = offered(&["explain", ""]);
    assert!(all.iter().all(|key| key.starts_with('-') || key.contains('.') || key == "base" || key == "printer"), "{all:?}");
    assert_eq!(offered(&["explain", "target.w"]), ["target.width_mm"]);
    assert_eq!(offered(&["solve", "--minimise", "envelope.w"]), ["envelope.width"]);
    assert_eq!(offered(&["solve", "--pareto", "mass,envelope.w"]), ["mass,envelope.width"]);
    assert_eq!(offered(&["solve", "--aim", "envelope.w"]), ["envelope.width="]);
    assert_eq!(offered(&["diff", "cognifly", "cognifly-v8", "--fail-on-increase", "mass.p"]), ["mass.printed="]);
    assert!(offered(&["fit", "--free", "k,"]).contains(&"k,c".to_string()));
    assert!(offered(&["fit", "--model", "nowhere.toml", "--free", ""]).contains(&"k".to_string()), "the default's, where there is none");
    assert_eq!(offered(&["coupon", "--read", "held=2.8,sl"]), ["held=2.8,slides="]);
    assert_eq!(offered(&["man", "synt"]), ["synthesize"]);
    assert_eq!(offered(&["man", "study", "ru"]), ["run"]);
    for words in [&["synthesize", "cog"][..], &["study", "run", "cog"], &["study", "pick", "cog"]] {
        assert_eq!(offered(words), ["cognifly-mine.toml"], "{words:?}");
    }
    for shell in ["elvish", "fish", "powershell", "zsh"] {
        assert!(text(&flexframe(&["completions", shell]).stdout).contains("flexframe"), "{shell}");
    }
}

/// Who stops reading hears no complaint; the exit code stays that of the findings.
#[test]
fn planted_reader_that_stops_reading() {
    for (arguments, code) in [(&["check", "--all"][..], 0), (&["check", "cognifly-v8"], 1), (&["check", "cognifly-v8", "--json"], 1)] {
        let mut child =
            Command::new(cargo_bin("flexframe")).args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("starts");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("ends");
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", text(&output.stderr));
        assert!(!text(&output.stderr).contains("cannot print"), "{arguments:?}: {}", text(&output.stderr));
    }
}

#[test]
fn regress_quiet_is_quiet() {
    let bench = Bench::new("base = \"cognifly\"\n");
    let output = bench.run("build", &["-q", "--no-pictures"]);
    assert_eq!((text(&output.stdout), text(&output.stderr)), (String::new(), String::new()));
    let render = bench.run("render", &["--json"]);
    let report: serde_json::Value = serde_json::from_slice(&render.stdout).expect("JSON");
    for path in report["pictures"].as_array().expect("a list") {
        let path = path.as_str().expect("a path");
        assert!(fs::read(path).expect("is there").starts_with(b"\x89PNG"), "{path}");
    }
}

/// The one document on standard output.
fn document(output: &Output) -> serde_json::Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {} {}", text(&output.stdout), text(&output.stderr)))
}

#[test]
fn planted_what_would_be_no_frame_is_not_amended() {
    let open = "base = \"cognifly\"\n[rods]\ncage_rod_length_mm = 300.0\n";
    let unknown = "base = \"cognifly\"\nqqqq = 1\n";
    let bench = Bench::new("base = \"cognifly\"\n");
    bench.write("scale.csv", "part,mass_g\nhub,9\n");
    let (bad, scale) = (bench.path("bad.toml"), bench.path("scale.csv"));
    for (before, arguments, said) in [
        (open, &["coupon", "--read", "plug=0.2", "--into", &bad][..], "the frame cannot close"),
        (open, &["weigh", &scale, "--into", &bad], "the frame cannot close"),
        (unknown, &["coupon", "--read", "plug=0.2", "--into", &bad], "unknown key `qqqq`"),
        (unknown, &["weigh", &scale, "--into", &bad], "unknown key `qqqq`"),
        ("name = \"empty\"\n", &["weigh", &scale, "--into", &bad], "is stated nowhere"),
    ] {
        bench.write("bad.toml", before);
        let output = flexframe(&[arguments, &["--json"]].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", text(&output.stderr));
        assert_says(&text(&output.stderr), &[said]);
        let refused = document(&output);
        assert!(refused["error"]["message"].as_str().is_some_and(|message| message.contains(said)), "{refused}");
        assert_eq!(fs::read_to_string(&bad).expect("is there"), before, "{arguments:?}");
    }
}

#[test]
fn analytic_json_is_one_document_with_its_version_whatever_the_end() {
    let bench = Bench::new("base = \"cognifly\"\n");
    bench.write("taken", "a file where a folder should be");
    let out = bench.path("out");
    for arguments in [
        &["render", "--findings", "-o", &out][..],
        &["coupon", "-o", &out],
        &["coupon", "--read", "plug=0.2", "--into", &bench.path("found.toml")],
        &["fold", "--step", "3"],
        &["build", "--part", "knee", "-o", &out],
    ] {
        let output = flexframe(&[arguments, &["--json"]].concat());
        assert!(output.status.code() == Some(0) && document(&output)["schema_version"].is_u64(), "{arguments:?}");
    }
    let [missing, taken, x] = ["missing/b", "taken", "x"].map(|name| bench.path(name));
    let solve = |of: &[&'static str], more: &[&str]| -> Vec<String> {
        let words = [&["solve", "--vary", "arm_rod", "--frames", "4"][..], of, more].concat();
        words.into_iter().map(String::from).collect()
    };
    let front = ["--pareto", "mass,clearance.propeller"];
    for (arguments, code, said) in [
        (solve(&["--minimise", "mass"], &["-o", &missing]), 3, "cannot write"),
        (solve(&front, &["-o", &taken]), 3, "cannot make the folder"),
        (solve(&["--minimise", "mass", "--subject-to", "mass<=100"], &[]), 1, "mass<=100g is 2"),
        (solve(&front, &["--subject-to", "mass<=100"]), 1, "mass<=100g is 2"),
        (["new", &x, "--mass", "150", "--frames", "4"].map(String::from).into(), 1, "no such variant was found"),
        (["man"].map(String::from).into(), 2, "leave --json out"),
        (["completions", "bash"].map(String::from).into(), 2, "leave --json out"),
        (["watch", &bench.path("frame.toml")].map(String::from).into(), 2, "leave --json out"),
        (["studio"].map(String::from).into(), 2, "leave --json out"),
    ] {
        let words: Vec<&str> = arguments.iter().map(String::as_str).chain(["--json"]).collect();
        let output = flexframe(&words);
        let told = document(&output);
        assert_eq!((output.status.code(), told["error"]["exit_code"].as_i64()), (Some(code), Some(code.into())), "{words:?}: {told}");
        assert_eq!(told["schema_version"], 1, "{words:?}");
        assert!(told["error"]["message"].as_str().is_some_and(|message| message.contains(said)), "{words:?}: {told}");
        assert!(text(&output.stderr).contains(said), "{words:?}: {}", text(&output.stderr));
    }
    // Where the answer could not be written, nobody waits for it.
    for arguments in
        [&["solve", "--minimise", "mass", "--vary", "arm_rod", "--frames", "4", "-o", &missing][..], &["new", &missing, "--mass", "230"]]
    {
        let output = flexframe(arguments);
        assert_eq!((output.status.code(), text(&output.stdout)), (Some(3), String::new()), "{}", text(&output.stderr));
        assert_says(&text(&output.stderr), &["cannot write", "its folder is not there; make it, or name another one"]);
    }
    let output = flexframe(&["fold", "cognifly", "--step", "3", "-o", &x]);
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    assert_says(&text(&output.stderr), &["--step alone writes nothing"]);
    let long = "[corner]\ncorner_socket_depth_mm = 13.0\n[hub_joint]\nhub_arm_socket_depth_mm = 8.0\n[fork]\nfork_socket_depth_mm = 7.0\n";
    let output = Bench::new(&format!("base = \"cognifly\"\n{long}")).run("fold", &["--json"]);
    assert_eq!((output.status.code(), document(&output)["error"]["exit_code"].as_i64()), (Some(1), Some(1)));
}

#[test]
fn planted_a_remedy_names_the_document_of_its_kind_of_file() {
    let key = refused("base = \"cognifly\"\nqqqq = 1\n");
    assert_says(&key, &["unknown key `qqqq`", "`flexframe params` lists the keys of all numbers, docs/frame-files.md those of names"]);
    let bench = Bench::new("");
    let shipped = |name: &str| fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("params").join(name)).expect("is there");
    for (name, text) in [
        ("model.toml", shipped("impact/paper.toml")),
        ("mechanics.toml", shipped("mechanics.toml")),
        ("plan.toml", shipped("synthetic/bottoming.toml")),
    ] {
        bench.write(name, &format!("qqqq = 1\n{text}"));
    }
    let [model, mechanics, plan, out] = ["model.toml", "mechanics.toml", "plan.toml", "out"].map(|name| bench.path(name));
    for (arguments, said) in [
        (&["drop", "--model", &model, "-o", &out][..], "docs/physics.md lists the keys of a model file"),
        (&["check", "--strength", "--mechanics", &mechanics], "docs/mechanics.md explains them"),
        (&["synthesize", &plan, "-o", &out], "docs/diagnosis.md lists the keys of a plan"),
    ] {
        let output = flexframe(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", text(&output.stderr));
        let message = text(&output.stderr) + &text(&flexframe(&[arguments, &["--json"]].concat()).stdout);
        assert_says(&message, &["unknown key `qqqq`", said]);
    }
    let output = flexframe(&["synthesize", "bottoming", "--json", "-o", &out]);
    assert_eq!(output.status.code(), Some(2));
    let message = document(&output)["error"]["message"].as_str().expect("a message").to_string();
    assert!(
        message.starts_with("there is no plan `bottoming`") && message.contains("bottoming.toml") && !message.contains("model"),
        "{message}"
    );
}

#[test]
fn analytic_target_size_is_met() {
    let frame = "base = \"cognifly\"\n[target]\nwidth_mm = 230.0\nheight_mm = 118.0\nstrut_tilt_deg = 24.0\n[limits]\nenvelope_width_mm = 230.0\nenvelope_height_mm = 118.0\n";
    let check = Bench::new(frame).run("check", &["--json"]);
    assert_eq!(check.status.code(), Some(0), "a limit equal to the target is kept");
    let report: serde_json::Value = serde_json::from_slice(&check.stdout).expect("JSON");
    let value = |subject: &str| {
        let findings = report["frames"][0]["findings"].as_array().expect("a list");
        findings.iter().find(|f| f["subject"] == subject).and_then(|f| f["value"].as_f64()).expect("is measured")
    };
    assert!((value("width without propellers") - 230.0).abs() < 0.05, "{}", value("width without propellers"));
    assert!((value("height without propellers") - 118.0).abs() < 0.05, "{}", value("height without propellers"));
    let both = refused(
        "base = \"cognifly\"\n[target]\nwidth_mm = 230.0\nheight_mm = 118.0\nstrut_tilt_deg = 24.0\n[rods]\narm_rod_length_mm = 80.0\n",
    );
    assert_says(&both, &["not both"]);
    // What the target gives is told, and cannot vary.
    let bench = Bench::new(frame);
    let target = bench.path("frame.toml");
    let told = flexframe(&["explain", "target.width_mm", &target]);
    assert_says(&text(&told.stdout), &["Width and depth", "230", "frame.toml:3", "rods.cage_rod_length_mm"]);
    let length = text(&flexframe(&["explain", "cage_rod", &target]).stdout);
    assert!(
        length.contains("(follows from [target])") && length.contains("has no other value") && !length.contains("no such frame"),
        "{length}"
    );
    let lengths = flexframe(&["params", &target, "--filter", "cage_rod_length", "--json"]);
    let rows: serde_json::Value = serde_json::from_slice(&lengths.stdout).expect("JSON");
    assert!(rows[0]["value"].as_f64().is_some_and(|mm| mm > 200.0) && rows[0]["follows"] == "target", "{rows}");
    for more in [["--vary", "cage_rod,arm_rod"], ["--vary", "motor_position,cage_rod"]] {
        let output = flexframe(&[&["solve", target.as_str(), "--minimise", "mass", "--frames", "20"][..], &more].concat());
        assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
        assert_says(
            &text(&output.stderr),
            &["`rods.cage_rod_length_mm` cannot vary: it follows from [target]", "state the three rod lengths"],
        );
    }
    let far = refused("base = \"cognifly\"\n[target]\nwidth_mm = 100.0\nheight_mm = 300.0\nstrut_tilt_deg = 24.0\n");
    assert_says(&far, &["the target size needs", "frame.toml:3"]);
}

/// What `check` says of a frame that breaks a limit.
fn violated(changes: &str) -> String {
    let output = Bench::new(&format!("base = \"cognifly\"\n{changes}")).run("check", &[]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    text(&output.stdout)
}

#[test]
fn planted_folds_that_cannot_be_are_refused_with_the_reason() {
    let strained = violated("[corner]\ncorner_hinge_thickness_mm = 1.6\n");
    assert_says(
        &strained,
        &["VIOLATED hinge_strain", "strains the material by 179 %, 145 % are allowed", "corner.corner_hinge_thickness_mm"],
    );
    let narrow = violated("[corner]\nnotch_half_angle_deg = 30.0\n");
    // The instructions are written, and the exit code says that they cannot be followed.
    let folded = Bench::new("base = \"cognifly\"\n[corner]\nnotch_half_angle_deg = 30.0\n").run("fold", &[]);
    assert_eq!(folded.status.code(), Some(1));
    assert_says(&text(&folded.stderr), &["VIOLATED fold_sequence", "53.2 deg beyond the closing of their notch"]);
    assert_says(&narrow, &["VIOLATED fold_sequence", "53.2 deg beyond the closing of their notch", "corner.notch_half_angle_deg"]);
    let long = "[corner]\ncorner_socket_depth_mm = 13.0\n[hub_joint]\nhub_arm_socket_depth_mm = 8.0\n[fork]\nfork_socket_depth_mm = 7.0\n";
    let reason = ["VIOLATED fold_sequence", "the leg needs 13.0 mm to enter the foot", "85 % are allowed", "fork.fork_socket_depth_mm"];
    assert_says(&violated(long), &reason);
    let output = Bench::new(&format!("base = \"cognifly\"\n{long}")).run("fold", &[]);
    assert_eq!(output.status.code(), Some(1));
    assert_says(&text(&output.stderr), &["cannot be folded: the leg needs 13.0 mm"]);
}

/// A load in front of the front motors: those behind would have to pull down.
#[test]
fn planted_a_frame_that_cannot_hover_is_told() {
    let load = "[extras.load]\nmass_g = 400.0\nmass_basis = \"measured\"\nsource = \"own\"\nposition_mm = [0.0, 90.0, 20.0]\n";
    let output = Bench::new(&format!("base = \"cognifly\"\n{load}")).run("export", &["--mjcf", "--model", "paper"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_says(&text(&output.stderr), &["warning: a hover takes -", "of motor_B", "no propeller pulls down"]);
    let plain = Bench::new("base = \"cognifly\"\n").run("export", &["--mjcf", "--model", "paper"]);
    assert!(!text(&plain.stderr).contains("hover"), "{}", text(&plain.stderr));
}

#[test]
fn analytic_export_writes_the_formats_that_are_asked_for() {
    let bench = Bench::new("base = \"cognifly\"\n");
    let folder = Path::new(&bench.path("out")).join("frame-simulators");
    for (options, written) in [
        (&["--mjcf"][..], &["frame.xml", "scene.xml"][..]),
        (&["--urdf", "--sdf"], &["frame.urdf", "model.sdf", "model.config"]),
        (&[], &["frame.xml", "scene.xml", "frame.urdf", "model.sdf", "model.config"]),
    ] {
        let output = bench.run("export", &[options, &["--model", "paper", "--json"]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let told: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!((told["legs"]["stiffness_n_m"].as_f64(), told["legs"]["damping_n_s_m"].as_f64()), (Some(7040.0), Some(46.0)));
        let kept: serde_json::Value = serde_json::from_slice(&fs::read(folder.join("simulator.json")).expect("is written")).expect("JSON");
        assert_eq!(told, kept);
        for name in ["frame.xml", "scene.xml", "frame.urdf", "model.sdf", "model.config"] {
            assert_eq!(folder.join(name).exists(), written.contains(&name), "{options:?} {name}");
        }
        assert_eq!(folder.join("meshes/cage.obj").exists(), options != ["--mjcf"], "{options:?}");
    }
    let own = bench.run("export", &["--mjcf", "--json"]);
    let told: serde_json::Value = serde_json::from_slice(&own.stdout).expect("JSON");
    assert_eq!(told["legs"]["from"], "frame");
    let output = bench.run("export", &["--model", "paper", "--mechanics", "absent.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert_says(&text(&output.stderr), &["--mechanics", "--model frame"]);
}

#[test]
fn planted_what_a_simulator_does_not_get_is_told_and_a_sensor_is_where_its_extra_is() {
    let extra = "[extras.pilot]\nmass_g = 6.0\nmass_basis = \"measured\"\nsource = \"own\"\nposition_mm = [0.0, 10.0, 30.0]\ncovers = [\"flight_controller\"]\n";
    let bench = Bench::new(&format!("base = \"cognifly\"\nbought.flight_controller = \"none\"\n{extra}"));
    let model = bench.path("rubbing.toml");
    let rubbing = include_str!("../../params/impact/paper.toml").to_owned() + "[effects.coulomb_friction]\nf_c_n = 50.0\n";
    fs::write(&model, rubbing).expect("can be written");
    let output = bench.run("export", &["--mjcf", "--model", &model, "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_says(&text(&output.stderr), &["warning: coulomb_friction of rubbing is left out"]);
    let told: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!((&told["imu"]["on"], told["imu"]["position_m"][2].as_f64()), (&"pilot".into(), Some(0.03)), "{:#}", told["imu"]);
}

#[test]
fn regress_fold_draws_one_step() {
    let bench = Bench::new("base = \"cognifly\"\n");
    let output = bench.run("fold", &["--step", "20", "--png", "-q"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let folder = Path::new(&bench.path("out")).join("frame-step-20");
    for name in ["20_before.png", "20_after.png"] {
        assert!(fs::read(folder.join(name)).expect("is written").starts_with(b"\x89PNG"), "{name}");
    }
    let output = bench.run("fold", &["--step", "40", "--png"]);
    assert_eq!(output.status.code(), Some(2));
    assert_says(&text(&output.stderr), &["there is no step 40", "1 to 39"]);
    // Without --png it is told, under the number that pages, pictures and JSON have for it.
    let output = bench.run("fold", &["--step", "39"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_says(
        &text(&output.stdout),
        &["39. Propellers", "Takes 4 x propeller.", "motor 1, rear right: clockwise", "Caution. The battery is out"],
    );
    assert!(text(&output.stdout).lines().all(|line| line.chars().count() <= 80));
    let told: serde_json::Value = serde_json::from_slice(&bench.run("fold", &["--step", "38", "--json"]).stdout).expect("JSON");
    assert_eq!((&told["number"], &told["mount"]), (&38.into(), &"cartridge".into()));
    assert!(told["text"].as_str().expect("a text").contains("without propellers"));
}

#[test]
fn planted_print_factors_are_found_by_a_scale_and_written_back() {
    let bench = Bench::new("base = \"cognifly\" # mine\n\n[limits]\nmass_budget_g = 230.0\n");
    let frame = bench.path("frame.toml");
    let told = |arguments: &[&str]| -> (Option<i32>, serde_json::Value) {
        let output = flexframe(arguments);
        (output.status.code(), serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", text(&output.stderr))))
    };
    let (code, before) = told(&["weigh", &frame, "--json"]);
    assert_eq!(code, Some(0), "nothing is weighed yet");
    let parts = before["parts"].as_array().expect("parts");
    // TPU is printed with 0.9 of its volume, a little more or less from part to part; ABS with 0.97.
    let mut table = String::from("part,quantity,mass_g\n");
    for (at, part) in parts.iter().enumerate() {
        let factor = if part["material"] == "tpu-95a" { 0.9 + if at % 2 == 0 { 0.01 } else { -0.01 } } else { 0.97 };
        let mass_g = 4.0 * factor * part["solid_g"].as_f64().expect("g");
        table += &format!("{},4,{mass_g:.2}\n", part["part"].as_str().expect("a name"));
    }
    bench.write("scale.csv", &table);
    let (code, found) = told(&["weigh", &frame, &bench.path("scale.csv"), "--into", &frame, "--json"]);
    assert_eq!(code, Some(0));
    let factor = |at: usize| found["print_factors"][at]["print_factor"].as_f64().expect("a factor");
    assert!((factor(0) - 0.9).abs() < 2e-3 && (factor(1) - 0.97).abs() < 1e-3, "{found}");
    let interval = |at: usize, end: usize| found["print_factors"][at]["ci95"][end].as_f64().expect("an end");
    assert!(interval(0, 0) < 0.9 && 0.9 < interval(0, 1) && interval(0, 1) - interval(0, 0) < 0.05, "{found}");
    let written = fs::read_to_string(&frame).expect("is there");
    assert!(written.starts_with("base = \"cognifly\" # mine\n"), "{written}");
    let after_g = found["total_g"]["after"].as_f64().expect("g");
    let masses: serde_json::Value = serde_json::from_slice(&flexframe(&["check", &frame, "--json"]).stdout).expect("JSON");
    let counted =
        masses["frames"][0]["findings"].as_array().expect("findings").iter().find(|f| f["rule"] == "mass_budget").expect("is checked");
    assert!((counted["value"].as_f64().expect("g") - after_g).abs() < 0.02, "{after_g} {counted}");
    // What a lighter limit would say.
    bench.write("light.toml", "base = \"frame\"\n[limits]\nmass_budget_g = 200.0\n");
    let output = flexframe(&["weigh", &bench.path("light.toml"), &bench.path("scale.csv")]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stdout));
}

#[test]
fn analytic_readings_that_cannot_be_are_refused() {
    let bench = Bench::new("base = \"cognifly\"\n");
    for (table, said) in [
        ("part,mass_g\nhubb,9\n", "did you mean `hub`"),
        ("part,mass_g\nhub,9\nhub,90\n", "line 3"),
        ("part,mass\nhub,9\n", "lacks the column `mass_g`"),
        ("part,mass_g\nhub,nine\n", "no number"),
        ("part,mass_g\naccessory_plate,2\n", "the frame has no `accessory_plate`; its parts are"),
        ("part,mass_g\n", "write its rows below"),
    ] {
        bench.write("scale.csv", table);
        let output = flexframe(&["weigh", &bench.path("frame.toml"), &bench.path("scale.csv"), "--into", &bench.path("new.toml")]);
        assert_eq!(output.status.code(), Some(2), "{table}");
        assert!(text(&output.stderr).contains(said), "{}", text(&output.stderr));
        assert!(!Path::new(&bench.path("new.toml")).exists());
    }
    let output = flexframe(&["weigh", "--slicer=there-is-no-such-slicer"]);
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
}

#[test]
fn analytic_hinges_that_were_folded_become_a_limit() {
    let bench = Bench::new("base = \"cognifly\"\n\n[limits]\nhinge_strain_factor = 4.0 # guessed\n");
    let output = bench.run("coupon", &[]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let frame = bench.path("frame.toml");
    let read = |table: &str| {
        bench.write("hinges.csv", table);
        flexframe(&["coupon", &frame, "--read", &format!("plug=0.2,{}", bench.path("hinges.csv")), "--into", &frame])
    };
    // The table as it comes with the coupon, filled in.
    let blank = fs::read_to_string(Path::new(&bench.path("out/frame-coupon")).join("hinges.csv")).expect("is there");
    let output = read(&blank.replace("1.7,114,", "1.7,114,23").replace("2.9,114,", "2.9,114,held"));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("1.7 mm folded by 114 deg: 170 %, cracked after 23 folds"), "{}", text(&output.stdout));
    let written = fs::read_to_string(&frame).expect("is there");
    assert!(written.contains("hinge_strain_factor = 5.831 # hinges folded 100 times"), "{written}");
    assert!(written.contains("99 % held, 170 % cracked after 23") && written.contains("plug_clearance_mm = 0.2"), "{written}");
    // The frame's own fold is within what held.
    let check = text(&flexframe(&["check", &frame, "--all"]).stdout);
    let strut = check.lines().find(|line| line.contains("hinge_strain") && line.contains("top corner strut")).expect("is checked");
    assert!(strut.starts_with("holds") && strut.contains("limit   99.47 %"), "{strut}");
    for (table, said) in [
        (
            "thickness_mm,fold_deg,folds\n1.7,114,held\n2.9,114,80\n",
            "hinges.csv, line 3: 2.9 mm cracked after 80 folds at 99 %, but 1.7 mm held",
        ),
        ("thickness_mm,fold_deg,folds\n1.7,114,4\n", "hinges.csv: every hinge cracked"),
        ("thickness_mm,fold_deg,folds\n2.9,114,held\n1.7,114,yes\n", "hinges.csv, line 3: `folds` is `yes`"),
        ("thickness_mm,fold_deg\n1.7,114\n", "line 1: lacks the column `folds`"),
        ("thickness_mm,fold_deg,folds\n2.2,114,held\n", "line 2: the coupon of this frame has no hinge of 2.2 mm"),
        (blank.as_str(), "hinges.csv: no hinge was folded"),
    ] {
        let output = read(table);
        assert_eq!(output.status.code(), Some(2), "{table}");
        assert!(text(&output.stderr).contains(said), "{}", text(&output.stderr));
        assert_eq!(fs::read_to_string(&frame).expect("is there"), written, "{table}");
    }
}

#[test]
fn analytic_what_was_found_on_a_coupon_becomes_a_printers_clearances() {
    let bench = Bench::new("base = \"cognifly\" # mine\n\n[fit]\nslide_clearance_mm = 0.3 # guessed\n");
    let output = bench.run("coupon", &[]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let names =
        ["gauge.stl", "bar.stl", "bosses.stl", "hinge-29.stl", "gauge.ini", "plate_tpu.3mf", "hinges.csv", "coupon.md", "coupon.png"];
    for name in names {
        assert!(Path::new(&bench.path("out/frame-coupon")).join(name).is_file(), "{name}");
    }
    let frame = bench.path("frame.toml");
    let output = flexframe(&["coupon", &frame, "--read", "held=2.8,slides=3.1,hinge=2.5", "--into", &frame, "-q"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    // r θ / (2 t) with a web of 2.5 in place of 2.9 mm, and a socket that is 0.05 mm thinner.
    assert_says(
        &text(&output.stderr),
        &["corner.corner_hinge_thickness_mm 2.9 -> 2.5: the corners' webs are strained by", "instead of 99 %"],
    );
    let written = fs::read_to_string(&frame).expect("is there");
    for line in [
        "base = \"cognifly\" # mine",
        "slide_clearance_mm = 0.15 # found",
        "grip_clearance_mm = -0.35 # found",
        "corner_hinge_thickness_mm = 2.5",
    ] {
        assert!(written.contains(line), "{written}");
    }
    // The knee grows around wider bores, and the fork's cheeks stand further apart.
    for held in ["held=3.0,slides=3.3", "held=2.8,slides=3.1"] {
        let fresh = bench.path(&format!("{}.toml", &held[5..8]));
        let output = flexframe(&["coupon", "--read", held, "--into", &fresh]);
        assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()), "{held}");
        assert_eq!(flexframe(&["check", &fresh, "-q"]).status.code(), Some(0), "{held}");
    }
    // The corners grow, too, and what no longer fits is said.
    let narrow = bench.path("narrow.toml");
    fs::write(&narrow, "base = \"cognifly\"\n[limits]\nenvelope_width_mm = 209.7\n").expect("can be written");
    let output = flexframe(&["coupon", &narrow, "--read", "held=3.2,slides=3.4", "--into", &bench.path("fresh.toml")]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert_says(&text(&output.stderr), &["VIOLATED envelope", "fresh.toml --remedies` looks for what helps"]);
    assert!(!text(&output.stderr).contains("knee"), "{}", text(&output.stderr));
    // The page's commands name the frame as the shell finds it, and the table by the page's own folder.
    let page = fs::read_to_string(Path::new(&bench.path("out/frame-coupon")).join("coupon.md")).expect("is there");
    for command in [format!("flexframe coupon {frame} --read held="), format!("flexframe coupon {frame} --read FOLDER/hinges.csv --into")] {
        assert!(page.contains(&command), "{command} is not in:\n{page}");
    }
    assert!(page.contains("FOLDER is that of this page."), "{page}");
    // The bores follow.
    let output = flexframe(&["params", &frame, "--filter", "clearance", "--json"]);
    assert!(text(&output.stdout).contains("-0.35"), "{}", text(&output.stdout));
    for wrong in ["held=2.85", "held=2.8", "held=3.3,slides=3.4", "hold=2.8", "held=3.1,slides=3.0"] {
        let output = flexframe(&["coupon", &frame, "--read", wrong, "--into", &frame]);
        assert_eq!(output.status.code(), Some(2), "{wrong}");
        assert_eq!(fs::read_to_string(&frame).expect("is there"), written, "{wrong}");
    }
}
