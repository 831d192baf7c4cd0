//! The sub-assemblies of a frame, each with its parts and with the steps that make it: centre, module, battery cartridge.

use crate::frame::assembly::{Body, BodyKind, Design};
use crate::frame::fold::FoldSequence;
use crate::frame::mounting::{MountStep, Mounting, PartLine};
use crate::frame::skeleton::MODULE_NAMES;
use crate::report::picture::fold_scene::Picture;
use crate::report::picture::sub_assembly_scene;

/// A page about a sub-assembly.
pub struct SubAssembly {
    /// Its name in files.
    pub name: &'static str,
    /// What it is, and how many of it.
    pub heading: String,
    /// Where it goes.
    pub text: String,
    /// The steps that make it, each with its number.
    pub steps: Vec<String>,
    /// The parts of one of it, in words and as lines.
    pub parts: Vec<(String, PartLine)>,
    /// It, put together.
    pub picture: Picture,
}

/// The mount that puts the cartridge in.
const CARTRIDGE: &str = "cartridge";
/// How the bill's lines of cage rods begin.
const CAGE: &str = "cage";

/// Centre, module and cartridge, in the order in which they are made.
pub fn sub_assemblies(design: &Design, fold: &FoldSequence, mounting: &Mounting) -> [SubAssembly; 3] {
    let ((centre, module), cartridge) =
        rayon::join(|| rayon::join(|| centre(design, mounting), || module(design, fold, mounting)), || cartridge(design, fold, mounting));
    [centre, module, cartridge]
}

fn numbered(number: usize, title: &str) -> String {
    format!("{number}. {title}")
}

fn picture(design: &Design, is_in: impl Fn(&Body) -> bool) -> Picture {
    let bodies: Vec<&Body> = design.bodies.iter().filter(|body| is_in(body)).collect();
    sub_assembly_scene::together(design, &bodies)
}

fn centre(design: &Design, mounting: &Mounting) -> SubAssembly {
    let is_of = |body: &Body, step: &MountStep| step.onto == body.name || step.brings.contains(&body.name);
    SubAssembly {
        name: "centre",
        heading: "The centre, once".into(),
        text: "Hub, electronics, and what holds the battery. The four modules are plugged into it.".into(),
        steps: mounting.before.iter().enumerate().map(|(at, step)| numbered(at + 1, step.title)).collect(),
        parts: in_words(added(mounting.before.iter().flat_map(|step| &step.parts))),
        picture: picture(design, |body| mounting.before.iter().any(|step| is_of(body, step))),
    }
}

fn module(design: &Design, fold: &FoldSequence, mounting: &Mounting) -> SubAssembly {
    let own = || fold.steps.iter().zip(&mounting.fold_parts).enumerate().filter(|(_, (step, _))| step.repeats == MODULE_NAMES.len());
    let first = mounting.before.len() + 1;
    let all = added(own().flat_map(|(_, (_, parts))| parts));
    // Where cage rods have two lengths, each is in two of the modules.
    let is_half =
        |line: &PartLine| line.part.starts_with(CAGE) && all.iter().any(|other| other.part != line.part && other.part.starts_with(CAGE));
    let part = |line: &PartLine| {
        let (share, note) = if is_half(line) { (0.5, ", in two of the modules") } else { (1.0, "") };
        let each = PartLine { count: line.count / (share * MODULE_NAMES.len() as f64), ..line.clone() };
        (format!("{}{note}", each.words()), each)
    };
    SubAssembly {
        name: "module",
        heading: format!("The module, {} alike", MODULE_NAMES.len()),
        text: "An arm with motor, strut, corners, and the cage rods towards the next module. Each step is done at each of the four.".into(),
        steps: own().map(|(at, (step, _))| numbered(first + at, step.title)).collect(),
        parts: all.iter().map(part).collect(),
        picture: picture(design, |body| body.module == Some(0) && design.shape(body).kind != BodyKind::Propeller),
    }
}

fn cartridge(design: &Design, fold: &FoldSequence, mounting: &Mounting) -> SubAssembly {
    let moves = mounting.after.iter().find(|step| step.mount == CARTRIDGE).map_or(&[][..], |step| &step.moves);
    let own = || {
        let all = mounting.after.iter().enumerate().filter(|(_, step)| step.mount != CARTRIDGE);
        all.filter(|(_, step)| !step.brings.is_empty() && step.brings.iter().all(|body| moves.contains(body)))
    };
    let first = mounting.before.len() + fold.steps.len() + 1;
    let side = design.centre.battery_axes.open_side();
    SubAssembly {
        name: "cartridge",
        heading: "The battery cartridge, once a battery".into(),
        text: format!("{} stay together. It slides into the sleeve from the {side}, as one piece.", kept_together(design)),
        steps: own().map(|(at, step)| numbered(first + at, step.title)).collect(),
        parts: in_words(added(own().flat_map(|(_, step)| &step.parts))),
        picture: picture(design, |body| moves.contains(&body.name)),
    }
}

/// What of the cartridge is not taken apart again.
fn kept_together(design: &Design) -> &'static str {
    let has = |role: &str| design.frame.bought.contains_key(role);
    match (has("connector"), has("magnet")) {
        (true, true) => "Battery, lid, plug and magnet",
        (true, false) => "Battery, lid and plug",
        (false, true) => "Battery, lid and magnet",
        (false, false) => "Battery and lid",
    }
}

fn in_words(lines: Vec<PartLine>) -> Vec<(String, PartLine)> {
    lines.into_iter().map(|line| (line.words(), line)).collect()
}

/// Lines of one part as one.
fn added<'a>(lines: impl Iterator<Item = &'a PartLine>) -> Vec<PartLine> {
    let mut all: Vec<PartLine> = Vec::new();
    for line in lines {
        match all.iter_mut().find(|other| other.part == line.part) {
            Some(other) => other.count += line.count,
            None => all.push(line.clone()),
        }
    }
    all
}
