//! The take-off mass stays within the budget: 250 g is where rules for small drones begin in many countries.
//!
//! The mass is the table's: volumes times densities, the catalogue's masses, and what is estimated.

use std::collections::BTreeSet;

use super::finding::Finding;
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use super::scene::Scene;
use crate::frame::assembly::mass::{covering, uncovered_g};
use crate::params::frame::Extra;

const LEVERS: &[&str] = &["bought.battery", "bought.motor", "materials.rigid"];
const BATTERY: &[&str] = &["battery.battery_mass_g"];

pub static RULE: Rule = Rule {
    id: "mass_budget",
    title: "Take-off mass",
    requires: "the take-off mass is within its budget",
    units: &["g"],
    limits: &[Limit::Key { subject: "", key: "limits.mass_budget_g" }],
    levers: Levers::Sets(&[LEVERS, BATTERY]),
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
    let take_off = TakeOffMass { total_g, estimated_g, limit_g: scene.design.frame.limits.mass_budget_g };
    std::iter::once(take_off.finding()).chain(light_battery(scene)).chain(light_extras(scene)).collect()
}

/// Least part of the catalogue's mass that a frame states for what is bought: packs of one kind differ by less. Chosen.
const LEAST_STATED: f64 = 0.85;

/// A warning of a battery that is stated to be lighter than the one that is bought, and is in no extra's mass.
fn light_battery(scene: &Scene) -> Option<Finding> {
    let frame = &scene.design.frame;
    let stated_g = frame.battery.battery_mass_g;
    let bought = frame.bought.get("battery").filter(|bought| stated_g < LEAST_STATED * bought.part.mass_g)?;
    let weighed = |extra: &Extra| extra.covers.iter().any(|role| role == "battery");
    if frame.extras.values().any(weighed) {
        return None;
    }
    let (name, bought_g) = (&bought.name, bought.part.mass_g);
    let missing = Measure { rule: RULE.id, value: bought_g - stated_g, limit: 0.0, unit: "g", levers: BATTERY };
    let message = format!(
        "battery_mass_g = {stated_g} leaves {missing:.1} g of {name} of the bill, {bought_g} g, out of the take-off mass, and no extra covers it",
        missing = missing.value
    );
    Some(missing.note("battery".into(), message))
}

/// A warning of each extra that is lighter than the bought parts in its mass.
fn light_extras(scene: &Scene) -> Vec<Finding> {
    let design = scene.design;
    let of = |(name, extra): (&String, &Extra)| {
        let is_in_it = |role: &&String| design.frame.bought.contains_key(*role) && covering(design, role) == Some(name.as_str());
        let covered: BTreeSet<&String> = extra.covers.iter().filter(is_in_it).collect();
        // A battery that is stated to weigh nothing is weighed with something else.
        let by_itself_g = |role: &str| match design.frame.bought.get(role) {
            Some(item) if role == "battery" && design.frame.battery.battery_mass_g == 0.0 => item.part.mass_g,
            _ => uncovered_g(design, role),
        };
        let each: Vec<(&String, f64)> = covered.into_iter().map(|role| (role, by_itself_g(role))).collect();
        let all_g: f64 = each.iter().map(|(_, mass_g)| mass_g).sum();
        if extra.mass_g >= LEAST_STATED * all_g {
            return None;
        }
        let missing = Measure { rule: RULE.id, value: all_g - extra.mass_g, limit: 0.0, unit: "g", levers: BATTERY };
        let (heaviest, heaviest_g) = each.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let message = format!(
            "the extra `{name}` weighs {} g and covers parts that weigh {all_g:.1} g by themselves, {heaviest_g:.1} g of it the {}: {:.1} g are in no \
             mass. State its mass_g anew, or take what it does not weigh out of its `covers`",
            extra.mass_g,
            heaviest.replace('_', " "),
            missing.value
        );
        let mut finding = missing.note(format!("extra {name}"), message);
        finding.levers = vec![format!("extras.{name}.mass_g").into(), format!("extras.{name}.covers").into()];
        Some(finding)
    };
    design.frame.extras.iter().filter_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};

    #[test]
    fn planted_a_battery_that_is_bought_and_weighs_nothing_or_little() {
        let found = Planted::frame(|frame| frame.battery.battery_mass_g = 0.0).found(check);
        assert!(found.len() == 2 && found[1].warns() && found[1].message.contains("battery-3s-650 of the bill"), "{found:?}");
        let found = Planted::frame(|frame| frame.battery.battery_mass_g = 45.0).found(check);
        assert!(found.len() == 2 && found[1].message.contains("leaves 13.0 g of battery-3s-650"), "{found:?}");
        assert_eq!(Planted::frame(|frame| frame.battery.battery_mass_g = 54.0).found(check).len(), 1);
    }

    #[test]
    fn planted_an_extra_that_is_lighter_than_what_it_covers() {
        let extra = |mass_g: f64, covers: &[&str]| Extra {
            mass_g,
            mass_basis: crate::params::catalogue::MassBasis::Measured,
            source: "a scale".into(),
            position_mm: None,
            covers: covers.iter().map(ToString::to_string).collect(),
        };
        let with = |mass_g: f64| {
            Planted::frame(|frame| drop(frame.extras.insert("pack".into(), extra(mass_g, &["battery", "computer"])))).found(check)
        };
        let found = with(30.0);
        assert!(found.len() == 2 && found[1].warns() && found[1].subject == "extra pack", "{found:?}");
        assert!(found[1].message.contains("the extra `pack` weighs 30 g and covers parts that weigh"), "{found:?}");
        assert!(found[1].levers[0] == "extras.pack.mass_g" && with(70.0).len() == 1, "{found:?}");
        // What another extra weighs is in that one's mass.
        let two = [("none".into(), extra(0.0, &["battery"])), ("own".into(), extra(60.0, &["battery"]))];
        let both = Planted::frame(|frame| frame.extras.extend(two.clone())).found(check);
        assert_eq!(both.len(), 1, "{both:?}");
        let mut light = Planted::frame(|frame| drop(frame.extras.insert("pack".into(), extra(5.0, &["battery"]))));
        light.design.frame.battery.battery_mass_g = 0.0;
        let found = light.found(check);
        assert!(found.iter().any(|finding| finding.message.contains("weigh 58.0 g by themselves")), "{found:?}");
    }

    #[test]
    fn planted_a_heavy_battery() {
        assert_eq!(violated(&Planted::preset("cognifly").found(check)), []);
        let found = Planted::frame(|frame| frame.battery.battery_mass_g += 100.0).found(check);
        assert_eq!(violated(&found).len(), 1, "{found:?}");
    }
}
