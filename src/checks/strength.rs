//! The design drop: the acceleration of the payload, how far the flexible parts stretch, how near the rods come to buckling, and how
//! fast what hangs lowest hits the ground.
//!
//! The numbers are those of the frame's own mechanics, `docs/mechanics.md`; limits and drop height stand in
//! `params/mechanics.toml`. Strain is that of the drop alone, on top of what folding leaves.

use super::finding::Finding;
use super::ground::{self, GroundClearance};
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Limit, Rule};
use super::scene::Scene;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::mechanics::result::prediction::{Prediction, PredictionError, predict};
use crate::mechanics::settings::{DropLimits, MechanicsSettings};

/// The rod first: on frames of all sizes in the catalogue it moved the peak most. A flexible material changes it only where its modulus is stated.
const PAYLOAD: &[&str] = &["bought.rod", "rods.strut_rod_length_mm"];
const STRETCH: &[&str] = &["corner.corner_wall_mm", "hub_joint.arch_width_mm", "materials.flexible"];
const MODULUS: &[&str] = &["materials.flexible"];
const BUCKLING: &[&str] = &["rods.rod_diameter_mm", "rods.cage_rod_length_mm", "bought.rod"];

pub static RULE: Rule = Rule {
    id: "design_drop",
    title: "Design drop",
    requires: "acceleration, travel, strain and rod compression in the design drop are within their limits",
    units: &["g", "mm", "%", "N", "m/s", ""],
    limits: &[Limit::Mechanics],
    levers: Levers::Sets(&[PAYLOAD, STRETCH, BUCKLING, MODULUS, ground::LEVERS]),
    blame: Blame::Levers,
    in_search: InSearch::AsGoal("the mechanics take a second or two a frame: a goal of a `design_drop` measure asks for them"),
    found: Found::FromPrediction,
};

/// Holds a prediction against the limits of the design drop. A body that hits the ground is noted: its impact is in no figure, and no
/// limit of it is known.
pub fn strength(design: &Design, masses: &MassTable, limits: &DropLimits, found: &Prediction) -> Vec<Finding> {
    let drop_m = found.drop_m;
    let peak = Measure { rule: RULE.id, value: found.payload_peak_g, limit: limits.payload_peak_g, unit: "g", levers: PAYLOAD };
    let [value, limit] = peak.figures(1);
    let message = format!("dropped from {drop_m} m the payload's peak is {value} g, {limit} g are allowed");
    let mut findings = vec![peak.at_most("payload".into(), message)];
    findings.push(travel(design, found));
    let (zone, strain) = found.strain;
    let breaks = design.frame.flexible.material.elongation_at_break_percent.unwrap_or(0.0);
    let stretch = Measure { rule: RULE.id, value: 100.0 * strain, limit: breaks / limits.strain_factor, unit: "%", levers: STRETCH };
    let [value, limit] = stretch.figures(0);
    let message = format!("dropped from {drop_m} m the {zone} stretch by {value} %, {limit} % are allowed");
    findings.push(stretch.at_most(zone.into(), message));
    if let Some(rod) = &found.rod {
        let buckling = Measure {
            rule: RULE.id,
            value: rod.compression_n,
            limit: rod.buckling_n / limits.buckling_factor,
            unit: "N",
            levers: BUCKLING,
        };
        let [value, limit] = buckling.figures(0);
        let message = format!("dropped from {drop_m} m {} is compressed by {value} N, {limit} N are allowed against buckling", rod.rod);
        findings.push(buckling.at_most(rod.rod.clone(), message));
    }
    findings.extend(strike(design, masses, found));
    findings.extend(found.doubt.clone().map(|doubt| doubted(design, doubt)));
    findings
}

/// The design drop of a frame by its own mechanics. One that ends in no figures, as the frame gives way, keeps no limit.
///
/// # Errors
/// When the frame has no model.
pub fn design_drop(design: &Design, masses: &MassTable, settings: &MechanicsSettings) -> Result<Vec<Finding>, PredictionError> {
    match predict(design, masses, settings) {
        Ok(found) => Ok(strength(design, masses, &settings.limits, &found)),
        Err(error) if error.gives_way() => {
            let doubt = settings.doubt(&design.frame.flexible);
            Ok([gives_way(&error.to_string())].into_iter().chain(doubt.map(|doubt| doubted(design, doubt))).collect())
        }
        Err(error) => Err(error),
    }
}

/// What has to be said of the flexible material.
fn doubted(design: &Design, doubt: String) -> Finding {
    let unknown = Measure { rule: RULE.id, value: 1.0, limit: 0.0, unit: "", levers: MODULUS };
    unknown.note(format!("modulus of {}", design.frame.flexible.name), doubt)
}

/// A design drop that cannot be followed.
fn gives_way(why: &str) -> Finding {
    let lost = Measure { rule: RULE.id, value: 1.0, limit: 0.0, unit: "", levers: PAYLOAD };
    lost.at_most("frame".into(), format!("the design drop cannot be followed: {why}"))
}

/// How far the centre comes down. In the model arms do not meet the lower ring: a frame that comes down farther has a low peak there, which says nothing.
fn travel(design: &Design, found: &Prediction) -> Finding {
    let room_mm = design.skeleton.closure.ring_half_height_mm;
    let travel = Measure { rule: RULE.id, value: found.travel_mm, limit: room_mm, unit: "mm", levers: PAYLOAD };
    let [value, limit] = travel.figures(0);
    let message = format!(
        "dropped from {} m the centre comes down by {value} mm, there are {limit} mm until the arms are at the lower ring",
        found.drop_m
    );
    travel.at_most("travel".into(), message)
}

/// The lowest body where it hits the ground.
fn strike(design: &Design, masses: &MassTable, found: &Prediction) -> Option<Finding> {
    let GroundClearance { lowest, clearance_mm, .. } = ground::measure(&Scene::new(design, masses))?;
    let value = found.speed_m_s(clearance_mm)?;
    let speed = Measure { rule: RULE.id, value, limit: 0.0, unit: "m/s", levers: ground::LEVERS };
    let [told, _] = speed.figures(1);
    let message = format!(
        "dropped from {} m {lowest}, {clearance_mm:.1} mm above the ground, hits it at {told} m/s; no peak includes that impact",
        found.drop_m
    );
    Some(speed.note(format!("{lowest} on the ground"), message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::Verdict;
    use crate::frame::assembly::mass;
    use crate::frame::skeleton::RodRole;
    use crate::mechanics::result::strength::RodForce;
    use crate::params::Frame;

    #[test]
    fn planted_a_hard_a_stretched_and_a_slender_frame() {
        let design = Design::new(Frame::load("cognifly-v8").expect("is valid").0).expect("closes");
        let masses = mass::table(&design);
        let limits = MechanicsSettings::load(None).expect("is sound").limits;
        let rod = RodForce { rod: "arm".into(), role: RodRole::Arm, compression_n: 10.0, buckling_n: 400.0 };
        let good = Prediction {
            initial_n_mm: 10.0,
            secant_8_mm_n_mm: 8.0,
            drop_m: 1.0,
            payload_peak_g: 100.0,
            travel_mm: 9.0,
            descent: vec![[0.0, 4.4], [5.0, 4.0], [9.0, 0.0]],
            strain: ("bottom corner leg web", 0.3),
            rod: Some(rod.clone()),
            stiffness_band: [0.5, 2.0],
            young_mpa: 65.0,
            doubt: None,
        };
        let violated =
            |found: &Prediction| strength(&design, &masses, &limits, found).iter().filter(|f| f.verdict == Verdict::Violated).count();
        assert_eq!(violated(&good), 0);
        // The battery hangs 10.9 mm above the ground.
        let notes =
            |found: &Prediction| strength(&design, &masses, &limits, found).into_iter().filter(|f| f.unit == "m/s").collect::<Vec<_>>();
        assert!(notes(&good).is_empty());
        let deep = Prediction { descent: vec![[0.0, 4.4], [10.8, 3.5], [11.0, 3.0], [15.0, 0.0]], travel_mm: 15.0, ..good.clone() };
        assert!(notes(&deep)[0].message.contains("battery_sleeve, 10.9 mm above the ground, hits it at 3.2 m/s"), "{:?}", notes(&deep));
        let unknown = Prediction { doubt: Some("states no modulus".into()), ..good.clone() };
        let found = strength(&design, &masses, &limits, &unknown);
        assert!(found.iter().any(|f| f.verdict == Verdict::Note && f.message == "states no modulus" && f.warns()), "{found:?}");
        assert_eq!(gives_way("it collapses").verdict, Verdict::Violated);
        // A body that stands on the ground hits it as fast as the frame comes down.
        assert_eq!(
            [deep.speed_m_s(0.0), deep.speed_m_s(-1.0), deep.speed_m_s(15.0), deep.speed_m_s(15.1)],
            [Some(4.4), Some(4.4), Some(0.0), None]
        );
        assert_eq!(violated(&Prediction { payload_peak_g: 151.0, ..good.clone() }), 1);
        assert_eq!(violated(&Prediction { travel_mm: 58.0, ..good.clone() }), 1);
        assert_eq!(violated(&Prediction { strain: ("bottom corner leg web", 1.5), ..good.clone() }), 1);
        assert_eq!(violated(&Prediction { rod: Some(RodForce { compression_n: 210.0, ..rod }), ..good }), 1);
    }
}
