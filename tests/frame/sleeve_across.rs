//! The battery's sleeve across the frame: the turned centre, its way out, what is in its way, how it is mounted and simulated.

use flexframe::checks::{self, Finding, Verdict};
use flexframe::export::simulator::{LegSpring, model};
use flexframe::frame::assembly::{Design, mass};
use flexframe::frame::fold::FoldSequence;
use flexframe::frame::mounting::Mounting;
use flexframe::params::sleeve_direction::SleeveDirection;
use flexframe::params::{Frame, preset};

use crate::common;

const ACROSS: &str = "sleeve.sleeve_direction = \"across\"\n";

fn designed(base: &str, changes: &str) -> Design {
    let frame = common::resolve(&format!("base = \"{base}\"\n{changes}")).expect("a frame");
    Design::with(frame, common::memo()).expect("designs")
}

fn bounds(design: &Design, name: &str) -> [[f64; 3]; 2] {
    design.placed(design.bodies.iter().find(|body| body.name == name).expect("is there")).bounds_mm()
}

fn violated(design: &Design) -> Vec<Finding> {
    checks::check(design, &mass::table(design)).into_iter().filter(|f| f.verdict == Verdict::Violated).collect()
}

#[test]
fn analytic_across_the_rear_is_the_right_of_all_that_holds_the_battery() {
    let [along, across] = ["", ACROSS].map(|changes| designed("cognifly", changes));
    let turning = ["battery", "flow_sensor", "connector_bracket", "connector_lid", "magnet_bracket", "magnet_lid", "tie"];
    for name in ["battery_bracket", "battery_sleeve", "battery_lid"].into_iter().chain(turning) {
        let ([low, high], found) = (bounds(&along, name), bounds(&across, name));
        let turned = [[-high[1], low[0], low[2]], [-low[1], high[0], high[2]]];
        let near = (0..3).all(|axis| (0..2).all(|end| (found[end][axis] - turned[end][axis]).abs() < 2e-3));
        assert!(near, "{name}: {found:?}, {turned:?} turned");
    }
    let still = ["hub", "pi_carrier", "computer", "camera", "flight_controller", "motor_FR", "corner_top_FR"];
    for name in still.into_iter().filter(|name| along.bodies.iter().any(|body| body.name == *name)) {
        assert_eq!(bounds(&along, name), bounds(&across, name), "{name}");
    }
}

#[test]
fn regress_every_preset_breaks_no_other_limit_with_the_sleeve_across() {
    for name in preset::names() {
        let told = |changes: &str| -> Vec<String> {
            violated(&designed(name, changes)).into_iter().map(|f| format!("{} {}", f.rule, f.subject)).collect()
        };
        assert_eq!(told(ACROSS), told(""), "{name}");
    }
}

#[test]
fn analytic_a_long_frame_is_lighter_with_the_sleeve_across() {
    let long = "rods.cage_side_ratio = 1.14\nlimits.envelope_depth_mm = 240.0\n";
    let [along, across] = [String::new(), ACROSS.into()].map(|changes: String| designed("cognifly", &format!("{long}{changes}")));
    assert_eq!(violated(&across), []);
    // The ties beside the hub stay where they are, those in front and behind stand apart with the modules.
    let forward = along.centre.places.forward_mm;
    assert!((along.centre.bracket_half_mm - across.centre.bracket_half_mm - forward).abs() < 1e-9);
    let [along_g, across_g] = [&along, &across].map(|design| mass::table(design).total_g);
    assert!(along_g - across_g > 2.0, "{along_g} {across_g}");
}

#[test]
fn planted_a_high_battery_meets_the_ring_on_the_right_until_the_struts_are_longer() {
    let limits = "limits.envelope_width_mm = 300.0\nlimits.envelope_height_mm = 200.0\nlimits.mass_budget_g = 500.0\n";
    let pack = "bought.battery = \"high\"\noverride.parts.high.kind = \"battery\"\noverride.parts.high.size_mm = [70.0, 44.0, 30.0]\n\
                override.parts.high.mass_g = 58.0\noverride.parts.high.mass_basis = \"estimate\"\noverride.parts.high.source = \"a guess\"\n";
    let low = violated(&designed("cognifly", &format!("{ACROSS}{limits}{pack}")));
    let slides: Vec<&Finding> = low.iter().filter(|f| f.rule == "battery_slide").collect();
    assert!(!slides.is_empty() && slides.iter().all(|f| f.subject.ends_with("past cage_BR_bottom")), "{low:?}");
    assert!(slides.iter().all(|f| f.levers.iter().any(|lever| lever == "rods.strut_rod_length_mm")), "{slides:?}");
    let rods = "rods.strut_rod_length_mm = 60.0\nrods.arm_rod_length_mm = 80.0\n";
    assert_eq!(violated(&designed("cognifly", &format!("{ACROSS}{limits}{pack}{rods}"))), []);
}

#[test]
fn planted_a_board_that_is_too_long_for_the_turned_bay_names_the_direction() {
    let design = |changes: &str| {
        let mut frame = common::resolve(&format!("base = \"cognifly\"\n{changes}")).expect("a frame");
        // 50 mm from left to right: between the uprights there are 43.8 mm.
        frame.bought.get_mut("flight_controller").expect("has one").part.size_mm = [50.0, 32.5, 5.0];
        Design::with(frame, common::memo()).expect("designs")
    };
    assert_eq!(violated(&design("")), []);
    let found = violated(&design(ACROSS));
    let board = found.iter().find(|f| f.subject == "battery_bracket and flight_controller").expect("they meet");
    assert_eq!(board.levers[0], "sleeve.sleeve_direction");
}

#[test]
fn analytic_instructions_name_the_side_of_the_battery() {
    let said = |design: &Design| {
        let mounting = Mounting::new(design, &FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded"));
        let steps = mounting.steps().map(|step| (step.mount, step.from, step.text.clone(), step.sweep.beyond_mm3)).collect::<Vec<_>>();
        assert!(steps.iter().all(|(.., text, _)| !text.contains(['{', '}'])), "{steps:?}");
        assert!(steps.iter().all(|(.., beyond)| *beyond <= 0.0), "{steps:?}");
        steps
    };
    let [along, across] = ["", ACROSS].map(|changes| said(&designed("cognifly", changes)));
    let step = |steps: &[(&str, Option<[f64; 3]>, String, f64)], id: &str| {
        steps.iter().find(|(mount, ..)| *mount == id).map(|(_, from, text, _)| (*from, text.clone())).expect("is a step")
    };
    for (id, is_along, is_across) in
        [("cartridge", [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]), ("magnet_in_lid", [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0])]
    {
        assert_eq!((step(&along, id).0, step(&across, id).0), (Some(is_along), Some(is_across)), "{id}");
    }
    assert!(step(&along, "cartridge").1.starts_with("Slide battery and lid from the rear"), "{along:?}");
    assert!(step(&across, "cartridge").1.starts_with("Slide battery and lid from the right"), "{across:?}");
    assert!(step(&across, "ties").1.contains("hub and bracket, left and right, and out"), "{across:?}");
    assert!(step(&across, "flow_sensor").1.ends_with("state that in the flight controller's settings."), "{across:?}");
    assert_eq!(step(&along, "camera"), step(&across, "camera"));
}

#[test]
fn analytic_a_simulator_s_sleeve_lies_across() {
    let sleeve = |changes: &str| {
        let design = designed("cognifly", changes);
        let legs = LegSpring { from: "paper".into(), stiffness_n_m: 7040.0, damping_n_s_m: 46.0, doubt: None };
        let model = model(&design, &mass::table(&design), legs);
        let shape = model.shapes.iter().find(|shape| shape.name == "sleeve").expect("has one").clone();
        let span = |axis: usize| {
            let along = || shape.vertices_m.iter().map(|vertex| vertex[axis]);
            along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
        };
        [span(0), span(1), span(2)]
    };
    let ([long, wide, high], found) = (sleeve(""), sleeve(ACROSS));
    assert!(long > 1.5 * wide, "{long} {wide}");
    let near = [wide, long, high].iter().zip(found).all(|(a, b)| (a - b).abs() < 1e-5);
    assert!(near, "{found:?}");
}

#[test]
fn regress_a_frame_that_says_nothing_has_its_sleeve_along() {
    let silent = Frame::load("cognifly-mini").expect("a preset").0;
    let stated = common::resolve("base = \"cognifly-mini\"\nsleeve.sleeve_direction = \"along\"\n").expect("a frame");
    assert_eq!(silent.sleeve_direction, stated.sleeve_direction);
    assert_eq!(
        Design::with(silent, common::memo()).expect("designs").centre,
        Design::with(stated, common::memo()).expect("designs").centre
    );
}

#[test]
fn analytic_a_word_is_read_and_another_one_refused() {
    let read = |value: &str| common::resolve(&format!("base = \"cognifly\"\nsleeve.sleeve_direction = {value}\n"));
    for word in SleeveDirection::WORDS {
        assert_eq!(read(&format!("\"{word}\"")).expect("a frame").sleeve_direction.word(), word);
    }
    for (value, says) in [("\"acros\"", "\"across\""), ("\"sideways\"", "\"along\", \"across\""), ("90.0", "a text in quotes")] {
        let refused = read(value).expect_err("is no direction");
        assert!(format!("{refused} {refused:?}").contains(says), "{value}: {refused:?}");
    }
}
