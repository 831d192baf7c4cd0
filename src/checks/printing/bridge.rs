//! What spans from one support to another is no longer than its material bridges.

use crate::checks::finding::Finding;
use crate::checks::measure::Measure;
use crate::checks::printing::hung::{Hung, PROCESS, place};
use crate::checks::rule::{Blame, Found, InSearch, Levers, Limit, Rule};
use crate::printing::printability::Fault;

pub static RULE: Rule = Rule {
    id: "bridge",
    title: "Bridges",
    requires: "no bridge is longer than the material spans",
    units: &["mm"],
    limits: &[Limit::Material],
    levers: Levers::Sets(PROCESS),
    blame: Blame::Levers,
    in_search: InSearch::AtTheEnd("all layers of all parts are looked at"),
    found: Found::WithAnother,
};

pub(in crate::checks) fn finding(hung: &Hung) -> Finding {
    let worst = hung.worst(Fault::Bridge, |place| place.span_mm);
    let limit = hung.process.bridge_mm;
    let value = worst.map_or(0.0, |worst| worst.span_mm);
    let measure = Measure { rule: RULE.id, value, limit, unit: "mm", levers: hung.levers() };
    let [span, allowed] = measure.figures(1);
    let what = match worst {
        None => "nothing is bridged".into(),
        Some(worst) => format!("the longest bridge spans {span} mm, {} bridges {allowed} mm ({})", hung.material, place(worst)),
    };
    hung.judged(measure, &what)
}
