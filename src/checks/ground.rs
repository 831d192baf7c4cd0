//! What hangs under the hub stays clear of the ground when the frame stands on its lower corners: the legs give on
//! landing, and the battery must not take the blow.
//!
//! An extra has a place and no size. It is warned of where that place itself is below the ground.

use super::finding::Finding;
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use super::scene::Scene;
use crate::params::frame::Extra;

pub(super) const LEVERS: &[&str] = &["bracket.bay_height_mm", "battery.battery_height_mm", "rods.strut_rod_length_mm"];

/// The record of a rule: what hangs lowest stays clear of the ground.
pub static RULE: Rule = Rule {
    id: "ground_clearance",
    title: "Ground clearance",
    requires: "the lowest body under the hub is clear of the ground",
    units: &["mm"],
    limits: &[Limit::Key { subject: "", key: "limits.ground_clearance_mm" }],
    levers: Levers::Sets(&[LEVERS]),
    blame: Blame::Levers,
    in_search: InSearch::Constraints { subjects: &[""], binds: true },
    found: Found::By(&[Pass::quick(check)]),
};

/// Room under the centre.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundClearance {
    /// What hangs lowest.
    pub lowest: String,
    /// From the lowest point of the corners up to it, mm.
    pub clearance_mm: f64,
    /// Least, mm.
    pub limit_mm: f64,
}

impl GroundClearance {
    fn finding(&self) -> Finding {
        let Self { lowest, clearance_mm: value, limit_mm: limit } = self;
        let measure = Measure { rule: RULE.id, value: *value, limit: *limit, unit: "mm", levers: LEVERS };
        let [height, least] = measure.figures(2);
        measure.at_least(lowest.clone(), format!("{lowest} hangs {height} mm above the ground, {least} mm are needed"))
    }
}

/// Measures the room; `None` without corners or a centre.
pub(super) fn measure(scene: &Scene) -> Option<GroundClearance> {
    let centre = scene.placed.iter().filter(|p| p.body.module.is_none());
    let lowest = centre.min_by(|a, b| a.bounds.low[2].total_cmp(&b.bounds.low[2]));
    let lowest = lowest?;
    let clearance_mm = lowest.bounds.low[2] - scene.design.ground_mm()?;
    let limit_mm = scene.design.frame.limits.ground_clearance_mm;
    Some(GroundClearance { lowest: lowest.body.name.clone(), clearance_mm, limit_mm })
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let mut found: Vec<Finding> = measure(scene).iter().map(GroundClearance::finding).collect();
    found.extend(buried(scene));
    found
}

/// A warning of each extra whose mass is placed below the ground.
fn buried(scene: &Scene) -> Vec<Finding> {
    let Some(ground_mm) = scene.design.ground_mm() else { return Vec::new() };
    let of = |(name, extra): (&String, &Extra)| {
        let below_mm = ground_mm - extra.position_mm?[2];
        let measure = Measure { rule: RULE.id, value: below_mm, limit: 0.0, unit: "mm", levers: &[] };
        let message = format!(
            "the extra `{name}` is placed {below_mm:.1} mm below the ground: state another extras.{name}.position_mm, or the frame stands on it"
        );
        let warning = measure.note(format!("extra {name} below the ground"), message);
        Some(warning).filter(|warning| extra.mass_g > 0.0 && warning.warns())
    };
    scene.design.frame.extras.iter().filter_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};
    use crate::params::{Frame, FrameFile};

    #[test]
    fn measured_the_real_frame_keeps_10_9_mm() {
        let found = Planted::preset("cognifly-v8").found(check);
        assert!((found[0].value - 10.9).abs() < 0.05 && found[0].margin > 0.0, "{found:?}");
    }

    /// The feet are 57 mm below the arms.
    #[test]
    fn planted_an_extra_below_the_ground() {
        let warned = |height_mm: f64, mass_g: f64| {
            let text = format!(
                "base = \"cognifly\"\n[extras.payload]\nmass_g = {mass_g}\nmass_basis = \"measured\"\nsource = \"a scale\"\nposition_mm = [0, 0, {height_mm}]\n"
            );
            let file = FrameFile::parse("own.toml", &text).expect("reads");
            let found = Planted::designed(Frame::resolve(&file).expect("resolves")).found(check);
            found.into_iter().filter(Finding::warns).collect::<Vec<_>>()
        };
        let [payload] = &warned(-80.0, 12.0)[..] else { panic!("not one warning") };
        assert!(payload.message.contains("`payload`") && (20.0..26.0).contains(&payload.value), "{payload:?}");
        assert_eq!((warned(-50.0, 12.0), warned(-80.0, 0.0)), (Vec::new(), Vec::new()));
    }

    #[test]
    fn planted_a_higher_bay() {
        let found = Planted::frame(|frame| frame.bracket.bay_height_mm += 8.0).found(check);
        assert_eq!(violated(&found).len(), 1, "{found:?}");
    }
}
