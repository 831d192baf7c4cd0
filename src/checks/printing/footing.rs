//! Each part stands while it is printed: enough of it lies on the bed, its weight is over that, and it is not too slender.
//!
//! What stands under a supported place stands with the part. The brim of its material counts where it keeps a part from tipping over, and not as
//! contact. The first layer is that of the design: of its walls a printer's `elephant_foot_mm` leaves a line in the file. What of it is narrower than half of a line is not counted, as a slicer leaves it out.

use crate::checks::finding::Finding;
use crate::checks::measure::Measure;
use crate::checks::printing::hung::Hung;
use crate::checks::rule::{Blame, Found, InSearch, Levers, Limit, Rule};
use crate::frame::assembly::{Design, Printed};
use crate::params::PartName;
use crate::printing::printability::Footing;

const LEVERS: &[&str] = &["printer"];
/// The fork's bar is all that it stands on, where that is higher than its sockets are wide.
const FORK: &[&str] = &["fork.fork_bar_height_mm", "printer"];

pub static RULE: Rule = Rule {
    id: "footing",
    title: "Footing",
    requires: "each part stands on its first layer while it is printed",
    units: &["mm2", "deg", ""],
    limits: &[Limit::Printer],
    levers: Levers::Sets(&[LEVERS, FORK]),
    blame: Blame::Levers,
    in_search: InSearch::AtTheEnd("all layers of all parts are looked at"),
    found: Found::WithAnother,
};

/// Least area of a first layer, mm²: chosen; the smallest part of the real frame, which printed, has 50.
const CONTACT_MM2: f64 = 20.0;
/// Least tilt before a part falls, °: chosen.
const TIP_DEG: f64 = 10.0;
/// Most height over the width of the first layer: chosen; the battery's sleeve has 2.9.
const SLENDER: f64 = 5.0;

/// How a part stands while it is printed: three findings.
pub fn standing(design: &Design, part: &Printed) -> [Finding; 3] {
    findings(&Hung::in_design(design, part), design, part)
}

pub(in crate::checks) fn findings(hung: &Hung, design: &Design, part: &Printed) -> [Finding; 3] {
    let (name, printer) = (part.name, &design.frame.printer);
    let footing = Footing::of(part, &hung.process, &hung.supported());
    let Footing { contact_mm2, tip, slender } = &footing;
    let levers = if name == PartName::Fork { FORK } else { LEVERS };
    let measure = |value: f64, limit: f64, unit| Measure { rule: RULE.id, value, limit, unit, levers };
    let contact = measure(*contact_mm2, printer.least_contact_mm2.unwrap_or(CONTACT_MM2), "mm2");
    let [area, least] = contact.figures(0);
    let tilt = measure(tip.to_deg(), printer.least_tip_deg.unwrap_or(TIP_DEG), "deg");
    let [angle, least_angle] = tilt.figures(0);
    let tall = measure(*slender, printer.most_slender.unwrap_or(SLENDER), "");
    let [ratio, most] = tall.figures(1);
    // Less than nothing: the weight is that far beyond the edge.
    let tips = if tip.to_deg() < 0.0 {
        format!("does not stand, as its weight is not over its first layer; it tips over at {angle} deg")
    } else {
        format!("tips over at {angle} deg")
    };
    let remedy = "print it with a wider brim (`brim_mm` of its material) or lay it down";
    [
        contact.at_least(
            format!("{name}: contact"),
            format!("the contact area of {name} with the bed is {area} mm2, at least {least}: else lay it down"),
        ),
        tilt.at_least(format!("{name}: tilt"), format!("{name} {tips}, at least {least_angle}: else {remedy}")),
        tall.at_most(
            format!("{name}: height"),
            format!("{name} is {ratio} times as high as its first layer is wide, at most {most}: else {remedy}"),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use crate::checks::planted::{Planted, violated};
    use crate::checks::printing::overhang::check;

    #[test]
    fn planted_limits_that_a_part_misses() {
        let mut frame = Planted::preset("cognifly");
        assert_eq!(violated(&frame.found(check)), []);
        frame.design.frame.rigid.material.brim_mm = None;
        let printer = &mut frame.design.frame.printer;
        (printer.least_contact_mm2, printer.least_tip_deg, printer.most_slender) = (Some(60.0), Some(25.0), Some(2.0));
        let broken: Vec<String> = violated(&frame.found(check)).into_iter().map(|f| f.subject).collect();
        for subject in ["camera_connector_left: contact", "battery_sleeve: tilt", "battery_sleeve: height"] {
            assert!(broken.iter().any(|b| b == subject), "{subject}: {broken:?}");
        }
    }

    /// The sleeve is the highest part for what it stands on.
    #[test]
    fn planted_a_wider_brim_steadies_a_part() {
        let sleeve = |brim_mm: f64| {
            let frame = Planted::frame(|frame| frame.rigid.material.brim_mm = Some(brim_mm));
            let found = frame.found(check);
            ["contact", "tilt", "height"].map(|of| {
                let subject = format!("battery_sleeve: {of}");
                found.iter().find(|finding| finding.rule == "footing" && finding.subject == subject).expect("is looked at").value
            })
        };
        let ([area, tilt, ratio], [same, steadier, less]) = (sleeve(0.0), sleeve(8.0));
        assert!((area - same).abs() < 1e-9 && steadier > tilt + 5.0 && less < 0.8 * ratio, "{tilt} {steadier} {ratio} {less}");
    }
}
