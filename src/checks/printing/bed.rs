//! Each printed part fits the printer, as it is printed.
//!
//! On a rectangular bed the part may be turned by a right angle; on a round one its corners' distance from the middle
//! of its box counts.

use crate::checks::finding::{Finding, Verdict};
use crate::checks::measure::Measure;
use crate::checks::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use crate::checks::scene::Scene;
use crate::frame::assembly::Printed;
use crate::params::catalogue::{Bed, Printer};
use crate::printing::room::{has_place, reach_mm};

const LEVERS: &[&str] = &["printer"];

pub static RULE: Rule = Rule {
    id: "printer_bed",
    title: "Printer's bed",
    requires: "each part fits the printer's bed",
    units: &["mm", "places"],
    limits: &[Limit::Printer],
    levers: Levers::Sets(&[LEVERS]),
    blame: Blame::Levers,
    in_search: InSearch::Constraints { subjects: &[""], binds: true },
    found: Found::By(&[Pass::quick(check)]),
};

/// The room that a part needs on the printer.
#[derive(Clone, Debug, PartialEq)]
pub struct BedUse {
    /// The part.
    pub part: &'static str,
    /// Length, width and height, mm.
    pub size_mm: [f64; 3],
    /// What is nearest to its limit: `length`, `width`, `diameter` or `height`.
    pub tightest: &'static str,
    /// That size, mm.
    pub value_mm: f64,
    /// Room for it, mm.
    pub limit_mm: f64,
}

impl BedUse {
    fn of(part: &Printed, printer: &Printer) -> Self {
        let [x, y, z] = part.mesh.size_mm();
        let [long, wide] = [printer.size_mm[0].max(printer.size_mm[1]), printer.size_mm[0].min(printer.size_mm[1])];
        let mut uses = match printer.bed {
            Bed::Rectangular => vec![("length", x.max(y), long), ("width", x.min(y), wide)],
            Bed::Round => vec![("diameter", 2.0 * reach_mm(part), wide)],
        };
        uses.push(("height", z, printer.height_mm));
        let tight = uses.into_iter().min_by(|a, b| (a.2 - a.1).total_cmp(&(b.2 - b.1)));
        let (tightest, value_mm, limit_mm) = tight.unwrap_or(("height", z, printer.height_mm));
        Self { part: part.name.slug(), size_mm: [x, y, z], tightest, value_mm, limit_mm }
    }

    fn finding(&self) -> Finding {
        let Self { part, size_mm: [x, y, z], tightest, value_mm, limit_mm } = self;
        let measure = Measure { rule: RULE.id, value: *value_mm, limit: *limit_mm, unit: "mm", levers: LEVERS };
        let [value, limit] = measure.figures(1);
        let message = format!("{part} is printed as {x:.1} x {y:.1} x {z:.1} mm: {tightest} {value} mm of {limit} mm on the printer");
        measure.at_most((*part).into(), message)
    }
}

/// A part that the bed would be large enough for, but for what the printer keeps clear: places that are left for it, and how many it needs.
fn kept_out(part: &Printed, printer: &Printer) -> Finding {
    let (slug, kept) = (part.name.slug(), printer.kept_clear_mm.as_ref().map_or(0, Vec::len));
    let areas =
        if kept == 1 { "the area that the printer keeps clear".into() } else { format!("the {kept} areas that the printer keeps clear") };
    let message = format!(
        "{slug} has no place on the bed, in its middle, at an edge or beside another area, turned or not, that is clear of {areas} (kept_clear_mm)"
    );
    Measure { rule: RULE.id, value: 0.0, limit: 1.0, unit: "places", levers: LEVERS }.at_least(slug.into(), message)
}

pub(in crate::checks) fn check(scene: &Scene) -> Vec<Finding> {
    let printer = &scene.design.frame.printer;
    let finding = |part: &Printed| {
        let found = BedUse::of(part, printer).finding();
        if found.verdict == Verdict::Violated || has_place(part, printer) { found } else { kept_out(part, printer) }
    };
    scene.design.printed.iter().map(finding).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};
    use crate::params::PartName;

    #[test]
    fn planted_beds_too_small_and_too_low() {
        let mut frame = Planted::preset("cognifly");
        assert_eq!(violated(&frame.found(check)), []);
        let hub = frame.design.part(PartName::Hub).expect("has a hub").mesh.size_mm();
        frame.design.frame.printer.size_mm = [hub[0] - 1.0, 300.0];
        assert_eq!(violated(&frame.found(check)).iter().map(|f| f.subject.as_str()).collect::<Vec<_>>(), ["hub"]);
        frame.design.frame.printer.size_mm = [hub[0] + 1.0, hub[0] + 1.0];
        frame.design.frame.printer.bed = Bed::Round;
        assert!(violated(&frame.found(check)).iter().any(|f| f.subject == "hub"));
        frame.design.frame.printer.bed = Bed::Rectangular;
        frame.design.frame.printer.size_mm = [2.0 * hub[0]; 2];
        // A stripe across the bed that leaves no room beside it.
        frame.design.frame.printer.kept_clear_mm = Some(vec![[0.6 * hub[0], 0.0, 1.4 * hub[0], 2.0 * hub[0]]]);
        let found = frame.found(check);
        assert!(violated(&found).iter().any(|f| f.subject == "hub" && f.message.contains("kept_clear_mm")), "{found:?}");
        assert!(violated(&found).iter().all(|f| f.subject != "knee"), "a small part has room beside it");
        // A stripe that is free between two areas, and a round bed whose middle is kept clear: there is room beside.
        let wide = hub[0].max(hub[1]);
        frame.design.frame.printer.size_mm = [4.0 * wide; 2];
        frame.design.frame.printer.kept_clear_mm =
            Some(vec![[0.0, 0.0, 0.5 * wide, 4.0 * wide], [1.6 * wide, 0.0, 4.0 * wide, 4.0 * wide]]);
        assert_eq!(violated(&frame.found(check)), []);
        frame.design.frame.printer.bed = Bed::Round;
        frame.design.frame.printer.kept_clear_mm = Some(vec![[-0.2 * wide, -0.2 * wide, 0.2 * wide, 0.2 * wide]]);
        assert_eq!(violated(&frame.found(check)), []);
        frame.design.frame.printer.bed = Bed::Rectangular;
        frame.design.frame.printer.size_mm = [2.0 * hub[0]; 2];
        frame.design.frame.printer.kept_clear_mm = None;
        frame.design.frame.printer.bed = Bed::Round;
        frame.design.frame.printer.height_mm = 1.0;
        assert_eq!(violated(&frame.found(check)).len(), frame.design.printed.len());
    }
}
