//! Accessories that stand out of the cage.

use super::comparison::{measure, name};
use crate::checks::finding::Finding;
use crate::checks::scene::{Scene, bounds_of};
use crate::params::PartName;

pub(super) const MAST: &[&str] = &["accessories.mast_height_mm"];
pub(super) const FPV_CAMERA: &[&str] = &["accessories.fpv_above_mm"];

/// What stands high on the accessory plate, and the key of its height.
const STANDING: [(&str, &[&str]); 2] = [("gps", MAST), ("fpv_camera", FPV_CAMERA)];

/// A warning of each accessory that stands above the corners of the top ring, on which the frame lies when it lands upside down.
pub(super) fn accessories(scene: &Scene) -> Vec<Finding> {
    let ring = bounds_of(scene.placed.iter().filter(|placed| placed.is_part(PartName::TopCorner)));
    let Some(ring_mm) = ring.map(|bounds| bounds.high[2]) else { return Vec::new() };
    let of = |(role, levers): (&str, &'static [&'static str])| {
        let above_mm = scene.bought(role)?.bounds.high[2] - ring_mm;
        let called = name(&scene.design.frame, role);
        let message = format!("{called} stands {above_mm:.1} mm above the top ring: a landing upside down is on it");
        Some(measure(above_mm, 0.0, "mm", levers).note(format!("{role} in the cage"), message)).filter(Finding::warns)
    };
    STANDING.into_iter().filter_map(of).collect()
}

#[cfg(test)]
mod tests {
    use crate::checks::hardware::check;
    use crate::checks::planted::Planted;
    use crate::params::{Frame, FrameFile};

    /// The GPS is 6 mm high; the ring stands between masts of 10 and of 100 mm.
    #[test]
    fn planted_a_mast_that_stands_out_of_the_cage() {
        let warned = |mast_mm: f64| {
            let text = format!(
                "base = \"cognifly\"\n[bought]\ncomputer = \"none\"\ncamera = \"none\"\ngps = \"gps-22x20\"\n[accessories]\nmast_height_mm = {mast_mm}\n"
            );
            let file = FrameFile::parse("own.toml", &text).expect("reads");
            let found = Planted::designed(Frame::resolve(&file).expect("resolves")).found(check);
            found.into_iter().filter(|finding| finding.warns()).collect::<Vec<_>>()
        };
        assert_eq!(warned(10.0), []);
        let [gps] = &warned(100.0)[..] else { panic!("not one warning") };
        assert_eq!(gps.subject, "gps in the cage");
        let [lower] = &warned(90.0)[..] else { panic!("not one warning") };
        assert!((gps.value - lower.value - 10.0).abs() < 1e-6, "{gps:?} {lower:?}");
    }
}
