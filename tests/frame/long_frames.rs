//! Frames that are longer than wide: their symmetry, their rods, their fold and their mechanics.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use flexframe::checks::{self, Verdict};
use flexframe::frame::assembly::{BodyKind, Design, mass};
use flexframe::frame::fold::{FoldSequence, Task, sweeps};
use flexframe::frame::skeleton::{RodRole, Skeleton};
use flexframe::mechanics::model::frame_model::{Extent, FrameModel};
use flexframe::mechanics::result::static_curve::StaticCurve;
use flexframe::mechanics::settings::MechanicsSettings;
use flexframe::params::Frame;
use flexframe::solid::{Feature, MeshSolid};
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

use crate::common;

const RATIO: f64 = 1.14;

fn frame(changes: &str) -> Frame {
    common::resolve(&format!("base = \"cognifly\"\nlimits.envelope_depth_mm = 300.0\n{changes}")).expect("a frame")
}

fn designed(changes: &str) -> Design {
    Design::with(frame(changes), common::memo()).expect("designs")
}

fn long() -> &'static Design {
    static LONG: LazyLock<Design> = LazyLock::new(|| designed(&format!("rods.cage_side_ratio = {RATIO}")));
    &LONG
}

/// Names without the module that they end in or hold.
fn kind(name: &str) -> String {
    let of_module = |word: &&str| !["FR", "FL", "BL", "BR", "left", "right"].contains(word);
    name.split('_').filter(of_module).collect::<Vec<_>>().join("_")
}

#[test]
fn analytic_each_body_of_a_module_has_its_mirror_images() {
    let design = long();
    let bodies = || design.bodies.iter().filter(|body| body.module.is_some());
    let middle = |body| {
        let [low, high] = design.placed(body).bounds_mm();
        Point3::from((Vector3::from(low) + Vector3::from(high)) * 0.5)
    };
    assert!(bodies().count() > 40);
    for body in bodies() {
        for mirror in [Vector3::new(-1.0, 1.0, 1.0), Vector3::new(1.0, -1.0, 1.0)] {
            let wanted = Point3::from(middle(body).coords.component_mul(&mirror));
            let found = bodies().filter(|other| kind(&other.name) == kind(&body.name)).any(|other| (middle(other) - wanted).norm() < 2e-3);
            // A motor's screws are turned with their motor, and no mirror image.
            assert!(found || body.name.starts_with("motor_screw"), "{}: nothing at {wanted}", body.name);
        }
    }
}

#[test]
fn analytic_rods_end_in_the_sockets_of_two_modules() {
    let skeleton = &long().skeleton;
    for rod in &skeleton.rods {
        let along = (rod.end - rod.start).normalize();
        for (tip, socket, inwards) in [(rod.start, &rod.sockets[0], along), (rod.end, &rod.sockets[1], -along)] {
            let in_socket = (tip - socket.bottom).dot(&socket.axis);
            assert!((tip - socket.bottom - socket.axis.into_inner() * in_socket).norm() < 1e-9, "{}: off the bore's axis", rod.name);
            assert!(socket.axis.dot(&inwards) > 1.0 - 1e-9 && (0.0..socket.depth_mm).contains(&in_socket), "{}", rod.name);
        }
    }
    let length = |role| skeleton.length_mm(role);
    assert!((length(RodRole::CageSide) / length(RodRole::Cage) - RATIO).abs() < 1e-9);
    let counts: BTreeMap<&str, usize> = skeleton.roles().into_iter().map(|role| (role.slug(), skeleton.rods_of(role).count())).collect();
    assert_eq!(counts, BTreeMap::from([("arm", 8), ("cage", 4), ("cage_side", 4), ("leg", 4), ("strut", 8)]));
}

#[test]
fn analytic_rods_weigh_what_their_lengths_say() {
    let masses = mass::table(long());
    let rod = &long().frame;
    let area_mm2 = std::f64::consts::PI * (0.5 * rod.rods.rod_diameter_mm).powi(2);
    let line = |name: &str| masses.lines.iter().find(|line| line.name == name).expect("a line").total_g;
    let ratio = line("cage_side_rod") / line("cage_rod");
    let sawn = [RodRole::CageSide, RodRole::Cage].map(|role| long().skeleton.sawn_mm(role));
    assert!((ratio - sawn[0] / sawn[1]).abs() < 2e-3, "{ratio}, rods of {area_mm2:.2} mm2");
}

#[test]
fn analytic_modules_balance_on_the_hubs_axis() {
    let design = long();
    let modules = design.bodies.iter().filter(|body| body.module.is_some());
    let (mut sum, mut volume) = (Vector3::zeros(), 0.0);
    for body in modules {
        let mesh = design.placed(body);
        sum += mesh.mesh().moments().0.coords * mesh.volume_mm3();
        volume += mesh.volume_mm3();
    }
    let centre = sum / volume;
    assert!(centre.x.abs() < 2e-3 && centre.y.abs() < 2e-3, "{centre}");
}

#[test]
fn analytic_a_long_frame_keeps_every_limit() {
    let design = long();
    let masses = mass::table(design);
    let broken: Vec<String> = checks::check(design, &masses)
        .iter()
        .filter(|f| f.verdict == Verdict::Violated)
        .map(|f| format!("{} {}: {}", f.rule, f.subject, f.message))
        .collect();
    assert_eq!(broken, Vec::<String>::new());
}

/// Bodies that meet while a frame is folded, with the step.
fn met(design: &Design) -> Vec<(Task, [String; 2])> {
    let fold = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
    let found = sweeps(design, &fold);
    fold.steps.iter().zip(found).flat_map(|(step, sweep)| sweep.meetings.into_iter().map(|m| (step.task, m.bodies))).collect()
}

#[test]
fn analytic_nothing_is_in_the_way_of_a_long_frames_fold() {
    assert_eq!(met(long()), []);
}

#[test]
fn planted_a_side_rod_that_is_too_long_is_found() {
    let mut design = designed(&format!("rods.cage_side_ratio = {RATIO}"));
    let body = design.bodies.iter().position(|body| body.name == "cage_FL_top").expect("a rod");
    let mut shape = design.shape(&design.bodies[body]).clone();
    assert_eq!(shape.kind, BodyKind::Rod(RodRole::CageSide));
    let feature = Feature::cylinder(0.5 * design.frame.rods.rod_diameter_mm, design.skeleton.length_mm(RodRole::CageSide) + 5.0);
    let solid = MeshSolid::build(&feature);
    shape.mesh = std::sync::Arc::new(solid.mesh());
    shape.solid = solid;
    shape.feature = Some(feature);
    design.bodies[body].shape = design.shapes.len();
    design.shapes.push(shape);
    let found = met(&design);
    assert!(found.iter().any(|(_, bodies)| bodies.iter().any(|name| name == "cage_FL_top")), "{found:?}");
}

/// Of the real frame, whose load has its centre of mass on the hub's axis: with one beside it the whole frame leans, which a quarter cannot.
#[test]
fn analytic_a_quarter_and_the_whole_long_frame_are_one() {
    let settings = MechanicsSettings::load(None).expect("the program's own numbers are sound");
    let frame = common::resolve(&format!("base = \"cognifly-v8\"\nrods.cage_side_ratio = {RATIO}")).expect("a frame");
    let design = Design::with(frame, common::memo()).expect("designs");
    let [quarter, whole] = [Extent::Quarter, Extent::Whole].map(|extent| {
        let model = FrameModel::new(&design, &mass::table(&design), &settings, extent).expect("has a model");
        StaticCurve::new(&model, 6.0, &[]).expect("is followed")
    });
    assert!(quarter.points.len() > 3);
    for (a, b) in quarter.points.iter().zip(&whole.points) {
        assert!((a.force_n - b.force_n).abs() < 1e-3 * (1.0 + b.force_n), "{a:?} {b:?}");
    }
}

#[test]
fn analytic_instructions_say_which_rod_goes_where() {
    let fold = FoldSequence::new(&long().frame, &long().skeleton).expect("can be folded");
    let step = fold.steps.iter().find(|step| step.task == Task::PushTopCage).expect("a step");
    assert!(step.text.contains("front right and rear left take a rod of 192.0 mm"), "{}", step.text);
    assert!(step.text.contains("front left and rear right one of 218.5 mm"), "{}", step.text);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    /// The skeleton of any ratio: what is at the sides grows by the ratio, and nothing else of a module changes.
    #[test]
    fn analytic_any_ratio_moves_modules_and_changes_none(ratio in 1.0..1.25_f64) {
        let [square, long] = [1.0, ratio].map(|ratio| {
            let mut frame = Frame::load("cognifly").expect("a preset").0;
            frame.rods.cage_side_ratio = ratio;
            Skeleton::new(&frame).expect("closes")
        });
        let apart_mm = 0.5 * (ratio - 1.0) * square.length_mm(RodRole::Cage);
        for (was, is) in square.nodes.iter().zip(&long.nodes) {
            let along = if was.name == "H" { 0.0 } else { apart_mm.copysign(was.position.y) };
            prop_assert!((is.position - was.position - Vector3::new(0.0, along, 0.0)).norm() < 1e-9, "{}", was.name);
        }
        for (was, is) in square.rods.iter().zip(&long.rods) {
            let wanted = if is.role == RodRole::CageSide { was.length_mm() * ratio } else { was.length_mm() };
            prop_assert!((is.length_mm() - wanted).abs() < 1e-9, "{}", is.name);
        }
    }
}
