//! The steps' texts for frames that lack a part, and for those in which an extra stands for one.

use std::collections::BTreeMap;

use super::mounting_plan::texts;
use super::{Fixing, MOUNTS};
use crate::frame::assembly::Design;
use crate::frame::assembly::wires::wires;
use crate::params::{Frame, FrameFile};

const NO_COMPUTER: &str = "computer = \"none\"\ncamera = \"none\"\nflow_sensor = \"none\"\n";

/// The default frame with these lines of `[bought]`, and extras, each for a role.
fn design(bought: &str, extras: &[(&str, &str)]) -> Design {
    let extra = |(name, role): &(&str, &str)| {
        let covers = if role.is_empty() { String::new() } else { format!("covers = [\"{role}\"]\n") };
        format!("[extras.{name}]\nmass_g = 4.0\nmass_basis = \"estimate\"\nsource = \"a guess\"\n{covers}")
    };
    let extras: String = extras.iter().map(extra).collect();
    let text = format!("base = \"cognifly\"\n[bought]\n{bought}{extras}");
    let frame = Frame::resolve(&FrameFile::parse("own.toml", &text).expect("reads")).expect("resolves");
    Design::new(frame).expect("designs")
}

fn told(bought: &str, extras: &[(&str, &str)]) -> BTreeMap<&'static str, String> {
    texts(&design(bought, extras))
}

/// Roles of the wires that are drawn.
fn drawn(design: &Design) -> Vec<&'static str> {
    let mut roles: Vec<&str> = wires(design).into_iter().map(|wire| wire.role).collect();
    roles.dedup();
    roles
}

#[test]
fn planted_single_controllers_are_told_by_the_extras_name() {
    let bought = format!("{NO_COMPUTER}motor_controller = \"none\"\n");
    let design = design(&bought, &[("arm_escs", "motor_controller"), ("led_strip", "")]);
    assert_eq!(drawn(&design), Vec::<&str>::new());
    let told = texts(&design);
    let all: String = told.values().cloned().collect();
    assert!(!all.contains("battery pads") && !all.contains("motor wires of the bill"), "{all}");
    assert!(told["connector_in_bracket"].contains("they are the battery wires of the bill"), "{}", told["connector_in_bracket"]);
    assert!(told["bracket_alone"].contains("that reach to the extra \"arm escs\""), "{}", told["bracket_alone"]);
    let wiring = &told["wiring_of_extra"];
    assert!(wiring.contains("Fasten the extra \"arm escs\"") && wiring.contains("arm escs (for the motor controller)"), "{wiring}");
    assert!(wiring.contains("led strip") && !told.contains_key("wiring") && !told.contains_key("bracket"), "{wiring}");
    let built_in: Vec<&String> = design.frame.built_in_extras().map(|(name, _)| name).collect();
    assert_eq!(built_in, ["arm_escs", "led_strip", "wiring"]);
    let pairs = self::told(&bought, &[("left_escs", "motor_controller"), ("right_escs", "motor_controller")]);
    assert!(
        pairs["wiring_of_extra"].contains("Fasten the extra \"left escs\" and the extra \"right escs\""),
        "{}",
        pairs["wiring_of_extra"]
    );
}

#[test]
fn planted_cables_end_at_no_motor_controller() {
    let bought = "computer = \"none\"\ncamera = \"none\"\nflight_controller = \"none\"\ngps = \"gps-22x20\"\nbuzzer = \"buzzer-9mm\"\n";
    let design = design(bought, &[("teensy", "flight_controller")]);
    assert_eq!(drawn(&design), ["motor_wire", "battery_wire"]);
    let told = texts(&design);
    let all: String = told.values().cloned().collect();
    assert!(!all.contains("of the motor controller."), "{all}");
    assert!(told["wiring"].contains("Connect to the extra \"teensy\": flow sensor, GPS, buzzer."), "{}", told["wiring"]);
    assert!(told["wiring"].contains("teensy (for the flight controller)"), "{}", told["wiring"]);
    assert!(told["radio"].contains("5 V of the extra \"teensy\""), "{}", told["radio"]);
    assert!(told["motor_controller"].contains("Plug a cable for the extra \"teensy\""), "{}", told["motor_controller"]);
}

/// What closes and connects the lid may be an extra: then no step speaks of the part that is not bought.
#[test]
fn planted_a_plug_and_a_latch_that_are_extras() {
    let plug = told("connector = \"none\"\n", &[("plug", "connector")]);
    let all: String = plug.values().cloned().collect();
    assert!(!all.contains("connector's") && !all.contains("power connector") && !all.contains("battery wires"), "{all}");
    assert!(
        plug["bracket"].contains(
            "before you turn it over. Solder the leads of the extra \"plug\" to the battery pads of the motor controller at its rear"
        ),
        "{}",
        plug["bracket"]
    );
    assert!(plug["cartridge"].contains("connect the battery by the extra \"plug\""), "{}", plug["cartridge"]);
    let latch = design("magnet = \"none\"\n", &[("latch", "magnet")]);
    let told = texts(&latch);
    let all: String = told.values().cloned().collect();
    assert!(!all.contains("magnets") && !all.contains("its magnet") && !all.contains("the magnet is"), "{all}");
    assert!(told["cartridge"].contains("until the plug is in, and hold the lid by the extra \"latch\""), "{}", told["cartridge"]);
    assert_eq!(Fixing::MagnetAndPlug.in_frame(&latch.frame), Fixing::Plug);
    assert_eq!(Fixing::Ties("tie").in_frame(&latch.frame), Fixing::Ties("tie"));
}

#[test]
fn planted_steps_do_not_name_what_a_frame_lacks() {
    let blind = told("camera = \"none\"\n", &[]);
    assert!(!blind["computer"].contains("camera socket") && !blind["carrier"].contains("the camera"), "{blind:?}");
    let receiver = told(&format!("{NO_COMPUTER}receiver = \"receiver-nano\"\n"), &[]);
    let plate = &receiver["accessory_plate"];
    assert!(plate.contains("over the hub's, the receiver's slots to the left."), "{plate}");
    let mast = told(&format!("{NO_COMPUTER}gps = \"gps-22x20\"\n"), &[]);
    assert!(mast["accessory_plate"].contains("over the hub's, the mast to the rear."), "{}", mast["accessory_plate"]);
    let stiff = told(&format!("{NO_COMPUTER}damper = \"none\"\n"), &[]);
    let of_stack = ["stack_nuts", "flight_controller", "spacers_between_boards"].map(|id| &stiff[id][..]).join(" ");
    assert!(
        !of_stack.contains("damper") && of_stack.contains("up to the lowest board, finger tight. No board is bent by it."),
        "{of_stack}"
    );
}

/// What fastens the bracket instead of ties is called by its name, and no step takes a tie in hand.
#[test]
fn planted_without_ties_no_step_takes_one() {
    let goggles = format!("{NO_COMPUTER}fpv_camera = \"fpv-camera-14\"\n");
    for (bought, laid, id) in [("", "carrier", "computer"), (&*goggles, "plate", "fpv_camera")] {
        let design = design(&format!("{bought}tie = \"none\"\n"), &[("straps", "tie")]);
        let told = texts(&design);
        let all: String = told.values().cloned().collect();
        for words in ["of the ties", "the ties:", "Put a tie", "two ties", "tie's strap", "no tie"] {
            assert!(!all.contains(words), "{words}: {all}");
        }
        assert!(told[id].contains("What of the extra \"straps\" goes through"), "{}", told[id]);
        let bracket = &told["bracket"];
        assert!(bracket.contains(&format!("Fasten it and the {laid} with the extra \"straps\".")), "{bracket}");
        assert!(bracket.contains("are loose until they are fastened with the bracket"), "{bracket}");
        let mount = MOUNTS.iter().find(|mount| mount.id == id).expect("is a mount");
        assert!(mount.tools_in(&design.frame).iter().all(|tool| !tool.words().contains("of the ties")), "{id}");
        assert!(mount.tools.iter().any(|tool| tool.words().contains("of the ties")), "{id}");
    }
}

/// A receiver that a file lists as extra has the step of a receiver, and no other.
#[test]
fn planted_a_receiver_among_the_extras_is_told_once() {
    let told = told("", &[("receiver", ""), ("led_strip", "")]);
    assert!(told["radio"].contains("stick the receiver flat"), "{}", told["radio"]);
    assert!(told["wiring"].contains("as its maker says: led strip."), "{}", told["wiring"]);
    assert!(told["flight_controller"].contains("has leads (led strip)"), "{}", told["flight_controller"]);
}

/// Of ISO 4762.
#[test]
fn analytic_the_key_is_that_of_the_screws_thread() {
    let of = |thread_mm: f64| {
        let mut design = design(NO_COMPUTER, &[]);
        design.frame.bought.get_mut("stack_screw").expect("has them").part.thread_mm = Some(thread_mm);
        texts(&design)["stack_screws"].rsplit_once("thread.").expect("is told").1.to_owned()
    };
    for (thread, key) in [(2.0, "1.5"), (2.5, "2"), (3.0, "2.5"), (4.0, "3")] {
        assert_eq!(of(thread), format!(" Socket heads of M{thread} take a hex key of {key} mm."));
    }
    assert_eq!(of(3.5), "", "no such head is usual");
}

/// Whatever an extra stands for, and whatever is left out: no name between braces is left.
#[test]
fn analytic_every_name_between_braces_is_filled_in() {
    for roles in [
        &[][..],
        &["motor_controller"],
        &["flight_controller", "motor_controller", "connector", "magnet", "tie"],
        &["flight_controller", "connector"],
        &["motor_controller", "connector", "magnet"],
    ] {
        let bought: String = roles.iter().map(|role| format!("{role} = \"none\"\n")).collect();
        let names: Vec<String> = roles.iter().map(|role| format!("own_{role}")).collect();
        let extras: Vec<(&str, &str)> = names.iter().map(String::as_str).zip(roles.iter().copied()).collect();
        let told = told(&bought, &extras);
        assert!(told.keys().all(|id| MOUNTS.iter().any(|mount| mount.id == *id)));
        let [all, tied] = [told.values().cloned().collect::<Vec<_>>().join("\n"), told["cartridge"].clone()];
        assert!(
            !all.contains(['{', '}']) && !all.contains("what stands for") && !all.contains("  ") && !tied.is_empty(),
            "{roles:?}: {all}"
        );
        for name in &names {
            assert!(all.contains(&name.replace('_', " ")), "{name}: {all}");
        }
    }
}
