//! Numbers that follow from the choice of a bought part, or from another number, unless a frame file states them.

use std::collections::BTreeMap;

use super::catalogue::BoughtPart;
use super::frame::BoughtItem;
use super::roles::HUNG;

/// Room around a connector's section in its channel, across and up together, mm: 10.55 x 5.55 around an XT30.
pub const CONNECTOR_CLEARANCE_MM: f64 = 0.35;

/// From a motor's face to the underside of its propeller, mm: what the catalogued sizes leave of the 14.2 mm from plate to propeller
/// that the real frame's side view shows (CogniFly-STL, Right.png, to +-2 mm): 10.8 mm of motor, half of 5.0 mm of propeller.
const PROPELLER_GAP_MM: f64 = 0.9;

/// The fork's bar over its rod, mm: as on the real frame, whose bar is 5.6 mm high for rods of 3 mm. The whole fork is as thick, and
/// so cuts its sockets flat where it lies on the bed.
const BAR_OVER_ROD_MM: f64 = 2.6;

/// The gap between the fork's cheeks over its rod, mm: as on the real frame, 6.13 mm for rods of 3 mm that are held in
/// bores of 2.7 mm. The knee between them is as wide as its strut's bore with two walls, so the gap grows with the grip's clearance.
const CHEEKS_OVER_ROD_MM: f64 = 3.13;

/// The motor's plate over the circle and a hole of its screws, mm: as on the real frame, 15 mm around holes of 2 mm on 9 mm.
const PLATE_OVER_HOLES_MM: f64 = 4.0;

/// Everything bought, by role.
type Bought = BTreeMap<String, BoughtItem>;

/// A number that follows from a bought part.
struct Follows {
    key: &'static str,
    /// The roles that it may follow from; the first that the frame has counts.
    roles: &'static [&'static str],
    /// Fields of the entry that it follows from.
    fields: &'static [&'static str],
    figure: fn(&BoughtPart, &Bought) -> Option<f64>,
    /// What holds when the frame does without that part.
    without: Option<f64>,
}

impl Follows {
    /// From a part that every frame has.
    const fn always(key: &'static str, roles: &'static [&'static str], figure: fn(&BoughtPart, &Bought) -> Option<f64>) -> Self {
        Self { key, roles, fields: &[], figure, without: None }
    }

    /// From a part that a frame may do without.
    const fn or(key: &'static str, roles: &'static [&'static str], figure: fn(&BoughtPart, &Bought) -> Option<f64>, without: f64) -> Self {
        Self { key, roles, fields: &[], figure, without: Some(without) }
    }

    /// The same, of these fields of the entry.
    const fn of(self, fields: &'static [&'static str]) -> Self {
        Self { fields, ..self }
    }
}

const FOLLOWS: [Follows; 24] = [
    Follows::always("rod_diameter_mm", &["rod"], |rod, _| rod.diameter_mm).of(&["diameter_mm"]),
    Follows::always("fork_bar_height_mm", &["rod"], |rod, _| Some(sum_mm([rod.diameter_mm?, BAR_OVER_ROD_MM]))).of(&["diameter_mm"]),
    Follows::always("fork_cheek_gap_mm", &["rod"], |rod, _| Some(sum_mm([rod.diameter_mm?, CHEEKS_OVER_ROD_MM]))).of(&["diameter_mm"]),
    Follows::always("propeller_diameter_mm", &["propeller"], |propeller, _| propeller.diameter_mm).of(&["diameter_mm"]),
    Follows::always("propeller_height_mm", &["propeller"], propeller_height_mm),
    Follows::always("battery_length_mm", &["battery"], |battery, _| Some(battery.size_mm[0])).of(&["size_mm"]),
    Follows::always("battery_width_mm", &["battery"], |battery, _| Some(battery.size_mm[1])).of(&["size_mm"]),
    Follows::always("battery_height_mm", &["battery"], |battery, _| Some(battery.size_mm[2])).of(&["size_mm"]),
    Follows::always("battery_mass_g", &["battery"], |battery, _| Some(battery.mass_g)).of(&["mass_g"]),
    Follows::always("motor_plate_diameter_mm", &["motor"], motor_plate_mm).of(&["hole_pcd_mm", "hole_diameter_mm"]),
    Follows::always("motor_hole_circle_mm", &["motor"], |motor, _| motor.hole_pcd_mm).of(&["hole_pcd_mm"]),
    Follows::always("motor_hole_diameter_mm", &["motor"], |motor, _| motor.hole_diameter_mm).of(&["hole_diameter_mm"]),
    Follows::always("motor_shaft_hole_mm", &["motor"], |motor, _| motor.shaft_hole_diameter_mm).of(&["shaft_hole_diameter_mm"]),
    Follows::or("stack_pattern_mm", &HUNG, |board, _| Some(board.hole_pattern_mm?[0]), 20.0).of(&["hole_pattern_mm"]),
    Follows::or("pi_pattern_along_mm", &["computer"], |board, _| Some(board.hole_pattern_mm?[0]), 58.0).of(&["hole_pattern_mm"]),
    Follows::or("pi_pattern_across_mm", &["computer"], |board, _| Some(board.hole_pattern_mm?[1]), 23.0).of(&["hole_pattern_mm"]),
    Follows::or("camera_pattern_across_mm", &["camera"], |camera, _| Some(camera.hole_pattern_mm?[0]), 21.0).of(&["hole_pattern_mm"]),
    Follows::or("camera_pattern_up_mm", &["camera"], |camera, _| Some(camera.hole_pattern_mm?[1]), 12.5).of(&["hole_pattern_mm"]),
    Follows::or("sensor_hole_pitch_mm", &["flow_sensor"], |sensor, _| sensor.hole_pitch_mm, 30.5).of(&["hole_pitch_mm"]),
    Follows::or("magnet_length_mm", &["magnet"], |magnet, _| Some(magnet.size_mm[0]), 10.0).of(&["size_mm"]),
    Follows::or("magnet_width_mm", &["magnet"], |magnet, _| Some(magnet.size_mm[1]), 5.0).of(&["size_mm"]),
    Follows::or("magnet_thickness_mm", &["magnet"], |magnet, _| Some(magnet.size_mm[2]), 3.0).of(&["size_mm"]),
    Follows::or("connector_width_mm", &["connector"], |c, _| Some(c.size_mm[1] + CONNECTOR_CLEARANCE_MM), 10.55).of(&["size_mm"]),
    Follows::or("connector_height_mm", &["connector"], |c, _| Some(c.size_mm[2] + CONNECTOR_CLEARANCE_MM), 5.55).of(&["size_mm"]),
];

/// Numbers that are another number unless a file states them: key, and the other one with its table.
const SAME_AS: [(&str, &str); 1] = [("envelope_depth_mm", "limits.envelope_width_mm")];

/// Numbers that grow, beside what they follow from, with another number: key, the other one with its table, and its usual value. The knee
/// between the fork's cheeks is wider where its bores are.
const GROW_WITH: [(&str, &str, f64); 1] = [("fork_cheek_gap_mm", "fit.grip_clearance_mm", -0.3)];

/// The number, with its table, that a key grows with unless a file states it, and that number's usual value.
pub(super) fn grows_with(key: &str) -> Option<(&'static str, f64)> {
    GROW_WITH.iter().find(|(follower, ..)| *follower == key).map(|(_, other, usual)| (*other, *usual))
}

/// A number that follows from a bought part, with the other number that it grows with at a value of its own.
pub(super) fn grown_mm(followed_mm: f64, other_mm: f64, usual_mm: f64) -> f64 {
    sum_mm([followed_mm, other_mm, -usual_mm])
}

/// The number, with its table, that a key is equal to unless a file states it.
pub(super) fn same_as(key: &str) -> Option<&'static str> {
    SAME_AS.iter().find(|(follower, _)| *follower == key).map(|(_, followed)| *followed)
}

/// What a number follows from, in lists: a bought part's role, or another number's key with its table.
pub fn followed(key: &str) -> Option<&'static str> {
    role_of(key).or_else(|| same_as(key))
}

/// What a number follows from in a frame with these bought parts: a role, or another number's key with its table.
pub fn followed_in(bought: &Bought, key: &str) -> Option<&'static str> {
    role_in(bought, key).or_else(|| same_as(key))
}

/// The key that a number follows from in a frame with these bought parts: that of a part's choice, or another number's.
pub fn followed_key_in(bought: &Bought, key: &str) -> Option<String> {
    role_in(bought, key).map(|role| format!("bought.{role}")).or_else(|| same_as(key).map(String::from))
}

/// The key that a number follows from, in lists: that of a bought part's choice, or another number's.
pub fn followed_key(key: &str) -> Option<String> {
    role_of(key).map(|role| format!("bought.{role}")).or_else(|| same_as(key).map(String::from))
}

/// A sum without the noise that sums of decimals have: it is printed as the key's value.
fn sum_mm<const N: usize>(terms: [f64; N]) -> f64 {
    (terms.iter().sum::<f64>() * 1e6).round() / 1e6
}

/// The motor's plate: its rim around the screw holes.
fn motor_plate_mm(motor: &BoughtPart, _: &Bought) -> Option<f64> {
    Some(sum_mm([motor.hole_pcd_mm?, motor.hole_diameter_mm?, PLATE_OVER_HOLES_MM]))
}

/// From the motor's seat to the middle of its propeller: the propeller is on the motor.
fn propeller_height_mm(propeller: &BoughtPart, bought: &Bought) -> Option<f64> {
    let motor = &bought.get("motor")?.part;
    Some(sum_mm([motor.motor_height_mm(), PROPELLER_GAP_MM, 0.5 * propeller.hub_mm()]))
}

/// The number that a part alone gives a key in a role; none where the key does not follow from the role, or from more than the part.
pub(super) fn from_part(role: &str, part: &BoughtPart, key: &str) -> Option<f64> {
    let rule = FOLLOWS.iter().find(|rule| rule.key == key && rule.roles.contains(&role))?;
    (rule.figure)(part, &Bought::new())
}

/// The number that a bought part, or its absence, gives a key.
pub(super) fn from_bought(bought: &Bought, key: &str) -> Option<f64> {
    let rule = FOLLOWS.iter().find(|rule| rule.key == key)?;
    match rule.roles.iter().find_map(|role| bought.get(*role)) {
        Some(item) => (rule.figure)(&item.part, bought),
        None => rule.without,
    }
}

/// The role and the fields that a key's number needs of the bought part that it follows from, where that part lacks them.
pub(super) fn lacking(bought: &Bought, key: &str) -> Option<(&'static str, &'static [&'static str])> {
    let rule = FOLLOWS.iter().find(|rule| rule.key == key && !rule.fields.is_empty())?;
    let role = rule.roles.iter().find(|role| bought.contains_key(**role))?;
    Some((role, rule.fields))
}

/// The key of the entry's field that a number follows from, where a bought part of the frame is that entry.
pub(super) fn field_of(bought: &Bought, key: &str) -> Option<String> {
    let rule = FOLLOWS.iter().find(|rule| rule.key == key)?;
    let item = rule.roles.iter().find_map(|role| bought.get(*role))?;
    rule.fields.first().map(|field| format!("override.parts.{}.{field}", item.name))
}

/// The role of the bought part that a key's number follows from in a frame with these parts.
pub fn role_in(bought: &Bought, key: &str) -> Option<&'static str> {
    role_among(key, |role| bought.contains_key(role))
}

/// The same in a frame that has these roles: the first one counts.
pub fn role_among(key: &str, has: impl Fn(&str) -> bool) -> Option<&'static str> {
    let rule = FOLLOWS.iter().find(|rule| rule.key == key)?;
    rule.roles.iter().find(|role| has(role)).or(rule.roles.first()).copied()
}

/// The role of the bought part that a key's number follows from in a frame that has all of them.
pub fn role_of(key: &str) -> Option<&'static str> {
    role_among(key, |_| true)
}
