//! What is mounted around the fold: every part once, an order without circles, ways that are free, and ways that are not.

use std::collections::BTreeSet;

use flexframe::export::bill::bill;
use flexframe::frame::assembly::wires::wires;
use flexframe::frame::assembly::{Design, mass};
use flexframe::frame::fold::FoldSequence;
use flexframe::frame::mounting::{MOUNTS, MountStep, Mounting, untold, without_a_step};
use flexframe::params::Frame;
use flexframe::report::booklet::content::Booklet;
use flexframe::solid::{Feature, MeshSolid};
use nalgebra::{Point3, Vector3};

use crate::common;

fn designed(name: &str) -> Design {
    Design::with(Frame::load(name).expect("a preset").0, common::memo()).expect("designs")
}

fn without(roles: &[&str]) -> Design {
    let mut frame = Frame::load("cognifly").expect("a preset").0;
    frame.bought.retain(|role, _| !roles.contains(&role.as_str()));
    Design::with(frame, common::memo()).expect("designs")
}

fn mounted(design: &Design) -> Mounting {
    Mounting::new(design, &FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded"))
}

/// Names and quantities of what a bill lists as things.
fn listed(design: &Design) -> Vec<(String, f64)> {
    let bill = bill(design, &mass::table(design), None);
    let print = bill.print.iter().map(|line| (line.part.to_string(), f64::from(line.quantity)));
    let rods = bill.rods.iter().map(|line| (line.rod.clone(), f64::from(line.quantity)));
    let buy = bill
        .buy
        .iter()
        .filter(|line| line.role != "rod" && line.kind != "supply")
        .map(|line| (line.role.clone(), f64::from(line.quantity)));
    print.chain(rods).chain(buy).collect()
}

#[test]
fn analytic_every_part_of_the_bill_is_in_one_step() {
    let whoop = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/frames/whoop-aio-fpv.toml");
    for design in [designed("cognifly"), designed(whoop), without(&["computer", "camera"]), without(&["flow_sensor", "damper"])] {
        let mounting = mounted(&design);
        assert_eq!(without_a_step(listed(&design).into_iter(), mounting.parts()), Vec::<String>::new());
        // Nothing that the design lacks is spoken of.
        let bodies: BTreeSet<&str> = design.bodies.iter().map(|body| body.name.as_str()).collect();
        assert!(mounting.steps().all(|step| step.brings.iter().all(|name| bodies.contains(name.as_str())) && bodies.contains(step.onto)));
    }
}

/// No hand gets under the computer or into the closed bay: what belongs there comes before. Ties hold something, or there are none.
#[test]
fn regress_ties_and_wires_come_before_what_closes_the_way_to_them() {
    let whoop = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/frames/whoop-aio-fpv.toml");
    for (frame, count, laid) in [("cognifly", 4.0, true), (whoop, 2.0, false)] {
        let mounting = mounted(&designed(frame));
        let ties: f64 = mounting.parts().filter(|line| line.part == "tie").map(|line| line.count).sum();
        let text = |id: &str| mounting.steps().find(|step| step.mount == id).map_or("", |step| &step.text);
        assert_eq!((ties, text("ties").contains("the hub's holes left and right")), (count, laid), "{frame}");
        assert!(
            text("bracket").contains("Solder the motor wires of the bill") && text("wiring").contains("solder them together"),
            "{frame}"
        );
        assert_eq!(text("computer").contains("one down through the hole in front"), laid, "{frame}");
        assert_eq!(text("ties").contains("are in it already"), laid, "{frame}");
        // Wires and small parts have steps of their own; what has none is told.
        let told = text("wiring").contains("as its maker says: video.");
        assert_eq!((told, text("wiring").contains("as its maker says")), (!laid, !laid), "{frame}: {}", text("wiring"));
    }
}

/// What keeps the motor mounts in their places is told alike where it is bought, on the first page, and where it is done.
#[test]
fn regress_the_glue_of_the_motor_mounts_is_told_everywhere() {
    let design = designed("cognifly");
    let fold = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
    let masses = mass::table(&design);
    let bought = bill(&design, &masses, None).buy.into_iter().map(|line| line.note).collect::<Vec<_>>();
    let done = fold.steps.iter().filter_map(|step| step.caution.clone()).map(String::from).collect::<Vec<_>>();
    let first = Booklet::new(&design, &masses, &fold, &[]).preface;
    assert!(bought.iter().any(|note| note.contains("four motor mounts") && note.contains("loose in its bore")), "{bought:?}");
    assert!(first.iter().any(|line| line.contains("cyanoacrylate") && line.contains("four motor mounts")), "{first:?}");
    assert!(done.iter().any(|text| text.contains("the mount") && text.contains("cyanoacrylate")), "{done:?}");
}

/// The first power tries the motors, so their wires come before it, also where the battery cannot get in; the instructions say that it cannot.
#[test]
fn planted_a_battery_that_meets_a_rod_comes_after_the_motor_wires_and_the_instructions_say_so() {
    let pack = "[bought]\nbattery = \"own\"\n[override.parts.own]\nkind = \"battery\"\nsize_mm = [75, 35, 26]\nmass_g = 98\n\
                mass_basis = \"datasheet\"\nsource = \"its maker\"\n";
    let high = common::resolve(&format!("base = \"cognifly\"\n{pack}")).expect("resolves");
    for (design, barred) in [(designed("cognifly"), false), (Design::with(high, common::memo()).expect("designs"), true)] {
        let mounting = mounted(&design);
        let of = |id: &str| mounting.after.iter().position(|step| step.mount == id).expect("a step");
        assert!(of("wiring") < of("cartridge") && of("cartridge") < of("propellers"));
        let fold = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
        let booklet = Booklet::new(&design, &mass::table(&design), &fold, &[]);
        assert_eq!(booklet.preface[0].contains("cannot be assembled"), barred, "{:?}", booklet.preface);
        let caution = booklet.after[of("cartridge")].caution.clone().unwrap_or_default();
        assert_eq!(caution.contains("on the way battery lid runs into cage"), barred, "{caution}");
    }
}

/// A frame whose motor controller is the flight controller, too.
fn all_in_one(roles: &[&str]) -> Design {
    let mut frame = Frame::load("cognifly").expect("a preset").0;
    frame.bought.retain(|role, _| !roles.contains(&role.as_str()) && role != "flight_controller");
    frame.bought.get_mut("motor_controller").expect("has one").part.all_in_one = Some(true);
    Design::with(frame, common::memo()).expect("designs")
}

/// Dampers go into the flight controller, and where one board is both controllers, or the only one, into that.
#[test]
fn analytic_dampers_go_into_the_upper_board() {
    let steps = |design: &Design| {
        let mounting = mounted(design);
        let of = |id: &str| mounting.steps().position(|step| step.mount == id);
        [of("dampers"), of("dampers_in_motor_controller"), of("motor_controller"), of("both_controllers")]
    };
    let both = steps(&designed("cognifly"));
    assert!(both[0].is_some() && both[1].is_none() && both[2].is_some() && both[3].is_none());
    let one = steps(&all_in_one(&["flow_sensor"]));
    assert!(one[0].is_none() && one[2].is_none() && one[1].is_some_and(|at| Some(at) < one[3]), "{one:?}");
    let motors_alone = steps(&without(&["flight_controller", "flow_sensor"]));
    assert!(motors_alone[0].is_none() && motors_alone[3].is_none(), "{motors_alone:?}");
    assert!(motors_alone[1].is_some_and(|at| Some(at) < motors_alone[2]), "{motors_alone:?}");
}

/// The bracket stands before and behind the battery, or left and right of it: wires come in at its open sides.
#[test]
fn planted_no_motor_wire_runs_through_the_bracket() {
    let across = common::resolve("base = \"cognifly\"\n[sleeve]\nsleeve_direction = \"across\"\n").expect("resolves");
    for design in [designed("cognifly"), designed("cognifly-mini"), Design::with(across, common::memo()).expect("designs")] {
        let bracket = design.bodies.iter().find(|body| body.name == "battery_bracket").expect("has a bracket");
        let solid = design.shapes[bracket.shape].solid.placed(&bracket.pose);
        for wire in wires(&design).iter().filter(|wire| wire.role == "motor_wire") {
            let tube = MeshSolid::from_mesh(&wire.mesh()).expect("is closed");
            let shared_mm3 = tube.intersection(&solid).volume_mm3();
            assert!(tube.volume_mm3() > 100.0 && shared_mm3 < 1.0, "{} {}: {shared_mm3} mm3", design.frame.name, wire.name);
        }
    }
}

/// A cable is drawn in the one step that brings its ends together.
#[test]
fn analytic_each_cable_is_laid_in_one_step() {
    let design = designed("cognifly");
    let mounting = mounted(&design);
    for cable in wires(&design).into_iter().filter(|wire| wire.joins.is_some()) {
        let laid = mounting.steps().filter(|step| cable.joins.is_some_and(|ends| step.joined_end(ends).is_some())).count();
        assert_eq!(laid, 1, "{}", cable.name);
    }
}

#[test]
fn analytic_texts_name_no_cable_of_what_the_design_lacks() {
    let told = |design: &Design| {
        let texts: String = mounted(design).steps().map(|step| step.text.clone()).collect();
        ["sensor cable", "board cable"].map(|cable| texts.contains(cable))
    };
    assert_eq!(told(&designed("cognifly")), [true; 2]);
    assert_eq!(told(&all_in_one(&["flow_sensor", "damper"])), [false; 2]);
}

/// Cables, wires and the receiver that a bill lists as used up.
fn connected(design: &Design) -> Vec<String> {
    let bill = bill(design, &mass::table(design), None);
    let supplies = bill.buy.into_iter().filter(|line| line.kind == "supply");
    supplies
        .filter(|line| line.role.ends_with("_cable") || line.role.ends_with("_wire") || line.role == "receiver")
        .map(|line| line.role)
        .collect()
}

/// No cable and no receiver is bought that no step connects, and no step connects one that is not bought.
#[test]
fn regress_every_cable_of_the_bill_is_connected_in_a_step() {
    for name in common::all_frames() {
        let design = designed(&name);
        let (mounting, roles) = (mounted(&design), connected(&design));
        let steps: Vec<&MountStep> = mounting.steps().collect();
        assert!(roles.len() >= 3, "{name}: {roles:?}");
        assert_eq!(untold(roles.iter().map(String::as_str), &steps), Vec::<&str>::new(), "{name}");
        for step in &steps {
            assert!(step.supplies.iter().all(|role| roles.iter().any(|other| other == role)), "{name}: {:?}", step.supplies);
            assert!(!step.text.contains(['{', '}']), "{name}: {}", step.text);
        }
        // The receiver is mounted once, with a place of its own or without one.
        let receivers = steps.iter().filter(|step| ["receiver", "radio"].contains(&step.mount)).count();
        assert_eq!(receivers, 1, "{name}");
    }
}

#[test]
fn planted_a_cable_that_no_step_plugs_in_is_found() {
    let design = designed("cognifly");
    let mut mounting = mounted(&design);
    let roles = connected(&design);
    let of = |mounting: &Mounting| {
        let steps: Vec<&MountStep> = mounting.steps().collect();
        untold(roles.iter().map(String::as_str), &steps).into_iter().map(String::from).collect::<Vec<_>>()
    };
    // The carrier's step without the words about the cable, and no step for the receiver.
    for step in &mut mounting.before {
        step.text = step.text.replace("computer cable", "lead");
    }
    mounting.before.retain(|step| step.mount != "radio");
    assert_eq!(of(&mounting), ["computer_cable", "receiver"]);
}

/// Nuts hold the boards on the screws: four of them after the last board, before the bracket closes the bay, with spares in the bill.
#[test]
fn regress_nuts_hold_the_boards_of_every_frame_with_a_stack() {
    for name in common::all_frames() {
        let design = designed(&name);
        let mounting = mounted(&design);
        let at = |id: &str| mounting.before.iter().position(|step| step.mount == id);
        let nuts = at("stack_nuts").unwrap_or_else(|| panic!("{name}: no nuts"));
        for board in ["flight_controller", "motor_controller", "both_controllers"] {
            assert!(at(board).is_none_or(|board| board < nuts), "{name}");
        }
        assert!(at("bracket").is_some_and(|bracket| nuts < bracket), "{name}");
        let lines: Vec<_> = mounting.before[nuts].parts.iter().map(|line| (line.part.as_str(), line.count)).collect();
        assert_eq!(lines, [("stack_nut", 4.0)], "{name}");
        let bill = bill(&design, &mass::table(&design), None);
        let line = bill.buy.iter().find(|line| line.role == "stack_nut").expect("is bought");
        assert_eq!([line.quantity, line.with_spares], [4, 5], "{name}");
        let of_steps: f64 = mounting.parts().filter(|line| line.part == "stack_spacer").map(|line| line.count).sum();
        let spacers = bill.buy.iter().find(|line| line.role == "stack_spacer").expect("are bought");
        assert_eq!(of_steps, f64::from(spacers.quantity), "{name}");
        let [first, last] =
            [mounting.parts().find(|line| line.part == "stack_spacer"), mounting.parts().filter(|line| line.part == "stack_spacer").last()];
        let counts = [first, last].map(|line| line.map(|line| line.count));
        assert_eq!(counts, if name == "cognifly" { [Some(4.0), Some(8.0)] } else { counts }, "{name}");
    }
}

/// The measured total of the real frame stays: its nuts are a part of what nobody itemised.
#[test]
fn measured_the_real_frames_total_contains_its_nuts() {
    let masses = mass::table(&designed("cognifly-v8"));
    let nuts = masses.lines.iter().find(|line| line.name == "stack_nut").expect("has nuts");
    assert_eq!((nuts.total_g, nuts.basis.as_str()), (0.0, "in unitemised"));
    assert!((masses.total_g - 241.0).abs() < 0.05, "{}", masses.total_g);
}

/// Which face of the board goes up, and what to set where it faces the ground, in every frame.
#[test]
fn regress_the_board_with_the_arrow_has_a_side_and_an_alignment() {
    for name in common::all_frames() {
        let mounting = mounted(&designed(&name));
        let board = mounting.before.iter().find(|step| ["flight_controller", "both_controllers"].contains(&step.mount)).expect("has one");
        for words in ["face with its arrow is towards the hub", "faces the ground", "roll 180 degrees"] {
            assert!(board.text.contains(words), "{name}: {}", board.text);
        }
        assert!(board.caution.is_some_and(|caution| caution.contains("Before the first flight, test the alignment")), "{name}");
    }
}

/// Where the rods are of bamboo, no step and no caution speaks of carbon.
#[test]
fn regress_instructions_of_bamboo_rods_name_no_carbon() {
    let design = designed("cognifly-bamboo");
    let fold = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
    let cautions: String = fold.steps.iter().filter_map(|step| step.caution.as_deref()).collect();
    let texts: String = mounted(&design).steps().map(|step| format!("{} {}", step.text, step.caution.unwrap_or_default())).collect();
    assert!(cautions.contains("bamboo"), "{cautions}");
    assert!(!format!("{cautions}{texts}").to_lowercase().contains("carbon"), "{cautions}{texts}");
}

/// Two of the ties pass between computer and carrier: the step lays washers there, and the bill has them.
#[test]
fn regress_washers_under_the_computer_are_told_and_bought() {
    let design = designed("cognifly");
    let step = mounted(&design).before.into_iter().find(|step| step.mount == "computer").expect("is mounted");
    assert!(step.text.contains("Lay washers on each of the carrier's four holes"), "{}", step.text);
    let bill = bill(&design, &mass::table(&design), None);
    let line = bill.buy.iter().find(|line| line.role == "small_screws").expect("are bought");
    assert!(line.search.contains("washers") && line.note.contains("computer onto its carrier"), "{line:?}");
    assert!(step.text.contains("two screws M2 x 4 through its rear holes"), "{}", step.text);
    assert!(line.note.contains("2 x M2 x 4 and 2 x M2 x 8"), "{line:?}");
    let camera = mounted(&design).before.into_iter().find(|step| step.mount == "camera").expect("is mounted");
    assert!(camera.text.contains("4 screws M2 x 8, a nut behind each post"), "{}", camera.text);
    // A boss of the hub reaches under the carrier's holes: a head or a nut has no room there.
    let hub = &design.bodies.iter().find(|body| body.name == "hub").map(|body| design.shape(body)).expect("has one").solid;
    let (carrier, low) = (&design.frame.pi_carrier, design.centre.carrier_top_mm() - design.frame.pi_carrier.carrier_thickness_mm);
    let [x, y] = [carrier.pi_pattern_across_mm, carrier.pi_pattern_along_mm].map(|pattern| 0.5 * pattern);
    let head = Feature::cylinder_between(Point3::new(x, y, low - 1.6), Point3::new(x, y, low), 2.0);
    let shared_mm3 = hub.intersection(&MeshSolid::build(&head)).volume_mm3();
    assert!(shared_mm3 > 1.0, "{shared_mm3}");
}

/// A camera for goggles needs a transmitter that no frame has: bill and step say so.
#[test]
fn regress_a_camera_for_goggles_says_that_its_transmitter_is_not_included() {
    let design = designed(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/frames/four-inch-long-range.toml"));
    let bill = bill(&design, &mass::table(&design), None);
    let line = bill.buy.iter().find(|line| line.role == "fpv_camera").expect("has one");
    assert!(line.note.contains("transmitter") && line.note.contains("only where the frame's file lists them"), "{line:?}");
    let step = mounted(&design).before.into_iter().find(|step| step.mount == "fpv_camera").expect("is mounted");
    assert!(
        step.text.contains("video transmitter") && step.text.contains("has no place of its own") && step.text.contains("Turn it up by 20°"),
        "{}",
        step.text
    );
    // It is digital: its ribbon has an end at the camera, and one at the transmitter.
    assert!(step.text.contains("Push its ribbon into its socket now"), "{}", step.text);
    let wiring = mounted(&design).after.into_iter().find(|step| step.mount == "wiring").expect("has a step");
    assert!(wiring.text.contains("Push the ribbon of the camera for goggles into its video transmitter"), "{}", wiring.text);
}

/// A receiver without a body is drawn all the same: dark blue as all that a step brings.
#[test]
fn regress_the_receiver_is_seen_in_its_step() {
    let design = designed("cognifly");
    let fold = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
    let booklet = Booklet::new(&design, &mass::table(&design), &fold, &[]);
    let panel = booklet.before.iter().find(|panel| panel.heading.ends_with("Radio receiver onto the hub")).expect("has a step");
    let blue = panel.picture.rgb.chunks_exact(3).filter(|pixel| pixel[2] > pixel[0] + 30 && pixel[2] > pixel[1] + 20).count();
    assert!(blue > 2000, "{blue} pixels");
    assert!(panel.held.contains("The receiver is drawn as one of 18 x 12 x 4 mm."), "{}", panel.held);
}

/// An extra is taken in hand in the step that names it first, and not again with the motor wires.
#[test]
fn planted_an_extra_is_in_one_step() {
    let extra = |name: &str, covers: &str| {
        format!("[extras.{name}]\nmass_g = 1.5\nmass_basis = \"datasheet\"\nsource = \"its maker\"\ncovers = [{covers}]\n")
    };
    let extras = [extra("receiver", ""), extra("straps", "\"tie\"")].concat();
    let frame = common::resolve(&format!("base = \"cognifly\"\n[bought]\ntie = \"none\"\n{extras}")).expect("resolves");
    let mounting = mounted(&Design::with(frame, common::memo()).expect("designs"));
    let taken_in = |name: &str| {
        let takes = |step: &&MountStep| step.parts.iter().any(|line| line.part == name);
        mounting.steps().filter(takes).map(|step| step.mount).collect::<Vec<_>>()
    };
    // What stands for the ties is taken in hand where two of them would be.
    assert_eq!([taken_in("receiver"), taken_in("straps")], [["radio"], ["computer"]]);
}

/// Wires of the bill are a supply of the step that speaks of them first.
#[test]
fn regress_wires_are_introduced_where_they_are_first_used() {
    let mounting = mounted(&designed("cognifly"));
    for role in ["battery_wire", "motor_wire"] {
        let words = format!("{}s of the bill", role.replace('_', " "));
        let told = mounting.steps().position(|step| step.text.contains(&words));
        assert!(told.is_some() && told == mounting.steps().position(|step| step.supplies.contains(&role)), "{role}");
    }
}

#[test]
fn planted_a_part_without_a_step_is_found() {
    let design = designed("cognifly");
    let mut mounting = mounted(&design);
    let at = mounting.before.iter().position(|step| step.mount == "stack_screws").expect("is mounted");
    mounting.before.remove(at);
    let missing = without_a_step(listed(&design).into_iter(), mounting.parts());
    assert_eq!(missing, ["hub", "stack_screw"]);
}

#[test]
fn analytic_precedence_has_no_circle_and_the_order_keeps_it() {
    let ids: Vec<&str> = MOUNTS.iter().map(|mount| mount.id).collect();
    assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), ids.len());
    assert!(MOUNTS.iter().flat_map(|mount| mount.needs).all(|(id, _)| ids.contains(id)));
    for preset in ["cognifly", "cognifly-v8", "cognifly-2s2000"] {
        let mounting = mounted(&designed(preset));
        let order: Vec<&str> = mounting.steps().map(|step| step.mount).collect();
        for (at, step) in mounting.steps().enumerate() {
            assert!(step.after.iter().all(|other| order[..at].contains(&other.mount)), "{preset}: {step:?}");
            assert!(step.before.iter().all(|other| order[at + 1..].contains(&other.mount)), "{preset}: {step:?}");
            assert_eq!(step.sweep.meetings, [], "{preset}: {}", step.title);
        }
        // The meshes alone say that the boards are in before the bracket closes the bay.
        let board = mounting.before.iter().find(|step| step.mount == "motor_controller").expect("is mounted");
        assert!(board.before.iter().any(|other| other.mount == "bracket"), "{preset}: {board:?}");
    }
}

#[test]
fn analytic_propellers_come_last_and_the_first_power_is_without_them() {
    for design in [designed("cognifly"), without(&["computer", "camera"])] {
        let mounting = mounted(&design);
        let fold = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
        let [.., power, last] = &mounting.after[..] else { panic!("{:?}", mounting.after) };
        assert_eq!((power.mount, last.mount, last.brings.len(), last.repeats), ("cartridge", "propellers", 4, 4));
        assert!(power.text.contains("first power, without propellers") && last.after.iter().any(|other| other.mount == "cartridge"));
        assert_eq!(last.onto_of("propeller_BL"), "motor_BL");
        let turning = |body: &&flexframe::frame::assembly::Body| body.name.starts_with("propeller_");
        let all = mounting.before.len() + fold.steps.len() + mounting.after.len();
        assert!(design.bodies.iter().filter(turning).all(|body| mounting.first_step(&fold, &body.name) == Some(all - 1)));
    }
}

/// As the steps say: battery and lid are taken out after the first power, and are out while hands are at the propellers.
#[test]
fn regress_battery_and_lid_are_out_of_the_frame_at_the_propellers() {
    for name in common::all_frames() {
        let mounting = mounted(&designed(&name));
        let [.., power, last] = &mounting.after[..] else { panic!("{name}: {:?}", mounting.after) };
        assert!(power.text.contains("take battery and lid out again") && last.caution.is_some_and(|text| text.contains("battery is out")));
        assert_eq!(last.taken_out, power.moves, "{name}");
        assert!(["battery", "battery_lid"].iter().all(|body| last.taken_out.iter().any(|out| out == body)), "{name}: {last:?}");
        assert!(last.there.iter().all(|body| !last.taken_out.contains(body)), "{name}: {last:?}");
        let others = || mounting.steps().filter(|step| step.mount != "propellers");
        assert!(others().all(|step| step.taken_out.is_empty()), "{name}");
    }
}

#[test]
fn planted_an_order_in_which_something_is_in_the_way() {
    let design = designed("cognifly");
    let fold = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
    let swapped = |first: &str, then: &str| -> Mounting {
        let mut order: Vec<&str> = mounted(&design).steps().map(|step| step.mount).collect();
        let [a, b] = [first, then].map(|id| order.iter().position(|other| *other == id).expect("is mounted"));
        let moved = order.remove(b);
        order.insert(a, moved);
        Mounting::in_given_order(&design, &fold, &order)
    };
    let met = |mounting: &Mounting, id: &str| {
        let step = mounting.steps().find(|step| step.mount == id).expect("is mounted").clone();
        step.sweep.meetings.into_iter().flat_map(|m| m.bodies).collect::<BTreeSet<String>>()
    };
    // The bracket under the hub before the boards: its base closes the bay.
    let found = met(&swapped("flight_controller", "bracket"), "flight_controller");
    assert!(found.contains("flight_controller") && found.contains("battery_bracket"), "{found:?}");
    // The lid in the sleeve before its battery.
    let found = met(&swapped("battery", "cartridge"), "battery");
    assert!(found.contains("battery") && found.len() > 1, "{found:?}");
}

#[test]
fn planted_a_motor_behind_the_sleeve_is_in_the_way_of_the_battery() {
    let mut design = designed("cognifly");
    let battery = design.bodies.iter().find(|body| body.name == "battery").expect("has one");
    let [low, high] = design.placed(battery).bounds_mm();
    let motor = design.bodies.iter_mut().find(|body| body.name == "motor_BL").expect("has one");
    motor.pose.translation.vector = Vector3::new(0.0, low[1] - 40.0, 0.5 * (low[2] + high[2]));
    let mounting = mounted(&design);
    for step in mounting.steps() {
        assert_eq!(step.sweep.beyond_mm3 > 0.0, step.mount == "cartridge", "{}: {:?}", step.title, step.sweep);
    }
    assert!(mounting.after.iter().flat_map(|step| &step.sweep.meetings).all(|m| m.bodies[1] == "motor_BL"));
}
