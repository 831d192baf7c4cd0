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
