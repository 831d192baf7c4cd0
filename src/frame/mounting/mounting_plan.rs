//! The mounts of a design in an order that can be carried out.

use std::collections::BTreeSet;
use std::ops::Range;

use nalgebra::Vector3;
use rayon::prelude::*;
use serde::Serialize;

use super::figures::figures;
use super::fragments::filled;
use super::mount::{ALL_IN_ONE, BOTH_CONTROLLERS, Fixing, Mount, PLUGGED, RECEIVER, Stage};
use super::mounts::MOUNTS;
use super::part_lines::{PartLine, PartsSeen, fold_bodies};
use super::way::{Compared, Ways};
use crate::frame::assembly::wire::Wire;
use crate::frame::assembly::wires::wires;
use crate::frame::assembly::{Body, Design};
use crate::frame::fold::{FoldSequence, Meeting, Sweep, in_words};
use crate::params::Frame;

/// A mount that has to come first, or later.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Precedence {
    /// The other.
    pub mount: &'static str,
    /// What breaks otherwise.
    pub because: String,
}

/// A step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MountStep {
    /// Its name.
    pub mount: &'static str,
    /// When.
    pub stage: Stage,
    /// In a few words.
    pub title: &'static str,
    /// In sentences.
    pub text: String,
    /// What it takes, in words.
    pub tool: String,
    /// What to take care of.
    pub caution: Option<&'static str>,
    /// How often: once, or once a module.
    pub repeats: usize,
    /// All repeats together, minutes; an estimate.
    pub minutes: f64,
    /// What keeps the parts.
    pub fixing: Fixing,
    /// The bodies that it brings.
    pub brings: Vec<String>,
    /// Everything that moves: what they carry already comes with them.
    pub moves: Vec<String>,
    /// What they are put onto; where each module has one, that of the first module.
    pub onto: &'static str,
    /// What is joined to that already.
    pub there: Vec<String>,
    /// What was mounted before and is out of the frame again meanwhile.
    pub taken_out: Vec<String>,
    /// Where they come from, in frame axes.
    pub from: Option<[f64; 3]>,
    /// How far away they are clear of all that is there, mm.
    pub travel_mm: f64,
    /// What of the bill is taken in hand for the first time.
    pub parts: Vec<PartLine>,
    /// Lines of the bill, used up, that the text tells of: cables that are plugged in here, wires that are soldered.
    pub supplies: Vec<&'static str>,
    /// Mounts that have to be done before.
    pub after: Vec<Precedence>,
    /// Mounts that it has to come before.
    pub before: Vec<Precedence>,
    /// What the motion meets.
    pub sweep: Sweep,
}

/// All mounts of a design.
#[derive(Clone, Debug, PartialEq)]
pub struct Mounting {
    /// Before the fold.
    pub before: Vec<MountStep>,
    /// What of the bill each step of the fold takes in hand for the first time.
    pub fold_parts: Vec<Vec<PartLine>>,
    /// After it.
    pub after: Vec<MountStep>,
}

/// Least and most that a part is shown off its place, mm.
const SHOWN_MM: [f64; 2] = [25.0, 140.0];

impl MountStep {
    /// How far off its place what moves is shown, in frame axes, mm.
    pub fn shown_off_mm(&self) -> Vector3<f64> {
        let along = self.from.map_or_else(Vector3::zeros, Vector3::from);
        along * self.travel_mm.clamp(SHOWN_MM[0], SHOWN_MM[1])
    }

    /// Which of two bodies this step brings to the other; none where it does not bring them together.
    pub fn joined_end(&self, ends: [&str; 2]) -> Option<usize> {
        joined_end(&self.moves, &self.there, ends)
    }

    /// What one of its bodies is put onto: that of the body's own module where each has one.
    pub fn onto_of(&self, body: &str) -> String {
        Mount::onto_of(self.onto, body)
    }
}

/// Which of two bodies is among those that move, while the other is there.
fn joined_end(moves: &[String], there: &[String], ends: [&str; 2]) -> Option<usize> {
    let is_in = |bodies: &[String], name: &str| bodies.iter().any(|body| body == name);
    (0..2).find(|end| is_in(moves, ends[*end]) && is_in(there, ends[1 - end]))
}

/// Mounts that are done, by their names.
type Done = BTreeSet<&'static str>;

impl Mounting {
    /// The mounts of a design, in their order around its fold.
    pub fn new(design: &Design, fold: &FoldSequence) -> Self {
        let planning = Planning::new(design);
        Self::in_order(design, fold, &planning, &planning.order())
    }

    /// The same in an order that is given by their names, as tests of wrong orders do; what the order breaks is in the steps' sweeps.
    pub fn in_given_order(design: &Design, fold: &FoldSequence, order: &[&str]) -> Self {
        let planning = Planning::new(design);
        let order: Vec<&'static Mount> = order.iter().filter_map(|id| planning.mount(id)).collect();
        Self::in_order(design, fold, &planning, &order)
    }

    fn in_order(design: &Design, fold: &FoldSequence, planning: &Planning, order: &[&'static Mount]) -> Self {
        let mut seen = PartsSeen::new(design);
        let folded = order.iter().position(|mount| mount.stage == Stage::AfterFold).unwrap_or(order.len());
        // What takes the time does not depend on the steps before having been looked at.
        let mut found =
            (0..order.len()).into_par_iter().with_max_len(1).map(|at| planning.found(order, at)).collect::<Vec<_>>().into_iter();
        let mut steps = |range: Range<usize>, seen: &mut PartsSeen| {
            range.zip(found.by_ref()).map(|(at, found)| planning.step(order, at, found, seen)).collect()
        };
        let before = steps(0..folded, &mut seen);
        let fold_parts = fold.steps.iter().map(|step| seen.of_fold(step)).collect();
        let after = steps(folded..order.len(), &mut seen);
        Self { before, fold_parts, after }
    }

    /// What of the bill all steps take in hand, the fold's among them.
    pub fn parts(&self) -> impl Iterator<Item = &PartLine> {
        self.steps().flat_map(|step| &step.parts).chain(self.fold_parts.iter().flatten())
    }

    /// The step, from 0 among all, in which a body is first taken in hand; none of a body that no step is about.
    pub fn first_step(&self, fold: &FoldSequence, body: &str) -> Option<usize> {
        let mounted = |steps: &[MountStep]| steps.iter().position(|step| step.onto == body || step.brings.iter().any(|name| name == body));
        let folded = || fold.steps.iter().position(|step| fold_bodies(step).iter().any(|name| name == body));
        let (before, folds) = (self.before.len(), fold.steps.len());
        let in_fold = || folded().map(|at| before + at);
        mounted(&self.before).or_else(in_fold).or_else(|| mounted(&self.after).map(|at| before + folds + at))
    }

    /// All steps, without the fold's between them.
    pub fn steps(&self) -> impl Iterator<Item = &MountStep> {
        self.before.iter().chain(&self.after)
    }
}

/// The mounts that a design has a part for, or for which it has what they are about. Of several that bring the same part the first that
/// has what it is put onto.
pub fn mounts_of(design: &Design) -> Vec<&'static Mount> {
    let has = |name: &str| match name {
        ALL_IN_ONE => design.frame.is_all_in_one(),
        name => design.bodies.iter().any(|body| body.name == name),
    };
    let mut found: Vec<&'static Mount> = Vec::new();
    for mount in MOUNTS.iter().filter(|mount| mount.is_for(has)) {
        let brought = |name: &str| found.iter().any(|other| other.brings.contains(&name));
        if mount.brings.is_empty() || mount.brings.iter().any(|name| has(name) && !brought(name)) {
            found.push(mount);
        }
    }
    found
}

/// The texts of a design's mounts, without those of cables, by their names.
#[cfg(test)]
pub(super) fn texts(design: &Design) -> std::collections::BTreeMap<&'static str, String> {
    let planning = Planning::new(design);
    planning.mounts.iter().map(|mount| (mount.id, planning.text(mount, &[]))).collect()
}

struct Planning<'a> {
    ways: Ways<'a>,
    frame: &'a Frame,
    mounts: Vec<&'static Mount>,
    /// The wires that join two bodies.
    cables: Vec<Wire>,
    /// What stands for names between braces in texts.
    figures: Vec<(&'static str, String)>,
}

impl<'a> Planning<'a> {
    fn new(design: &'a Design) -> Self {
        let cables = wires(design).into_iter().filter(|wire| wire.joins.is_some()).collect();
        Self { ways: Ways::new(design), frame: &design.frame, mounts: mounts_of(design), cables, figures: figures(design) }
    }

    fn mount(&self, id: &str) -> Option<&'static Mount> {
        self.mounts.iter().copied().find(|mount| mount.id == id)
    }

    /// An order that breaks nothing: all is taken apart, each time by the last that can be undone, and that read backwards. Where none
    /// can be undone, one that nothing left needs is: then its sweep says what is in the way.
    fn order(&self) -> Vec<&'static Mount> {
        let mut left = self.mounts.clone();
        let mut order = Vec::new();
        while !left.is_empty() {
            let without = |at: usize| left.iter().enumerate().filter(|(i, _)| *i != at).map(|(_, m)| m.id).collect::<Done>();
            let needed = |at: usize| left.iter().any(|other| other.needs.iter().any(|(id, _)| *id == left[at].id));
            let later = |at: usize| left[at].stage == Stage::BeforeFold && left.iter().any(|other| other.stage == Stage::AfterFold);
            let may = |at: &usize| !needed(*at) && !later(*at);
            let free = (0..left.len()).rev().filter(may).find(|at| self.broken(&without(*at), left[*at]).is_none());
            let Some(at) = free.or_else(|| (0..left.len()).rev().find(may)) else { break };
            order.push(left.remove(at));
        }
        order.reverse();
        order
    }

    /// Everything that hangs on a body, by names.
    fn component(&self, of: &'static str, done: &Done) -> BTreeSet<&'static str> {
        let mut found = BTreeSet::from([of]);
        loop {
            let before = found.len();
            for mount in self.mounts.iter().filter(|mount| done.contains(mount.id)) {
                if found.contains(mount.onto) || mount.brings.iter().any(|name| found.contains(name)) {
                    found.insert(mount.onto);
                    found.extend(mount.brings);
                }
            }
            if found.len() == before {
                return found;
            }
        }
    }

    /// What is out of the frame again while something is mounted.
    fn taken_out(&self, done: &Done, mount: &Mount) -> Vec<&Body> {
        let left = left_in(done, mount);
        let out = self.mounts.iter().filter(|other| mount.taken_out.contains(&other.id)).flat_map(|other| other.brings);
        let bodies: BTreeSet<&'static str> = out.flat_map(|name| self.component(name, &left)).collect();
        self.ways.bodies(bodies.into_iter())
    }

    /// What moves in a mount, and what stays.
    fn sides(&self, done: &Done, mount: &'static Mount) -> [Vec<&Body>; 2] {
        let done = &left_in(done, mount);
        let moving: BTreeSet<&'static str> = mount.brings.iter().flat_map(|name| self.component(name, done)).collect();
        let onto = if mount.is_in_each_module() { "hub" } else { mount.onto };
        let still: BTreeSet<&'static str> = self.component(onto, done).difference(&moving).copied().collect();
        let mut there = self.ways.bodies(still.iter().copied());
        if mount.stage == Stage::AfterFold && still.contains("hub") {
            there.extend(self.ways.modules());
        }
        [self.ways.bodies(moving.into_iter()), there]
    }

    /// What each body that a mount moves meets of each that stays.
    fn compared(&self, done: &Done, mount: &'static Mount, way: impl Fn(&Body, &Body) -> Compared + Sync) -> Vec<Compared> {
        let [moving, still] = self.sides(done, mount);
        let pairs: Vec<_> = moving.iter().flat_map(|a| still.iter().map(move |b| (a, b))).collect();
        pairs.par_iter().map(|(a, b)| way(a, b)).collect()
    }

    fn sweep(&self, done: &Done, mount: &'static Mount) -> Sweep {
        let compared = self.compared(done, mount, |a, b| self.ways.compared(mount, a, b));
        let beyond = |m: &Meeting| m.shared_mm3 - m.allowed_mm3;
        let mut meetings: Vec<Meeting> = compared.iter().filter_map(|pair| pair.worst.clone()).collect();
        meetings.sort_by(|a, b| beyond(b).total_cmp(&beyond(a)));
        Sweep {
            places: compared.iter().map(|pair| pair.places).max().unwrap_or(0),
            pairs: compared.len(),
            comparisons: compared.iter().map(|pair| pair.comparisons).sum(),
            beyond_mm3: meetings.first().map_or(0.0, beyond),
            meetings,
        }
    }

    /// What keeps a mount from being done after those that are.
    fn broken(&self, done: &Done, mount: &'static Mount) -> Option<String> {
        let missing = mount.needs.iter().find(|(id, _)| self.mount(id).is_some() && !done.contains(id));
        if let Some((_, because)) = missing {
            return Some((*because).into());
        }
        let bars = self.compared(done, mount, |a, b| self.ways.barred(mount, a, b));
        let most = |a: &Meeting, b: &Meeting| a.shared_mm3.total_cmp(&b.shared_mm3);
        let bar = bars.into_iter().filter_map(|pair| pair.worst).max_by(most);
        bar.map(|m| format!("{} runs into {} on its way", m.bodies[0], m.bodies[1]))
    }

    /// What a person does, with the cables that are plugged in.
    fn text(&self, mount: &Mount, cables: &[&Wire]) -> String {
        let axes = self.ways.battery_axes();
        let text = axes.words(&filled(&mount.text_in(axes), self.frame));
        let text = self.figures.iter().fold(text, |text, (name, words)| text.replace(name, words));
        let told = cables.iter().map(|cable| axes.words(&cable.plugged(|body| called(self.frame, body)))).collect::<Vec<_>>().join(" ");
        match (text.contains(PLUGGED), told.is_empty()) {
            (true, true) => text.replace(PLUGGED, ""),
            (true, false) => text.replace(PLUGGED, &format!("{told} ")),
            (false, true) => text,
            (false, false) => format!("{text} {told}"),
        }
    }

    /// What its text tells of beside cables; a receiver that the frame's file lists is no supply.
    fn supplies(&self, mount: &Mount) -> impl Iterator<Item = &'static str> {
        mount.supplies.iter().copied().filter(|role| *role != RECEIVER || !self.frame.extras.contains_key(RECEIVER))
    }

    /// What meets what on a mount's way, after those that come before it in an order.
    fn found(&self, order: &[&'static Mount], at: usize) -> OnTheWay {
        let mount = order[at];
        let done = names_of(&order[..at]);
        let depends = |other: &'static Mount, because: String| Precedence { mount: other.id, because };
        let after = order[..at].iter().filter_map(|other| {
            let without: Done = done.iter().copied().filter(|id| *id != other.id).collect();
            self.broken(&without, mount).map(|because| depends(other, because))
        });
        let before = order[at + 1..].iter().filter_map(|other| {
            let with: Done = done.iter().copied().chain([other.id]).collect();
            self.broken(&with, mount).map(|because| depends(other, because))
        });
        OnTheWay { after: after.collect(), before: before.collect(), sweep: self.sweep(&done, mount) }
    }

    fn step(&self, order: &[&'static Mount], at: usize, found: OnTheWay, seen: &mut PartsSeen) -> MountStep {
        let mount = order[at];
        let OnTheWay { after, before, sweep } = found;
        let done = names_of(&order[..at]);
        let [moving, still] = self.sides(&done, mount);
        let names = |bodies: &[&Body]| bodies.iter().map(|body| body.name.clone()).collect::<Vec<_>>();
        let (moves, there) = (names(&moving), names(&still));
        let cables: Vec<&Wire> =
            self.cables.iter().filter(|cable| cable.joins.is_some_and(|ends| joined_end(&moves, &there, ends).is_some())).collect();
        let (repeats, from) = (mount.repeats(), mount.from_in(self.ways.battery_axes()));
        let text = self.text(mount, &cables);
        MountStep {
            mount: mount.id,
            stage: mount.stage,
            title: mount.title,
            parts: seen.of_mount(mount, &text),
            text,
            tool: in_words(&mount.tools_in(self.frame)),
            caution: mount.caution,
            repeats,
            minutes: mount.minutes * repeats as f64,
            fixing: mount.fixing.in_frame(self.frame),
            brings: names(&self.ways.bodies(mount.brings.iter().copied())),
            moves,
            onto: mount.onto,
            there,
            taken_out: names(&self.taken_out(&done, mount)),
            from,
            travel_mm: from.map_or(0.0, |from| self.ways.travel_mm(&Vector3::from(from), &moving, &still)),
            supplies: self.supplies(mount).chain(cables.iter().map(|cable| cable.role)).collect(),
            after,
            before,
            sweep,
        }
    }
}

/// A body in a sentence.
fn called(frame: &Frame, body: &str) -> String {
    if body == "motor_controller" && frame.is_all_in_one() { BOTH_CONTROLLERS.into() } else { body.replace('_', " ") }
}

/// What was found of a mount's place in an order.
struct OnTheWay {
    /// Mounts that have to be done before.
    after: Vec<Precedence>,
    /// Mounts that it has to come before.
    before: Vec<Precedence>,
    /// What its motion meets.
    sweep: Sweep,
}

/// What is done and not out again while something is mounted.
fn left_in(done: &Done, mount: &Mount) -> Done {
    done.iter().copied().filter(|id| !mount.taken_out.contains(id)).collect()
}

fn names_of(mounts: &[&'static Mount]) -> Done {
    mounts.iter().map(|mount| mount.id).collect()
}
