//! Something that two frames differ in.

use serde::Serialize;

use crate::figures::decimals;

/// Something that differs, reported for either side; empty where a side has no such thing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Changed {
    /// What.
    pub name: String,
    /// Unit of the values.
    pub unit: &'static str,
    /// Either side's, as reported.
    pub reported: [String; 2],
    /// Either side's number; none where a side has no such thing, or where it is no number.
    pub values: [Option<f64>; 2],
    /// Whether the second side is better, worse, or neither.
    pub trend: Trend,
}

/// Whether a change is for the better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Trend {
    /// Better.
    Better,
    /// Worse.
    Worse,
    /// Neither, or equal.
    Neither,
}

impl Changed {
    pub(super) fn numbers(name: String, unit: &'static str, values: [Option<f64>; 2], places: usize) -> Self {
        let reported = distinguished(values, places);
        Self { name, unit, reported, values, trend: Trend::Neither }
    }

    /// Something that is no number.
    pub(super) fn words(name: String, reported: [String; 2]) -> Self {
        Self { name, unit: "", reported, values: [None; 2], trend: Trend::Neither }
    }

    /// Whether both sides are reported alike.
    pub fn is_same(&self) -> bool {
        self.reported[0] == self.reported[1]
    }

    /// By how much the second is more than the first.
    pub fn grown(&self) -> Option<f64> {
        Some(self.values[1]? - self.values[0]?)
    }

    /// Growth with its sign, at the places of the values.
    pub fn grown_reported(&self) -> String {
        let places = self.reported.iter().map(|reported| reported.split_once('.').map_or(0, |(_, after)| after.len())).max().unwrap_or(0);
        self.grown().map_or(String::new(), |grown| {
            let reported = decimals(grown, places);
            if grown > 0.0 && shows(grown, places) { format!("+{reported}") } else { reported }
        })
    }
}

/// Least difference of two numbers of frame files.
pub(super) const LEAST: f64 = 1e-6;

/// Whether a difference is more than zeros when it is reported with so many places.
fn shows(difference: f64, places: usize) -> bool {
    decimals(difference, places).contains(|digit: char| matches!(digit, '1'..='9'))
}

/// Whether both sides have a number, and the same one as far as its places tell: what is worked out is off in the last digits,
/// and a difference that is reported as 0 is none.
pub(super) fn same(values: [Option<f64>; 2], places: usize) -> bool {
    matches!(values, [Some(a), Some(b)] if !shows(b - a, places))
}

/// Two numbers with so many places that they and their difference look different when they are, up to six.
fn distinguished(values: [Option<f64>; 2], places: usize) -> [String; 2] {
    let reported = |places| values.map(|value| value.map_or(String::new(), |value| decimals(value, places)));
    let [Some(a), Some(b)] = values else { return reported(places) };
    let apart = |places: &usize| reported(*places)[0] != reported(*places)[1] && shows(b - a, *places);
    let differ = (a - b).abs() > LEAST;
    reported(if differ { (places..=6).find(apart).unwrap_or(6) } else { places })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_numbers_that_differ_look_different() {
        assert_eq!(distinguished([Some(1.0), Some(1.0004)], 2), ["1.0000", "1.0004"]);
        assert_eq!(distinguished([Some(1.0), None], 2), ["1.00", ""]);
        // Rounding alone does not tell them apart: their difference has to show, too.
        assert_eq!(distinguished([Some(1.004_999), Some(1.005_001)], 2), ["1.004999", "1.005001"]);
        let changed = Changed::numbers("x".into(), "g", [Some(231.552), Some(263.6)], 2);
        assert_eq!((changed.reported.clone(), changed.grown_reported().as_str()), (["231.55".into(), "263.60".into()], "+32.05"));
        let less = Changed::numbers("x".into(), "g", [Some(2.0), Some(1.0)], 2);
        assert_eq!(less.grown_reported(), "-1.00");
        assert_eq!(Changed::numbers("x".into(), "g", [Some(2.0), Some(2.0)], 2).grown_reported(), "0.00");
    }
}
