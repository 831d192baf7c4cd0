//! What is bought goes together: it finds the holes that it needs, what carries it, and what it cannot do without.

use super::catalogue::HOLE_PLAY_MM;
use super::frame::Frame;
use super::refusal::Reason;
use super::relation::BrokenRelation;
use super::roles::{HUNG, NEEDED};

/// Checks every relation of what is bought.
pub(super) fn hold(frame: &Frame) -> Result<(), BrokenRelation> {
    small_parts(frame)?;
    motor_holes(frame)?;
    carried_camera(frame)?;
    accessories(frame)?;
    driven_motors(frame)?;
    flown(frame)?;
    fastened(frame)?;
    stack(frame)
}

/// What a bought part does for others, by its key: what nothing does without it, and the roles of which one is there.
const SERVED: [(&str, &str, &[&str]); 7] = [
    ("bought.motor_screw", "holds the motors", &["motor"]),
    ("bought.stack_screw", "holds the boards under the hub", &HUNG),
    ("bought.stack_nut", "holds the boards on their screws", &HUNG),
    ("bought.stack_spacer", "keeps the boards where they are along their screws", &HUNG),
    ("bought.tie", "holds the bracket with the battery", &["battery"]),
    ("bought.connector", "connects the battery", &["battery"]),
    ("bought.magnet", "holds the battery's lid", &["battery"]),
];

/// Whether a frame can be without a bought part in a role as it is: without an extra that stands for it.
pub fn is_optional(role: &str) -> bool {
    !NEEDED.contains(&role) && !SERVED.iter().any(|(key, ..)| self::role(key) == role)
}

/// Whether an extra stands for a role.
fn is_covered(frame: &Frame, role: &str) -> bool {
    frame.extras.values().any(|extra| extra.covers.iter().any(|covered| covered == role))
}

/// Whether a frame has what a key of `[bought]` names, or an extra that stands for it.
fn has(frame: &Frame, key: &str) -> bool {
    let role = role(key);
    frame.bought.contains_key(role) || is_covered(frame, role)
}

/// The role of a key of `[bought]`.
fn role(key: &str) -> &str {
    key.strip_prefix("bought.").unwrap_or(key)
}

/// What has to be held or connected has what does it, or an extra that stands for that.
fn fastened(frame: &Frame) -> Result<(), BrokenRelation> {
    let is_there = |served: &&str| frame.bought.contains_key(*served);
    let missing = |(key, _, served): &&(&'static str, &str, &[&str])| !has(frame, key) && served.iter().any(is_there);
    let Some((key, does, _)) = SERVED.iter().find(missing) else { return Ok(()) };
    let message = format!("`{key}` = \"none\" leaves nothing that {does}");
    let remedy = format!("name one; what {does} instead is an entry of [extras] with covers = [\"{}\"]", role(key));
    Err(BrokenRelation { key, reason: Box::new(Reason::Impossible { message, remedy }) })
}

/// A frame flies by a flight controller: a board of its own, or one that drives the motors, too.
fn flown(frame: &Frame) -> Result<(), BrokenRelation> {
    let key = "bought.flight_controller";
    if has(frame, key) || frame.is_all_in_one() {
        return Ok(());
    }
    let board = frame.bought.get("motor_controller").map(|board| board.name.as_str());
    let alone = board.map_or(String::new(), |name| format!(": `{name}` is a motor controller alone"));
    let both = board.map_or(String::new(), |name| {
        format!(" where `{name}` is both controllers on one board, state all_in_one = true in [override.parts.{name}];")
    });
    let message = format!("`{key}` = \"none\" leaves nothing that flies the frame{alone}");
    let remedy = format!(
        "name one, or as motor_controller a board that is both, such as \"aio-20x20\";{both} one that is elsewhere on the frame is an entry of \
         [extras] with covers = [\"flight_controller\"]"
    );
    Err(BrokenRelation { key, reason: Box::new(Reason::Impossible { message, remedy }) })
}

/// A flight controller alone drives no motor: a board that is both controllers has the role of the motor controller, and controllers on the
/// arms are an extra.
fn driven_motors(frame: &Frame) -> Result<(), BrokenRelation> {
    let key = "bought.motor_controller";
    if has(frame, key) {
        return Ok(());
    }
    let board = frame.bought.get("flight_controller").map(|board| board.name.as_str());
    let beside = board.map_or(String::new(), |name| format!(" beside the flight controller `{name}`"));
    let both = board.map_or(String::new(), |name| {
        format!(" where `{name}` is both controllers on one board, write motor_controller = \"{name}\" and flight_controller = \"none\";")
    });
    let message = format!("`{key}` = \"none\" leaves nothing that drives the motors{beside}");
    let remedy =
        format!("name a motor_controller;{both} controllers on the arms are an entry of [extras] with covers = [\"motor_controller\"]");
    Err(BrokenRelation { key, reason: Box::new(Reason::Impossible { message, remedy }) })
}

/// The camera stands on the computer's board.
fn carried_camera(frame: &Frame) -> Result<(), BrokenRelation> {
    let has = |role: &str| frame.bought.contains_key(role);
    if has("computer") || !has("camera") {
        return Ok(());
    }
    let message =
        "`bought.computer` = \"none\" leaves nothing for the camera to stand on: its connectors are glued onto the computer's board".into();
    let remedy = "write camera = \"none\" in [bought], too, or name a computer".into();
    Err(BrokenRelation { key: "bought.computer", reason: Box::new(Reason::Impossible { message, remedy }) })
}

/// The accessory plate lies where the computer's carrier does.
fn accessories(frame: &Frame) -> Result<(), BrokenRelation> {
    let Some(key) = ACCESSORY_KEYS.into_iter().find(|key| key.strip_prefix("bought.").is_some_and(|role| frame.bought.contains_key(role)))
    else {
        return Ok(());
    };
    if !frame.bought.contains_key("computer") {
        return Ok(());
    }
    let message = format!("`{key}` lies on the accessory plate, which has its place where the computer's carrier is");
    let remedy = "write computer = \"none\" and camera = \"none\" in [bought], or count the part as a mass in [extras]".into();
    Err(BrokenRelation { key, reason: Box::new(Reason::Impossible { message, remedy }) })
}

/// Keys of what the accessory plate carries.
const ACCESSORY_KEYS: [&str; 4] = ["bought.receiver", "bought.buzzer", "bought.gps", "bought.fpv_camera"];

/// The boards under the hub hang on four screws: their holes are one square.
fn stack(frame: &Frame) -> Result<(), BrokenRelation> {
    let boards = ["bought.flight_controller", "bought.motor_controller"].into_iter().zip(HUNG);
    let patterns = boards.filter_map(|(key, role)| Some((key, frame.bought.get(role)?)));
    for (key, item) in patterns {
        let Some([along, across]) = item.part.hole_pattern_mm else { continue };
        let pattern = frame.hub.stack_pattern_mm;
        if [along, across].iter().all(|side| (side - pattern).abs() <= HOLE_PLAY_MM) {
            continue;
        }
        let name = &item.name;
        let message = format!("the holes of `{name}` are {along} x {across} mm apart, those of the hub's stack {pattern} x {pattern} mm");
        let remedy = "choose boards of one square pattern for flight_controller and motor_controller, or \"none\" for one of them; without stack_pattern_mm the hub follows the first".into();
        return Err(BrokenRelation { key, reason: Box::new(Reason::Impossible { message, remedy }) });
    }
    Ok(())
}

/// Parts of the kind "other", and whether they are straps: a strap holds no board, and what goes onto a thread ties nothing.
const SMALL_PARTS: [(&str, bool); 4] =
    [("bought.tie", true), ("bought.stack_nut", false), ("bought.stack_spacer", false), ("bought.damper", false)];

fn small_parts(frame: &Frame) -> Result<(), BrokenRelation> {
    for (key, is_strap) in SMALL_PARTS {
        let Some(item) = frame.bought.get(role(key)) else { continue };
        let wrong = if is_strap { item.part.thread_mm.is_some() } else { item.part.strap_mm.is_some() };
        if wrong {
            let what = if is_strap { "goes onto a thread" } else { "is a strap" };
            let message = format!("`{key}` is `{}`, which {what} (`{}`)", item.name, if is_strap { "thread_mm" } else { "strap_mm" });
            let remedy = format!("choose a {}; `flexframe list parts` lists them", role(key).trim_start_matches("stack_"));
            return Err(BrokenRelation { key, reason: Box::new(Reason::Impossible { message, remedy }) });
        }
    }
    Ok(())
}

/// The motor mount has three screw holes, or four.
fn motor_holes(frame: &Frame) -> Result<(), BrokenRelation> {
    let Some(motor) = frame.bought.get("motor") else { return Ok(()) };
    let count = motor.part.motor_holes();
    if (3..=4).contains(&count) {
        return Ok(());
    }
    let message = format!("the motor `{}` has {count} screw holes, a motor mount has 3 or 4", motor.name);
    let remedy = "choose a motor with three or four holes; params/bought.toml shows them".into();
    Err(BrokenRelation { key: "bought.motor", reason: Box::new(Reason::Impossible { message, remedy }) })
}
