//! What of the bill a step takes in hand for the first time: each line of the bill in one step, by the bodies that stand for it.

use std::collections::BTreeSet;

use serde::Serialize;

use super::fragments::extra_called;
use super::mount::{Fixing, Mount, RADIO, RECEIVER};
use crate::frame::assembly::{Body, Design};
use crate::frame::fold::{Member, Step};
use crate::frame::skeleton::MODULE_NAMES;

/// So many of a line of the bill.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartLine {
    /// Its name in the bill: a printed part, a rod, a role.
    pub part: String,
    /// How many; a half of a pair that is bought as one is 0.5.
    pub count: f64,
    /// Thread and length under the head of a screw, mm.
    pub screw_mm: Option<[f64; 2]>,
    /// Width and height of a screw's head, mm.
    pub head_mm: Option<[f64; 2]>,
    /// A body that looks like it.
    pub body: Option<String>,
}

impl PartLine {
    /// How many of what, with a screw's size.
    pub fn words(&self) -> String {
        let count = if self.count == 0.5 { "half a".into() } else { ((100.0 * self.count).round() / 100.0).to_string() };
        let size = self.screw_mm.map_or(String::new(), |[thread, length]| format!(", M{thread} x {length}"));
        format!("{count} x {}{size}", self.part.replace('_', " ")).replace("half a x", "half a")
    }
}

/// Bodies that were in hand already.
pub(super) struct PartsSeen<'a> {
    design: &'a Design,
    seen: BTreeSet<String>,
    /// Extras, by their names: each is beside the first step that names it, and what no step names beside that in which wires are soldered.
    extras_seen: BTreeSet<String>,
}

/// How many pieces of a bought part a body represents; 1 for other bodies.
fn pieces(design: &Design, body: &Body, line: &str) -> f64 {
    let kind = |body: &Body| design.shape(body).kind;
    let all: f64 = design.bodies.iter().map(kind).filter(|kind| kind.bill_line() == line).map(|kind| kind.weight(&design.frame)).sum();
    design.frame.bought.get(line).map_or(1.0, |item| f64::from(item.quantity) * kind(body).weight(&design.frame) / all)
}

impl<'a> PartsSeen<'a> {
    pub(super) fn new(design: &'a Design) -> Self {
        Self { design, seen: BTreeSet::new(), extras_seen: BTreeSet::new() }
    }

    /// The new ones of these bodies, as lines.
    fn of(&mut self, names: impl Iterator<Item = String>) -> Vec<PartLine> {
        let mut lines: Vec<PartLine> = Vec::new();
        for name in names {
            let Some(body) = self.design.bodies.iter().find(|body| body.name == name) else { continue };
            if !self.seen.insert(name) {
                continue;
            }
            let part = self.design.shape(body).kind.bill_line().into_owned();
            let count = pieces(self.design, body, &part);
            match lines.iter_mut().find(|line| line.part == part) {
                Some(line) => line.count += count,
                None => {
                    let bought = self.design.frame.bought.get(&part).map(|item| &item.part);
                    let screw_mm = bought.and_then(|part| part.thread_mm.zip(part.length_mm)).map(|(thread, length)| [thread, length]);
                    let head_mm = bought.and_then(|part| part.head_diameter_mm.zip(part.head_height_mm)).map(|(wide, high)| [wide, high]);
                    lines.push(PartLine { part, count, screw_mm, head_mm, body: Some(body.name.clone()) });
                }
            }
        }
        lines
    }

    /// Of a mount, with what its text says of the design.
    pub(super) fn of_mount(&mut self, mount: &Mount, text: &str) -> Vec<PartLine> {
        let mut lines = self.of(mount.brings.iter().copied().chain([mount.onto]).map(String::from));
        let frame = &self.design.frame;
        let taken: Vec<&String> = frame
            .built_in_extras()
            .map(|(name, _)| name)
            .filter(|name| {
                let is_receiver = mount.id == RADIO && *name == RECEIVER;
                is_receiver || mount.fixing == Fixing::Solder || text.contains(&extra_called(name))
            })
            .filter(|name| !self.extras_seen.contains(*name))
            .collect();
        lines.extend(taken.iter().map(|name| PartLine { part: (*name).clone(), count: 1.0, screw_mm: None, head_mm: None, body: None }));
        self.extras_seen.extend(taken.into_iter().cloned());
        lines
    }

    /// Of a step of the fold, in all four modules.
    pub(super) fn of_fold(&mut self, step: &Step) -> Vec<PartLine> {
        self.of(fold_bodies(step).into_iter())
    }
}

/// The bodies of all four modules that a step of the fold is about.
pub(super) fn fold_bodies(step: &Step) -> Vec<String> {
    let members: Vec<Member> = step.task.contacts().into_iter().chain(step.task.lever()).flat_map(|(a, b)| [a, b]).collect();
    let hub = members.contains(&Member::Hub).then(|| Member::Hub.body(0));
    let bodies = members.iter().filter(|m| **m != Member::Hub).flat_map(|m| (0..MODULE_NAMES.len()).map(|module| m.body(module)));
    bodies.chain(hub).collect()
}

/// Lines of a bill, each with its quantity, that the steps' lines do not add up to.
pub fn without_a_step<'l>(bill: impl Iterator<Item = (String, f64)>, lines: impl Iterator<Item = &'l PartLine>) -> Vec<String> {
    let lines: Vec<&PartLine> = lines.collect();
    let of = |name: &str| lines.iter().filter(|line| line.part == name).map(|line| line.count).sum::<f64>();
    bill.filter(|(name, quantity)| (of(name) - quantity).abs() > 1e-9).map(|(name, _)| name).collect()
}
