//! Numbers that follow from the choice of a bought part unless a frame file states them.

use std::collections::BTreeMap;

use super::catalogue::BoughtPart;
use super::frame::BoughtItem;

/// Room around a connector's section in its channel, across and up together, mm: 10.55 x 5.55 around an XT30.
const CONNECTOR_CLEARANCE_MM: f64 = 0.35;

/// A number that follows from a bought part.
struct Follows {
    key: &'static str,
    role: &'static str,
    figure: fn(&BoughtPart) -> Option<f64>,
    /// What holds when the frame does without that part.
    without: Option<f64>,
}

const FOLLOWS: [Follows; 16] = [
    Follows { key: "rod_diameter_mm", role: "rod", figure: |rod| rod.diameter_mm, without: None },
    Follows { key: "propeller_diameter_mm", role: "propeller", figure: |propeller| propeller.diameter_mm, without: None },
    Follows { key: "battery_length_mm", role: "battery", figure: |battery| Some(battery.size_mm[0]), without: None },
    Follows { key: "battery_width_mm", role: "battery", figure: |battery| Some(battery.size_mm[1]), without: None },
    Follows { key: "battery_height_mm", role: "battery", figure: |battery| Some(battery.size_mm[2]), without: None },
    Follows { key: "battery_mass_g", role: "battery", figure: |battery| Some(battery.mass_g), without: None },
    Follows { key: "motor_hole_circle_mm", role: "motor", figure: |motor| motor.hole_pcd_mm, without: None },
    Follows { key: "motor_hole_diameter_mm", role: "motor", figure: |motor| motor.hole_diameter_mm, without: None },
    Follows { key: "motor_shaft_hole_mm", role: "motor", figure: |motor| motor.shaft_hole_diameter_mm, without: None },
    Follows { key: "stack_pattern_mm", role: "flight_controller", figure: |board| Some(board.hole_pattern_mm?[0]), without: Some(20.0) },
    Follows { key: "pi_pattern_along_mm", role: "computer", figure: |board| Some(board.hole_pattern_mm?[0]), without: Some(58.0) },
    Follows { key: "pi_pattern_across_mm", role: "computer", figure: |board| Some(board.hole_pattern_mm?[1]), without: Some(23.0) },
    Follows { key: "magnet_length_mm", role: "magnet", figure: |magnet| Some(magnet.size_mm[0]), without: Some(10.0) },
    Follows { key: "magnet_width_mm", role: "magnet", figure: |magnet| Some(magnet.size_mm[1]), without: Some(5.0) },
    Follows { key: "connector_width_mm", role: "connector", figure: |c| Some(c.size_mm[1] + CONNECTOR_CLEARANCE_MM), without: Some(10.55) },
    Follows { key: "connector_height_mm", role: "connector", figure: |c| Some(c.size_mm[2] + CONNECTOR_CLEARANCE_MM), without: Some(5.55) },
];

/// The number that a bought part, or its absence, gives a key.
pub(super) fn from_bought(bought: &BTreeMap<String, BoughtItem>, key: &str) -> Option<f64> {
    let rule = FOLLOWS.iter().find(|rule| rule.key == key)?;
    match bought.get(rule.role) {
        Some(item) => (rule.figure)(&item.part),
        None => rule.without,
    }
}

/// The role of the bought part that a key's number follows from.
pub fn role_of(key: &str) -> Option<&'static str> {
    FOLLOWS.iter().find(|rule| rule.key == key).map(|rule| rule.role)
}
