//! The centre of mass lies near the motors' centre in plan, so that no motor has to carry much more than its share.

use super::finding::{Finding, Verdict};
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use super::scene::Scene;
use crate::figures::decimals;
use crate::frame::skeleton::MODULE_NAMES;
use crate::params::frame::Extra;

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

/// Share of the offset from which on an extra is its cause: chosen.
const CAUSE: f64 = 0.5;

/// The extra that draws the centre of mass most towards where it lies, and by how much, mm; none that draws it by less than half of the way.
fn cause(scene: &Scene, middle: [f64; 2], offset_mm: [f64; 2]) -> Option<(String, f64)> {
    let far_mm = libm::hypot(offset_mm[0], offset_mm[1]);
    let drawn_mm = |extra: &Extra| {
        let position_mm = extra.position_mm?;
        let along = [0, 1].map(|axis| (position_mm[axis] - middle[axis]) * offset_mm[axis] / far_mm);
        Some(extra.mass_g * (along[0] + along[1]) / scene.masses.total_g)
    };
    let drawn = scene.design.frame.extras.iter().filter_map(|(name, extra)| Some((name.clone(), drawn_mm(extra)?)));
    drawn.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, mm)| *mm >= CAUSE * far_mm)
}

/// A finding that names an extra as its cause, its place before the other levers.
fn blamed(mut finding: Finding, (name, drawn_mm): (String, f64)) -> Finding {
    let key = format!("extras.{name}.position_mm");
    finding.message += &format!("; the extra `{name}` draws it there by {} mm: move it (`{key}`)", decimals(drawn_mm, 2));
    finding.levers.insert(0, key.into());
    finding.levers.truncate(LEVERS.len());
    finding
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let motors: Vec<_> = MODULE_NAMES.iter().filter_map(|module| scene.design.skeleton.node(&format!("M_{module}"))).collect();
    let [x, y, _] = scene.masses.centre_of_mass_mm;
    let count = motors.len().max(1) as f64;
    let middle = [motors.iter().map(|m| m.x).sum::<f64>() / count, motors.iter().map(|m| m.y).sum::<f64>() / count];
    let limit_mm = scene.design.frame.limits.centre_of_mass_offset_mm;
    let offset_mm = [x - middle[0], y - middle[1]];
    let finding = CentreOffset { offset_mm, limit_mm }.finding();
    let cause = cause(scene, middle, offset_mm).filter(|_| finding.verdict == Verdict::Violated);
    vec![match cause {
        Some(cause) => blamed(finding, cause),
        None => finding,
    }]
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
        assert_eq!(found[0].levers, LEVERS, "no extra is at the front");
    }

    /// 60 g, 50 mm in front, in a frame of some 300 g.
    #[test]
    fn planted_a_heavy_extra_is_named_as_the_cause() {
        let placed = |position_mm: [f64; 3]| {
            let frame = Planted::frame(|frame| {
                let wiring = frame.extras.get_mut("wiring").expect("has one");
                (wiring.mass_g, wiring.position_mm) = (60.0, Some(position_mm));
            });
            frame.found(check).remove(0)
        };
        let front = placed([0.0, 50.0, 0.0]);
        assert!(front.levers[0] == "extras.wiring.position_mm" && front.message.contains("the extra `wiring` draws it"), "{front:?}");
        assert_eq!(placed([0.0, 0.0, 0.0]).levers, LEVERS);
    }
}
