//! Bought parts go together: rods with what the bill of materials says they are, screws with the holes and threads that take them,
//! boards with the holes that carry them, propellers with their motors and inside of the cage.
//!
//! What is compared is what the catalogue states and what the frame has. A figure that an entry does not state is not compared.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4};

use super::finding::Finding;
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Pass, Rule};
use super::scene::{Placed, Scene, bounds_of};
use crate::frame::assembly::Kind;
use crate::frame::skeleton::{Accessories, SLOT_MM, Stack};
use crate::params::Frame;
use crate::params::catalogue::BoughtPart;

const ROD: &[&str] = &["rods.rod_diameter_mm", "bought.rod"];
const ROD_ALONE: &[&str] = &["bought.rod"];
const STOCK: &[&str] = &["bought.rod", "rods.cage_rod_length_mm", "rods.arm_rod_length_mm"];
const MOTOR_THREAD: &[&str] = &["bought.motor_screw", "bought.motor"];
const MOTOR_HEAD: &[&str] = &["motor_mount.motor_hole_diameter_mm", "bought.motor_screw"];
const SHAFT: &[&str] = &["motor_mount.motor_shaft_hole_mm", "bought.motor"];
const MOTOR_LENGTH: &[&str] = &["bought.motor_screw", "motor_mount.motor_plate_thickness_mm"];
const STACK_THREAD: &[&str] = &["hub.stack_pilot_diameter_mm", "bought.stack_screw"];
const STACK_HEAD: &[&str] = &["hub.stack_counterbore_diameter_mm", "bought.stack_screw"];
const STACK_FLOOR: &[&str] = &["hub.stack_counterbore_depth_mm", "hub.hub_plate_thickness_mm"];
const STACK_LENGTH: &[&str] = &["bought.stack_screw", "hub.stack_counterbore_depth_mm"];
const FLIGHT_HOLES: &[&str] = &["bought.flight_controller", "bought.stack_screw", "bought.damper"];
const STACK_HOLES: &[&str] = &["bought.motor_controller", "bought.stack_screw", "bought.damper"];
const SEAT: &[&str] = &["motor_mount.propeller_height_mm"];
const CAGE: &[&str] = &["rods.cage_rod_length_mm", "motor_mount.motor_position_mm", "bought.propeller"];
const MOTOR_HOLES: &[&str] = &["motor_mount.motor_hole_circle_mm", "bought.motor"];
const COMPUTER_HOLES: &[&str] = &["pi_carrier.pi_pattern_along_mm", "pi_carrier.pi_pattern_across_mm", "bought.computer"];
const CAMERA_HOLES: &[&str] = &["camera.camera_pattern_across_mm", "camera.camera_pattern_up_mm", "bought.camera"];
const TIED: &[&str] = &["accessories.accessory_side_mm", "bought.receiver", "bought.buzzer"];
const SENSOR_HOLES: &[&str] = &["sleeve.sensor_hole_pitch_mm", "bought.flow_sensor"];
const CARRIER_HOLES: &[&str] = &["pi_carrier.pi_hole_diameter_mm"];
const CONNECTOR_HOLES: &[&str] = &["camera.camera_hole_diameter_mm"];
const PLATE_HOLES: &[&str] = &["accessories.fpv_hole_diameter_mm"];
const COMPUTER_ALONE: &[&str] = &["bought.computer"];
const CAMERA_ALONE: &[&str] = &["bought.camera"];
const SENSOR_ALONE: &[&str] = &["bought.flow_sensor"];

pub static RULE: Rule = Rule {
    id: "hardware_fit",
    title: "Hardware",
    requires: "bought parts fit each other and what holds them",
    units: &["mm", "%"],
    limits: &[],
    levers: Levers::Sets(&[
        ROD,
        ROD_ALONE,
        STOCK,
        MOTOR_THREAD,
        MOTOR_LENGTH,
        MOTOR_HEAD,
        SHAFT,
        STACK_THREAD,
        STACK_HEAD,
        STACK_FLOOR,
        STACK_LENGTH,
        FLIGHT_HOLES,
        STACK_HOLES,
        SEAT,
        CAGE,
        MOTOR_HOLES,
        COMPUTER_HOLES,
        CAMERA_HOLES,
        SENSOR_HOLES,
        COMPUTER_ALONE,
        CAMERA_ALONE,
        SENSOR_ALONE,
        CARRIER_HOLES,
        CONNECTOR_HOLES,
        PLATE_HOLES,
        TIED,
    ]),
    blame: Blame::Levers,
    in_search: InSearch::Constraints { subjects: &["rod", "screw", "holes", "ties", "propellers on", "propellers in"], binds: false },
    found: Found::By(&[Pass::quick(check)]),
};

/// Two sizes that should be one may differ by this, mm: more than tolerances of stock, less than between two sizes that are sold.
const SAME_MM: f64 = 0.1;
/// How far holes may be from those they are screwed to, mm: an M2 screw in the usual hole of 3 mm, half of it to each side.
const HOLE_PLAY_MM: f64 = 0.5;
/// How far a rod's catalogued mass may be from that of its volume, %: densities of pultruded carbon spread by less.
const ROD_MASS_PERCENT: f64 = 15.0;
/// Least engagement of a motor's screw, in diameters: the real frame's M2 x 4 through 2.5 mm reach in by 0.75.
const ENGAGED: f64 = 0.5;
/// Most engagement, in diameters: beyond, screws of small motors meet the windings.
const ENGAGED_MOST: f64 = 1.5;
/// Height of a nut that the frame does not state, in diameters (ISO 4032: 1.6 mm of M2, 2.4 mm of M3).
const NUT: f64 = 0.8;
/// By how much a self-tapping screw's thread is wider than its pilot hole, mm, in the middle (0.1 on the real frame), and how far off.
const BITE_MM: [f64; 2] = [0.1, 0.2];

/// Least wall of a damper's neck around the screw in it, mm: M2 dampers are made for holes of 3 mm, thinner rubber is cut by the thread.
const NECK_MM: f64 = 0.25;
/// Least width by which what keeps a board on its screw is wider than the board's hole, on each side, mm: the rim of an M2 damper has 1 mm, an
/// M2 nut 0.5 mm beside a hole of 3 mm.
const RIM_MM: f64 = 0.25;
/// Least width of plate below the head of a screw, beside its hole, mm: half a millimetre all around.
const UNDER_HEAD_MM: f64 = 1.0;
/// Least plate under the head of a screw of the stack, mm: six layers, without which the head is pulled through.
const FLOOR_MM: f64 = 1.2;
/// Most air between a motor and its propeller, mm: shafts of such motors reach some 5 mm beyond them, and the hub needs most of it.
const AIR_MM: f64 = 2.0;
/// Holes that the small screws of the bill are for, mm: M2 is the smallest of them, and their washers have 5 mm.
const SMALL_SCREWS_MM: [f64; 2] = [2.0, 4.5];

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let mut found = rods(&scene.design.frame);
    found.extend(stock(scene));
    found.extend(motor_screws(&scene.design.frame));
    found.extend(stack_screws(scene));
    found.extend(stack_holes(scene));
    found.extend(small_holes(&scene.design.frame));
    found.extend(holes(&scene.design.frame));
    found.extend(tied(scene));
    found.extend(small_printed_holes(&scene.design.frame));
    found.extend(seat(&scene.design.frame));
    found.extend(cage(scene));
    found
}

fn part<'a>(frame: &'a Frame, role: &str) -> Option<&'a BoughtPart> {
    frame.bought.get(role).map(|item| &item.part)
}

fn name<'a>(frame: &'a Frame, role: &str) -> &'a str {
    frame.bought.get(role).map_or("", |item| &item.name)
}

fn measure(value: f64, limit: f64, unit: &'static str, levers: &'static [&'static str]) -> Measure {
    Measure { rule: &RULE, value, limit, unit, levers }
}

/// The rods of the frame are those of the bill of materials, and weigh what their volume does.
fn rods(frame: &Frame) -> Vec<Finding> {
    let Some(rod) = part(frame, "rod") else { return Vec::new() };
    let mut found = Vec::new();
    let (called, diameter_mm) = (name(frame, "rod"), frame.rods.rod_diameter_mm);
    if let Some(bought_mm) = rod.diameter_mm {
        let message =
            format!("the frame's bores are made for rods of {diameter_mm} mm, {called} in the bill of materials has {bought_mm} mm");
        found.push(measure((diameter_mm - bought_mm).abs(), SAME_MM, "mm", ROD).at_most("rod: diameter".into(), message));
        let bore_mm = rod.wall_mm.map_or(0.0, |wall| (bought_mm - 2.0 * wall).max(0.0));
        let length_mm = rod.stock_length_mm.unwrap_or(rod.size_mm[0]);
        let volume_mm3 = FRAC_PI_4 * (bought_mm * bought_mm - bore_mm * bore_mm) * length_mm;
        let solid_g = volume_mm3 * 1e-3 * frame.rod_material.material.density_g_cm3;
        let off = 100.0 * (rod.mass_g / solid_g - 1.0);
        let hint = if off < 0.0 && rod.wall_mm.is_none() { "; a tube states its wall_mm" } else { "" };
        let what = if bore_mm > 0.0 { "tube" } else { "rod" };
        let message = format!(
            "{called}: {:.2} g are stated for {length_mm:.0} mm, a {what} of {bought_mm} mm of {} weighs {solid_g:.2} g{hint}",
            rod.mass_g, frame.rod_material.name
        );
        found.push(measure(off.abs(), ROD_MASS_PERCENT, "%", ROD_ALONE).at_most("rod: mass".into(), message));
    }
    found
}

/// The longest rod can be cut from what is sold.
fn stock(scene: &Scene) -> Option<Finding> {
    let skeleton = &scene.design.skeleton;
    let rod = part(&scene.design.frame, "rod")?;
    let stock_mm = rod.stock_length_mm.unwrap_or(rod.size_mm[0]);
    let longest = skeleton.roles().into_iter().max_by(|a, b| skeleton.sawn_mm(*a).total_cmp(&skeleton.sawn_mm(*b)))?;
    let cut = measure(skeleton.sawn_mm(longest), stock_mm, "mm", STOCK);
    let [length, sold] = cut.figures(1);
    let called = name(&scene.design.frame, "rod");
    Some(cut.at_most(
        "rod: stock".into(),
        format!("the longest rod, {}, has {length} mm, {called} is sold in lengths of {sold} mm", longest.slug()),
    ))
}

/// The motors' screws have their thread, and reach in far enough, and not too far.
fn motor_screws(frame: &Frame) -> Vec<Finding> {
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
fn stack_screws(scene: &Scene) -> Vec<Finding> {
    let (frame, centre) = (&scene.design.frame, &scene.design.centre);
    let Some(screw) = part(frame, "stack_screw") else { return Vec::new() };
    let stack = Stack::new(frame, centre);
    let (Some(thread), Some(length), Some(lowest)) = (screw.thread_mm, screw.length_mm, stack.nut_seat_mm()) else {
        return Vec::new();
    };
    let (called, hub) = (name(frame, "stack_screw"), &frame.hub);
    let bite = thread - hub.stack_pilot_diameter_mm;
    let [meant, off] = BITE_MM;
    let message = format!("{called} is {bite:.2} mm wider than its pilot hole in the hub, {meant:.2} mm hold without splitting it");
    let mut found = vec![measure((bite - meant).abs(), off, "mm", STACK_THREAD).at_most("screw of the stack: bite".into(), message)];
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
    let message = match beyond.value < beyond.limit {
        true => format!(
            "{called} reaches {reach} mm beyond what it holds under the hub, a nut is {nut} mm high: the screw has to be {:.1} mm long",
            length + beyond.limit - beyond.value
        ),
        false => format!("{called} reaches {reach} mm beyond what it holds under the hub, a nut is {nut} mm high"),
    };
    found.push(beyond.at_least("screw of the stack: length".into(), message));
    found
}

/// The boards of the stack let their screws through, with the dampers that they hang in, and what keeps them on the screws does not slip
/// through their holes.
fn stack_holes(scene: &Scene) -> Vec<Finding> {
    let frame = &scene.design.frame;
    let Some(thread) = part(frame, "stack_screw").and_then(|screw| screw.thread_mm) else { return Vec::new() };
    let stack = Stack::new(frame, &scene.design.centre);
    let mut found = Vec::new();
    for (at, board) in stack.boards.iter().enumerate() {
        let Some(hole) = board.part.hole_diameter_mm else { continue };
        let levers = if board.role == "flight_controller" { FLIGHT_HOLES } else { STACK_HOLES };
        let (called, subject) = (name(frame, board.role), format!("holes of the {}", board.role));
        let damper = stack.dampers.filter(|_| at == 0).map(|(damper, _)| damper);
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
        let keeps = damper.map(|damper| ("a damper", damper.size_mm[0].min(damper.size_mm[1])));
        let Some((what, across)) = keeps.or_else(|| part(frame, "stack_nut").map(|nut| ("a nut", nut.size_mm[0].min(nut.size_mm[1]))))
        else {
            continue;
        };
        let kept = measure(hole, across - 2.0 * RIM_MM, "mm", levers);
        let [wide, most] = kept.figures(2);
        let message = format!("the holes of {called} are {wide} mm wide, {what} of {across} mm keeps it on its screw up to {most} mm");
        found.push(kept.at_most(format!("{subject}: what keeps it"), message));
    }
    found
}

/// Boards that small screws hold have holes for these.
fn small_holes(frame: &Frame) -> Vec<Finding> {
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
fn holes(frame: &Frame) -> Vec<Finding> {
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
fn small_printed_holes(frame: &Frame) -> Vec<Finding> {
    let printed: [(&str, f64, &'static [&'static str]); 3] = [
        ("computer", frame.pi_carrier.pi_hole_diameter_mm, CARRIER_HOLES),
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
fn tied(scene: &Scene) -> Vec<Finding> {
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
    ["receiver", "buzzer"].into_iter().filter_map(of).flatten().collect()
}

/// A propeller stands on its motor, neither in it nor above it.
fn seat(frame: &Frame) -> Vec<Finding> {
    let (Some(motor), Some(propeller)) = (part(frame, "motor"), part(frame, "propeller")) else { return Vec::new() };
    let under = frame.motor_mount.propeller_height_mm - 0.5 * propeller.hub_mm();
    let air = measure(under, motor.motor_height_mm(), "mm", SEAT);
    let [height, top] = air.figures(2);
    let message = format!("the underside of the propeller is {height} mm above the motor's seat, the motor is {top} mm high");
    let above = measure(under - motor.motor_height_mm(), AIR_MM, "mm", SEAT);
    let [gap, most] = above.figures(2);
    let reached = format!("the underside of the propeller is {gap} mm above the motor, its shaft carries it up to {most} mm");
    vec![air.at_least("propellers on the motors".into(), message), above.at_most("propellers on the motors: air".into(), reached)]
}

/// No propeller reaches out of the ring that keeps it off walls.
fn cage(scene: &Scene) -> Option<Finding> {
    let ring = |p: &&Placed| matches!(p.shape.kind, Kind::Rod(role) if role.is_cage());
    let cage = bounds_of(scene.placed.iter().filter(ring))?;
    let mount = &scene.design.frame.motor_mount;
    let wide = measure(
        2.0 * (mount.motor_position_mm * FRAC_1_SQRT_2) + mount.propeller_diameter_mm,
        (cage.high[0] - cage.low[0]).min(cage.high[1] - cage.low[1]),
        "mm",
        CAGE,
    );
    let [sweep, cage_mm] = wide.figures(2);
    let message = format!("the propellers sweep {sweep} mm across, the cage that keeps them off a wall is {cage_mm} mm wide");
    Some(wide.at_most("propellers in the cage".into(), message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};

    fn broken(change: impl FnOnce(&mut Frame)) -> Vec<String> {
        violated(&Planted::frame(change).found(check)).into_iter().map(|f| f.subject).collect()
    }

    fn own(frame: &mut Frame, role: &str, change: impl FnOnce(&mut BoughtPart)) {
        change(&mut frame.bought.get_mut(role).expect("has one").part);
    }

    #[test]
    fn planted_rods_that_are_not_those_of_the_bill() {
        assert_eq!(broken(|_| {}), Vec::<String>::new());
        assert_eq!(broken(|frame| frame.rods.rod_diameter_mm = 2.5), ["rod: diameter"]);
        assert_eq!(broken(|frame| own(frame, "rod", |rod| rod.mass_g = 5.0)), ["rod: mass"]);
        let shorter = |rod: &mut BoughtPart| (rod.stock_length_mm, rod.mass_g) = (Some(150.0), 0.15 * rod.mass_g);
        assert_eq!(broken(|frame| own(frame, "rod", shorter)), ["rod: stock"]);
        let tube = |rod: &mut BoughtPart| (rod.wall_mm, rod.mass_g) = (Some(0.5), 6.09);
        assert_eq!(broken(|frame| own(frame, "rod", tube)), Vec::<String>::new());
    }

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
        assert_eq!(m3, ["screw of the stack: bite", "screw of the stack: head", "holes of the flight_controller: screw"]);
    }

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
        assert_eq!(broken(|frame| frame.pi_carrier.pi_hole_diameter_mm = 1.9), ["holes for the computer: screw"]);
    }

    #[test]
    fn planted_propellers_in_the_motor_and_out_of_the_cage() {
        assert_eq!(broken(|frame| frame.motor_mount.propeller_height_mm = 13.0), ["propellers on the motors"]);
        assert_eq!(broken(|frame| frame.motor_mount.propeller_height_mm = 22.0), ["propellers on the motors: air"]);
        assert_eq!(broken(|frame| frame.motor_mount.propeller_diameter_mm = 120.0), ["propellers in the cage"]);
    }
}
