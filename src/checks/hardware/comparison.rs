//! What the comparisons of bought parts share.

use crate::checks::measure::Measure;
use crate::params::Frame;
use crate::params::catalogue::BoughtPart;

/// The rule's id.
pub(super) const ID: &str = "hardware_fit";
/// Two sizes that should be one may differ by this, mm: more than tolerances of stock, less than between two sizes that are sold.
pub(super) const SAME_MM: f64 = 0.1;

/// A bought part of a frame, by its role.
pub(super) fn part<'a>(frame: &'a Frame, role: &str) -> Option<&'a BoughtPart> {
    frame.bought.get(role).map(|item| &item.part)
}

/// Its name; empty where the frame has none.
pub(super) fn name<'a>(frame: &'a Frame, role: &str) -> &'a str {
    frame.bought.get(role).map_or("", |item| &item.name)
}

/// A comparison on its way to a finding.
pub(super) fn measure(value: f64, limit: f64, unit: &'static str, levers: &'static [&'static str]) -> Measure {
    Measure { rule: ID, value, limit, unit, levers }
}
