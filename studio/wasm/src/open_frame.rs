//! A frame that is open: its workspace, and the design that is shown of it.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use flexframe::checks::Cost;
use flexframe::checks::gate::{CheckedFrame, Outcome, Policy, data};
use flexframe::export::bill;
use flexframe::frame::assembly::Design;
use flexframe::frame::assembly::mass::MassTable;
use flexframe::memo::{Made, Memo, Step, Unwatched};
use flexframe::params::files::Files;
use flexframe::params::frame_file::Value as Typed;
use flexframe::params::roles::ROLES;
use flexframe::params::sleeve_direction::SleeveDirection;
use flexframe::params::{Frame, FrameFile, parameters};
use flexframe::report::data::difference_data;
use flexframe::variant::{Difference, Evaluation, Side};
use flexframe::workspace::Workspace;
use serde_json::{Value, json};

use crate::answer::Refused;
use crate::tell_stage;

/// A frame.
pub struct OpenFrame {
    asked: String,
    workspace: Workspace,
    /// The bodies.
    pub design: Arc<Design>,
    /// Their masses.
    pub masses: Arc<MassTable>,
    made: Vec<(Made, usize)>,
}

impl OpenFrame {
    /// Reads and designs a frame: a preset's name, or a file among these. `memo` is this frame's own.
    ///
    /// # Errors
    /// What the command line refuses.
    pub fn new(asked: &str, files: &dyn Files, memo: Arc<Memo>) -> Result<Self, Refused> {
        let mut workspace = Workspace::new(FrameFile::load_from(asked, files)?, memo)?;
        let (design, masses, made) = designed(&mut workspace)?;
        Ok(Self { asked: asked.into(), workspace, design, masses, made })
    }

    /// Takes another frame instead; parts that stay the same are not made again.
    ///
    /// # Errors
    /// What the command line refuses; then the frame is as it was.
    pub fn change(&mut self, asked: &str, files: &dyn Files) -> Result<(), Refused> {
        let former = self.workspace.file().clone();
        self.workspace.replace(FrameFile::load_from(asked, files)?)?;
        match designed(&mut self.workspace) {
            Ok((design, masses, made)) => {
                (self.asked, self.design, self.masses, self.made) = (asked.into(), design, masses, made);
                Ok(())
            }
            Err(refused) => {
                self.workspace.replace(former)?;
                Err(refused)
            }
        }
    }

    /// What is shown of it: what was read, its masses, and what was made for it.
    pub fn facts(&self) -> Value {
        let made: Vec<Value> = self.made.iter().map(|(made, times)| json!([made.step, made.subject, times])).collect();
        let mut facts = read(&self.design.frame, self.workspace.file());
        facts["masses"] = json!(*self.masses);
        facts["made"] = made.into();
        facts
    }

    /// Findings and masses, as of `check --json`.
    ///
    /// # Errors
    /// When the mechanics cannot be computed.
    pub fn findings(&mut self, quick: bool, strength: bool) -> Result<Value, Refused> {
        let dearest = if quick { Cost::Quick } else { Cost::Slow };
        let begun = AtomicUsize::new(0);
        let of = |passes: usize| passes + usize::from(strength);
        let tell = |step: Step| {
            tell_stage(begun.fetch_add(1, Ordering::Relaxed), of(step.of), step.name);
            ControlFlow::Continue(())
        };
        let mut findings = self.workspace.findings(dearest, &tell)?.value;
        if strength {
            let passes = begun.into_inner();
            tell_stage(passes, of(passes), "Design drop");
            findings.extend(crate::mechanics::design_drop(self)?);
        }
        let checked = CheckedFrame::new(&self.design.frame, self.workspace.file(), findings, (*self.masses).clone(), Policy::default());
        Ok(data::json(&[Outcome { asked: self.asked.clone(), result: Ok(checked) }]))
    }

    /// The bill of materials, as of `bom --json`.
    ///
    /// # Errors
    /// When it cannot be written as JSON.
    pub fn bill(&self) -> Result<Value, Refused> {
        serde_json::to_value(bill::bill(&self.design, &self.masses, None)).map_err(Refused::plain)
    }

    /// What another frame changes of this one, as of `diff --json`.
    ///
    /// # Errors
    /// When one of them cannot be designed again.
    pub fn difference(&self, other: &Self, quick: bool) -> Result<Value, Refused> {
        Ok(difference_data::json(&Difference::of(&[self.side(quick)?, other.side(quick)?])))
    }

    fn side(&self, quick: bool) -> Result<Side, Refused> {
        let memo = &self.design.memo;
        let refused = |error: flexframe::frame::assembly::DesignError| Refused::from(error.refusal(self.workspace.file()));
        let frame = self.workspace.frame().clone();
        let evaluation = if quick { Evaluation::quick(frame, memo) } else { Design::with(frame, memo).map(Evaluation::of) };
        Ok(Side { name: self.design.frame.name.clone(), evaluation: evaluation.map_err(refused)? })
    }
}

/// A frame as it is read: its name, every number and choice, and the keys that its own file states.
pub fn read(frame: &Frame, file: &FrameFile) -> Value {
    let values: BTreeMap<String, Option<f64>> =
        parameters().map(|p| (format!("{}.{}", p.table, p.key), frame.value(p.table, p.key))).collect();
    let stated: Vec<&String> = file.entries.iter().filter(|(_, entry)| entry.depth == 0).map(|(key, _)| key).collect();
    json!({
        "name": frame.name,
        "description": frame.description,
        "values": values,
        "choices": choices(frame, file),
        "stated": stated,
    })
}

/// What a frame chooses by name, by key.
fn choices(frame: &Frame, file: &FrameFile) -> BTreeMap<String, String> {
    let bought = |role: &str| frame.bought.get(role).map_or("none".to_string(), |item| item.name.clone());
    let mut choices: BTreeMap<String, String> = ROLES.iter().map(|(role, ..)| (format!("bought.{role}"), bought(role))).collect();
    choices.insert("materials.flexible".into(), frame.flexible.name.clone());
    choices.insert("materials.rigid".into(), frame.rigid.name.clone());
    choices.insert(SleeveDirection::KEY.into(), frame.sleeve_direction.word().into());
    if let Some(Typed::Text(printer)) = file.entries.get("printer").map(|entry| &entry.value) {
        choices.insert("printer".into(), printer.clone());
    }
    choices
}

type Designed = (Arc<Design>, Arc<MassTable>, Vec<(Made, usize)>);

fn designed(workspace: &mut Workspace) -> Result<Designed, Refused> {
    let design = workspace.design(&Unwatched)?;
    let masses = workspace.masses(&Unwatched)?;
    Ok((design.value, masses.value, design.made))
}
