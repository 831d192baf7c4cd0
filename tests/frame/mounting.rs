//! What is mounted around the fold: every part once, an order without circles, ways that are free, and ways that are not.

use std::collections::BTreeSet;

use flexframe::export::bill::bill;
use flexframe::frame::assembly::wires::wires;
use flexframe::frame::assembly::{Design, mass};
use flexframe::frame::fold::FoldSequence;
use flexframe::frame::mounting::{MOUNTS, Mounting, without_a_step};
use flexframe::params::Frame;
use nalgebra::Vector3;

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

/// Dampers go into the flight controller, and where one board is both controllers, into that.
#[test]
fn analytic_dampers_go_into_the_upper_board() {
    let steps = |design: &Design| {
        let mounting = mounted(design);
        let of = |id: &str| mounting.steps().position(|step| step.mount == id);
        [of("dampers"), of("dampers_in_motor_controller"), of("motor_controller")]
    };
    let both = steps(&designed("cognifly"));
    assert!(both[0].is_some() && both[1].is_none());
    let one = steps(&without(&["flight_controller", "flow_sensor"]));
    assert!(one[0].is_none() && one[1].is_some_and(|at| Some(at) < one[2]), "{one:?}");
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
        ["flow sensor's cable", "between the two boards"].map(|cable| texts.contains(cable))
    };
    assert_eq!(told(&designed("cognifly")), [true; 2]);
    assert_eq!(told(&without(&["flow_sensor", "flight_controller", "damper"])), [false; 2]);
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
