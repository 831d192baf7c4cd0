//! The instructions as a value: title page, half a page a mount, one page a step of the fold. Two files are written from it.

use crate::export::bill::bill;
use crate::export::cutting;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::frame::fold::{FoldBend, FoldSequence, Join, Step};
use crate::frame::mounting::{Fixing, MountStep, Mounting, PartLine, without_a_step};
use crate::frame::skeleton::{MODULE_WORDS, ROTORS};
use crate::report::picture::fold_scene;
use crate::report::picture::fold_scene::Picture;
use crate::report::picture::mount_scene::{self, Held};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Instructions to be printed.
pub struct Booklet {
    /// The frame's name.
    pub frame: String,
    /// What to know before the first step.
    pub preface: Vec<String>,
    /// The frame taken apart.
    pub apart: Picture,
    /// What is taken in hand, by its name in the bill; screws are drawn as large as they are instead.
    pub alone: BTreeMap<String, Picture>,
    /// How many, what, of what.
    pub parts: Vec<[String; 3]>,
    /// A line a stock length: what to cut from it.
    pub cuts: Vec<String>,
    /// What is mounted before the fold, two on a sheet.
    pub before: Vec<Panel>,
    /// The steps of the fold, each on a sheet.
    pub pages: Vec<Page>,
    /// What is mounted after it, two on a sheet; the propellers last.
    pub after: Vec<Panel>,
}

/// Half a sheet: one picture, the parts beside it.
pub struct Panel {
    /// Number and title.
    pub heading: String,
    /// How long, with what, what keeps it.
    pub facts: String,
    /// What to do.
    pub text: String,
    /// What to take care of.
    pub caution: Option<String>,
    /// What is taken in hand for the first time.
    pub parts: Vec<PartLine>,
    /// What comes, with its arrow.
    pub picture: Picture,
    /// How the picture is held.
    pub held: &'static str,
}

/// A step on paper.
pub struct Page {
    /// Number and title.
    pub heading: String,
    /// How often, how long, with what.
    pub facts: String,
    /// What to do.
    pub text: String,
    /// Angles, ways and what holds them.
    pub measures: Vec<String>,
    /// What to take care of.
    pub caution: Option<String>,
    /// What is taken in hand for the first time.
    pub parts: Vec<PartLine>,
    /// What the picture between the first and the last shows, where there is one.
    pub half_done: Option<&'static str>,
    /// Before, with arrows, half done where that helps, and after.
    pub pictures: Vec<Picture>,
}

impl Booklet {
    /// The instructions of a frame.
    pub fn new(design: &Design, masses: &MassTable, fold: &FoldSequence) -> Self {
        let mounting = Mounting::new(design, fold);
        let folded = fold.steps.iter().map(|step| step.minutes);
        let minutes: f64 = folded.chain(mounting.steps().map(|step| step.minutes)).sum();
        let first = mounting.before.len();
        let panels = |steps: &[MountStep], from: usize| -> Vec<Panel> {
            steps.par_iter().enumerate().map(|(at, step)| Panel::new(design, step, from + at)).collect()
        };
        let page = |(at, step): (usize, &Step)| Page::new(design, fold, step, (at, first), mounting.fold_parts.get(at));
        Self {
            frame: design.frame.name.clone(),
            preface: preface(&mounting, fold.steps.len(), minutes, &forgotten(design, masses, &mounting)),
            apart: fold_scene::apart(design, fold),
            alone: alone(design, &mounting),
            parts: parts(masses),
            cuts: cuts(design),
            before: panels(&mounting.before, 0),
            pages: fold.steps.par_iter().enumerate().map(page).collect(),
            after: panels(&mounting.after, first + fold.steps.len()),
        }
    }
}

/// A picture of each thing that a step takes in hand.
fn alone(design: &Design, mounting: &Mounting) -> BTreeMap<String, Picture> {
    let lines: BTreeMap<&str, &PartLine> =
        mounting.parts().filter(|line| line.screw_mm.is_none()).map(|line| (&*line.part, line)).collect();
    let drawn = lines.par_iter().filter_map(|(name, line)| Some((name.to_string(), mount_scene::part(design, line)?)));
    drawn.collect::<Vec<_>>().into_iter().collect()
}

fn preface(mounting: &Mounting, folds: usize, minutes: f64, forgotten: &[String]) -> Vec<String> {
    let (before, after) = (mounting.before.len(), mounting.after.len());
    let mut lines = vec![
        format!(
            "{} steps, about {minutes:.0} minutes: {before} put hub and electronics together, {folds} fold the frame, {after} finish it. \
             Print the parts flat, as they lie in their files; cut the rods; lay everything out.",
            before + folds + after
        ),
        "Carbon dust harms lungs, eyes and skin: cut the rods wet, under a mask, with glasses and gloves, and wipe them before use.".into(),
        "Glue belongs on rigid parts where a step says so: the sleeve under the bracket, magnets, power connector, camera connectors. Of the \
         rods only one that is loose in its bore is glued. Never glue a hinge, nor the plugs in the hub: they let go in a crash."
            .into(),
        "In the pictures what moves is dark, what it is joined to is less dark, and the rest is pale. Those of the fold show one module; a \
         step that says 4 x is done at each of the four."
            .into(),
    ];
    if !forgotten.is_empty() {
        lines.push(format!("Of the bill no step says where these go: {}.", forgotten.join(", ").replace('_', " ")));
    }
    lines
}

/// Lines of the bill that are in no step.
fn forgotten(design: &Design, masses: &MassTable, mounting: &Mounting) -> Vec<String> {
    let bill = bill(design, masses, None);
    let print = bill.print.iter().map(|line| (line.part.to_string(), f64::from(line.quantity)));
    let rods = bill.rods.iter().map(|line| (line.rod.clone(), f64::from(line.quantity)));
    let covers = |role: &str| design.frame.extras.get(role).is_some_and(|extra| !extra.covers.is_empty());
    let buy = bill.buy.iter().filter(|line| line.role != "rod" && line.kind != "supply" && !covers(&line.role));
    without_a_step(print.chain(rods).chain(buy.map(|line| (line.role.clone(), f64::from(line.quantity)))), mounting.parts())
}

/// Which way each propeller turns.
fn rotations() -> String {
    let mut motors: Vec<(u32, String)> = MODULE_WORDS
        .iter()
        .enumerate()
        .map(|(module, place)| (ROTORS[module].number, format!("motor {}, {place}: {}", ROTORS[module].number, ROTORS[module].spin.words())))
        .collect();
    motors.sort();
    let motors: Vec<String> = motors.into_iter().map(|(_, words)| words).collect();
    format!("Seen from above: {}. This is the usual numbering of flight controllers, \"props in\".", motors.join("; "))
}

impl Panel {
    fn new(design: &Design, step: &MountStep, at: usize) -> Self {
        Self {
            heading: format!("{}. {}", at + 1, step.title),
            facts: format!("{}; {}; {}", often(step.repeats, step.minutes), step.tool, fixed(step.fixing)),
            text: if step.fixing == Fixing::Shaft { format!("{} {}", step.text, rotations()) } else { step.text.into() },
            caution: step.caution.map(Into::into),
            parts: step.parts.clone(),
            picture: mount_scene::mount(design, step),
            held: Held::of(step).words(),
        }
    }
}

/// How often, and how long it takes.
fn often(repeats: usize, minutes: f64) -> String {
    if repeats == 1 { format!("once, {minutes:.0} min") } else { format!("{repeats} x, {:.0} min each", minutes / repeats as f64) }
}

fn fixed(fixing: Fixing) -> String {
    match fixing {
        Fixing::Screws(role) => format!("held by the {}s", role.replace('_', " ")),
        Fixing::Thread => "cuts its own thread".into(),
        Fixing::Glue => "glued".into(),
        Fixing::Ties(role) => format!("held by {}s", role.replace('_', " ")),
        Fixing::Tape => "taped".into(),
        Fixing::Squeezed => "squeezed in".into(),
        Fixing::MagnetAndPlug => "held by magnet and plug".into(),
        Fixing::Solder => "soldered".into(),
        Fixing::Shaft => "on the motor's shaft".into(),
    }
}

/// How many of what, with a screw's size.
pub fn part_words(line: &PartLine) -> String {
    let count = if line.count.fract() == 0.0 { format!("{:.0}", line.count) } else { "half a".into() };
    let size = line.screw_mm.map_or(String::new(), |[thread, length]| format!(", M{thread} x {length}"));
    format!("{count} x {}{size}", line.part.replace('_', " ")).replace("half a x", "half a")
}

fn parts(masses: &MassTable) -> Vec<[String; 3]> {
    let row = |name: &str| name.replace('_', " ");
    masses.lines.iter().map(|line| [format!("{} x", line.quantity), row(&line.name), row(&line.material)]).collect()
}

fn cuts(design: &Design) -> Vec<String> {
    let stock_mm = design.frame.bought.get("rod").map_or(1000.0, |rod| rod.part.stock_length_mm.unwrap_or(rod.part.size_mm[0]));
    match cutting::cutting_plan(design, stock_mm) {
        Ok(plan) => plan
            .iter()
            .enumerate()
            .map(|(index, stock)| {
                let pieces: Vec<String> = stock.pieces.iter().map(|(role, mm)| format!("{} {mm:.1}", role.slug())).collect();
                format!("{}. of {stock_mm:.0} mm: {}; rest {:.1}", index + 1, pieces.join(", "), stock.rest_mm)
            })
            .collect(),
        Err(error) => vec![error.to_string()],
    }
}

impl Page {
    /// A word for each picture.
    pub fn captions(&self) -> Vec<&'static str> {
        ["Before"].into_iter().chain(self.half_done).chain(["After"]).collect()
    }

    fn new(design: &Design, fold: &FoldSequence, step: &Step, (at, first): (usize, usize), parts: Option<&Vec<PartLine>>) -> Self {
        let mut measures: Vec<String> = step.bends.iter().map(bend).collect();
        measures.extend(depths(step));
        measures.extend(left_out(step));
        Self {
            heading: format!("{}. {}", first + at + 1, step.title),
            facts: format!("{}; {}", often(step.repeats, step.minutes), step.tool),
            text: step.text.to_string(),
            measures,
            caution: step.caution.map(Into::into),
            parts: parts.cloned().unwrap_or_default(),
            half_done: fold_scene::half_way(step.task).map(|(_, words)| words),
            pictures: fold_scene::step(design, fold, at),
        }
    }
}

fn bend(bend: &FoldBend) -> String {
    let part = bend.body.trim_end_matches("_FR").replace('_', " ");
    let moment = bend.load.moment_n_mm.map_or(String::new(), |moment| format!(", held by some {moment:.0} N mm"));
    let preload =
        if bend.preload_deg > 0.0 { format!("; its notch is closed at {:.0}°", bend.to_deg - bend.preload_deg) } else { String::new() };
    format!("{part}, {}: from {:.0}° to {:.0}°{preload}{moment}.", bend.hinge, bend.from_deg, bend.to_deg)
}

/// How deep the rods go: the rings that the pictures show on them.
fn depths(step: &Step) -> Vec<String> {
    let line = |join: &Join| join.depth_mm.map(|mm| format!("The ring on the rod marks how deep it goes: {mm:.1} mm."));
    let mut lines: Vec<String> = step.joins.iter().filter_map(line).collect();
    lines.dedup();
    lines
}

/// What stays open until the triangle is closed, once for both of two rods.
fn left_out(step: &Step) -> Option<String> {
    let join = step.joins.iter().find(|join| join.left_out_mm > 0.05)?;
    Some(format!("Leave a gap of {:.1} mm between ring and bore: bending the foot closes it.", join.left_out_mm))
}
