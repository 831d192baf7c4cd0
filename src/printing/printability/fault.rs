//! The places of a part that hang over air, and what they break.

use std::sync::Arc;

use super::process::Process;
use super::unsupported::{self, Hanging};
use crate::frame::assembly::{Design, Printed};

/// What a place that hangs breaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// It begins on nothing.
    Island,
    /// It reaches out too far.
    Overhang,
    /// It is bridged, too long.
    Bridge,
}

impl Hanging {
    /// What it breaks, if anything.
    pub fn fault(&self, process: &Process) -> Option<Fault> {
        if self.island {
            Some(Fault::Island)
        } else if self.bridged {
            (self.span_mm > process.bridge_mm).then_some(Fault::Bridge)
        } else if self.overhang_mm(process) > process.ledge_mm {
            Some(Fault::Overhang)
        } else {
            (self.span_mm > process.bridge_mm).then_some(Fault::Bridge)
        }
    }

    /// How far it reaches out, mm. Of what rests on nothing nobody knows from where: it is as far as it is large, and farther than anything may.
    pub fn overhang_mm(&self, process: &Process) -> f64 {
        if self.reach_mm.is_finite() { self.reach_mm } else { libm::sqrt(self.area_mm2).max(2.0 * process.ledge_mm) }
    }
}

/// The places of a part of a design that hang over air, found once for the rules and for the plates.
pub fn hanging(design: &Design, part: &Printed, process: &Process) -> Arc<Vec<Hanging>> {
    let inputs = (part.flat.key(), part.print_pose, process);
    design.memo.hold("places over air", &inputs, || unsupported::of(&part.printed(), &part.mesh, process))
}

/// Whether a part of a design needs support.
pub fn needs_support(design: &Design, part: &Printed, process: &Process) -> bool {
    hanging(design, part, process).iter().any(|place| place.fault(process).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::Region;
    use crate::units::Angle;

    /// Less than a ledge across, and nothing under it: it needs support, and what the rule says of it is beyond the ledge, too.
    #[test]
    fn analytic_what_rests_on_nothing_reaches_beyond_any_ledge() {
        let process = Process {
            line_mm: 0.45,
            layer_mm: 0.2,
            overhang: Angle::deg(45.0),
            ledge_mm: 2.0,
            bridge_mm: 20.0,
            support_comes_off: true,
            brim_mm: 0.0,
        };
        let plan = Region::rectangle([[0.0, 0.0], [1.0, 1.0]], 0.0);
        let place = |reach_mm: f64| Hanging {
            layers: vec![(1.0, plan.clone())],
            plan: plan.clone(),
            area_mm2: 1.0,
            heights_mm: [1.0, 1.0],
            island: false,
            reach_mm,
            span_mm: 0.0,
            bridged: false,
        };
        assert_eq!((place(f64::INFINITY).fault(&process), place(1.5).fault(&process)), (Some(Fault::Overhang), None));
        assert!(place(f64::INFINITY).overhang_mm(&process) > process.ledge_mm);
        assert_eq!(place(1.5).overhang_mm(&process), 1.5);
    }
}
