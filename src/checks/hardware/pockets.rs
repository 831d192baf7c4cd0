//! Magnets and power connector hold in what is printed for them: a warning where a magnet does not go into its pocket, the magnets are far apart
//! when the battery is home, or nothing but glue stops the connector.

use super::comparison::{measure, part};
use crate::checks::finding::{Finding, Verdict};
use crate::params::Frame;

pub(super) const CLEARANCE: &[&str] = &["bracket.magnet_clearance_mm"];
pub(super) const APART: &[&str] = &["bracket.magnet_gap_mm"];
pub(super) const STEP: &[&str] = &["bracket.connector_step_mm"];

/// Least clearance of a magnet in its pocket, mm, both sides together: chosen, what walls swell by as they are printed.
const GOES_IN_MM: f64 = 0.1;
/// Farthest that the magnets are apart when the battery is home, mm: chosen, twice what the real frame has.
const NEAR_MM: f64 = 0.6;
/// Least step that stops the connector as it is plugged in, mm: chosen, a little less than a line.
const STOPS_MM: f64 = 0.3;

/// Warnings of what holds loosely, or does not go in.
pub(super) fn held(frame: &Frame) -> Vec<Finding> {
    let bracket = &frame.bracket;
    let at_least = |(value, limit): (f64, f64), levers, subject: &str, message: String| Finding {
        verdict: Verdict::Note,
        ..measure(value, limit, "mm", levers).at_least(subject.into(), message)
    };
    let clearance = format!(
        "the pockets have {} mm more than the magnets: walls swell by a tenth as they are printed, and the magnets do not go in",
        bracket.magnet_clearance_mm
    );
    let apart = format!(
        "the magnets are {} mm apart when the battery is home: they pull much less than magnets that nearly touch, and they are what holds it",
        bracket.magnet_gap_mm
    );
    let step = format!(
        "the lid's hole is {} mm smaller than the connector's channel, each side: nothing but glue stops the connector as it is plugged in",
        bracket.connector_step_mm
    );
    let magnets = [
        at_least((bracket.magnet_clearance_mm, GOES_IN_MM), CLEARANCE, "pockets of the magnets: clearance", clearance),
        measure(bracket.magnet_gap_mm, NEAR_MM, "mm", APART).note("magnets: apart".into(), apart),
    ];
    let connector = at_least((bracket.connector_step_mm, STOPS_MM), STEP, "connector in the lid: step", step);
    let has = |role: &str| part(frame, role).is_some();
    let found = magnets.into_iter().filter(|_| has("magnet")).chain(Some(connector).filter(|_| has("connector")));
    found.filter(Finding::warns).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_a_tight_pocket_magnets_apart_and_a_connector_without_a_stop() {
        let (sound, _) = Frame::load("cognifly").expect("a preset");
        assert_eq!(held(&sound), []);
        let warned = |change: fn(&mut Frame)| {
            let mut frame = sound.clone();
            change(&mut frame);
            held(&frame).into_iter().map(|finding| finding.levers.concat()).collect::<Vec<_>>()
        };
        assert_eq!(warned(|frame| frame.bracket.magnet_clearance_mm = 0.05), CLEARANCE);
        assert_eq!(warned(|frame| frame.bracket.magnet_gap_mm = 0.8), APART);
        assert_eq!(warned(|frame| frame.bracket.connector_step_mm = 0.0), STEP);
        let without = |frame: &mut Frame| {
            frame.bracket.magnet_gap_mm = 0.8;
            frame.bought.remove("magnet");
        };
        assert_eq!(warned(without), Vec::<String>::new());
    }
}
