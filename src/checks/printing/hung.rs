//! What of a part hangs over air while it is printed.
//!
//! The rules of `overhang`, `island`, `bridge` and `footing` look at the same places, which are found once. Where support comes
//! off the material a part that needs it gets it on its plate, and the finding is a note; where it does not, the part cannot
//! be printed as it lies.

use std::sync::Arc;

use crate::checks::finding::Finding;
use crate::checks::measure::Measure;
use crate::figures::decimals;
use crate::frame::assembly::{Design, Printed};
use crate::params::PartName;
use crate::printing::printability;
use crate::printing::printability::{Fault, Hanging, Process};
use crate::solid::Region;

/// The keys of what a part is printed of, and on: for flexible parts, for rigid ones, and for the hub joint, between whose sockets less hangs where
/// they are wider.
pub(in crate::checks) const PROCESS: &[&[&str]; 3] = &[
    &["materials.flexible", "printer"],
    &["materials.rigid", "printer"],
    &["hub_joint.hub_joint_diameter_mm", "materials.flexible", "printer"],
];

/// The places of a part that hang, and what its material prints over air.
pub(in crate::checks) struct Hung<'a> {
    pub part: PartName,
    flexible: bool,
    pub material: &'a str,
    pub process: Process,
    pub places: Arc<Vec<Hanging>>,
}

impl<'a> Hung<'a> {
    pub fn in_design(design: &'a Design, part: &Printed) -> Self {
        let material = design.material_of(part.name);
        let process = Process::of(&material.material, &design.frame.printer);
        Self {
            part: part.name,
            flexible: part.part.is_flexible(),
            material: &material.name,
            process,
            places: printability::hanging(design, part, &process),
        }
    }

    /// The worst place that would break a rule, or is nearest to it.
    pub fn worst(&self, fault: Fault, size: impl Fn(&Hanging) -> f64) -> Option<&Hanging> {
        let concerned = self.places.iter().filter(|place| match fault {
            Fault::Island => place.island,
            Fault::Overhang => !place.island && !place.bridged,
            Fault::Bridge => !place.island && (place.bridged || place.fault(&self.process) == Some(Fault::Bridge)),
        });
        concerned.max_by(|a, b| size(a).total_cmp(&size(b)))
    }

    /// The places that break a rule.
    fn at_fault(&self, fault: Fault) -> impl Iterator<Item = &Hanging> {
        self.places.iter().filter(move |place| place.fault(&self.process) == Some(fault))
    }

    /// Area of all places that break a rule, mm².
    pub fn area_mm2(&self, fault: Fault) -> f64 {
        self.at_fault(fault).map(|place| place.area_mm2).sum()
    }

    /// The same in words, with how many places there are where there are several.
    pub fn area_of(&self, fault: Fault, digits: usize) -> String {
        let area = decimals(self.area_mm2(fault), digits);
        match self.at_fault(fault).count() {
            0 | 1 => format!("{area} mm2"),
            count => format!("{count} places of {area} mm2 together"),
        }
    }

    /// Where the worst of the places that break a rule lies; where there are several, which it is and its own area.
    pub fn worst_place(&self, fault: Fault, worst: &Hanging, which: &str) -> String {
        match self.at_fault(fault).count() {
            0 | 1 => place(worst),
            _ => format!("the {which}, of {} mm2, {}", decimals(worst.area_mm2, 0), place(worst)),
        }
    }

    /// The keys of what it is printed of, and on, and of its shape where one drives it.
    pub fn levers(&self) -> &'static [&'static str] {
        match self.part {
            PartName::HubJoint => PROCESS[2],
            _ => PROCESS[usize::from(!self.flexible)],
        }
    }

    /// The places that are printed on support.
    pub fn supported(&self) -> Vec<&Region> {
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
    format!(
        "around x {x} mm, y {y} mm as printed, {} to {} mm high",
        decimals(hanging.heights_mm[0], 1),
        decimals(hanging.heights_mm[1], 1)
    )
}
