//! No layer has a piece that begins in the air.

use crate::checks::finding::{Finding, Measure};
use crate::checks::printing::stance::{Hung, place};
use crate::figures::decimals;
use crate::printing::printability::Fault;

pub(in crate::checks) fn finding(hung: &Hung) -> Finding {
    let area_mm2 = hung.area_mm2(Fault::Island);
    let measure = Measure { rule: "island", value: area_mm2, limit: 0.0, unit: "mm2", levers: hung.levers() };
    let what = match hung.worst(Fault::Island, |place| place.area_mm2) {
        None => "every layer rests on the one below".into(),
        Some(worst) => format!("{} mm2 begin in the air ({})", decimals(area_mm2, 1), place(worst)),
    };
    hung.judged(measure, &what)
}
