//! Whether each part prints: what hangs over air, judged by the rules of `overhang`, `island` and `bridge`, and what it stands
//! on, by that of `footing`.
//!
//! They look at the same places, which are found once. Where support comes off the material a part that needs it gets
//! it on its plate, and the finding is a note; where it does not, the part cannot be printed as it lies.

use rayon::prelude::*;

use super::{bridge, footing, island, overhang};
use crate::checks::finding::{Finding, Measure};
use crate::checks::scene::Scene;
use crate::figures::decimals;
use crate::frame::assembly::{Design, Printed};
use crate::params::PartName;
use crate::printing::printability;
use crate::printing::printability::{Fault, Footing, Hanging, Process};
use crate::solid::Region;

/// The places of a part that hang, and what its material prints over air.
pub(in crate::checks) struct Hung<'a> {
    pub part: PartName,
    pub material: &'a str,
    pub process: Process,
    pub places: Vec<Hanging>,
}

impl<'a> Hung<'a> {
    fn in_design(design: &'a Design, part: &Printed) -> Self {
        let material = design.material_of(part.name);
        let process = Process::of(&material.material, &design.frame.printer);
        Self { part: part.name, material: &material.name, process, places: printability::hanging(part, &process) }
    }

    /// The worst place that would break a rule, or is nearest to it.
    pub fn worst(&self, fault: Fault, size: impl Fn(&Hanging) -> f64) -> Option<&Hanging> {
        let concerned = self.places.iter().filter(|place| match fault {
            Fault::Island => place.island,
            Fault::Overhang => !place.island && !place.bridged,
            Fault::Bridge => !place.island && place.bridged,
        });
        concerned.max_by(|a, b| size(a).total_cmp(&size(b)))
    }

    /// Area of all places that break a rule, mm².
    pub fn area_mm2(&self, fault: Fault) -> f64 {
        self.places.iter().filter(|place| place.fault(&self.process) == Some(fault)).map(|place| place.area_mm2).sum()
    }

    /// The keys of what it is printed of, and on.
    pub fn levers(&self) -> &'static [&'static str] {
        if self.part.is_flexible() { &["materials.flexible", "printer"] } else { &["materials.rigid", "printer"] }
    }

    /// The places that are printed on support.
    fn supported(&self) -> Vec<&Region> {
        let held = self.places.iter().filter(|place| self.process.support_comes_off && place.fault(&self.process).is_some());
        held.map(|place| &place.plan).collect()
    }

    /// The finding: with support the limit is not broken.
    pub fn judged(&self, measure: Measure, what: &str) -> Finding {
        let good = measure.value <= measure.limit;
        let remedy = match (good, self.process.support_comes_off) {
            (true, _) => String::new(),
            (false, true) => "; it gets support on its plate".into(),
            (false, false) => format!("; support does not come off {}: print it of another material or change its shape", self.material),
        };
        let message = format!("{}: {what}{remedy}", self.part);
        let subject = self.part.slug().into();
        if good || !self.process.support_comes_off { measure.at_most(subject, message) } else { measure.note(subject, message) }
    }
}

/// Where a place lies, in words.
pub(in crate::checks) fn place(hanging: &Hanging) -> String {
    let [x, y] = hanging.plan.middle_mm().map(|mm| decimals(mm, 1));
    format!("around {x}, {y} as printed, {} to {} mm high", decimals(hanging.heights_mm[0], 1), decimals(hanging.heights_mm[1], 1))
}

/// How a part stands while it is printed: three findings.
pub fn standing(design: &Design, part: &Printed) -> [Finding; 3] {
    stands(&Hung::in_design(design, part), design, part)
}

fn stands(hung: &Hung, design: &Design, part: &Printed) -> [Finding; 3] {
    let footing = Footing::of(part, hung.process.layer_mm, &hung.supported());
    footing::findings(part.name, &footing, &design.frame.printer)
}

pub(in crate::checks) fn check(scene: &Scene) -> Vec<Finding> {
    let design = scene.design;
    let found = |part: &Printed| {
        let hung = Hung::in_design(design, part);
        let over_air = [overhang::finding(&hung), island::finding(&hung), bridge::finding(&hung)];
        over_air.into_iter().chain(stands(&hung, design, part)).collect()
    };
    let found: Vec<Vec<Finding>> = design.printed.par_iter().map(found).collect();
    found.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::Verdict;
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
        let frame = Planted::frame(|frame| frame.rigid.material.support_comes_off = Some(false));
        let broken = violated(&frame.found(check));
        let (footing, hanging): (Vec<_>, Vec<_>) = broken.into_iter().partition(|f| f.rule == "footing");
        assert_eq!(hanging.len(), 3);
        // Without the support the lid and both camera connectors lean out over their first layer.
        assert_eq!(footing.len(), 3);
        assert!(hanging.iter().all(|f| f.message.contains("support does not come off abs")), "{hanging:?}");
    }
}
