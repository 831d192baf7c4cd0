//! No gap of a part is narrower than a printed line: lines on both sides would fill it. It is measured with the
//! [walls](super::wall).

use crate::checks::rule::{Blame, Found, InSearch, Levers, Limit, Rule};
use crate::frame::parts::record;

pub static RULE: Rule = Rule {
    id: "narrowest_gap",
    title: "Gap width",
    requires: "no gap is narrower than a printed line",
    units: &["mm"],
    limits: &[Limit::Printer],
    levers: Levers::OfPart(|part| record(part).walls.iter().map(|wall| wall.keys).collect()),
    blame: Blame::Levers,
    in_search: InSearch::Constraints { subjects: &[""], binds: true },
    found: Found::WithAnother,
};
