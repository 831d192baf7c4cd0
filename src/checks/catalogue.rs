//! The catalogue of rules, and the checks of a frame by it.

use rayon::prelude::*;

use super::finding::Finding;
use super::ground::{self, GroundClearance};
use super::printing::{bed, bridge, footing, gap, island, layer_direction, overhang, wall};
use super::rule::{Cost, Found, Rule};
use super::scene::Scene;
use super::{cartridge, centre_of_mass, clearance, envelope, fold, hinge, interference, mass_budget, propeller, seating, strength};
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;

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
    let scene = Scene::new(design, masses);
    let passes = rules.iter().flat_map(|rule| match rule.found {
        Found::By(passes) => passes,
        Found::WithAnother | Found::FromPrediction => &[],
    });
    let passes: Vec<_> = passes.filter(|pass| pass.cost <= dearest).map(|pass| pass.find).collect();
    let found: Vec<Vec<Finding>> = passes.par_iter().map(|find| find(&scene)).collect();
    found.into_iter().flatten().collect()
}

/// The room under the centre, as the rule measures it.
pub fn ground_clearance(design: &Design, masses: &MassTable) -> Option<GroundClearance> {
    ground::measure(&Scene::new(design, masses))
}
