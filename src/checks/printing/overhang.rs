//! Nothing that leans more than its material prints over air reaches out far with a free edge.
//!
//! The pass over all parts gives the findings of islands, bridges and the footing, too: they look at the same places.

use rayon::prelude::*;

use crate::checks::finding::Finding;
use crate::checks::measure::Measure;
use crate::checks::printing::hung::{Hung, PROCESS, place};
use crate::checks::printing::{bridge, footing, island};
use crate::checks::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use crate::checks::scene::Scene;
use crate::figures::decimals;
use crate::frame::assembly::{Design, Printed};
use crate::printing::printability::{Fault, Hanging};

pub static RULE: Rule = Rule {
    id: "overhang",
    title: "Overhangs",
    requires: "no region overhangs farther than the material allows",
    units: &["mm"],
    limits: &[Limit::Material],
    levers: Levers::Sets(PROCESS),
    blame: Blame::Levers,
    in_search: InSearch::AtTheEnd("all layers of all parts are looked at"),
    found: Found::By(&[Pass::slow(check)]),
};

fn finding(hung: &Hung) -> Finding {
    let overhang_mm = |place: &Hanging| place.overhang_mm(&hung.process);
    let worst = hung.worst(Fault::Overhang, overhang_mm);
    let reach_mm = worst.map_or(0.0, overhang_mm);
    let limit = hung.process.ledge_mm;
    let measure = Measure { rule: RULE.id, value: reach_mm, limit, unit: "mm", levers: hung.levers() };
    let [reach, allowed] = measure.figures(1);
    let angle = decimals(hung.process.overhang.to_deg(), 0);
    let what = match worst {
        None => format!("nothing unsupported is inclined by more than {angle} deg"),
        Some(worst) if reach_mm > limit => format!(
            "inclined by more than {angle} deg, {} overhang by {reach} mm without support, {allowed} mm are allowed ({})",
            hung.area_of(Fault::Overhang, 0),
            hung.worst_place(Fault::Overhang, worst, "farthest")
        ),
        Some(worst) => {
            format!("regions inclined by more than {angle} deg overhang by {reach} mm, {allowed} mm are allowed ({})", place(worst))
        }
    };
    hung.judged(measure, &what)
}

fn of_part(design: &Design, part: &Printed) -> Vec<Finding> {
    let hung = Hung::in_design(design, part);
    let over_air = [finding(&hung), island::finding(&hung), bridge::finding(&hung)];
    over_air.into_iter().chain(footing::findings(&hung, design, part)).collect()
}

pub(in crate::checks) fn check(scene: &Scene) -> Vec<Finding> {
    let design = scene.design;
    let found = |part: &Printed| {
        let inputs = (part.name, part.flat.key(), part.print_pose, design.material_of(part.name), &design.frame.printer);
        design.memo.get("places that hang", part.name.slug(), &inputs, || of_part(design, part)).to_vec()
    };
    let found: Vec<Vec<Finding>> = design.printed.par_iter().map(found).collect();
    found.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::finding::Verdict;
    use crate::checks::planted::{Planted, violated};

    #[test]
    fn regress_what_the_default_frame_is_supported_for() {
        let frame = Planted::preset("cognifly");
        let found = frame.found(check);
        assert_eq!(violated(&found), []);
        let mut noted: Vec<String> =
            found.iter().filter(|f| f.verdict == Verdict::Note).map(|f| format!("{} {}", f.rule, f.subject)).collect();
        noted.sort();
        let known = ["overhang battery_lid", "overhang camera_connector_left", "overhang camera_connector_right"];
        assert_eq!(noted, known);
    }

    #[test]
    fn planted_flexible_parts_that_print_worse_over_air_are_refused() {
        let broken = |change: fn(&mut crate::params::catalogue::Material)| {
            let found = Planted::frame(|frame| change(&mut frame.flexible.material)).found(check);
            let mut rules: Vec<String> = violated(&found).iter().map(|f| f.rule.to_string()).collect();
            rules.dedup();
            rules
        };
        assert_eq!(broken(|material| material.ledge_mm = Some(1.0)), ["overhang"]);
        assert_eq!(broken(|material| material.bridge_mm = Some(1.0)).first().map(String::as_str), Some("bridge"));
        assert_eq!(broken(|_| ()), Vec::<String>::new());
    }

    #[test]
    fn planted_support_that_does_not_come_off_makes_a_note_a_violation() {
        let frame = Planted::frame(|frame| {
            (frame.rigid.material.support_comes_off, frame.rigid.material.brim_mm) = (Some(false), None);
        });
        let broken = violated(&frame.found(check));
        let (footing, hanging): (Vec<_>, Vec<_>) = broken.into_iter().partition(|f| f.rule == "footing");
        assert_eq!(hanging.len(), 3);
        // Without support and brim the lid and both camera connectors lean out over their first layer.
        assert_eq!(footing.len(), 3);
        assert!(hanging.iter().all(|f| f.message.contains("support does not come off abs")), "{hanging:?}");
    }
}
