//! What spans from one support to another is no longer than its material bridges.

use crate::checks::finding::{Finding, Measure};
use crate::checks::printing::stance::{Hung, place};
use crate::printing::printability::Fault;

pub(in crate::checks) fn finding(hung: &Hung) -> Finding {
    let worst = hung.worst(Fault::Bridge, |place| place.span_mm);
    let limit = hung.process.bridge_mm;
    let value = worst.map_or(0.0, |worst| worst.span_mm);
    let measure = Measure { rule: "bridge", value, limit, unit: "mm", levers: hung.levers() };
    let [span, allowed] = measure.figures(1);
    let what = match worst {
        None => "nothing is bridged".into(),
        Some(worst) => format!("the longest bridge spans {span} mm, {} bridges {allowed} mm ({})", hung.material, place(worst)),
    };
    hung.judged(measure, &what)
}
