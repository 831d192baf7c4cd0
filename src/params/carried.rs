//! Which bought parts a frame can carry in which roles: those whose numbers are within the bounds of the keys that follow from them.

use super::catalogue::BoughtPart;
use super::follows;
use super::frame::catalogue;
use super::parameter::Parameter;

/// What carries a role's part, in a refusal; a place, where it is none of these.
const CARRIERS: [(&str, &str); 11] = [
    ("motor", "motor mount"),
    ("battery", "sleeve"),
    ("rod", "joint"),
    ("computer", "carrier"),
    ("flight_controller", "place under the hub"),
    ("motor_controller", "place under the hub"),
    ("camera", "camera connector"),
    ("flow_sensor", "tray"),
    ("connector", "channel"),
    ("magnet", "pocket"),
    ("propeller", "place on the motor"),
];

/// What carries a role's part.
pub(super) fn carrier(role: &str) -> &'static str {
    CARRIERS.iter().find(|(known, _)| *known == role).map_or("place", |(_, carrier)| carrier)
}

/// Whether every number that follows from a part alone, in a role, is within its bounds. What follows from two parts is not looked at, and of
/// what grows with another number its usual value.
pub fn is_carried(role: &str, part: &BoughtPart) -> bool {
    let is_within = |p: &Parameter| follows::from_part(role, part, p.key).is_none_or(|value| (p.min..=p.max).contains(&value));
    catalogue().all(is_within)
}

#[cfg(test)]
mod tests {
    use super::super::frame_file::{FrameFile, Value};
    use super::super::preset::{self, names_in};
    use super::super::refusal::Reason;
    use super::super::roles::ROLES;
    use crate::params::Frame;

    #[test]
    fn analytic_boards_are_offered_where_their_holes_are_within_bounds() {
        assert_eq!(names_in("computer"), ["pi-zero-w"]);
        let boards = ["aio-20x20", "esc-4in1-20x20", "flight-controller-20x20"];
        assert_eq!([names_in("flight_controller"), names_in("motor_controller")], [boards.map(String::from), boards.map(String::from)]);
        assert_eq!(names_in("tail"), Vec::<String>::new());
    }

    /// Of every shipped part of a role's kind: a frame refuses it where it is not offered, and never for a number that follows from it
    /// where it is.
    #[test]
    fn analytic_what_is_not_offered_is_refused_with_what_to_do() {
        let file = FrameFile::load("cognifly").expect("is a preset");
        for (role, _, kind) in ROLES {
            for name in preset::part_names(kind) {
                let mut chosen = file.clone();
                chosen.set(&format!("bought.{role}"), Value::Text(name.clone()));
                let refusal = Frame::resolve(&chosen).err();
                let not_carried = refusal.as_ref().is_some_and(|refusal| matches!(*refusal.reason, Reason::NotCarried { .. }));
                match names_in(role).contains(&name) {
                    true => assert!(!not_carried, "{role} = {name}: {refusal:?}"),
                    false => assert!(refusal.is_some(), "{role} = {name}"),
                }
            }
        }
        let mut feather = file;
        feather.set("bought.computer", Value::Text("feather-m0".into()));
        let refusal = Frame::resolve(&feather).expect_err("has no carrier");
        assert!(
            refusal.to_string().starts_with("there is no carrier for the computer `feather-m0`: `pi_carrier.pi_pattern_a"),
            "{refusal}"
        );
        let remedy = refusal.remedy();
        assert!(remedy.contains("choose another computer") && remedy.contains("entry of [extras]"), "{remedy}");
        assert!(!remedy.contains("nearest allowed"), "{remedy}");
    }
}
