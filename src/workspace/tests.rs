//! Workspaces on a preset.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::{Answer, Refused, Workspace};
use crate::checks::Cost;
use crate::memo::{Memo, Step, Unwatched};
use crate::params::FrameFile;
use crate::params::frame_file::Value;
use crate::report::frame_folder::FolderChoice;

fn workspace() -> Workspace {
    Workspace::new(FrameFile::load("cognifly").expect("a preset"), Arc::new(Memo::default())).expect("a preset")
}

/// The subjects of a step that were made.
fn made<'a, T>(answer: &'a Answer<T>, step: &str) -> Vec<&'a str> {
    answer.made.iter().filter(|(made, _)| made.step == step).map(|(made, _)| made.subject.as_str()).collect()
}

#[test]
fn analytic_a_change_remakes_what_it_drives() {
    let mut workspace = workspace();
    let first = workspace.findings(Cost::Quick, &Unwatched).expect("is found");
    assert_eq!(made(&first, "flat part").len(), 13);
    let again = workspace.findings(Cost::Quick, &Unwatched).expect("is found");
    assert!(again.value == first.value && again.made.is_empty(), "{:?}", again.made);
    workspace.set("motor_mount.motor_skirt_wall_mm", Value::Number(1.5)).expect("is within bounds");
    let changed = workspace.findings(Cost::Quick, &Unwatched).expect("is found");
    assert_eq!((made(&changed, "flat part"), made(&changed, "folded part")), (vec!["motor_mount"], vec![]));
    assert!(changed.made.iter().all(|(made, _)| made.step != "seating" || made.subject.contains("motor")), "{:?}", changed.made);
    workspace.set("limits.mass_budget_g", Value::Number(240.0)).expect("is within bounds");
    assert_eq!(workspace.findings(Cost::Quick, &Unwatched).expect("is found").made, []);
}

#[test]
fn planted_a_refused_value_changes_nothing() {
    let mut workspace = workspace();
    let before = workspace.masses(&Unwatched).expect("is weighed").value;
    let refusal = workspace.set("rods.arm_rod_length_mm", Value::Number(-4.0)).expect_err("is out of bounds");
    assert!(refusal.to_string().contains("arm_rod_length_mm"), "{refusal}");
    assert_eq!(workspace.masses(&Unwatched).expect("is weighed").value, before);
}

#[test]
fn analytic_files_end_between_two_pictures() {
    let mut workspace = workspace();
    let ended = |step: Step| if step.name.ends_with("assembled_top.png") { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    let choice = FolderChoice { pictures: true, step: false };
    assert!(matches!(workspace.files(choice, &ended), Err(Refused::Ended)));
}

#[test]
fn analytic_a_computation_ends_between_two_steps() {
    let mut workspace = workspace();
    let begun = AtomicUsize::new(0);
    let third = |step: Step| {
        assert!(step.of > 3 && !step.name.is_empty());
        if begun.fetch_add(1, Ordering::Relaxed) < 3 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    assert!(matches!(workspace.design(&third), Err(Refused::Ended)));
    let whole = workspace.design(&Unwatched).expect("is designed");
    assert_eq!(made(&whole, "flat part").len(), 13, "what was done is reported with the next answer");
    assert_eq!(whole.value.printed.len(), 13);
}
