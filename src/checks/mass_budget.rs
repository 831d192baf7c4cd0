//! The take-off mass stays within the budget: 250 g is where rules for small drones begin in many countries.
//!
//! The mass is the table's: volumes times densities, the catalogue's masses, and what is estimated.

use super::finding::Finding;
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use super::scene::Scene;

const LEVERS: &[&str] = &["bought.battery", "bought.motor", "materials.rigid"];

pub static RULE: Rule = Rule {
    id: "mass_budget",
    title: "Take-off mass",
    requires: "the take-off mass is within its budget",
    units: &["g"],
    limits: &[Limit::Key { subject: "", key: "limits.mass_budget_g" }],
    levers: Levers::Sets(&[LEVERS]),
    blame: Blame::Masses { summed: true },
    in_search: InSearch::Constraints { subjects: &[""], binds: true },
    found: Found::By(&[Pass::quick(check)]),
};

/// The take-off mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TakeOffMass {
    /// All together, g.
    pub total_g: f64,
    /// What of it is estimated, g.
    pub estimated_g: f64,
    /// The budget, g.
    pub limit_g: f64,
}

impl TakeOffMass {
    fn finding(&self) -> Finding {
        let Self { total_g, estimated_g, limit_g } = *self;
        let measure = Measure { rule: RULE.id, value: total_g, limit: limit_g, unit: "g", levers: LEVERS };
        let [total, budget] = measure.figures(1);
        let message = format!("the frame takes off with {total} g ({estimated_g:.1} g of it estimated), the budget is {budget} g");
        measure.at_most("take-off mass".into(), message)
    }
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let (total_g, estimated_g) = (scene.masses.total_g, scene.masses.estimated_g);
    vec![TakeOffMass { total_g, estimated_g, limit_g: scene.design.frame.limits.mass_budget_g }.finding()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};

    #[test]
    fn planted_a_heavy_battery() {
        assert_eq!(violated(&Planted::preset("cognifly").found(check)), []);
        let found = Planted::frame(|frame| frame.battery.battery_mass_g += 100.0).found(check);
        assert_eq!(violated(&found).len(), 1, "{found:?}");
    }
}
