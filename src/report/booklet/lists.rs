//! What to have at hand before the first step: the parts, the rods to cut, what is used up, and tools.

use crate::export::bill::{Bill, BuyLine, CutLine};
use crate::export::cutting;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::{LineKind, MassTable};
use crate::frame::fold::{FoldSequence, worn};
use crate::frame::mounting::mounts_of;
use crate::frame::skeleton::RodRole;

/// The lists of a frame.
pub struct Lists {
    /// How many, what, of what.
    pub parts: Vec<[String; 3]>,
    /// A line a stock length: what to cut from it.
    pub cuts: Vec<String>,
    /// A line each thing that the steps use up and that is not weighed: small ties, glue, wires.
    pub supplies: Vec<String>,
    /// A line each tool that the steps name, and what rods are cut with and what is worn for it.
    pub tools: Vec<&'static str>,
}

impl Lists {
    pub(super) fn new(design: &Design, fold: &FoldSequence, masses: &MassTable, bill: &Bill) -> Self {
        let supplies = bill.buy.iter().filter(|line| line.kind == "supply").map(supply).collect();
        Self { parts: parts(design, masses), cuts: cuts(design, bill), supplies, tools: tools(design, fold) }
    }
}

/// What rods are cut and their ends made smooth with.
const FOR_RODS: [&str; 3] = ["ruler or caliper", "fine saw or cutting disc", "fine sandpaper"];

/// Each once, in the order in which they are needed.
fn tools(design: &Design, fold: &FoldSequence) -> Vec<&'static str> {
    let mounted = mounts_of(design).into_iter().flat_map(|mount| mount.tools).filter_map(|tool| tool.lasting());
    let folded = fold.steps.iter().flat_map(|step| &step.tools).filter_map(|tool| tool.lasting());
    let mut all: Vec<&'static str> = Vec::new();
    for tool in FOR_RODS.into_iter().chain(worn(&design.frame).iter().copied()).chain(folded).chain(mounted) {
        if !all.contains(&tool) {
            all.push(tool);
        }
    }
    all
}

fn supply(line: &BuyLine) -> String {
    let length = line.length_mm.map_or(String::new(), |mm| format!(", {mm:.0} mm"));
    format!("{} x {}{length}: {}", line.quantity, spaced(&line.role), line.search)
}

fn spaced(name: &str) -> String {
    name.replace('_', " ")
}

/// What is taken in hand: no extra that states the mass of other parts.
fn parts(design: &Design, masses: &MassTable) -> Vec<[String; 3]> {
    let is_built_in = |name: &str| design.frame.built_in_extras().any(|(extra, _)| extra == name);
    let in_hand = masses.lines.iter().filter(|line| line.kind != LineKind::Extra || is_built_in(&line.name));
    in_hand.map(|line| [format!("{} x", line.quantity), spaced(&line.name), spaced(&line.material)]).collect()
}

fn words(role: RodRole) -> String {
    spaced(role.slug())
}

/// Which cage rod goes where, of a frame in which they have two lengths.
fn two_lengths(design: &Design) -> Option<String> {
    let [across, side] = [RodRole::Cage, RodRole::CageSide].map(words);
    let line = format!("A {across} rod lies across the frame, in front or at the rear; a {side} rod along its left or right side.");
    design.skeleton.closure.places.are_apart().then_some(line)
}

fn cuts(design: &Design, bill: &Bill) -> Vec<String> {
    if let Some(error) = &bill.cut_error {
        return vec![error.clone()];
    }
    let line = |(index, cut): (usize, &CutLine)| {
        let pieces: Vec<String> = cut.pieces.iter().map(|(rod, mm)| format!("{} {mm:.1}", spaced(rod))).collect();
        format!("{}. of {:.0} mm: {}; rest {}", index + 1, bill.stock_mm, pieces.join(", "), cutting::rest_words(cut.rest_mm))
    };
    bill.cut.iter().enumerate().map(line).chain(two_lengths(design)).collect()
}
