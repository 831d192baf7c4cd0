//! Propellers, motors and accessories that stand out of the cage.

use super::comparison::{measure, name, part};
use crate::checks::finding::{Finding, Verdict};
use crate::checks::scene::{Placed, Scene, bounds_of};
use crate::frame::assembly::BodyKind;
use crate::params::{Frame, PartName};

pub(super) const MAST: &[&str] = &["accessories.mast_height_mm"];
pub(super) const SLENDER: &[&str] = &["accessories.mast_diameter_mm", "accessories.mast_height_mm"];
pub(super) const FPV_CAMERA: &[&str] = &["accessories.fpv_above_mm"];

pub(super) const RISER: &[&str] = &["motor_mount.motor_riser_mm", "rods.strut_rod_length_mm"];

/// Most height of a mast over its diameter: chosen; the default one has 6.7. A column that is printed upright shakes under the nozzle, and bends at its
/// foot when the frame lands.
const MOST_SLENDER: f64 = 10.0;

/// What stands high on the accessory plate, and the key of its height.
const STANDING: [(&str, &[&str]); 2] = [("gps", MAST), ("fpv_camera", FPV_CAMERA)];

/// A warning of each accessory that stands above the corners of the top ring, on which the frame lies when it lands upside down.
pub(super) fn accessories(scene: &Scene) -> Vec<Finding> {
    let Some(ring_mm) = ring_mm(scene) else { return Vec::new() };
    let of = |(role, levers): (&str, &'static [&'static str])| {
        let above_mm = scene.bought(role)?.bounds.high[2] - ring_mm;
        let called = name(&scene.design.frame, role);
        let above = measure(above_mm, 0.0, "mm", levers);
        let [stands, _] = above.figures(1);
        let message = format!("{called} stands {stands} mm above the top ring: a landing upside down is on it");
        Some(above.note(format!("{role} in the cage"), message)).filter(Finding::warns)
    };
    STANDING.into_iter().filter_map(of).collect()
}

/// A warning of a mast that is slender.
pub(super) fn mast(frame: &Frame) -> Option<Finding> {
    part(frame, "gps")?;
    let (height_mm, diameter_mm) = (frame.accessories.mast_height_mm, frame.accessories.mast_diameter_mm);
    let slender = measure(height_mm, MOST_SLENDER * diameter_mm, "mm", SLENDER);
    let [high, most] = slender.figures(1);
    let message = format!(
        "the mast is {high} mm high and {diameter_mm} mm thick, {most} mm are {MOST_SLENDER} times its diameter: a slender column shakes under the \
         nozzle and bends when the frame lands"
    );
    Some(slender.note("mast of the gps: slender".into(), message)).filter(Finding::warns)
}

/// Propellers, or motors, above these corners: upside down the frame would stand on what breaks first.
pub(super) fn propellers(scene: &Scene) -> Option<Finding> {
    let turns = |placed: &&Placed| matches!(placed.shape.kind, BodyKind::Motor | BodyKind::Propeller);
    let highest_mm = bounds_of(scene.placed.iter().filter(turns))?.high[2];
    let above = measure(highest_mm - ring_mm(scene)?, 0.0, "mm", RISER);
    let [above_mm, _] = above.figures(1);
    let message = format!("propellers or motors stand {above_mm} mm above the top ring: a landing upside down is on them");
    Some(above.at_most("propellers in the cage: height".into(), message)).filter(|finding| finding.verdict == Verdict::Violated)
}

/// Height of the highest corners of the top ring, mm.
fn ring_mm(scene: &Scene) -> Option<f64> {
    bounds_of(scene.placed.iter().filter(|placed| placed.is_part(PartName::TopCorner))).map(|bounds| bounds.high[2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::hardware::check;
    use crate::checks::planted::Planted;
    use crate::params::FrameFile;

    /// The GPS is 6 mm high; the ring stands between masts of 10 and of 100 mm.
    #[test]
    fn planted_a_mast_that_stands_out_of_the_cage() {
        let warned = |mast_mm: f64| {
            let text = format!(
                "base = \"cognifly\"\n[bought]\ncomputer = \"none\"\ncamera = \"none\"\ngps = \"gps-22x20\"\n[accessories]\nmast_height_mm = {mast_mm}\n"
            );
            let file = FrameFile::parse("own.toml", &text).expect("reads");
            let found = Planted::designed(Frame::resolve(&file).expect("resolves")).found(check);
            found.into_iter().filter(|finding| finding.warns() && finding.subject == "gps in the cage").collect::<Vec<_>>()
        };
        assert_eq!(warned(10.0), []);
        let [gps] = &warned(100.0)[..] else { panic!("not one warning") };
        let [lower] = &warned(90.0)[..] else { panic!("not one warning") };
        assert!((gps.value - lower.value - 10.0).abs() < 1e-6, "{gps:?} {lower:?}");
    }

    /// The default mast is 6 mm thick.
    #[test]
    fn planted_a_slender_mast_is_warned_of() {
        let (mut frame, _) = Frame::load("cognifly").expect("a preset");
        let mut slender = |height_mm: f64, diameter_mm: f64| {
            (frame.accessories.mast_height_mm, frame.accessories.mast_diameter_mm) = (height_mm, diameter_mm);
            let without = mast(&frame);
            assert_eq!(without, None, "there is no gps");
            let gps = frame.bought.values().next().cloned().expect("something is bought");
            frame.bought.insert("gps".into(), gps);
            let found = mast(&frame).is_some();
            frame.bought.remove("gps");
            found
        };
        assert_eq!([(60.0, 6.0), (60.1, 6.0), (100.0, 12.0), (100.0, 4.0)].map(|(h, d)| slender(h, d)), [false, true, false, true]);
    }

    /// A riser lifts motor and propeller by as much as it is high.
    #[test]
    fn planted_propellers_above_the_top_ring() {
        let of = |raised_mm: f64| {
            let mut frame = Planted::preset("cognifly");
            let raised: Vec<usize> = (0..frame.design.bodies.len())
                .filter(|at| frame.design.shape(&frame.design.bodies[*at]).kind == BodyKind::Propeller)
                .collect();
            for at in raised {
                frame.design.bodies[at].pose.translation.z += raised_mm;
            }
            propellers(&Scene::new(&frame.design, &frame.masses))
        };
        assert_eq!(of(0.0), None);
        let [high, higher] = [60.0, 70.0].map(|raised_mm| of(raised_mm).expect("stand out"));
        assert!((higher.value - high.value - 10.0).abs() < 1e-6 && high.levers == RISER, "{high:?}");
    }
}
