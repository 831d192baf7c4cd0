//! What two frames differ in.

use std::collections::BTreeSet;

use serde::Serialize;

use super::changed::{Changed, LEAST, Trend, same};
use super::measures::{Better, Evaluation, MEASURES, Measure};
use super::stated_values;
use crate::checks::Verdict;
use crate::figures::decimals;
use crate::frame::assembly::mass::{LineKind, MassLine};
use crate::params::sleeve_direction::SleeveDirection;
use crate::params::{Frame, parameters};

/// One of two frames.
pub struct Side {
    /// What to call it: its name, or its name and a revision.
    pub name: String,
    /// The frame.
    pub evaluation: Evaluation,
}

impl Side {
    /// The frame with what to call it.
    pub fn named(&self) -> (&str, &Evaluation) {
        (&self.name, &self.evaluation)
    }
}

/// What two frames differ in.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// What the sides are called.
    pub names: [String; 2],
    /// Numbers and choices of the frame files that differ, and what the files state of parts, materials, printers and extras.
    pub parameters: Vec<Changed>,
    /// Lines of the mass table that differ, g.
    pub masses: Vec<Changed>,
    /// Printed volumes that differ, part by part, all copies, mm³.
    pub volumes: Vec<Changed>,
    /// Every measure, equal ones too.
    pub measures: Vec<Changed>,
    /// Peaks that say of neither frame that it is better, and why: the one with the lower peak hits the ground faster.
    pub not_compared: Vec<String>,
    /// Limits that the second violates and the first does not.
    pub broken: Vec<String>,
    /// Limits that the first violates and the second does not.
    pub mended: Vec<String>,
}

impl Difference {
    /// What the second frame changes.
    pub fn of(sides: &[Side; 2]) -> Self {
        let [a, b] = sides.each_ref().map(|side| &side.evaluation);
        let violated = |e: &Evaluation| -> Vec<(String, String)> {
            let broken = e.findings.iter().filter(|f| f.verdict == Verdict::Violated);
            broken.map(|f| (format!("{}: {}", f.rule, f.subject), f.message.clone())).collect()
        };
        let without = |of: &[(String, String)], other: &[(String, String)]| -> Vec<String> {
            of.iter().filter(|(key, _)| other.iter().all(|(known, _)| known != key)).map(|(_, message)| message.clone()).collect()
        };
        let (before, after) = (violated(a), violated(b));
        Self {
            names: sides.each_ref().map(|side| side.name.clone()),
            parameters: parameter_changes([&a.design.frame, &b.design.frame]),
            masses: mass_changes([a, b]),
            volumes: volume_changes([a, b]),
            measures: measure_changes([a, b]),
            not_compared: MEASURES.iter().filter_map(|measure| why_not_compared(measure, sides.each_ref().map(Side::named))).collect(),
            broken: without(&after, &before),
            mended: without(&before, &after),
        }
    }

    /// Whether the frames are alike in all that is compared.
    pub fn is_empty(&self) -> bool {
        let is_none = [&self.parameters, &self.masses, &self.volumes].iter().all(|changes| changes.is_empty());
        is_none && self.measures.iter().all(Changed::is_same) && self.broken.is_empty() && self.mended.is_empty()
    }
}

fn parameter_changes(frames: [&Frame; 2]) -> Vec<Changed> {
    let numbers = parameters().filter_map(|p| {
        let values = frames.map(|frame| frame.value(p.table, p.key));
        let same = matches!(values, [Some(a), Some(b)] if (a - b).abs() <= LEAST) || values == [None; 2];
        (!same).then(|| Changed::numbers(format!("{}.{}", p.table, p.key), p.unit(), values, 2))
    });
    let roles: BTreeSet<&String> = frames.iter().flat_map(|frame| frame.bought.keys()).collect();
    let mut choices: Vec<(String, [String; 2])> = roles
        .into_iter()
        .map(|role| (format!("bought.{role}"), frames.map(|frame| frame.bought.get(role).map_or("none".into(), |item| item.name.clone()))))
        .collect();
    choices.push(("materials.flexible".into(), frames.map(|frame| frame.flexible.name.clone())));
    choices.push(("materials.rigid".into(), frames.map(|frame| frame.rigid.name.clone())));
    choices.push((SleeveDirection::KEY.into(), frames.map(|frame| frame.sleeve_direction.word().into())));
    choices.push(("printer".into(), frames.map(|frame| frame.printer_name.clone())));
    let choices = choices.into_iter().filter(|(_, [a, b])| a != b).map(|(name, reported)| Changed::words(name, reported));
    numbers.chain(choices).chain(stated_values::changes(frames)).collect()
}

/// Lines by name: a line of one side alone is named too.
fn paired(sides: [Vec<(String, f64)>; 2], unit: &'static str, places: usize) -> Vec<Changed> {
    let mut names: Vec<&String> = Vec::new();
    for (name, _) in sides.iter().flatten() {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let value = |side: &[(String, f64)], name: &str| side.iter().find(|(known, _)| known == name).map(|(_, value)| *value);
    let mut changes = Vec::new();
    for name in names {
        let values = [value(&sides[0], name), value(&sides[1], name)];
        if !same(values, places) {
            let mut changed = Changed::numbers(name.clone(), unit, values, places);
            let grown = values[1].unwrap_or(0.0) - values[0].unwrap_or(0.0);
            changed.trend = if grown < 0.0 { Trend::Better } else { Trend::Worse };
            changes.push(changed);
        }
    }
    changes
}

/// Whether what is no extra has the name of a line.
fn is_other(sides: [&Evaluation; 2], line: &MassLine) -> bool {
    sides.iter().flat_map(|e| &e.masses.lines).any(|other| other.kind != LineKind::Extra && other.name == line.name)
}

fn mass_changes(sides: [&Evaluation; 2]) -> Vec<Changed> {
    // An extra may be called as something else is.
    let named = |line: &MassLine| {
        if line.kind == LineKind::Extra && is_other(sides, line) { format!("{} (extra)", line.name) } else { line.name.clone() }
    };
    paired(sides.map(|e| e.masses.lines.iter().map(|line| (named(line), line.total_g)).collect()), "g", 2)
}

fn volume_changes(sides: [&Evaluation; 2]) -> Vec<Changed> {
    let volumes = |e: &Evaluation| {
        let parts = e.design.printed.iter();
        parts.map(|part| (part.name.slug().to_string(), part.volume_mm3 * f64::from(part.part.quantity()))).collect()
    };
    paired(sides.map(volumes), "mm3", 0)
}

fn measure_changes(sides: [&Evaluation; 2]) -> Vec<Changed> {
    let change = |measure: &Measure| {
        let values = sides.map(|e| measure.of(e));
        let name = measure.name.to_string();
        if same(values, measure.places()) {
            return Changed {
                name,
                unit: measure.unit,
                reported: values.map(|value| measure.reported(value)),
                values,
                trend: Trend::Neither,
            };
        }
        let mut changed = Changed::numbers(name, measure.unit, values, measure.places());
        let worse = |grown: f64| (grown > 0.0) == (measure.better == Better::Less);
        changed.trend = match changed.grown() {
            Some(_) if measure.better == Better::Neither || contradicted(measure, sides).is_some() => Trend::Neither,
            Some(grown) if worse(grown) => Trend::Worse,
            Some(_) => Trend::Better,
            None => Trend::Neither,
        };
        changed
    };
    let asked = |measure: &&Measure| !measure.is_mechanics() || sides.iter().any(|e| e.prediction.is_some());
    MEASURES.iter().filter(asked).map(change).collect()
}

/// Least difference of two impacts on the ground that says something, m/s.
const LEAST_STRIKE_M_S: f64 = 0.05;

/// How fast either frame hits the ground where the one with the lower peak is the faster one: the peak leaves that impact out.
fn contradicted(measure: &Measure, sides: [&Evaluation; 2]) -> Option<[f64; 2]> {
    let [a, b] = sides.map(|e| Some((measure.of(e)?, e.strike_m_s(measure)?)));
    let ((peak_a, strike_a), (peak_b, strike_b)) = (a?, b?);
    let faster = if peak_b < peak_a { strike_b - strike_a } else { strike_a - strike_b };
    (!same([Some(peak_a), Some(peak_b)], measure.places()) && faster > LEAST_STRIKE_M_S).then_some([strike_a, strike_b])
}

/// Why a measure says of neither of two frames, each with what to call it, that it is better; none where it does, or the frames are equal in it.
pub fn why_not_compared(measure: &Measure, sides: [(&str, &Evaluation); 2]) -> Option<String> {
    let strikes = contradicted(measure, sides.map(|(_, evaluation)| evaluation))?;
    let of = |at: usize| match strikes[at] {
        0.0 => format!("{} does not hit the ground", sides[at].0),
        strike => format!("{} hits the ground at {} m/s", sides[at].0, decimals(strike, 2)),
    };
    Some(format!("{}: not compared, because the lower one leaves out the harder impact: {}, {}", measure.name, of(0), of(1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_difference_that_is_reported_as_zero_is_none() {
        assert!(same([Some(209.49), Some(209.494)], 2) && !same([Some(209.49), Some(209.50)], 2));
        assert!(same([Some(100.0), Some(100.4)], 0) && !same([Some(100.0), Some(99.0)], 0));
        assert!(!same([Some(1.0), None], 2) && !same([None, None], 2));
        let sides = [vec![("a".to_string(), 1.0)], vec![("a".to_string(), 1.004)]];
        assert!(paired(sides, "g", 2).is_empty());
    }

    #[test]
    fn analytic_lines_of_one_side_alone_are_named() {
        let sides = [vec![("a".to_string(), 1.0), ("b".to_string(), 2.0)], vec![("b".to_string(), 2.0), ("c".to_string(), 3.0)]];
        let names: Vec<(String, [Option<f64>; 2])> = paired(sides, "g", 2).into_iter().map(|c| (c.name, c.values)).collect();
        assert_eq!(names, [("a".to_string(), [Some(1.0), None]), ("c".to_string(), [None, Some(3.0)])]);
    }
}
