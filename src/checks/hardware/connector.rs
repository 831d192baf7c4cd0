//! The halves of the power connector reach each other: one is glued into the bracket, the other one into the lid's block.

use super::comparison::{measure, name, part};
use crate::checks::finding::Finding;
use crate::checks::scene::Scene;
use crate::frame::assembly::centre_body::connector_halves_mm;

pub(super) const HALVES: &[&str] = &["lid.lid_block_depth_mm", "lid.lid_reach_mm", "bought.connector"];

/// Least part of a mated pair that one half is: chosen. The halves of the default frame's pair are 0.43 and 0.57 of it.
const LEAST_HALF: f64 = 0.3;

/// The shorter half of the pair.
pub(super) fn halves(scene: &Scene) -> Option<Finding> {
    let (frame, centre) = (&scene.design.frame, &scene.design.centre);
    let pair_mm = part(frame, "connector")?.size_mm[0];
    let [bracket_mm, lid_mm] = connector_halves_mm(pair_mm, frame, centre);
    let (at, long_mm) = if bracket_mm < lid_mm { ("bracket", bracket_mm) } else { ("lid", lid_mm) };
    let half = measure(long_mm, LEAST_HALF * pair_mm, "mm", HALVES);
    let [long, needed] = half.figures(1);
    let message = format!(
        "the lid's half of the connector has to be {lid_mm:.1} mm long to reach from behind the lid's block to the bracket; of {}, {pair_mm:.1} mm, \
         that leaves {long} mm for the half in the {at}, {needed} mm are needed",
        name(frame, "connector")
    );
    Some(half.at_least("connector: the shorter half".into(), message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::finding::Verdict;
    use crate::checks::planted::Planted;

    #[test]
    fn planted_halves_that_no_pair_has() {
        let verdict = |depth_mm: Option<f64>| {
            let planted = Planted::frame(|frame| frame.lid.lid_block_depth_mm = depth_mm.unwrap_or(frame.lid.lid_block_depth_mm));
            let found = planted.found(|scene| halves(scene).into_iter().collect());
            (found[0].verdict, found[0].message.clone())
        };
        assert_eq!(verdict(None).0, Verdict::Holds);
        let (deep, message) = verdict(Some(15.0));
        assert!(deep == Verdict::Violated && message.contains("leaves 2.8 mm for the half in the bracket, 7.2 mm are needed"), "{message}");
    }
}
