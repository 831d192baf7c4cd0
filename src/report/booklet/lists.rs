//! What to have at hand before the first step: the parts, the rods to cut, and what is used up.

use crate::export::bill::{Bill, BuyLine};
use crate::export::cutting;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::frame::skeleton::RodRole;

/// The lists of a frame.
pub struct Lists {
    /// How many, what, of what.
    pub parts: Vec<[String; 3]>,
    /// A line a stock length: what to cut from it.
    pub cuts: Vec<String>,
    /// A line each thing that the steps use up and that is not weighed: small ties, glue, wires.
    pub supplies: Vec<String>,
}

impl Lists {
    pub(super) fn new(design: &Design, masses: &MassTable, bill: &Bill) -> Self {
        let supplies = bill.buy.iter().filter(|line| line.kind == "supply").map(supply).collect();
        Self { parts: parts(masses), cuts: cuts(design), supplies }
    }
}

fn supply(line: &BuyLine) -> String {
    let length = line.length_mm.map_or(String::new(), |mm| format!(", {mm:.0} mm"));
    format!("{} x {}{length}: {}", line.quantity, spaced(&line.role), line.search)
}

fn spaced(name: &str) -> String {
    name.replace('_', " ")
}

fn parts(masses: &MassTable) -> Vec<[String; 3]> {
    masses.lines.iter().map(|line| [format!("{} x", line.quantity), spaced(&line.name), spaced(&line.material)]).collect()
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

fn cuts(design: &Design) -> Vec<String> {
    let stock_mm = design.frame.stock_mm();
    match cutting::cutting_plan(design, stock_mm) {
        Ok(plan) => plan
            .iter()
            .enumerate()
            .map(|(index, stock)| {
                let pieces: Vec<String> = stock.pieces.iter().map(|(role, mm)| format!("{} {mm:.1}", words(*role))).collect();
                format!("{}. of {stock_mm:.0} mm: {}; rest {}", index + 1, pieces.join(", "), cutting::rest_words(stock.rest_mm))
            })
            .chain(two_lengths(design))
            .collect(),
        Err(error) => vec![error.to_string()],
    }
}
