//! The catalogue of rules, and the checks of a frame by it.

use std::convert::Infallible;
use std::ops::ControlFlow;

use rayon::prelude::*;

use super::finding::Finding;
use super::ground::{self, GroundClearance};
use super::printing::{bed, bridge, footing, gap, heat, island, layer_direction, overhang, wall};
use super::rule::{Cost, Find, Found, Rule};
use super::scene::Scene;
use super::{
    cartridge, centre_of_mass, clearance, envelope, fold, hardware, hinge, interference, mass_budget, propeller, seating, strength,
};
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::memo::{Progress, Step};

/// Every rule, in the order of the report: the only list.
pub static CATALOGUE: [&Rule; 22] = [
    &envelope::RULE,
    &mass_budget::RULE,
    &centre_of_mass::RULE,
    &propeller::RULE,
    &clearance::RULE,
    &seating::RULE,
    &interference::RULE,
    &hardware::RULE,
    &ground::RULE,
    &hinge::RULE,
    &fold::RULE,
    &wall::RULE,
    &gap::RULE,
    &cartridge::RULE,
    &bed::RULE,
    &heat::RULE,
    &layer_direction::RULE,
    &overhang::RULE,
    &island::RULE,
    &bridge::RULE,
    &footing::RULE,
    &strength::RULE,
];

/// Checks a design against its limits. The order of the findings depends on the design only.
pub fn check(design: &Design, masses: &MassTable) -> Vec<Finding> {
    check_by(&CATALOGUE, Cost::Slow, design, masses)
}

/// Checks a design by these rules, in their order, without the passes that cost more; of a sketch, what can be asked of it.
pub fn check_by(rules: &[&Rule], dearest: Cost, design: &Design, masses: &MassTable) -> Vec<Finding> {
    match found(rules, dearest, design, masses, &|_| ControlFlow::<Infallible>::Continue(())) {
        ControlFlow::Continue(found) => found,
        ControlFlow::Break(never) => match never {},
    }
}

/// What one rule finds, without the search for a fold and the passes that cost more. A rule whose findings come about in a pass of another is
/// asked with all of them.
pub fn check_one(rule: &Rule, dearest: Cost, design: &Design, masses: &MassTable) -> Vec<Finding> {
    let own = |known: &&&Rule| known.id == rule.id && matches!(known.found, Found::By(_));
    let alone: Vec<&Rule> = CATALOGUE.iter().filter(own).copied().collect();
    let others = CATALOGUE.iter().copied().filter(|known| alone.is_empty() && known.id != fold::RULE.id);
    let rules: Vec<&Rule> = alone.iter().copied().filter(|known| known.id != fold::RULE.id).chain(others).collect();
    check_by(&rules, dearest, design, masses).into_iter().filter(|finding| finding.rule == rule.id).collect()
}

/// The same with somebody who follows it, rule by rule; none when that one ended it.
pub fn followed(rules: &[&Rule], dearest: Cost, design: &Design, masses: &MassTable, progress: &dyn Progress) -> Option<Vec<Finding>> {
    found(rules, dearest, design, masses, &|step| progress.begins(step)).continue_value()
}

/// What these rules find, unless it is ended before one of them.
fn found<B: Send>(
    rules: &[&Rule],
    dearest: Cost,
    design: &Design,
    masses: &MassTable,
    begins: &(dyn Fn(Step) -> ControlFlow<B> + Sync),
) -> ControlFlow<B, Vec<Finding>> {
    let scene = Scene::new(design, masses);
    let passes = rules.iter().flat_map(|rule| match rule.found {
        Found::By(passes) => passes.iter().filter_map(|pass| Some((rule.title, pass.up_to(dearest)?))).collect(),
        Found::WithAnother | Found::FromPrediction => Vec::new(),
    });
    let passes: Vec<(&str, Find)> = passes.collect();
    let of = passes.len();
    let find = |(name, find): &(&str, Find)| begins(Step { name, of }).map_continue(|()| find(&scene));
    let found: Vec<ControlFlow<B, Vec<Finding>>> = passes.par_iter().map(find).collect();
    let mut findings = Vec::new();
    for of_pass in found {
        findings.extend(of_pass?);
    }
    ControlFlow::Continue(findings)
}

/// The room under the centre, as the rule measures it.
pub fn ground_clearance(design: &Design, masses: &MassTable) -> Option<GroundClearance> {
    ground::measure(&Scene::new(design, masses))
}
