//! No layer has a piece that begins in the air.

use crate::checks::finding::Finding;
use crate::checks::measure::Measure;
use crate::checks::printing::hung::{Hung, PROCESS};
use crate::checks::rule::{Blame, Found, InSearch, Levers, Rule};
use crate::printing::printability::Fault;

pub static RULE: Rule = Rule {
    id: "island",
    title: "Islands",
    requires: "no layer has a region that begins in the air",
    units: &["mm2"],
    limits: &[],
    levers: Levers::Sets(PROCESS),
    blame: Blame::Levers,
    in_search: InSearch::AtTheEnd("all layers of all parts are looked at"),
    found: Found::WithAnother,
};

pub(in crate::checks) fn finding(hung: &Hung) -> Finding {
    let area_mm2 = hung.area_mm2(Fault::Island);
    let measure = Measure { rule: RULE.id, value: area_mm2, limit: 0.0, unit: "mm2", levers: hung.levers() };
    let what = match hung.worst(Fault::Island, |place| place.area_mm2) {
        None => "every layer rests on the one below".into(),
        Some(worst) => {
            format!("{} begin in the air ({})", hung.area_of(Fault::Island, 1), hung.worst_place(Fault::Island, worst, "largest"))
        }
    };
    hung.judged(measure, &what)
}

#[cfg(test)]
mod tests {
    use crate::checks::planted::{Planted, violated};
    use crate::checks::printing::overhang::check;

    /// A layer of this knee has slivers a hundredth of a square millimetre large that are apart from the layer below by a twentieth of a millimetre,
    /// on a body that stands on it.
    #[test]
    fn regress_a_sliver_of_a_body_that_stands_is_no_island() {
        for strut_mm in [67.9, 68.0, 68.01] {
            let found = Planted::frame(|frame| {
                (frame.rods.cage_rod_length_mm, frame.rods.arm_rod_length_mm, frame.rods.strut_rod_length_mm) = (285.0, 140.0, strut_mm);
                (frame.hub_joint.arm_pitch_mm, frame.hub.hub_mouth_mm, frame.motor_mount.motor_position_mm) = (31.0, 30.0, 116.5);
            });
            let knee: Vec<_> =
                violated(&found.found(check)).into_iter().filter(|f| f.rule == "island" && f.subject.contains("knee")).collect();
            assert_eq!(knee, [], "{strut_mm} mm");
        }
    }
}
