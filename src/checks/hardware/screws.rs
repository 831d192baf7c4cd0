//! Screws of motors and boards have their threads, their heads' seats and their lengths.

use super::comparison::{SAME_MM, measure, name, part};
use crate::checks::finding::Finding;
use crate::checks::scene::Scene;
use crate::frame::mounting::pilot_hole_mm;
use crate::frame::skeleton::Stack;
use crate::params::Frame;

pub(super) const MOTOR_THREAD: &[&str] = &["bought.motor_screw", "bought.motor"];
pub(super) const MOTOR_HEAD: &[&str] = &["motor_mount.motor_hole_diameter_mm", "bought.motor_screw"];
pub(super) const MOTOR_LENGTH: &[&str] = &["bought.motor_screw", "motor_mount.motor_plate_thickness_mm"];
pub(super) const STACK_THREAD: &[&str] = &["hub.stack_pilot_diameter_mm", "bought.stack_screw"];
/// What goes onto the stack's screws, each with what drives whether it fits.
pub(super) const ON_STACK: [(&str, &str, &[&str]); 3] = [
    ("stack_nut", "nut", &["bought.stack_nut", "bought.stack_screw"]),
    ("stack_spacer", "spacer", &["bought.stack_spacer", "bought.stack_screw"]),
    ("damper", "damper", &["bought.damper", "bought.stack_screw"]),
];
pub(super) const STACK_HEAD: &[&str] = &["hub.stack_counterbore_diameter_mm", "bought.stack_screw"];
pub(super) const STACK_FLOOR: &[&str] = &["hub.stack_counterbore_depth_mm", "hub.hub_plate_thickness_mm"];
pub(super) const STACK_LENGTH: &[&str] = &["bought.stack_screw", "hub.stack_counterbore_depth_mm"];

/// Least engagement of a screw, in diameters: the real frame's M2 x 4 through 2.5 mm reach into the motor by 0.75.
pub(super) const ENGAGED: f64 = 0.5;
/// Most engagement, in diameters: beyond, screws of small motors meet the windings.
const ENGAGED_MOST: f64 = 1.5;
/// Height of a nut that the frame does not state, in diameters (ISO 4032: 1.6 mm of M2, 2.4 mm of M3).
const NUT: f64 = 0.8;
/// Least width of plate below the head of a screw, beside its hole, mm: half a millimetre all around.
const UNDER_HEAD_MM: f64 = 1.0;
/// Least plate under the head of a screw of the stack, mm: six layers, without which the head is pulled through.
const FLOOR_MM: f64 = 1.2;

/// The motors' screws have their thread, and reach in far enough, and not too far.
pub(super) fn motor_screws(frame: &Frame) -> Vec<Finding> {
    let (Some(screw), Some(motor)) = (part(frame, "motor_screw"), part(frame, "motor")) else { return Vec::new() };
    let (Some(thread), Some(length)) = (screw.thread_mm, screw.length_mm) else { return Vec::new() };
    let called = name(frame, "motor_screw");
    let mut found = Vec::new();
    if let Some(hole) = motor.hole_diameter_mm {
        let message = format!("{called} has a thread of {thread} mm, the holes of {} one of {hole} mm", name(frame, "motor"));
        found.push(measure((thread - hole).abs(), SAME_MM, "mm", MOTOR_THREAD).at_most("screw of the motor: thread".into(), message));
    }
    let mount = &frame.motor_mount;
    if let Some(head) = screw.head_diameter_mm {
        let carried = measure(head - mount.motor_hole_diameter_mm, UNDER_HEAD_MM, "mm", MOTOR_HEAD);
        let [rim, needed] = carried.figures(2);
        let message = format!(
            "the head of {called}, {head} mm wide, is {rim} mm wider than its hole of {} mm in the mount, {needed} mm keep it from being pulled through",
            mount.motor_hole_diameter_mm
        );
        found.push(carried.at_least("screw of the motor: head".into(), message));
    }
    let plate = mount.motor_plate_thickness_mm;
    let engaged = length - plate;
    let least = measure(engaged, ENGAGED * thread, "mm", MOTOR_LENGTH);
    let [reach, need] = least.figures(2);
    let message = format!("{called} goes through {plate} mm of plate and {reach} mm into the motor, {need} mm are needed");
    found.push(least.at_least("screw of the motor: engagement".into(), message));
    let most = measure(engaged, ENGAGED_MOST * thread, "mm", MOTOR_LENGTH);
    let [reach, room] = most.figures(2);
    let message = format!("{called} goes {reach} mm into the motor; beyond {room} mm screws meet the windings");
    found.push(most.at_most("screw of the motor: windings".into(), message));
    found
}

/// The screws of the stack bite into the hub, sink into it, and reach through boards and nuts.
pub(super) fn stack_screws(scene: &Scene) -> Vec<Finding> {
    let (frame, centre) = (&scene.design.frame, &scene.design.centre);
    let Some(screw) = part(frame, "stack_screw") else { return Vec::new() };
    let stack = Stack::new(frame, centre);
    let (Some(thread), Some(length), Some(lowest)) = (screw.thread_mm, screw.length_mm, stack.nut_seat_mm()) else {
        return Vec::new();
    };
    let (called, hub) = (name(frame, "stack_screw"), &frame.hub);
    let [narrow, wide] = pilot_hole_mm(thread).map(|limit| measure(hub.stack_pilot_diameter_mm, limit, "mm", STACK_THREAD));
    let ([hole, least], [bored, most]) = (narrow.figures(2), wide.figures(2));
    let splits = format!("the pilot holes in the hub are {hole} mm wide, {called} splits what is narrower than {least} mm");
    let slips = format!("the pilot holes in the hub are {bored} mm wide, {called} holds in {most} mm");
    let mut found =
        vec![narrow.at_least("screw of the stack: splitting".into(), splits), wide.at_most("screw of the stack: bite".into(), slips)];
    for (role, word, levers) in ON_STACK {
        let Some(own) = part(frame, role).and_then(|part| part.thread_mm) else { continue };
        let message = format!("{} goes onto a screw M{own}, {called} is M{thread}", name(frame, role));
        found.push(measure((own - thread).abs(), SAME_MM, "mm", levers).at_most(format!("screw of the stack: {word}"), message));
    }
    if let Some(head) = screw.head_diameter_mm {
        let sunk = measure(head, hub.stack_counterbore_diameter_mm, "mm", STACK_HEAD);
        let [wide, bore] = sunk.figures(2);
        let message = format!("the head of {called} is {wide} mm wide, its counterbore {bore} mm");
        found.push(sunk.at_most("screw of the stack: head".into(), message));
        let floor = measure(hub.hub_plate_thickness_mm - hub.stack_counterbore_depth_mm, FLOOR_MM, "mm", STACK_FLOOR);
        let [left, needed] = floor.figures(2);
        let message = format!("{left} mm of the hub's plate carry the head of {called}, {needed} mm are needed");
        found.push(floor.at_least("screw of the stack: floor".into(), message));
    }
    let beyond =
        measure(lowest - (stack.seat_mm - length), part(frame, "stack_nut").map_or(NUT * thread, |nut| nut.size_mm[2]), "mm", STACK_LENGTH);
    let [reach, nut] = beyond.figures(2);
    let ends = reach.strip_prefix('-').map_or(format!("reaches {reach} mm beyond"), |short| format!("ends {short} mm short of"));
    let message = match beyond.value < beyond.limit {
        true => format!(
            "{called} {ends} what it holds under the hub, a nut is {nut} mm high: the screw has to be {:.1} mm long",
            // Up to the next tenth: rounded down it might be what it is.
            (10.0 * (length + beyond.limit - beyond.value) - 1e-6).ceil() / 10.0
        ),
        false => format!("{called} {ends} what it holds under the hub, a nut is {nut} mm high"),
    };
    found.push(beyond.at_least("screw of the stack: length".into(), message));
    found
}

#[cfg(test)]
mod tests {
    use crate::checks::hardware::tests::{broken, own};

    #[test]
    fn planted_screws_that_do_not_fit() {
        assert_eq!(broken(|frame| own(frame, "motor_screw", |screw| screw.length_mm = Some(3.0))), ["screw of the motor: engagement"]);
        assert_eq!(broken(|frame| own(frame, "motor_screw", |screw| screw.length_mm = Some(6.0))), ["screw of the motor: windings"]);
        assert_eq!(broken(|frame| own(frame, "motor", |motor| motor.hole_diameter_mm = Some(1.6))), ["screw of the motor: thread"]);
        assert_eq!(broken(|frame| own(frame, "stack_screw", |screw| screw.length_mm = Some(6.0))), ["screw of the stack: length"]);
        let m3 = broken(|frame| {
            own(frame, "stack_screw", |screw| {
                (screw.thread_mm, screw.head_diameter_mm, screw.length_mm) = (Some(3.0), Some(5.5), Some(20.0))
            });
        });
        assert_eq!(broken(|frame| frame.motor_mount.motor_hole_diameter_mm = 3.1), ["screw of the motor: head"]);
        assert_eq!(
            broken(|frame| (frame.hub.hub_plate_thickness_mm, frame.hub.stack_counterbore_depth_mm) = (2.5, 2.4))
                .first()
                .map(String::as_str),
            Some("screw of the stack: floor")
        );
        let unlike = ["nut", "spacer", "damper"].map(|word| format!("screw of the stack: {word}"));
        assert_eq!(m3[1..4], unlike);
        assert_eq!(
            [&m3[..1], &m3[4..]].concat(),
            ["screw of the stack: splitting", "screw of the stack: head", "holes of the flight_controller: screw"]
        );
    }

    #[test]
    fn planted_pilot_holes_of_the_stack() {
        let m2 = |hole_mm: f64| broken(|frame| frame.hub.stack_pilot_diameter_mm = hole_mm);
        assert_eq!(m2(1.6), Vec::<String>::new());
        assert_eq!(m2(1.5), ["screw of the stack: splitting"]);
        assert_eq!(m2(2.1), ["screw of the stack: bite"], "wider than the screw");
        let m3 = |hole_mm: f64| {
            broken(|frame| {
                own(frame, "stack_screw", |screw| screw.thread_mm = Some(3.0));
                frame.hub.stack_pilot_diameter_mm = hole_mm;
            })
        };
        for (hole_mm, splits) in [(2.3, true), (2.5, false), (2.7, false), (2.9, false)] {
            let found = m3(hole_mm);
            let says = |what: &str| found.iter().any(|subject| subject == what);
            assert_eq!([says("screw of the stack: splitting"), says("screw of the stack: bite")], [splits, false], "{hole_mm}");
        }
    }
}
