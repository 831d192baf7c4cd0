//! A folder of `tests/frames/` is a test: a frame file, and beside it a snapshot of every stage that it reaches.
//!
//! A frame that is refused pins its message; the others pin skeleton, parts, masses and findings. After a change that is
//! meant, `INSTA_UPDATE=always cargo test --release --test frame frames` writes them anew; look at what it wrote.

use crate::common;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use assert_cmd::cargo::cargo_bin;
use flexframe::checks::{self, Finding};
use flexframe::frame::assembly::mass::MassTable;
use flexframe::frame::assembly::{Design, mass};
use flexframe::params::Frame;
use rayon::prelude::*;

/// A stage's name and what it came to.
type Stages = Vec<(&'static str, String)>;

/// To three digits; the sign of what rounds to zero goes.
fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0 + 0.0
}

fn skeleton(design: &Design) -> String {
    let closure = &design.skeleton.closure;
    let mut text = format!("strut tilt {:.3} deg\nleg tilt {:.3} deg\n\n", closure.strut_tilt.to_deg(), closure.leg_tilt.to_deg());
    for role in design.skeleton.roles() {
        let count = design.skeleton.rods_of(role).count();
        let _ = writeln!(text, "{count} {} rods of {:.3} mm", role.slug(), design.skeleton.length_mm(role));
    }
    text.push('\n');
    for node in &design.skeleton.nodes {
        let [x, y, z] = <[f64; 3]>::from(node.position).map(rounded);
        let _ = writeln!(text, "{:<5} {x:>9.3} {y:>9.3} {z:>9.3} mm", node.name);
    }
    text
}

fn parts(design: &Design) -> String {
    let mut text = String::new();
    for part in &design.printed {
        let [x, y, z] = part.mesh.size_mm();
        let (name, euler, volume) = (part.name, part.topology.euler, part.volume_mm3);
        let _ = writeln!(text, "{name:<24} {volume:>9.1} mm3  {x:>7.3} x {y:>7.3} x {z:>7.3} mm  Euler {euler}");
    }
    text
}

fn masses(table: &MassTable) -> String {
    let mut text = String::new();
    for line in &table.lines {
        let _ = writeln!(
            text,
            "{:<8} {:<22} {:>2} x {:>7.3} = {:>7.3} g  {} ({})",
            line.kind.word(),
            line.name,
            line.quantity,
            line.each_g,
            line.total_g,
            line.material,
            line.basis
        );
    }
    let [x, y, z] = table.centre_of_mass_mm.map(rounded);
    let _ = writeln!(text, "\nin all {:.3} g, of which {:.3} g are estimates", table.total_g, table.estimated_g);
    let _ = writeln!(text, "centre of mass {x:.2} {y:.2} {z:.2} mm");
    let [ixx, iyy, izz] = [0, 1, 2].map(|i| table.inertia_g_mm2[i][i] / 1000.0);
    let _ = writeln!(text, "inertia {ixx:.1} {iyy:.1} {izz:.1} kg mm2");
    text
}

/// A subject without the module and the side: which of several alike is the tightest is a matter of the last bit.
fn one_of_many(subject: &str) -> String {
    let mut text = subject.to_string();
    for module in ["_FR", "_FL", "_BL", "_BR"] {
        for side in ["_top", "_bottom", "_left", "_right", ""] {
            text = text.replace(&format!("{module}{side}"), "");
        }
    }
    text
}

fn findings(findings: &[Finding]) -> String {
    let mut text = String::new();
    for shown in checks::tightest(findings) {
        let finding = shown.finding;
        let verdict = format!("{:?}", finding.verdict).to_lowercase();
        let (value, limit) = (rounded(finding.value), rounded(finding.limit));
        let (rule, subject, unit, of) = (&finding.rule, one_of_many(&finding.subject), &finding.unit, shown.of);
        let _ = writeln!(text, "{verdict:<8} {rule:<19} {value:>9.2} of {limit:>7.2} {unit:<4} {subject} (1 of {of})");
    }
    text
}

/// Every stage that a frame reaches, or what is wrong: said by the test's own thread, as the words of another are lost.
fn stages(folder: &Path) -> Result<Stages, String> {
    let wrong = |what: String| format!("{}: {what}", folder.display());
    let check = Command::new(cargo_bin("flexframe")).args(["check", "-q", "frame.toml"]).env("NO_COLOR", "1").current_dir(folder).output();
    let check = check.map_err(|error| wrong(format!("the program does not start: {error}")))?;
    if check.status.code() == Some(2) {
        return Ok(vec![("refusal", String::from_utf8(check.stderr).expect("UTF-8"))]);
    }
    let frame = Frame::load(&folder.join("frame.toml").display().to_string()).map_err(|error| wrong(error.to_string()))?.0;
    let design = Design::with(frame, common::memo()).map_err(|error| wrong(error.to_string()))?;
    let table = mass::table(&design);
    let found = checks::check(&design, &table);
    let code = if found.iter().any(|finding| finding.margin < 0.0 && finding.verdict == checks::Verdict::Violated) { 1 } else { 0 };
    if check.status.code() != Some(code) {
        let (status, said) = (check.status, String::from_utf8_lossy(&check.stderr));
        return Err(wrong(format!("the shell is told {status}, not {code}: {said}")));
    }
    Ok(vec![("skeleton", skeleton(&design)), ("parts", parts(&design)), ("masses", masses(&table)), ("findings", findings(&found))])
}

fn cases() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/frames");
    let mut cases: Vec<PathBuf> = fs::read_dir(root).expect("is there").map(|entry| entry.expect("is there").path()).collect();
    cases.retain(|path| path.is_dir());
    cases.sort();
    cases
}

#[test]
fn regress_every_stage_of_every_frame() {
    let cases = cases();
    assert!(cases.len() >= 16, "{} folders", cases.len());
    let reached: Result<Vec<Stages>, String> = cases.par_iter().map(|folder| stages(folder)).collect();
    let reached = reached.unwrap_or_else(|wrong| panic!("{wrong}"));
    for (folder, stages) in cases.iter().zip(&reached) {
        let refused = stages.iter().any(|(stage, _)| *stage == "refusal");
        let named = folder.file_name().is_some_and(|name| name.to_string_lossy().starts_with("refused-"));
        assert_eq!(refused, named, "{}: refused, and called so", folder.display());
        let mut settings = insta::Settings::new();
        settings.set_snapshot_path(folder);
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        for (stage, text) in stages {
            settings.bind(|| insta::assert_snapshot!(*stage, text));
        }
        // A frame that was refused and no longer is has to lose its message, and the other way round.
        let expected: BTreeSet<String> = stages.iter().map(|(stage, _)| format!("{stage}.snap")).collect();
        let names =
            fs::read_dir(folder).expect("is there").map(|entry| entry.expect("is there").file_name().to_string_lossy().into_owned());
        let present: BTreeSet<String> = names.filter(|name| name.ends_with(".snap")).collect();
        assert_eq!(present, expected, "{}: snapshots", folder.display());
    }
}
