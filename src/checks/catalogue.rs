//! The catalogue of rules, and the checks of a frame by it.

use std::ops::ControlFlow;

use rayon::prelude::*;

use super::finding::Finding;
use super::ground::{self, GroundClearance};
use super::printing::{bed, bridge, footing, gap, island, layer_direction, overhang, wall};
use super::rule::{Cost, Found, Pass, Rule};
use super::scene::Scene;
use super::{cartridge, centre_of_mass, clearance, envelope, fold, hinge, interference, mass_budget, propeller, seating, strength};
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::memo::{Progress, Step, Unwatched};

/// Every rule, in the order of the report: the only list.
pub static CATALOGUE: [&Rule; 20] = [
    &envelope::RULE,
    &mass_budget::RULE,
    &centre_of_mass::RULE,
    &propeller::RULE,
    &clearance::RULE,
    &seating::RULE,
    &interference::RULE,
    &ground::RULE,
    &hinge::RULE,
    &fold::RULE,
    &wall::RULE,
    &gap::RULE,
    &cartridge::RULE,
    &bed::RULE,
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

/// Checks a design by these rules, in their order, without the passes that cost more.
pub fn check_by(rules: &[&Rule], dearest: Cost, design: &Design, masses: &MassTable) -> Vec<Finding> {
    followed(rules, dearest, design, masses, &Unwatched).unwrap_or_default()
}

/// The same with somebody who follows it, rule by rule; none when that one ended it.
pub fn followed(rules: &[&Rule], dearest: Cost, design: &Design, masses: &MassTable, progress: &dyn Progress) -> Option<Vec<Finding>> {
    let scene = Scene::new(design, masses);
    let passes = rules.iter().flat_map(|rule| match rule.found {
        Found::By(passes) => passes.iter().map(|pass| (rule.title, pass)).collect(),
        Found::WithAnother | Found::FromPrediction => Vec::new(),
    });
    let passes: Vec<_> = passes.filter(|(_, pass)| pass.cost <= dearest).collect();
    let of = passes.len();
    let find = |(name, pass): &(&str, &Pass)| match progress.begins(Step { name, of }) {
        ControlFlow::Break(()) => None,
        ControlFlow::Continue(()) => Some((pass.find)(&scene)),
    };
    let found: Option<Vec<Vec<Finding>>> = passes.par_iter().map(find).collect();
    found.map(|found| found.into_iter().flatten().collect())
}

/// The room under the centre, as the rule measures it.
pub fn ground_clearance(design: &Design, masses: &MassTable) -> Option<GroundClearance> {
    ground::measure(&Scene::new(design, masses))
}
