//! The instructions as a value: title page, a page of parts and rods, a page a sub-assembly, half a page a mount, one page a step of the
//! fold. Two files are written from it. A step has one number, on its page, in the names of its pictures, in `fold.json` and on the command
//! line.

use crate::checks::{Finding, Verdict};
use crate::export::bill::{Bill, bill};
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::frame::fold::{FoldBend, FoldSequence, Join, Step, Sweep, Task, in_words, sweeps, when_cut};
use crate::frame::mounting::{Fixing, MountStep, Mounting, PartLine, untold, without_a_step};
use crate::frame::skeleton::{MODULE_WORDS, ROTORS};
use crate::report::booklet::lists::Lists;
use crate::report::booklet::sub_assembly::{SubAssembly, sub_assemblies};
use crate::report::picture::fold_scene;
use crate::report::picture::fold_scene::Picture;
use crate::report::picture::mount_scene::{self, Held};
use crate::report::picture::propeller_scene;
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
    /// What to have at hand.
    pub lists: Lists,
    /// Centre, module and cartridge: each before the steps that make it.
    pub assemblies: [SubAssembly; 3],
    /// What is mounted before the fold, two on a sheet where they fit.
    pub before: Vec<Panel>,
    /// The steps of the fold, each on a sheet.
    pub pages: Vec<Page>,
    /// What is mounted after it, likewise; the propellers last.
    pub after: Vec<Panel>,
}

/// Half a sheet: one picture, the parts beside it.
pub struct Panel {
    /// From 1, among all steps.
    pub number: usize,
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
    /// How the picture is held, and the colours of its wires.
    pub held: String,
}

/// A step on paper.
pub struct Page {
    /// From 1, among all steps.
    pub number: usize,
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

/// One step of the instructions.
pub enum OneStep {
    /// Of a mount.
    Mount(Panel),
    /// Of the fold.
    Fold(Page),
}

/// Every step, with what it takes to write about it.
pub struct AllSteps<'a> {
    /// The frame.
    pub design: &'a Design,
    /// Its fold.
    pub fold: &'a FoldSequence,
    mounting: Mounting,
}

impl<'a> AllSteps<'a> {
    /// Those of a frame.
    pub fn new(design: &'a Design, fold: &'a FoldSequence) -> Self {
        Self { design, fold, mounting: Mounting::new(design, fold) }
    }

    /// How often each step is done, and what it is called.
    pub fn titles(&self) -> Vec<(usize, &'static str)> {
        let mounts = |steps: &[MountStep]| steps.iter().map(|step| (step.repeats, step.title)).collect::<Vec<_>>();
        let folds = self.fold.steps.iter().map(|step| (step.repeats, step.title));
        mounts(&self.mounting.before).into_iter().chain(folds).chain(mounts(&self.mounting.after)).collect()
    }

    /// The step of a number from 1; none beyond the last.
    pub fn one(&self, number: usize) -> Option<OneStep> {
        let (at, before, folds) = (number.checked_sub(1)?, self.mounting.before.len(), self.fold.steps.len());
        if let Some(step) = at.checked_sub(before).and_then(|at| self.fold.steps.get(at)) {
            let at = at - before;
            let sweeps = sweeps(self.design, self.fold);
            let parts = self.mounting.fold_parts.get(at);
            return Some(OneStep::Fold(Page::new((self.design, self.fold), step, sweeps.get(at), (at, before), parts)));
        }
        let step = if at < before { self.mounting.before.get(at) } else { self.mounting.after.get(at - before - folds) };
        step.map(|step| OneStep::Mount(Panel::new(self.design, step, at)))
    }
}

impl OneStep {
    /// What its page says, a paragraph a line.
    pub fn paragraphs(&self) -> Vec<String> {
        let (heading, facts, parts, text, measures, caution) = match self {
            Self::Mount(panel) => (&panel.heading, &panel.facts, &panel.parts, &panel.text, &[][..], &panel.caution),
            Self::Fold(page) => (&page.heading, &page.facts, &page.parts, &page.text, &page.measures[..], &page.caution),
        };
        let takes: Vec<String> = parts.iter().map(PartLine::words).collect();
        let mut lines = vec![heading.clone(), facts.clone()];
        if !takes.is_empty() {
            lines.push(format!("Takes {}.", takes.join(", ")));
        }
        lines.push(text.clone());
        lines.extend(measures.iter().cloned());
        lines.extend(caution.iter().map(|caution| format!("Caution. {caution}")));
        lines
    }

    /// Its pictures by their names.
    pub fn pictures(&self) -> Vec<(String, &Picture)> {
        match self {
            Self::Mount(panel) => vec![(panel.picture_name(), &panel.picture)],
            Self::Fold(page) => page.picture_names().into_iter().zip(&page.pictures).collect(),
        }
    }
}

impl Booklet {
    /// The instructions of a frame, with what its check found.
    pub fn new(design: &Design, masses: &MassTable, fold: &FoldSequence, findings: &[Finding]) -> Self {
        let mounting = Mounting::new(design, fold);
        let folded = fold.steps.iter().map(|step| step.minutes);
        let minutes: f64 = folded.chain(mounting.steps().map(|step| step.minutes)).sum();
        let first = mounting.before.len();
        let panels = |steps: &[MountStep], from: usize| -> Vec<Panel> {
            steps.par_iter().enumerate().map(|(at, step)| Panel::new(design, step, from + at)).collect()
        };
        let sweeps = sweeps(design, fold);
        let page = |(at, step): (usize, &Step)| Page::new((design, fold), step, sweeps.get(at), (at, first), mounting.fold_parts.get(at));
        let bill = bill(design, masses, None);
        let mut preface = preface(design, &mounting, fold, minutes, &forgotten(design, &bill, &mounting));
        preface.splice(..0, violated(findings));
        let barred_steps = barred_steps(&mounting, &sweeps);
        if !barred_steps.is_empty() {
            preface.insert(0, format!("This frame cannot be assembled as it is: something is in the way of {}.", barred_steps.join(", ")));
        }
        let (((apart, alone), assemblies), ((before, after), pages)) = rayon::join(
            || {
                let whole = || rayon::join(|| fold_scene::apart(design, fold), || alone(design, &mounting));
                rayon::join(whole, || sub_assemblies(design, fold, &mounting))
            },
            || {
                let mounts = || rayon::join(|| panels(&mounting.before, 0), || panels(&mounting.after, first + fold.steps.len()));
                rayon::join(mounts, || fold.steps.par_iter().enumerate().map(page).collect())
            },
        );
        let frame = design.frame.name.clone();
        Self { frame, preface, apart, alone, lists: Lists::new(design, fold, masses, &bill), assemblies, before, pages, after }
    }

    /// What is written above everything.
    pub fn title(&self) -> String {
        format!("{}: how to put it together", self.frame)
    }

    /// What is mounted after the fold: what comes before the cartridge is made, and the rest.
    pub fn around_cartridge(&self) -> [&[Panel]; 2] {
        let [.., cartridge] = &self.assemblies;
        let made = self.after.iter().position(|panel| cartridge.steps.contains(&panel.heading));
        let (first, rest) = self.after.split_at(made.unwrap_or(0));
        [first, rest]
    }
}

/// The steps, by their numbers, that something is in the way of.
fn barred_steps(mounting: &Mounting, folded: &[Sweep]) -> Vec<String> {
    let mounted = |steps: &[MountStep]| steps.iter().map(|step| barred(&step.sweep).is_some()).collect::<Vec<_>>();
    let folded = folded.iter().map(|sweep| barred(sweep).is_some());
    let all = mounted(&mounting.before).into_iter().chain(folded).chain(mounted(&mounting.after));
    all.enumerate().filter(|(_, barred)| *barred).map(|(at, _)| format!("step {}", at + 1)).collect()
}

/// The limits that a frame violates, each rule with what its first finding says; nothing where it holds all.
fn violated(findings: &[Finding]) -> Option<String> {
    let mut rules: Vec<(&Finding, usize)> = Vec::new();
    for finding in findings.iter().filter(|finding| finding.verdict == Verdict::Violated) {
        match rules.iter_mut().find(|(first, _)| first.rule == finding.rule) {
            Some((_, more)) => *more += 1,
            None => rules.push((finding, 0)),
        }
    }
    let told = |(first, more): &(&Finding, usize)| {
        let more = if *more > 0 { format!(" ({more} more like it)") } else { String::new() };
        format!("{}: {}{more}", first.rule.replace('_', " "), first.message)
    };
    let told: Vec<String> = rules.iter().map(told).collect();
    (!told.is_empty())
        .then(|| format!("This frame violates limits, so change it before you build it. {}. `flexframe check` says more.", told.join(". ")))
}

/// A picture of each thing that a step takes in hand.
fn alone(design: &Design, mounting: &Mounting) -> BTreeMap<String, Picture> {
    let lines: BTreeMap<&str, &PartLine> =
        mounting.parts().filter(|line| line.screw_mm.is_none()).map(|line| (&*line.part, line)).collect();
    let drawn = lines.par_iter().filter_map(|(name, line)| Some((name.to_string(), mount_scene::part(design, line)?)));
    drawn.collect::<Vec<_>>().into_iter().collect()
}

fn preface(design: &Design, mounting: &Mounting, fold: &FoldSequence, minutes: f64, forgotten: &[String]) -> Vec<String> {
    let (before, after) = (mounting.before.len(), mounting.after.len());
    let whole = whole_modules(fold, before).join(" and ");
    let folds = fold.steps.len();
    let mut lines = vec![
        format!(
            "{} steps, about {minutes:.0} minutes: {before} put hub and electronics together, {folds} fold the frame, {after} finish it. \
             Print the parts flat, as they lie in their files; cut the rods; lay everything out.",
            before + folds + after
        ),
        when_cut(&design.frame),
        "Glue belongs on rigid parts in the steps that say so, and hardens as its maker says before anything pulls at it. A drop of \
         cyanoacrylate keeps each of the four motor mounts in its place on the arms, and a rod that is loose in its bore. Never glue a hinge, \
         nor the plugs in the hub: they let go in a crash."
            .into(),
        format!(
            "{} In the steps {whole} whole modules move: there only the ends that go into something have a colour of their own. The steps of the fold show the module of the \
             front right; one that says 4 x is done at each of the four.",
            fold_scene::key()
        ),
        "First power is without propellers: they are the last step.".into(),
    ];
    if !forgotten.is_empty() {
        lines.push(format!("Of the bill no step says where these go: {}.", forgotten.join(", ").replace('_', " ")));
    }
    lines
}

/// Numbers of the steps in which whole modules move.
fn whole_modules(fold: &FoldSequence, before: usize) -> Vec<String> {
    let whole = |step: &Step| matches!(step.task, Task::PlugHub | Task::CloseRing);
    fold.steps.iter().enumerate().filter(|(_, step)| whole(step)).map(|(at, _)| (before + at + 1).to_string()).collect()
}

/// Lines of the bill that are in no step: what is built in, and cables, wires and receiver of what is used up.
fn forgotten(design: &Design, bill: &Bill, mounting: &Mounting) -> Vec<String> {
    let print = bill.print.iter().map(|line| (line.part.to_string(), f64::from(line.quantity)));
    let rods = bill.rods.iter().map(|line| (line.rod.clone(), f64::from(line.quantity)));
    let is_built_in = |name: &str| design.frame.built_in_extras().any(|(extra, _)| extra == name);
    let weighs_others = |role: &str| design.frame.extras.contains_key(role) && !is_built_in(role);
    let buy = bill.buy.iter().filter(|line| line.role != "rod" && line.kind != "supply" && !weighs_others(&line.role));
    let mut forgotten =
        without_a_step(print.chain(rods).chain(buy.map(|line| (line.role.clone(), f64::from(line.quantity)))), mounting.parts());
    let connected = bill.buy.iter().filter(|line| line.kind == "supply" && (line.length_mm.is_some() || line.role == "receiver"));
    let steps: Vec<&MountStep> = mounting.steps().collect();
    forgotten.extend(untold(connected.map(|line| line.role.as_str()), &steps).into_iter().map(String::from));
    forgotten
}

/// Which way each propeller turns.
fn rotations() -> String {
    let mut motors: Vec<(u32, String)> = MODULE_WORDS
        .iter()
        .enumerate()
        .map(|(module, place)| {
            (ROTORS[module].number, format!("motor {}, {place}: {}", ROTORS[module].number, ROTORS[module].spin.words()))
        })
        .collect();
    motors.sort();
    let motors: Vec<String> = motors.into_iter().map(|(_, words)| words).collect();
    format!(
        "{} Seen from above: {}. This is the usual numbering of flight controllers, \"props in\".",
        propeller_scene::key(),
        motors.join("; ")
    )
}

impl Panel {
    /// Name of its picture, beside the page.
    pub fn picture_name(&self) -> String {
        format!("steps/{:02}.png", self.number)
    }

    fn new(design: &Design, step: &MountStep, at: usize) -> Self {
        Self {
            number: at + 1,
            heading: format!("{}. {}", at + 1, step.title),
            facts: format!("{}; {}; {}", often(step.repeats, step.minutes), step.tool, fixed(step.fixing)),
            text: if step.fixing == Fixing::Shaft { format!("{} {}", step.text, rotations()) } else { step.text.clone() },
            caution: cautions(barred(&step.sweep), step.caution),
            parts: step.parts.clone(),
            picture: mount_scene::mount(design, step),
            held: format!("{}{}", Held::of(step).words(), mount_scene::key(design, step)),
        }
    }
}

/// That a step cannot be done, where something is in its way.
fn barred(sweep: &Sweep) -> Option<String> {
    let meeting = sweep.meetings.first().filter(|_| sweep.beyond_mm3 > 0.0)?;
    let [a, b] = meeting.bodies.each_ref().map(|body| body.replace('_', " "));
    Some(format!("This step cannot be done as the frame is: on the way {a} runs into {b} ({:.1} mm3).", meeting.shared_mm3))
}

fn cautions(barred: Option<String>, own: Option<&str>) -> Option<String> {
    match (barred, own) {
        (Some(barred), Some(own)) => Some(format!("{barred} {own}")),
        (barred, own) => barred.or_else(|| own.map(String::from)),
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
        Fixing::SmallScrews => "held by small screws".into(),
        Fixing::SmallTies => "held by small ties".into(),
        Fixing::Squeezed => "squeezed in".into(),
        Fixing::MagnetAndPlug => "held by magnet and plug".into(),
        Fixing::Magnet => "held by the magnet".into(),
        Fixing::Plug => "held by the plug".into(),
        Fixing::Extra => "held by what the file lists as extra".into(),
        Fixing::Solder => "soldered".into(),
        Fixing::Shaft => "on the motor's shaft".into(),
    }
}

impl Page {
    /// Words for each picture.
    pub fn captions(&self) -> Vec<String> {
        let words = ["Before"].into_iter().chain(self.half_done).chain(["After"]);
        words.map(|words| format!("{words}. {}", Held::Upright.words())).collect()
    }

    /// Names of its pictures, beside the page.
    pub fn picture_names(&self) -> Vec<String> {
        let words = ["before"].into_iter().chain(self.half_done.map(|_| "between")).chain(["after"]);
        words.map(|word| format!("steps/{:02}_{word}.png", self.number)).collect()
    }

    fn new(
        (design, fold): (&Design, &FoldSequence),
        step: &Step,
        sweep: Option<&Sweep>,
        (at, first): (usize, usize),
        parts: Option<&Vec<PartLine>>,
    ) -> Self {
        let mut measures: Vec<String> = step.bends.iter().map(bend).collect();
        measures.extend(depths(step));
        measures.extend(left_out(step));
        Self {
            number: first + at + 1,
            heading: format!("{}. {}", first + at + 1, step.title),
            facts: format!("{}; {}", often(step.repeats, step.minutes), in_words(&step.tools)),
            text: step.text.to_string(),
            measures,
            caution: cautions(sweep.and_then(barred), step.caution.as_deref()),
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

/// How deep the rods go: the rings that the pictures show on them, which a person draws.
fn depths(step: &Step) -> Vec<String> {
    let line = |join: &Join| {
        join.depth_mm.map(|mm| {
            format!(
                "Before, mark the rod as the ring in the picture shows: all round, {mm:.1} mm from the end that goes in, with a pen that shows on \
                 it. The ring is at the mouth of the bore when the rod is at the bottom."
            )
        })
    };
    let mut lines: Vec<String> = step.joins.iter().filter_map(line).collect();
    lines.dedup();
    lines
}

/// What stays open until the triangle is closed, once for both of two rods.
fn left_out(step: &Step) -> Option<String> {
    let join = step.joins.iter().find(|join| join.left_out_mm > 0.05)?;
    Some(format!(
        "For now leave a gap of {:.1} mm between the ring and the mouth of the bore: bending the foot closes it later.",
        join.left_out_mm
    ))
}
