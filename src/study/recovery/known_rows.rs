//! Rows of hidden effects that are known, by the names of their columns.

use std::collections::BTreeMap;

use super::ceiling::DETECTABLE;
use super::findings::LANDING_KEYS;
use super::setting::{Case, Recovery};
use super::truth::Truth;
use crate::impact::landing::LANDING_TILT;
use crate::study::column::Column;
use crate::study::outcomes::{Outcome, Outcomes};
use crate::study::plan::Study;

/// A row.
pub(super) struct KnownRow<'a> {
    pub case: &'a Case,
    /// Whether it has the least strength of the study.
    pub is_weakest: bool,
    columns: &'a [Column],
    outcome: &'a Outcome,
}

/// The rows that are known, in their order.
pub(super) fn known_rows<'a>(study: &'a Study, recovery: &'a Recovery, outcomes: &'a Outcomes) -> Vec<KnownRow<'a>> {
    let weakest = recovery.strengths.iter().copied().reduce(f64::min);
    let row = |(at, case): (usize, &'a Case)| {
        let is_weakest = case.strength.is_some() && case.strength == weakest;
        Some(KnownRow { case, is_weakest, columns: &study.columns, outcome: outcomes.of(at)? })
    };
    recovery.cases.iter().enumerate().filter_map(row).collect()
}

impl KnownRow<'_> {
    fn column(&self, name: &str) -> Option<(&Column, f64)> {
        let Outcome::Figures(figures) = self.outcome else { return None };
        let at = self.columns.iter().position(|column| matches!(column, Column::Recovery(measure) if measure.name == name))?;
        Some((&self.columns[at], figures[at]?))
    }

    /// A figure, where the study has it and the row knows it.
    pub fn figure(&self, name: &str) -> Option<f64> {
        self.column(name).map(|(_, figure)| figure)
    }

    /// A word.
    pub fn word(&self, name: &str) -> Option<&'static str> {
        self.column(name).and_then(|(column, figure)| column.word(figure))
    }

    pub fn is_refused(&self) -> bool {
        matches!(self.outcome, Outcome::Refused(_))
    }

    pub fn is_nothing(&self) -> bool {
        self.case.truth == Truth::Nothing
    }

    pub fn is_one(&self) -> bool {
        matches!(self.case.truth, Truth::One(_))
    }

    pub fn is_pair(&self) -> bool {
        matches!(self.case.truth, Truth::Two(_))
    }

    /// Whether its truth is outside of the catalogue: not so near to something in it that both are the same in these drops.
    pub fn is_outside(&self) -> bool {
        matches!(self.case.truth, Truth::Outside(_)) && self.figure("left.rival").is_none_or(|left| left > DETECTABLE)
    }

    /// Whether its landings slope, where it has lateral axes.
    pub fn slopes(&self) -> Option<bool> {
        if let Truth::Landing(landing) = self.case.truth { Some(landing.is_sloped()) } else { None }
    }

    /// Whether its truth is this effect alone.
    pub fn is_of(&self, id: &str) -> bool {
        matches!(self.case.truth, Truth::One(spec) if spec.id == id)
    }

    pub fn is_detectable(&self) -> bool {
        self.figure("noncentrality").is_some_and(|found| found > DETECTABLE)
    }

    /// Whether a sum of squares that is left is more than trial variation.
    pub fn leaves(&self, name: &str) -> bool {
        self.figure(name).is_some_and(|left| left > DETECTABLE)
    }

    pub fn is_right(&self) -> Option<bool> {
        self.figure("right").map(|right| right == 1.0)
    }

    /// Whether a column of names has the effect that is hidden.
    pub fn is_first(&self, name: &str) -> Option<bool> {
        let Truth::One(spec) = self.case.truth else { return None };
        Some(self.word(name)? == spec.id)
    }

    /// The parameters whose truth and interval are known, and whether the one is in the other.
    pub fn covered(&self) -> Vec<(String, bool)> {
        let own = match self.case.truth {
            Truth::Landing(_) => LANDING_KEYS[2..].iter().map(|key| format!("{LANDING_TILT}.{key}")).collect(),
            Truth::One(spec) => spec.parameters.iter().map(|parameter| format!("{}.{}", spec.id, parameter.key)).collect(),
            _ => Vec::new(),
        };
        let keys = ["k", "c"].map(String::from).into_iter().chain(own);
        let columns = ["k", "c", "parameter.1", "parameter.2", "parameter.3"];
        let held = |(key, column): (String, &str)| {
            let figure = |end: &str| self.figure(&format!("{column}.{end}"));
            let (truth, least, most) = (figure("true")?, figure("least")?, figure("most")?);
            Some((key, (least..=most).contains(&truth)))
        };
        keys.zip(columns).filter_map(held).collect::<BTreeMap<String, bool>>().into_iter().collect()
    }
}
