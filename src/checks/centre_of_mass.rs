//! The centre of mass lies near the motors' centre in plan, so that no motor has to carry much more than its share.

use super::finding::Finding;
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use super::scene::Scene;
use crate::figures::decimals;
use crate::frame::skeleton::MODULE_NAMES;

const LEVERS: &[&str] = &["bought.battery", "camera.camera_reach_mm", "lid.lid_block_depth_mm"];

/// The rule.
pub static RULE: Rule = Rule {
    id: "centre_of_mass",
    title: "Centre of mass",
    requires: "the centre of mass is near the middle of the motors, in plan",
    units: &["mm"],
    limits: &[Limit::Key { subject: "", key: "limits.centre_of_mass_offset_mm" }],
    levers: Levers::Sets(&[LEVERS]),
    blame: Blame::Masses { summed: false },
    in_search: InSearch::Constraints { subjects: &[""], binds: true },
    found: Found::By(&[Pass::quick(check)]),
};

/// Where the centre of mass lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CentreOffset {
    /// From the motors' centre to the centre of mass, to the right and to the front, mm.
    pub offset_mm: [f64; 2],
    /// Largest distance, mm.
    pub limit_mm: f64,
}

impl CentreOffset {
    fn finding(&self) -> Finding {
        let [x, y] = self.offset_mm;
        let (value, limit) = (libm::hypot(x, y), self.limit_mm);
        let measure = Measure { rule: RULE.id, value, limit, unit: "mm", levers: LEVERS };
        let [far, allowed] = measure.figures(2);
        let [right, front] = [x, y].map(|offset| decimals(offset, 2));
        let message = format!(
            "the centre of mass lies {far} mm from the motors' centre in plan ({right} right, {front} front), {allowed} mm are allowed"
        );
        measure.at_most("centre of mass".into(), message)
    }
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let motors: Vec<_> = MODULE_NAMES.iter().filter_map(|module| scene.design.skeleton.node(&format!("M_{module}"))).collect();
    let [x, y, _] = scene.masses.centre_of_mass_mm;
    let count = motors.len().max(1) as f64;
    let middle = [motors.iter().map(|m| m.x).sum::<f64>() / count, motors.iter().map(|m| m.y).sum::<f64>() / count];
    let limit_mm = scene.design.frame.limits.centre_of_mass_offset_mm;
    vec![CentreOffset { offset_mm: [x - middle[0], y - middle[1]], limit_mm }.finding()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};

    #[test]
    fn planted_a_centre_of_mass_at_the_front() {
        let mut frame = Planted::preset("cognifly");
        assert_eq!(violated(&frame.found(check)), []);
        frame.masses.centre_of_mass_mm = [0.0, 8.0, 0.0];
        let found = frame.found(check);
        assert!(violated(&found).len() == 1 && (found[0].margin + 2.0).abs() < 1e-9, "{found:?}");
    }
}
