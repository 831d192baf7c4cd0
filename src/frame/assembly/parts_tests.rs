//! The records of the printed parts, in whole frames.

use std::sync::Arc;

use nalgebra::{Isometry3, UnitQuaternion};

use super::{BodyKind, Design, Printed, mass};
use crate::frame::parts::{Fold, MaterialClass, PrintedPart, Seat, Wall, catalogue};
use crate::frame::skeleton::{Centre, Skeleton};
use crate::memo::Memo;
use crate::params::{Frame, FrameFile, PartName, parameters, preset};
use crate::solid::Feature;

#[test]
fn analytic_every_part_is_made_placed_and_weighed_in_every_preset() {
    let mut met = Vec::new();
    let accessories = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/frames/four-inch-long-range.toml");
    for name in preset::names().chain([accessories]) {
        let design = Design::new(Frame::load(name).expect("is a frame").0).expect("closes");
        let masses = mass::table(&design);
        for part in catalogue().into_iter().filter(|part| (part.needed)(&design.frame)) {
            let made = design.part(part.name).unwrap_or_else(|| panic!("{name} has no {}", part.name));
            assert!(made.volume_mm3 > 0.0 && made.topology.bodies == 1, "{name}: {}", part.name);
            let bodies = design.bodies.iter().filter(|body| design.shape(body).kind == BodyKind::Printed(part.name));
            assert_eq!(bodies.count(), part.quantity() as usize, "{name}: {}", part.name);
            let line = masses.lines.iter().find(|line| line.name == part.name.slug()).expect("is weighed");
            assert!(line.total_g > 0.0 && line.quantity == part.quantity(), "{name}: {line:?}");
            met.push(part.name);
        }
    }
    assert!(PartName::ALL.iter().all(|name| met.contains(name)), "a part that none of them has");
}

/// Rods that are weighed with something else are counted there, and once.
#[test]
fn planted_rods_that_an_extra_covers_are_counted_once() {
    let design = |text: &str| {
        let file = FrameFile::parse("own.toml", &format!("base = \"cognifly\"\n{text}")).expect("reads");
        Design::new(Frame::resolve(&file).expect("is one")).expect("closes")
    };
    let of_rods = |masses: &mass::MassTable| {
        masses.lines.iter().filter(|line| line.kind == mass::LineKind::Rod).map(|line| line.total_g).sum::<f64>()
    };
    let plain = mass::table(&design(""));
    let weighed =
        mass::table(&design("[extras.all_rods]\nmass_g = 30.0\nmass_basis = \"measured\"\nsource = \"own\"\ncovers = [\"rod\"]\n"));
    assert!(of_rods(&plain) > 20.0 && of_rods(&weighed) == 0.0);
    assert!((weighed.total_g - (plain.total_g - of_rods(&plain) + 30.0)).abs() < 1e-9, "{} and {}", weighed.total_g, plain.total_g);
}

/// What is weighed together, with as much as its parts weigh, has the moments of its parts.
#[test]
fn analytic_an_extra_without_a_place_is_where_the_parts_are_that_it_covers() {
    let memo = Arc::default();
    let table = |text: &str| {
        let file = FrameFile::parse("own.toml", &format!("base = \"cognifly\"\n{text}")).expect("reads");
        mass::table(&Design::with(Frame::resolve(&file).expect("is one"), &memo).expect("closes"))
    };
    let together = |roles: &str, mass_g: f64, more: &str| {
        table(&format!("{more}[extras.both]\nmass_g = {mass_g}\nmass_basis = \"measured\"\nsource = \"a scale\"\ncovers = [{roles}]\n"))
    };
    let plain = table("");
    let of = |name: &str| plain.lines.iter().find(|line| line.name == name).map_or(0.0, |line| line.total_g);
    let rods_g: f64 = plain.lines.iter().filter(|line| line.kind == mass::LineKind::Rod).map(|line| line.total_g).sum();
    for (roles, mass_g) in [("\"battery\", \"motor\"", of("battery") + of("motor")), ("\"rod\", \"battery\"", rods_g + of("battery"))] {
        let weighed = together(roles, mass_g, "");
        assert!((weighed.total_g - plain.total_g).abs() < 1e-9);
        for axis in 0..3 {
            assert!((weighed.centre_of_mass_mm[axis] - plain.centre_of_mass_mm[axis]).abs() < 1e-9, "{roles}");
            for other in 0..3 {
                let [a, b] = [&weighed, &plain].map(|masses| masses.inertia_g_mm2[axis][other]);
                assert!((a - b).abs() < 1e-9 * plain.inertia_g_mm2[0][0], "{roles}: {a} {b}");
            }
        }
    }
    // Of a battery that is stated to weigh nothing, too.
    let weighed = together("\"battery\"", of("battery"), "[battery]\nbattery_mass_g = 0\n");
    assert!((weighed.centre_of_mass_mm[2] - plain.centre_of_mass_mm[2]).abs() < 1e-9);
}

#[test]
fn analytic_every_record_agrees_with_the_parameters() {
    for part in catalogue() {
        let name = part.name;
        let keys = part.walls.iter().flat_map(|wall| wall.keys);
        assert!(!part.walls.is_empty() && part.walls.iter().all(|wall| (1..=3).contains(&wall.keys.len())), "{name}: {:?}", part.walls);
        for key in keys {
            assert!(parameters().any(|p| *key == format!("{}.{}", p.table, p.key)), "{name}: {key} is no parameter");
        }
        assert!(parameters().any(|p| p.drives.contains(&name)), "nothing drives {name}");
    }
}

/// A small plate on the hub, in the place of a camera connector.
static TOY: PrintedPart = PrintedPart {
    name: PartName::CameraConnectorLeft,
    feature: |_, _, _| Feature::cuboid_between([0.0; 3], [10.0, 6.0, 2.0]),
    material: MaterialClass::Flexible,
    seat: Seat::Centre(|centre| Isometry3::translation(0.0, 0.0, centre.board_top_mm() + 5.0)),
    fold: Fold::Stands,
    print_turn: UnitQuaternion::identity,
    needed: |_| true,
    walls: &[Wall::anywhere(&["camera.camera_foot_mm"])],
};

#[test]
fn planted_a_part_needs_nothing_but_its_record() {
    let parts: Vec<&'static PrintedPart> = catalogue().into_iter().map(|part| if part.name == TOY.name { &TOY } else { part }).collect();
    let (mut frame, _) = Frame::load("cognifly").expect("a preset");
    frame.bought.remove("camera");
    let design = Design::of_parts(frame, &parts, &Arc::default()).expect("closes");
    let toy = design.part(TOY.name).expect("is made");
    assert!((toy.volume_mm3 - 120.0).abs() < 1e-3 && toy.topology.euler == 2, "{}", toy.volume_mm3);
    let body = design.bodies.iter().find(|body| body.name == TOY.name.slug()).expect("is placed");
    assert!((body.pose.translation.z - design.centre.board_top_mm() - 5.0).abs() < 1e-9 && body.module.is_none());
    let masses = mass::table(&design);
    let line = masses.lines.iter().find(|line| line.name == TOY.name.slug()).expect("is weighed");
    assert!(line.quantity == 1 && line.total_g > 0.0 && line.material == design.frame.flexible.name, "{line:?}");
    assert!(design.part(PartName::CameraConnectorRight).is_none(), "nothing carries a camera that is not there");
}

#[test]
fn planted_an_extra_is_where_its_file_says_whatever_it_is_called() {
    let memo = Arc::default();
    let of = |name: &str| {
        let text = format!(
            "base = \"cognifly-mini\"\n[extras.{name}]\nmass_g = 20.0\nposition_mm = [0, 60, 0]\nmass_basis = \"measured\"\nsource = \"a scale\"\n"
        );
        let frame = Frame::resolve(&FrameFile::parse("own.toml", &text).expect("reads")).expect("is allowed");
        let masses = mass::table(&Design::with(frame, &memo).expect("closes"));
        (masses.total_g, masses.centre_of_mass_mm, masses.inertia_g_mm2)
    };
    let ballast = of("ballast");
    for name in ["motor", "battery", "hub", "receiver", "cage_rod"] {
        assert_eq!(of(name), ballast, "{name}");
    }
}

/// Frames a few percent beside a preset: where the web of a folded corner is swept, its surface all but touches that of the sides.
#[test]
fn regress_corners_that_graze_are_made() {
    for text in include_str!("../../../tests/reference/grazing_corners.txt").split("# --- frame ---").skip(1) {
        let file = FrameFile::parse("grazing.toml", text).expect("reads");
        let frame = Frame::resolve(&file).expect("is allowed");
        let (skeleton, centre) = (Skeleton::new(&frame).expect("closes"), Centre::new(&frame));
        for name in [PartName::TopCorner, PartName::BottomCorner] {
            let made = Printed::make(name, &frame, &skeleton, &centre, &Memo::default());
            assert!(made.is_ok(), "{name}: {:?}", made.err());
        }
    }
}
