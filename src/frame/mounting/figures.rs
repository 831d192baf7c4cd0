//! Figures of a design, and sentences about them, in the texts of its mounts.

use super::camera_screws::CameraScrews;
use super::carrier_screws::{CarrierScrews, washers_mm};
use super::fragments::instead;
use super::mount::{
    BATTERY_REAR, CAMERA_SCREWS, COMPUTER_SCREWS, EXTRA_LEADS, EXTRAS, FOOT_SCREWS, FPV_RIBBON, FPV_TILT, HEX_KEY, LOOSE, RADIO, RECEIVER,
    TIE, TIES, WASHERS,
};
use super::mounts::MOUNTS;
use crate::frame::assembly::Design;
use crate::frame::assembly::cables::unconnected;
use crate::params::Frame;
use crate::params::frame::Extra;

/// How far the battery's rear may be off the lid's where both count as flush, mm.
const FLUSH_MM: f64 = 0.05;

/// Names between braces in the texts of mounts, each with what stands for it in a design.
pub(super) fn figures(design: &Design) -> Vec<(&'static str, String)> {
    let [computer, feet] = screws_told(design);
    vec![
        (BATTERY_REAR, battery_rear(design)),
        (WASHERS, washers_told(&design.frame)),
        (COMPUTER_SCREWS, computer),
        (FOOT_SCREWS, feet),
        (CAMERA_SCREWS, camera_screws(&design.frame)),
        (FPV_RIBBON, fpv_ribbon(&design.frame).into()),
        (HEX_KEY, hex_key(&design.frame)),
        (TIES, ties_told(design)),
        (FPV_TILT, format!("{:.0}", design.frame.accessories.fpv_tilt_deg)),
        (EXTRAS, extras_told(design)),
        (EXTRA_LEADS, extra_leads(design)),
        (LOOSE, loose_told(design)),
    ]
}

/// Threads with the keys of their socket heads (ISO 4762; M1.4, which that does not list, as screws of DIN 912 are sold), mm.
const HEX_KEYS_MM: [[f64; 2]; 6] = [[1.4, 1.3], [1.6, 1.5], [2.0, 1.5], [2.5, 2.0], [3.0, 2.5], [4.0, 3.0]];

/// The sentence about the key of the screws that hold the boards; none for a thread without one.
fn hex_key(frame: &Frame) -> String {
    let thread_mm = frame.bought.get("stack_screw").and_then(|screw| screw.part.thread_mm);
    let key = thread_mm.and_then(|thread| HEX_KEYS_MM.into_iter().find(|[of, _]| *of == thread));
    key.map_or_else(String::new, |[thread, key]| format!(" Socket heads of M{thread} take a hex key of {key} mm."))
}

/// What is laid onto the hub and held by the ties, by its body.
const LAID: [&str; 2] = ["pi_carrier", "accessory_plate"];

/// What is laid onto the hub, where something is.
fn laid(design: &Design) -> Option<&'static str> {
    LAID.into_iter().find(|name| design.bodies.iter().any(|body| body.name == *name))
}

/// The sentence about what falls off the hub when it is turned over.
fn loose_told(design: &Design) -> String {
    let until = if design.frame.bought.contains_key(TIE) { "the ties" } else { "they are fastened with the bracket" };
    laid(design).map_or_else(String::new, |name| {
        format!(
            "The {} and what is on it are loose until {until}: tape them to the hub before you turn it over. ",
            spaced(name).replace("pi ", "")
        )
    })
}

/// What a frame file lists as extra and takes no board's place, in a row of what may be soldered to a board.
fn extra_leads(design: &Design) -> String {
    let frame = &design.frame;
    let is_told = |name: &str| is_mounted_receiver(design, name);
    let has_leads = |(name, extra): &(&String, &Extra)| !is_told(name) && frame.replaced(extra).next().is_none();
    let names: Vec<String> = frame.built_in_things().filter(has_leads).map(|(name, _)| spaced(name)).collect();
    if names.is_empty() { String::new() } else { format!(", and for what of the file's extras has leads ({})", names.join(", ")) }
}

/// The sentences about the holes that ties go through.
fn ties_told(design: &Design) -> String {
    let of_bracket = "Put two ties through the holes of hub and bracket, {in front and at the rear}, and out by the bracket's slots";
    let told = match laid(design) {
        None => format!("{of_bracket}. "),
        Some("pi_carrier") => format!(
            "{of_bracket}; two through the hub's holes {{left and right}}. All four go through the carrier, too: the two in front and at the rear \
             are in it already. "
        ),
        Some(_) => {
            let first = if design.frame.bought.contains_key("fpv_camera") { ": the one in front is in it already" } else { "" };
            format!("{of_bracket}; two through the hub's holes {{left and right}}. All four go through the plate, too{first}. ")
        }
    };
    design.centre.battery_axes.words(&told)
}

/// The sentences about what a frame file lists as extra, and no step brings, and about what such an extra is connected to.
fn extras_told(design: &Design) -> String {
    let frame = &design.frame;
    let named = |(name, extra): (&String, &Extra)| {
        let replaced = frame.replaced(extra).map(spaced).collect::<Vec<_>>().join(" and the ");
        let name = spaced(name);
        if replaced.is_empty() { name } else { format!("{name} (for the {replaced})") }
    };
    let is_told_here = |(name, extra): &(&String, &Extra)| !is_mounted_receiver(design, name) && !is_told_before(frame, extra);
    let names: Vec<String> = frame.built_in_things().filter(is_told_here).map(named).collect();
    let listed = match names.is_empty() {
        true => String::new(),
        false => format!(" Fasten and connect what the frame's file lists as extra, as its maker says: {}.", names.join(", ")),
    };
    let ribbon =
        if is_digital(frame) { " Push the ribbon of the camera for goggles into its video transmitter, and close the latch." } else { "" };
    format!("{listed}{ribbon}{}", unconnected_told(design))
}

/// Whether an extra is the receiver that the step of a receiver without a place of its own is about.
fn is_mounted_receiver(design: &Design, name: &str) -> bool {
    let has = |body: &str| design.bodies.iter().any(|other| other.name == body);
    name == RECEIVER && MOUNTS.iter().any(|mount| mount.id == RADIO && mount.is_for(has))
}

/// Whether the camera for goggles is digital: then a ribbon leads to its video transmitter.
fn is_digital(frame: &Frame) -> bool {
    frame.bought.get("fpv_camera").is_some_and(|camera| camera.part.digital == Some(true))
}

/// The sentence about the ribbon of a digital camera for goggles, where it is still free.
fn fpv_ribbon(frame: &Frame) -> &'static str {
    match is_digital(frame) {
        true => {
            "Push its ribbon into its socket now and close the latch; the other end goes into the video transmitter when that is fastened. "
        }
        false => "",
    }
}

/// The sentences about what lies between computer and carrier, and about what passes there.
fn washers_told(frame: &Frame) -> String {
    let thick = format!("together {:.1} mm thick or a little more", washers_mm(frame));
    match frame.bought.contains_key(TIE) {
        true => format!(
            "{thick}: two of the ties pass between board and carrier. A drop of glue holds them. Put these two in now, one down through the hole \
             in front and one through that at the rear, their heads outside of the carrier: under the board no tie can be threaded."
        ),
        false => format!(
            "{thick}: they keep the board off the carrier. A drop of glue holds them. What of {} goes through the carrier's holes in front and at \
             the rear goes in now: the board lies over them.",
            instead(frame, TIE)
        ),
    }
}

/// The screws that hold the camera.
fn camera_screws(frame: &Frame) -> String {
    CameraScrews::new(frame).map_or_else(|| "small screws".into(), |screws| screws.words())
}

/// Whether an earlier step names an extra and takes it in hand: it stands for the power connector, which is soldered to a board under the hub, or for the
/// ties of the bracket.
fn is_told_before(frame: &Frame, extra: &Extra) -> bool {
    let replaced: Vec<&str> = frame.replaced(extra).collect();
    !replaced.is_empty() && replaced.iter().all(|role| ["connector", TIE].contains(role))
}

/// The sentence about what would be connected to a board under the hub that flies the frame, where an extra does.
fn unconnected_told(design: &Design) -> String {
    let from: Vec<&str> = unconnected(design).into_iter().map(called).collect();
    match &from[..] {
        [] => String::new(),
        [one] => format!(" Connect the {one} to {}: the bill has no cable for it.", instead(&design.frame, "flight_controller")),
        all => format!(" Connect to {}: {}. The bill has no cables for them.", instead(&design.frame, "flight_controller"), all.join(", ")),
    }
}

fn spaced(name: &str) -> String {
    name.replace('_', " ")
}

/// What is connected, by its role, in a sentence.
fn called(role: &str) -> &str {
    match role {
        "flow_sensor" => "flow sensor",
        "fpv_camera" => "camera for goggles",
        "gps" => "GPS",
        other => other,
    }
}

/// Where the battery's rear face is in its lid.
fn battery_rear(design: &Design) -> String {
    let centre = &design.centre;
    let inside_mm = centre.battery_y_mm[0] - (centre.rim_y_mm - centre.lid_cover_mm);
    match inside_mm {
        _ if inside_mm.abs() < FLUSH_MM => "flush with the edge of the lid's floor".into(),
        _ if inside_mm > 0.0 => format!("{inside_mm:.1} mm inside of the edge of the lid's floor"),
        _ => format!("{:.1} mm outside of the edge of the lid's floor", -inside_mm),
    }
}

/// The sentences about the screws that hold the computer, and about those through the feet of the camera's connectors.
fn screws_told(design: &Design) -> [String; 2] {
    let Some(screws) = CarrierScrews::new(&design.frame) else {
        return ["Fix it with small screws.", "Fix each with a small screw through its foot."].map(String::from);
    };
    let cut = "They cut their thread in the carrier. Longer ones would meet the hub below it.";
    let on_board = screws.words(screws.on_board);
    match screws.on_feet {
        None => [format!("Fix it with four screws {on_board} through its holes. {cut}"), String::new()],
        Some(on_feet) => [
            format!(
                "Fix it with two screws {on_board} through its rear holes. {cut} The front holes stay free: the camera's connectors go onto them."
            ),
            format!("Turn a screw {} from above through each foot and the board into the carrier.", screws.words(on_feet)),
        ],
    }
}
