//! The design drop: what the payload feels, how far the flexible parts stretch, how near the rods come to buckling.
//!
//! The numbers are those of the frame's own mechanics, `docs/mechanics.md`; limits and drop height stand in
//! `params/mechanics.toml`. Strain is that of the drop alone, on top of what folding leaves.

use super::finding::{Finding, Measure};
use crate::frame::assembly::Design;
use crate::mechanics::result::prediction::Prediction;
use crate::mechanics::settings::DropLimits;

/// Holds a prediction against the limits of the design drop.
pub fn strength(design: &Design, limits: &DropLimits, found: &Prediction) -> Vec<Finding> {
    let drop_m = found.drop_m;
    let peak = Measure {
        rule: "design_drop",
        value: found.payload_peak_g,
        limit: limits.payload_peak_g,
        unit: "g",
        levers: &["rods.strut_rod_length_mm", "corner.corner_hinge_thickness_mm", "materials.flexible"],
    };
    let [value, limit] = peak.figures(1);
    let message = format!("dropped from {drop_m} m the payload feels {value} g, {limit} g are allowed");
    let mut findings = vec![peak.at_most("payload".into(), message)];
    let (zone, strain) = found.strain;
    let breaks = design.frame.flexible.material.elongation_at_break_percent.unwrap_or(0.0);
    let stretch = Measure {
        rule: "design_drop",
        value: 100.0 * strain,
        limit: breaks / limits.strain_factor,
        unit: "%",
        levers: &["corner.corner_wall_mm", "hub_joint.arch_width_mm", "materials.flexible"],
    };
    let [value, limit] = stretch.figures(0);
    let message = format!("dropped from {drop_m} m the {zone} stretch by {value} %, {limit} % are allowed");
    findings.push(stretch.at_most(zone.into(), message));
    if let Some(rod) = &found.rod {
        let buckling = Measure {
            rule: "design_drop",
            value: rod.compression_n,
            limit: rod.buckling_n / limits.buckling_factor,
            unit: "N",
            levers: &["rods.rod_diameter_mm", "rods.cage_rod_length_mm", "bought.rod"],
        };
        let [value, limit] = buckling.figures(0);
        let message = format!("dropped from {drop_m} m {} is pressed by {value} N, {limit} N are allowed against buckling", rod.rod);
        findings.push(buckling.at_most(rod.rod.clone(), message));
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::Verdict;
    use crate::frame::skeleton::RodRole;
    use crate::mechanics::result::strength::RodForce;
    use crate::mechanics::settings::Settings;
    use crate::params::Frame;

    #[test]
    fn planted_a_hard_a_stretched_and_a_slender_frame() {
        let design = Design::new(Frame::load("cognifly-v8").expect("is valid").0).expect("closes");
        let limits = Settings::load(None).expect("is sound").limits;
        let rod = RodForce { rod: "arm".into(), role: RodRole::Arm, compression_n: 10.0, buckling_n: 400.0 };
        let good = Prediction {
            initial_n_mm: 10.0,
            secant_8_mm_n_mm: 8.0,
            drop_m: 1.0,
            payload_peak_g: 100.0,
            travel_mm: 20.0,
            strain: ("bottom corner leg web", 0.3),
            rod: Some(rod.clone()),
            stiffness_band: [0.5, 2.0],
        };
        let violated = |found: &Prediction| strength(&design, &limits, found).iter().filter(|f| f.verdict == Verdict::Violated).count();
        assert_eq!(violated(&good), 0);
        assert_eq!(violated(&Prediction { payload_peak_g: 151.0, ..good.clone() }), 1);
        assert_eq!(violated(&Prediction { strain: ("bottom corner leg web", 1.5), ..good.clone() }), 1);
        assert_eq!(violated(&Prediction { rod: Some(RodForce { compression_n: 210.0, ..rod }), ..good }), 1);
    }
}
