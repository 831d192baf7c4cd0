//! Holes are where those of what they hold are, let their screws through, and do not let slip what keeps them.

use super::comparison::{SAME_MM, measure, name, part};
use crate::checks::finding::Finding;
use crate::checks::scene::Scene;
use crate::frame::skeleton::{Accessories, SLOT_MM, Stack};
use crate::params::Frame;
use crate::params::catalogue::{BoughtPart, HOLE_PLAY_MM};

pub(super) const SHAFT: &[&str] = &["motor_mount.motor_shaft_hole_mm", "bought.motor"];
pub(super) const FLIGHT_HOLES: &[&str] = &["bought.flight_controller", "bought.stack_screw", "bought.damper"];
pub(super) const STACK_HOLES: &[&str] = &["bought.motor_controller", "bought.stack_screw", "bought.damper"];
pub(super) const MOTOR_HOLES: &[&str] = &["motor_mount.motor_hole_circle_mm", "bought.motor"];
pub(super) const COMPUTER_HOLES: &[&str] = &["pi_carrier.pi_pattern_along_mm", "pi_carrier.pi_pattern_across_mm", "bought.computer"];
pub(super) const CAMERA_HOLES: &[&str] = &["camera.camera_pattern_across_mm", "camera.camera_pattern_up_mm", "bought.camera"];
pub(super) const TIED: &[&str] = &["accessories.accessory_side_mm", "bought.receiver", "bought.buzzer"];
pub(super) const SLOTS: &[&str] = &["accessories.accessory_slot_mm", "bought.tie"];
pub(super) const SENSOR_HOLES: &[&str] = &["sleeve.sensor_hole_pitch_mm", "bought.flow_sensor"];
pub(super) const CONNECTOR_HOLES: &[&str] = &["camera.camera_hole_diameter_mm"];
pub(super) const PLATE_HOLES: &[&str] = &["accessories.fpv_hole_diameter_mm"];
pub(super) const COMPUTER_ALONE: &[&str] = &["bought.computer"];
pub(super) const CAMERA_ALONE: &[&str] = &["bought.camera"];
pub(super) const SENSOR_ALONE: &[&str] = &["bought.flow_sensor"];

/// Least wall of a damper's neck around the screw in it, mm: M2 dampers are made for holes of 3 mm, thinner rubber is cut by the thread.
const NECK_MM: f64 = 0.25;
/// Least width by which what keeps a board on its screw is wider than the board's hole, on each side, mm: the rim of an M2 damper has 1 mm, an
/// M2 nut 0.5 mm beside a hole of 3 mm.
const RIM_MM: f64 = 0.25;
/// Holes that the small screws of the bill are for, mm: M2 is the smallest of them, and their washers have 5 mm.
const SMALL_SCREWS_MM: [f64; 2] = [2.0, 4.5];

/// The boards of the stack let their screws through, with the dampers that they hang in, and what keeps them on the screws does not slip
/// through their holes.
pub(super) fn stack_holes(scene: &Scene) -> Vec<Finding> {
    let frame = &scene.design.frame;
    let Some(thread) = part(frame, "stack_screw").and_then(|screw| screw.thread_mm) else { return Vec::new() };
    let stack = Stack::new(frame, &scene.design.centre);
    let mut found = Vec::new();
    for board in &stack.boards {
        let Some(hole) = board.part.hole_diameter_mm else { continue };
        let levers = if board.role == "flight_controller" { FLIGHT_HOLES } else { STACK_HOLES };
        let (called, subject) = (name(frame, board.role), format!("holes of the {}", board.role));
        let damper = board.dampers;
        let (what, least) = match damper {
            Some(_) => (format!("the neck of a damper around the screw of {thread} mm"), thread + 2.0 * NECK_MM),
            None => ("the screw".into(), thread),
        };
        let passed = measure(hole, least, "mm", levers);
        let [wide, needed] = passed.figures(2);
        let bare = damper.is_some() && (thread..least).contains(&hole);
        let bare = if bare { "; with damper = \"none\" it hangs on the screws alone" } else { "" };
        let message = format!("the holes of {called} are {wide} mm wide, {what} needs {needed} mm{bare}");
        found.push(passed.at_least(format!("{subject}: screw"), message));
        let across = |what: &'static str, part: &BoughtPart| (what, part.size_mm[0].min(part.size_mm[1]));
        // Below an outer board is a nut, above it are spacers; a damper is both.
        let [above, below] =
            [board.spacers.map(|spacers| across("a spacer", spacers.part)), part(frame, "stack_nut").map(|nut| across("a nut", nut))];
        let narrower = || above.into_iter().chain(below).min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((what, across)) = damper.map(|damper| across("a damper", damper)).or_else(narrower) else { continue };
        let kept = measure(hole, across - 2.0 * RIM_MM, "mm", levers);
        let [wide, most] = kept.figures(2);
        let message = format!("the holes of {called} are {wide} mm wide, {what} of {across} mm keeps it on its screw up to {most} mm");
        found.push(kept.at_most(format!("{subject}: what keeps it"), message));
    }
    found
}

/// Boards that small screws hold have holes for these.
pub(super) fn small_holes(frame: &Frame) -> Vec<Finding> {
    let held = [("computer", COMPUTER_ALONE), ("camera", CAMERA_ALONE), ("flow_sensor", SENSOR_ALONE)];
    let [least, most] = SMALL_SCREWS_MM;
    let of = |(role, levers): (&'static str, &'static [&'static str])| {
        let hole = part(frame, role)?.hole_diameter_mm?;
        let called = name(frame, role);
        let (passed, kept) = (measure(hole, least, "mm", levers), measure(hole, most, "mm", levers));
        let ([wide, needed], [_, room]) = (passed.figures(2), kept.figures(2));
        let through = format!("the holes of {called} are {wide} mm wide, the smallest screw of the bill needs {needed} mm");
        let washer = format!("the holes of {called} are {wide} mm wide, a washer of the bill keeps it on its screw up to {room} mm");
        Some([
            passed.at_least(format!("holes of the {role}: screw"), through),
            kept.at_most(format!("holes of the {role}: what keeps it"), washer),
        ])
    };
    held.into_iter().filter_map(of).flatten().collect()
}

/// The holes that carry a bought part are where it has its own.
pub(super) fn holes(frame: &Frame) -> Vec<Finding> {
    let [motor, computer, camera, sensor] = ["motor", "computer", "camera", "flow_sensor"].map(|role| part(frame, role));
    let (carrier, hung) = (&frame.pi_carrier, &frame.camera);
    let own: [(&str, Option<f64>, f64, &'static [&'static str]); 6] = [
        ("motor", motor.and_then(|m| m.hole_pcd_mm), frame.motor_mount.motor_hole_circle_mm, MOTOR_HOLES),
        ("computer, along", computer.and_then(|c| Some(c.hole_pattern_mm?[0])), carrier.pi_pattern_along_mm, COMPUTER_HOLES),
        ("computer, across", computer.and_then(|c| Some(c.hole_pattern_mm?[1])), carrier.pi_pattern_across_mm, COMPUTER_HOLES),
        ("camera, across", camera.and_then(|c| Some(c.hole_pattern_mm?[0])), hung.camera_pattern_across_mm, CAMERA_HOLES),
        ("camera, up", camera.and_then(|c| Some(c.hole_pattern_mm?[1])), hung.camera_pattern_up_mm, CAMERA_HOLES),
        ("flow_sensor", sensor.and_then(|s| s.hole_pitch_mm), frame.sleeve.sensor_hole_pitch_mm, SENSOR_HOLES),
    ];
    let off = |(which, own, held, levers): (&str, Option<f64>, f64, &'static [&'static str])| {
        let (own, role) = (own?, which.split(',').next().unwrap_or(which));
        let message = format!("the holes of {} are {own} mm apart, those that hold it {held} mm", name(frame, role));
        Some(measure((own - held).abs(), HOLE_PLAY_MM, "mm", levers).at_most(format!("holes of the {which}"), message))
    };
    own.into_iter().filter_map(off).chain(shaft_hole(frame)).collect()
}

/// The mount lets the motor's shaft through, with what keeps it in the motor.
fn shaft_hole(frame: &Frame) -> Option<Finding> {
    let needs = part(frame, "motor")?.shaft_hole_diameter_mm.filter(|needs| *needs > 0.0)?;
    let hole = measure(frame.motor_mount.motor_shaft_hole_mm, needs - SAME_MM, "mm", SHAFT);
    let message =
        format!("the mount's hole below the shaft is {} mm wide, {} needs one of {needs} mm", hole.figures(2)[0], name(frame, "motor"));
    Some(hole.at_least("holes of the motor: shaft".into(), message))
}

/// Printed holes that small screws go through have room for them.
pub(super) fn small_printed_holes(frame: &Frame) -> Vec<Finding> {
    let printed: [(&str, f64, &'static [&'static str]); 2] = [
        ("camera", frame.camera.camera_hole_diameter_mm, CONNECTOR_HOLES),
        ("fpv_camera", frame.accessories.fpv_hole_diameter_mm, PLATE_HOLES),
    ];
    let of = |(role, hole, levers): (&str, f64, &'static [&'static str])| {
        part(frame, role)?;
        let passed = measure(hole, SMALL_SCREWS_MM[0], "mm", levers);
        let [wide, needed] = passed.figures(2);
        let message =
            format!("the printed holes for {} are {wide} mm wide, the smallest screw of the bill needs {needed} mm", name(frame, role));
        Some(passed.at_least(format!("holes for the {role}: screw"), message))
    };
    printed.into_iter().filter_map(of).collect()
}

/// The slots for the ties of receiver and buzzer have room on the accessory plate.
pub(super) fn tied(scene: &Scene) -> Vec<Finding> {
    let frame = &scene.design.frame;
    let seats = Accessories::new(frame, &scene.design.centre);
    let [least, most] = seats.slot_room_mm(frame);
    let of = |role: &str| {
        let [inner, outer] = seats.slot_x_mm(part(frame, role)?);
        let (inner, outer) = (measure(inner - 0.5 * SLOT_MM, least, "mm", TIED), measure(outer + 0.5 * SLOT_MM, most, "mm", TIED));
        let ([near, needed], [far, room], called) = (inner.figures(2), outer.figures(2), name(frame, role));
        Some([
            inner.at_least(
                format!("ties of the {role}: inner slot"),
                format!("the inner slot beside {called} is {near} mm from the hub's axis, {needed} mm keep it off the other side's"),
            ),
            outer.at_most(
                format!("ties of the {role}: outer slot"),
                format!("the outer slot beside {called} reaches {far} mm from the hub's axis, the tie hole leaves {room} mm"),
            ),
        ])
    };
    let tied = ["receiver", "buzzer"].into_iter().any(|role| part(frame, role).is_some());
    let strap_mm = part(frame, "tie").and_then(|tie| tie.strap_mm).filter(|_| tied);
    let slot = strap_mm.map(|[wide_mm, _]| {
        let slot = measure(frame.accessories.accessory_slot_mm, wide_mm, "mm", SLOTS);
        let [long, needed] = slot.figures(2);
        slot.at_least(
            "ties of receiver and buzzer: slot".into(),
            format!("the slots for their ties are {long} mm long, {} is {needed} mm wide", name(frame, "tie")),
        )
    });
    ["receiver", "buzzer"].into_iter().filter_map(of).flatten().chain(slot).collect()
}

#[cfg(test)]
mod tests {
    use crate::checks::hardware::tests::{broken, own};

    #[test]
    fn planted_holes_of_boards_that_do_not_take_what_holds_them() {
        let of = |role: &'static str, hole_mm: f64| broken(|frame| own(frame, role, |board| board.hole_diameter_mm = Some(hole_mm)));
        let says = |role: &str, what: &str| vec![format!("holes of the {role}: {what}")];
        // An M2 screw with a damper's neck around it in the flight controller, alone in the board below it.
        assert_eq!(of("flight_controller", 2.5), Vec::<String>::new());
        assert_eq!(of("flight_controller", 2.4), says("flight_controller", "screw"));
        assert_eq!(of("motor_controller", 2.0), Vec::<String>::new());
        assert_eq!(of("motor_controller", 1.9), says("motor_controller", "screw"));
        // A damper has 5 mm, a nut 4 mm.
        assert_eq!(of("flight_controller", 4.6), says("flight_controller", "what keeps it"));
        assert_eq!(of("motor_controller", 3.6), says("motor_controller", "what keeps it"));
        for role in ["computer", "camera", "flow_sensor"] {
            assert_eq!(of(role, 1.9), says(role, "screw"));
            assert_eq!(of(role, 4.6), says(role, "what keeps it"));
        }
        let alone = broken(|frame| {
            frame.bought.remove("flight_controller");
            own(frame, "motor_controller", |board| board.hole_diameter_mm = Some(2.0));
        });
        assert_eq!(alone, says("motor_controller", "screw"), "an only board hangs in the dampers");
    }

    #[test]
    fn planted_holes_elsewhere() {
        assert_eq!(broken(|frame| frame.camera.camera_pattern_up_mm = 14.0), ["holes of the camera, up"]);
        assert_eq!(broken(|frame| frame.motor_mount.motor_hole_circle_mm = 8.0), ["holes of the motor"]);
        assert_eq!(broken(|frame| frame.motor_mount.motor_shaft_hole_mm = 0.0), ["holes of the motor: shaft"]);
        assert_eq!(broken(|frame| frame.camera.camera_hole_diameter_mm = 1.5), ["holes for the camera: screw"]);
    }
}
