//! What is asked of a measure: `clearance.propeller>=3mm`, `mass=2g`.

use super::measures::{Evaluation, Measure, measure, measure_names};
use crate::checks::Verdict;
use crate::params::refusal::nearest;

/// Why a goal does not read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GoalError {
    /// No measure of this name.
    #[error("there is no measure `{name}`{}; there are {all}", .near.as_ref().map_or(String::new(), |near| format!(", did you mean `{near}`?")))]
    Unknown {
        /// As typed.
        name: String,
        /// The nearest known one.
        near: Option<String>,
        /// All of them.
        all: String,
    },
    /// Not of this form.
    #[error("`{text}` does not read: write {form}")]
    Form {
        /// As typed.
        text: String,
        /// What is wanted.
        form: &'static str,
    },
    /// Another unit.
    #[error("`{text}` is in {unit}, {name} is measured in {right}")]
    Unit {
        /// As typed.
        text: String,
        /// The unit in it.
        unit: String,
        /// The measure.
        name: &'static str,
        /// Its unit.
        right: &'static str,
    },
}

/// Which side of a number is good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sense {
    /// No more.
    AtMost,
    /// No less.
    AtLeast,
}

/// A limit of a measure.
#[derive(Clone, Copy)]
pub struct Goal {
    /// The measure.
    pub measure: &'static Measure,
    /// Which side is good.
    pub sense: Sense,
    /// The limit, in the measure's unit.
    pub limit: f64,
}

impl Goal {
    /// Reads `clearance.propeller>=3mm`; the unit may be left out.
    ///
    /// # Errors
    /// When it is none.
    pub fn parse(text: &str) -> Result<Self, GoalError> {
        let form = "a measure, <= or >=, and a number, such as 'clearance.propeller>=3mm'";
        let (at, sense) = match (text.find("<="), text.find(">=")) {
            (Some(at), None) => (at, Sense::AtMost),
            (None, Some(at)) => (at, Sense::AtLeast),
            _ => return Err(GoalError::Form { text: text.into(), form }),
        };
        let measure = measure_named(text[..at].trim())?;
        let limit = amount(text, &text[at + 2..], measure, form)?;
        Ok(Self { measure, sense, limit })
    }

    /// How far a value is on the good side, in the measure's unit.
    pub fn margin(&self, value: f64) -> f64 {
        match self.sense {
            Sense::AtMost => self.limit - value,
            Sense::AtLeast => value - self.limit,
        }
    }

    /// As it is written.
    pub fn reported(&self) -> String {
        let sign = if self.sense == Sense::AtMost { "<=" } else { ">=" };
        format!("{}{sign}{}{}", self.measure.name, self.limit, self.measure.unit)
    }
}

/// How much a measure may grow.
#[derive(Clone, Copy)]
pub struct Increase {
    /// The measure.
    pub measure: &'static Measure,
    /// By how much at most, in the measure's unit.
    pub most: f64,
}

impl Increase {
    /// Reads `mass=2g`; the unit may be left out.
    ///
    /// # Errors
    /// When it is none, or negative.
    pub fn parse(text: &str) -> Result<Self, GoalError> {
        let form = "a measure, = and a number that is not negative, such as mass=2g";
        let (name, rest) = text.split_once('=').ok_or_else(|| GoalError::Form { text: text.into(), form })?;
        let measure = measure_named(name.trim())?;
        let most = amount(text, rest, measure, form)?;
        if most < 0.0 { Err(GoalError::Form { text: text.into(), form }) } else { Ok(Self { measure, most }) }
    }

    /// By how much the measure grew, when that is too much. Less than a millionth is no growth.
    pub fn exceeded(&self, before: Option<f64>, after: Option<f64>) -> Option<f64> {
        let grown = after? - before?;
        (grown > self.most + 1e-6).then_some(grown)
    }
}

/// The value in an aim, `235g` of `mass=235g`, in the measure's unit; the unit may be left out.
///
/// # Errors
/// When it is no number, or in another unit.
pub fn value_of(text: &str, value: &str, measure: &'static Measure) -> Result<f64, GoalError> {
    amount(text, value, measure, "a measure, = and its value, such as stiffness=10")
}

/// A measure by its name.
pub(super) fn measure_named(name: &str) -> Result<&'static Measure, GoalError> {
    measure(name).ok_or_else(|| {
        let near = nearest(name, super::measures::MEASURES.iter().map(|m| m.name)).into_iter().next();
        GoalError::Unknown { name: name.into(), near, all: measure_names() }
    })
}

fn amount(text: &str, rest: &str, measure: &'static Measure, form: &'static str) -> Result<f64, GoalError> {
    let rest = rest.trim();
    let end = rest.find(|c: char| !(c.is_ascii_digit() || ".+-eE".contains(c))).unwrap_or(rest.len());
    let number: f64 = rest[..end].parse().map_err(|_| GoalError::Form { text: text.into(), form })?;
    let unit = rest[end..].trim();
    if !unit.is_empty() && unit != measure.unit {
        return Err(GoalError::Unit { text: text.into(), unit: unit.into(), name: measure.name, right: measure.unit });
    }
    if number.is_finite() { Ok(number) } else { Err(GoalError::Form { text: text.into(), form }) }
}

/// What a frame misses.
pub(super) fn broken(evaluation: &Evaluation, goals: &[Goal]) -> Vec<String> {
    let findings = evaluation.findings.iter().filter(|f| f.verdict == Verdict::Violated).map(|f| f.message.clone());
    let goals = goals.iter().filter(|goal| goal.measure.of(evaluation).is_none_or(|value| goal.margin(value) < 0.0));
    let told = |goal: &Goal| {
        let value = goal.measure.of(evaluation);
        // Never so short that a missed goal looks kept.
        let value = value.map_or_else(|| goal.measure.reported(None), |value| goal.measure.told_beside(value, goal.limit));
        format!("{} is {value}", goal.reported())
    };
    findings.chain(goals.map(told)).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn analytic_goals_read() {
        let goal = Goal::parse(" clearance.propeller >= 3mm ").expect("reads");
        assert_eq!(
            (goal.measure.name, goal.sense, goal.limit, goal.reported().as_str()),
            ("clearance.propeller", Sense::AtLeast, 3.0, "clearance.propeller>=3mm")
        );
        assert_eq!((goal.margin(5.0), Goal::parse("mass<=240").expect("reads").margin(250.0)), (2.0, -10.0));
        for wrong in ["", "mass", "mass=3", "mass<=", "mass<=x", "mass<=3mm", "mas<=3", "mass<=nan", "mass<=1e999", "mass<=1<=2>=3"] {
            assert!(Goal::parse(wrong).is_err(), "{wrong}");
        }
        assert!(Goal::parse("mas<=3").err().expect("no such measure").to_string().contains("did you mean `mass`"));
        assert!(Increase::parse("mass=-2g").is_err());
        let increase = Increase::parse("mass=2g").expect("reads");
        assert_eq!(increase.exceeded(Some(230.0), Some(232.0)), None);
        assert_eq!(increase.exceeded(Some(230.0), Some(233.0)), Some(3.0));
    }

    proptest! {
        #[test]
        fn analytic_no_text_makes_the_reader_panic(text in "\\PC{0,40}") {
            let _ = (Goal::parse(&text), Increase::parse(&text), Goal::parse(&format!("mass<={text}")));
        }
    }
}
