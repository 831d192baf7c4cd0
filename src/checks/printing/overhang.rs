//! Nothing that leans more than its material prints over air reaches out far with a free edge.

use crate::checks::finding::{Finding, Measure};
use crate::checks::printing::stance::{Hung, place};
use crate::figures::decimals;
use crate::printing::printability::Fault;

pub(in crate::checks) fn finding(hung: &Hung) -> Finding {
    let worst = hung.worst(Fault::Overhang, |place| place.reach_mm);
    // What rests on nothing at all reaches endlessly; a finding is a number.
    let reach_mm = worst.map_or(0.0, |worst| if worst.reach_mm.is_finite() { worst.reach_mm } else { libm::sqrt(worst.area_mm2) });
    let limit = hung.process.ledge_mm;
    let measure = Measure { rule: "overhang", value: reach_mm, limit, unit: "mm", levers: hung.levers() };
    let [reach, allowed] = measure.figures(1);
    let angle = decimals(hung.process.overhang.to_deg(), 0);
    let what = match worst {
        None => format!("nothing leans by more than {angle} deg over air"),
        Some(worst) if reach_mm > limit => format!(
            "leaning by more than {angle} deg, {} mm2 hang over air and reach out by {reach} mm, {allowed} mm hold themselves ({})",
            decimals(hung.area_mm2(Fault::Overhang), 0),
            place(worst)
        ),
        Some(worst) => format!("what leans by more than {angle} deg reaches out by {reach} of {allowed} mm ({})", place(worst)),
    };
    hung.judged(measure, &what)
}
