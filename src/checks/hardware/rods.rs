//! Rods of the frame are those of the bill of materials.

use std::f64::consts::FRAC_PI_4;

use super::comparison::{SAME_MM, measure, name, part};
use crate::checks::finding::Finding;
use crate::checks::scene::Scene;
use crate::params::Frame;

pub(super) const ROD: &[&str] = &["rods.rod_diameter_mm", "bought.rod"];
pub(super) const ROD_ALONE: &[&str] = &["bought.rod"];
pub(super) const STOCK: &[&str] = &["bought.rod", "rods.cage_rod_length_mm", "rods.arm_rod_length_mm"];

/// How far a rod's catalogued mass may be from that of its volume, %: densities of pultruded carbon spread by less.
const ROD_MASS_PERCENT: f64 = 15.0;

/// The rods of the frame are those of the bill of materials, and weigh what their volume does.
pub(super) fn rods(frame: &Frame) -> Vec<Finding> {
    let Some(rod) = part(frame, "rod") else { return Vec::new() };
    let mut found = Vec::new();
    let (called, diameter_mm) = (name(frame, "rod"), frame.rods.rod_diameter_mm);
    if let Some(bought_mm) = rod.diameter_mm {
        let message =
            format!("the frame's bores are made for rods of {diameter_mm} mm, {called} in the bill of materials has {bought_mm} mm");
        found.push(measure((diameter_mm - bought_mm).abs(), SAME_MM, "mm", ROD).at_most("rod: diameter".into(), message));
        let bore_mm = rod.wall_mm.map_or(0.0, |wall| (bought_mm - 2.0 * wall).max(0.0));
        let length_mm = rod.stock_mm();
        let volume_mm3 = FRAC_PI_4 * (bought_mm * bought_mm - bore_mm * bore_mm) * length_mm;
        let solid_g = frame.rod_material.material.solid_g(volume_mm3);
        let off = 100.0 * (rod.mass_g / solid_g - 1.0);
        let hint = if off < 0.0 && rod.wall_mm.is_none() { "; a tube states its wall_mm" } else { "" };
        let what = if bore_mm > 0.0 { "tube" } else { "rod" };
        let message = format!(
            "{called}: {:.2} g are stated for {length_mm:.0} mm, a {what} of {bought_mm} mm of {} weighs {solid_g:.2} g{hint}",
            rod.mass_g, frame.rod_material.name
        );
        found.push(measure(off.abs(), ROD_MASS_PERCENT, "%", ROD_ALONE).at_most("rod: mass".into(), message));
    }
    found
}

/// The longest rod can be cut from what is sold.
pub(super) fn stock(scene: &Scene) -> Option<Finding> {
    let skeleton = &scene.design.skeleton;
    let rod = part(&scene.design.frame, "rod")?;
    let stock_mm = rod.stock_mm();
    let longest = skeleton.roles().into_iter().max_by(|a, b| skeleton.sawn_mm(*a).total_cmp(&skeleton.sawn_mm(*b)))?;
    let cut = measure(skeleton.sawn_mm(longest), stock_mm, "mm", STOCK);
    let [length, sold] = cut.figures(1);
    let called = name(&scene.design.frame, "rod");
    Some(cut.at_most(
        "rod: stock".into(),
        format!("the longest rod, {}, has {length} mm, {called} is sold in lengths of {sold} mm", longest.slug()),
    ))
}

#[cfg(test)]
mod tests {
    use crate::checks::hardware::tests::{broken, own};
    use crate::params::catalogue::BoughtPart;

    #[test]
    fn planted_rods_that_are_not_those_of_the_bill() {
        assert_eq!(broken(|_| {}), Vec::<String>::new());
        assert_eq!(broken(|frame| frame.rods.rod_diameter_mm = 2.5), ["rod: diameter"]);
        assert_eq!(broken(|frame| own(frame, "rod", |rod| rod.mass_g = 5.0)), ["rod: mass"]);
        let shorter = |rod: &mut BoughtPart| (rod.stock_length_mm, rod.mass_g) = (Some(150.0), 0.15 * rod.mass_g);
        assert_eq!(broken(|frame| own(frame, "rod", shorter)), ["rod: stock"]);
        let tube = |rod: &mut BoughtPart| (rod.wall_mm, rod.mass_g) = (Some(0.5), 6.09);
        assert_eq!(broken(|frame| own(frame, "rod", tube)), Vec::<String>::new());
    }
}
