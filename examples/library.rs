//! flexframe as a library: a frame is changed value by value, weighed, checked and dropped, and its files are taken as bytes.
//!
//! `cargo run --release --example library` prints what it finds; nothing is written.

use std::error::Error;
use std::ops::ControlFlow;
use std::sync::Arc;

use flexframe::checks::{Cost, Verdict};
use flexframe::memo::{Memo, Step, Unwatched};
use flexframe::params::FrameFile;
use flexframe::params::frame_file::Value;
use flexframe::report::frame_folder::FolderChoice;
use flexframe::workspace::{Refused, Workspace};

/// A frame file as a person writes it: a preset, and what differs.
const LIGHTER: &str = r#"
base = "cognifly"

[rods]
cage_rod_length_mm = 181.0
"#;

/// A bought part of one's own, by every field that its kind needs.
const BATTERY: &str = r#"
kind = "battery"
mass_g = 55.0
mass_basis = "measured"
size_mm = [60.0, 31.0, 18.0]
cells = 3
source = "kitchen scale"
"#;

fn main() -> Result<(), Box<dyn Error>> {
    let memo = Arc::new(Memo::default());
    let mut workspace = Workspace::new(FrameFile::parse("lighter", LIGHTER)?, memo)?;
    println!("{:.1} g", workspace.masses(&Unwatched)?.value.total_g);

    // Values that depend on each other are set in a copy of the file, which then takes the place of the former one.
    let mut file = workspace.file().clone();
    file.set("override.parts.mine", Value::Other(flexframe::toml::from_str(BATTERY)?));
    file.set("bought.battery", Value::Text("mine".into()));
    workspace.replace(file)?;
    println!("{:.1} g with another battery", workspace.masses(&Unwatched)?.value.total_g);

    // A value that no frame can have changes nothing.
    if let Err(refusal) = workspace.set("rods.rod_diameter_mm", Value::Number(-3.0)) {
        println!("refused: {refusal}");
    }

    let findings = workspace.findings(Cost::Slow, &Unwatched)?.value;
    let violated = findings.iter().filter(|finding| finding.verdict == Verdict::Violated);
    violated.for_each(|finding| println!("violated: {}", finding.message));

    // Whoever follows a computation may end it.
    let impatient = |_: Step| ControlFlow::Break(());
    let choice = FolderChoice { pictures: false, step: false };
    assert!(matches!(workspace.files(choice, &impatient), Err(Refused::Ended)));
    for file in workspace.files(choice, &Unwatched)?.value {
        println!("{} {} bytes", file.path, file.bytes.len());
    }
    Ok(())
}
