//! What takes numbers, given many: units, closure, the mass table, and the readers of files.

use crate::common;
use std::collections::BTreeMap;

use flexframe::frame::assembly::{Body, Design, mass};
use flexframe::frame::skeleton::{Closure, Envelope, Rod, RodRole, Skeleton, lengths_for};
use flexframe::params::{Frame, FrameFile, LoadError, preset};
use flexframe::units::{Angle, Density};
use nalgebra::{Matrix3, Point3, Vector3};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn analytic_angles_keep_their_value_through_both_units(degrees in -720.0..720.0f64) {
        let angle = Angle::deg(degrees);
        prop_assert!((angle.to_deg() - degrees).abs() < 1e-12 * 720.0);
        prop_assert_eq!(Angle::rad(angle.to_rad()), angle);
        prop_assert!((angle.sin().powi(2) + angle.cos().powi(2) - 1.0).abs() < 1e-14);
        prop_assert!((angle.tan() * angle.cos() - angle.sin()).abs() < 1e-9);
    }

    #[test]
    fn analytic_masses_are_linear(density in 0.1..20.0f64, volume in 1.0..1e6f64) {
        let material = Density::g_cm3(density);
        prop_assert!((material.mass_g(volume) * 1000.0 / volume - density).abs() < 1e-12 * density);
        prop_assert!((material.mass_g(2.0 * volume) - 2.0 * material.mass_g(volume)).abs() < 1e-9);
    }
}

fn default_frame() -> Frame {
    Frame::load("cognifly").expect("a preset is valid").0
}

/// The default frame with other rods and joints.
fn lengths() -> impl Strategy<Value = Frame> {
    let rods = (60.0..320.0f64, 40.0..180.0f64, 20.0..120.0f64, 0.0..4.0f64);
    let joints = (4.0..8.0f64, 8.0..16.0f64, 4.0..9.0f64, 1.0..6.0f64, 9.0..20.0f64, 18.0..40.0f64, 1.0..7.0f64);
    // Every other frame near the default, so that enough of them close.
    (rods, joints, any::<bool>()).prop_map(|((cage, arm, strut, slack), (node, leg, knee, offset, reach, mouth, pivot), near)| {
        let mut frame = default_frame();
        let share = if near { 0.06 } else { 1.0 };
        let towards = |value: &mut f64, drawn: f64| *value += share * (drawn - *value);
        towards(&mut frame.rods.cage_rod_length_mm, cage);
        towards(&mut frame.rods.arm_rod_length_mm, arm);
        towards(&mut frame.rods.strut_rod_length_mm, strut);
        towards(&mut frame.rods.arm_rod_slack_mm, slack);
        towards(&mut frame.corner.corner_node_to_bottom_mm, node);
        towards(&mut frame.corner.corner_leg_bottom_mm, leg);
        towards(&mut frame.knee.knee_node_to_bottom_mm, knee);
        towards(&mut frame.knee.knee_node_offset_mm, offset);
        towards(&mut frame.fork.fork_reach_mm, reach);
        towards(&mut frame.hub.hub_mouth_mm, mouth);
        towards(&mut frame.hub_joint.hub_leg_pivot_mm, pivot);
        frame
    })
}

/// A rod lies on the axes of both its sockets, as deep in each as its slack leaves it.
fn assert_seated(rod: &Rod, slack_mm: [f64; 2]) {
    let ends = [rod.start, rod.end];
    for (i, socket) in rod.sockets.iter().enumerate() {
        let along = (ends[1 - i] - ends[i]).normalize();
        assert!(
            (along - socket.axis.into_inner()).norm() < 1e-9,
            "{}: the bore points along {:?}, the rod {along:?}",
            rod.name,
            socket.axis
        );
        let above = (ends[i] - socket.bottom).dot(&socket.axis);
        let off = (ends[i] - socket.bottom - socket.axis.into_inner() * above).norm();
        assert!(off < 1e-9 && (above - slack_mm[i]).abs() < 1e-9, "{}: {off} off, {above} above the bottom", rod.name);
    }
}

proptest! {
    #![proptest_config(config(512))]

    #[test]
    fn analytic_a_frame_closes_or_is_refused(frame in lengths()) {
        let Ok(skeleton) = Skeleton::new(&frame) else { return Ok(()) };
        let rods = &frame.rods;
        for (role, stated) in
            [(RodRole::Cage, rods.cage_rod_length_mm), (RodRole::Arm, rods.arm_rod_length_mm), (RodRole::Strut, rods.strut_rod_length_mm)]
        {
            prop_assert!(skeleton.rods_of(role).all(|rod| (rod.length_mm() - stated).abs() < 1e-9), "{role:?}");
        }
        prop_assert_eq!(skeleton.rods.len(), 28);
        for rod in &skeleton.rods {
            let slack = if rod.role == RodRole::Arm { rods.arm_rod_slack_mm } else { 0.0 };
            assert_seated(rod, [0.0, slack]);
        }
        let closure = &skeleton.closure;
        let leg = skeleton.length_mm(RodRole::Leg);
        prop_assert!(leg >= 20.0 && (leg - closure.leg_rod_length_mm).abs() < 1e-9);
        prop_assert!((10.0..=35.0).contains(&closure.strut_tilt.to_deg()));
    }

    #[test]
    fn analytic_a_wanted_size_gives_the_lengths_that_give_it(
        width_mm in 150.0..350.0f64, height_mm in 80.0..200.0f64, tilt in 12.0..33.0f64
    ) {
        let mut frame = default_frame();
        let lengths = lengths_for(&Envelope { width_mm, height_mm, strut_tilt: Angle::deg(tilt) }, &frame);
        [frame.rods.cage_rod_length_mm, frame.rods.arm_rod_length_mm, frame.rods.strut_rod_length_mm] = lengths;
        let Ok(closure) = Closure::solve(&frame) else { return Ok(()) };
        prop_assert!((closure.strut_tilt.to_deg() - tilt).abs() < 1e-9);
        // A size is a limit: the frame stays under it by 2 µm, which its rounded corners may take.
        let below_mm = height_mm - 2.0 * (closure.ring_half_height_mm + closure.corner_radius_mm);
        prop_assert!((0.0..0.003).contains(&below_mm), "{below_mm}");
    }
}

#[test]
fn analytic_enough_of_the_drawn_frames_close() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let mut runner = TestRunner::deterministic();
    let drawn = (0..400).map(|_| lengths().new_tree(&mut runner).expect("has no filter").current());
    let closing = drawn.filter(|frame| Closure::solve(frame).is_ok()).count();
    assert!((40..360).contains(&closing), "{closing} of 400 close: the test above sees too little of one kind");
}

/// The bodies that a line of the mass table stands for.
fn bodies_of<'a>(design: &'a Design, line: &str) -> Vec<&'a Body> {
    let shapes: Vec<String> = match line {
        "connector" | "magnet" => vec![format!("{line}_bracket"), format!("{line}_lid")],
        "stack_spacer" => vec![format!("{line}_hub"), format!("{line}_boards")],
        other => vec![other.into()],
    };
    design.bodies.iter().filter(|body| shapes.contains(&design.shape(body).name)).collect()
}

/// Mass, first moment and second moment, g, g mm, g mm².
type Moments = (f64, Vector3<f64>, Matrix3<f64>);

fn add(sum: &mut Moments, mass_g: f64, at: Vector3<f64>) {
    sum.0 += mass_g;
    sum.1 += at * mass_g;
    sum.2 += at * at.transpose() * mass_g;
}

/// Moments of a body by a rule of four points in each tetrahedron between the origin and a facet, exact to the second order.
fn add_body(sum: &mut Moments, design: &Design, body: &Body, mass_g: f64) {
    let (near, far) = (0.138_196_601_125_010_5, 0.585_410_196_624_968_5);
    let mesh = &design.shape(body).mesh;
    let density = mass_g / mesh.volume_mm3();
    for triangle in &mesh.triangles {
        let corners = mesh.corners(triangle).map(|corner| body.pose * corner);
        let all = [Point3::origin(), corners[0], corners[1], corners[2]].map(|corner| corner.coords);
        let volume = all[1].dot(&all[2].cross(&all[3])) / 6.0;
        let middle: Vector3<f64> = all.iter().sum();
        for corner in all {
            add(sum, 0.25 * density * volume, middle * near + corner * (far - near));
        }
    }
}

#[test]
fn analytic_the_mass_table_sums_and_its_inertia_is_that_of_all_tetrahedra() {
    for preset in ["cognifly", "cognifly-mini"] {
        let design = Design::with(Frame::load(preset).expect("a preset is valid").0, common::memo()).expect("can be made");
        let table = mass::table(&design);
        let mut sum: Moments = (0.0, Vector3::zeros(), Matrix3::zeros());
        for line in &table.lines {
            assert!((line.total_g - line.each_g * f64::from(line.quantity)).abs() < 1e-9, "{line:?}");
            let bodies = bodies_of(&design, &line.name);
            // Spacers are alike: their bodies weigh as much as they have volume. Halves of a pair count alike.
            let volume = |body: &Body| if line.name == "stack_spacer" { design.shape(body).mesh.volume_mm3() } else { 1.0 };
            let all: f64 = bodies.iter().map(|body| volume(body)).sum();
            for body in &bodies {
                add_body(&mut sum, &design, body, line.total_g * volume(body) / all);
            }
            if bodies.is_empty() && line.name == "motor_screw" {
                for module in ["FR", "FL", "BL", "BR"] {
                    add(&mut sum, 0.25 * line.total_g, design.skeleton.node(&format!("M_{module}")).expect("is there").coords);
                }
            } else if bodies.is_empty() {
                let at = design.frame.extras.get(&line.name).and_then(|extra| extra.position_mm).unwrap_or_default();
                add(&mut sum, line.total_g, at.into());
            }
        }
        let (mass_g, centre) = (sum.0, sum.1 / sum.0);
        assert!((mass_g - table.total_g).abs() < 1e-6 * mass_g, "{preset}: {mass_g} {}", table.total_g);
        assert!((centre - Vector3::from(table.centre_of_mass_mm)).norm() < 1e-4, "{preset}: {centre} {:?}", table.centre_of_mass_mm);
        let second = sum.2 - centre * centre.transpose() * mass_g;
        let inertia = Matrix3::identity() * second.trace() - second;
        let stated = Matrix3::from_fn(|row, column| table.inertia_g_mm2[row][column]);
        assert!((inertia - stated).norm() < 1e-5 * inertia.norm(), "{preset}: {inertia} {stated}");
        assert!((stated - stated.transpose()).norm() < 1e-9 * stated.norm(), "{preset}: not symmetric");
        let mut principal: Vec<f64> = stated.symmetric_eigenvalues().iter().copied().collect();
        principal.sort_by(f64::total_cmp);
        assert!(principal[0] > 0.0 && principal[0] + principal[1] > principal[2], "{preset}: no body has {principal:?}");
        let estimated: f64 = table.lines.iter().filter(|line| line.basis == "estimate").map(|line| line.total_g).sum();
        assert_eq!(estimated, table.estimated_g);
    }
}

/// Reads a text as a frame and says why not; nothing in it may panic, and every number of a frame is finite.
fn read(text: &str) -> Option<String> {
    match common::resolve(text) {
        Ok(frame) => {
            let numbers = flexframe::params::parameters().filter_map(|p| frame.value(p.table, p.key).map(|value| (p, value)));
            for (p, value) in numbers {
                assert!((p.min..=p.max).contains(&value), "{} = {value}", p.key);
            }
            assert!(frame.bought.values().all(|item| item.part.mass_g.is_finite() && item.part.mass_g >= 0.0));
            None
        }
        Err(LoadError::Refused(refusal)) => {
            assert!(!refusal.reason.remedy().is_empty());
            Some(refusal.render())
        }
        Err(other) => Some(other.to_string()),
    }
}

/// A change to a text: from where, how much goes, what comes.
fn mutated(text: &str, at: f64, gone: usize, new: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let from = (at * chars.len() as f64) as usize;
    let to = (from + gone).min(chars.len());
    chars[..from].iter().chain(new.chars().collect::<Vec<_>>().iter()).chain(&chars[to..]).collect()
}

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn planted_any_text_is_read_or_refused(text in "(?s).{0,120}") {
        read(&text);
    }

    #[test]
    fn planted_any_value_is_read_or_refused(
        key in prop::sample::select(vec!["base", "name", "printer", "schema", "rods", "rods.arm_rod_length_mm", "bought.motor", "extras.a",
            "extras.a.mass_g", "override.parts.x.mass_g", "target.width_mm", "materials.flexible", "limits.mass_budget_g", "a.b.c"]),
        value in prop::sample::select(vec!["1", "-0.0", "1e400", "nan", "-inf", "0x7fffffffffffffff", "99999999999999999999", "true", "\"\"",
            "\"cognifly\"", "\"..\"", "[]", "[1, \"a\", [2]]", "{}", "{ a = 1 }", "1979-05-27", "'''\n'''", "\"\\u0000\""]),
    ) {
        let base = if key == "base" { "" } else { "base = \"cognifly\"\n" };
        read(&format!("{base}{key} = {value}\n"));
    }

    #[test]
    fn planted_mutated_presets_are_read_or_refused(
        preset in prop::sample::select(preset::names().collect::<Vec<_>>()),
        changes in prop::collection::vec((0.0..1.0f64, 0usize..30, "[\\[\\]\"={}.#\n0-9a-z_ ö-]{0,8}"), 1..4),
    ) {
        let text = changes.iter().fold(preset::text(preset).expect("a preset").to_string(), |text, (at, gone, new)| mutated(&text, *at, *gone, new));
        read(&text);
    }

    #[test]
    fn planted_mutated_catalogue_entries_are_read_or_refused(
        place in prop::sample::select(vec!["parts.motor-1104", "parts.rod-carbon-3", "parts.battery-3s-650", "parts.magnet-10x5x3",
            "parts.flight-controller-20x20", "materials.tpu-95a", "materials.carbon", "printers.\"generic-0.4\""]),
        field in prop::sample::select(vec!["mass_g", "size_mm", "kind", "source", "diameter_mm", "density_g_cm3", "print_factor", "colour",
            "hole_pattern_mm", "hole_pcd_mm", "hole_count", "nozzle_mm", "bed", "material", "stock_length_mm", "mass_basis", "nothing"]),
        value in prop::sample::select(vec!["0", "-1", "3.0", "1e300", "nan", "inf", "\"round\"", "\"\"", "[1.0]", "[1.0, 2.0]", "[1.0, 2.0, 3.0]",
            "[nan, 1.0]", "[-1.0, 2.0, 3.0]", "[0.1, 0.2, 0.3, 1.0]", "\"nobody\"", "true", "\"estimate\"", "4"]),
    ) {
        read(&format!("base = \"cognifly\"\n[override.{place}]\n{field} = {value}\n"));
    }
}

#[test]
fn analytic_the_readers_above_read_what_is_right() {
    for preset in preset::names() {
        assert_eq!(read(preset::text(preset).expect("a preset")), None, "{preset}");
    }
    let shown: BTreeMap<&str, Option<String>> =
        [("a frame", common::toml("cognifly", &[])), ("none", "base = 3".into())].map(|(k, t)| (k, read(&t))).into();
    assert!(shown["a frame"].is_none() && shown["none"].as_ref().is_some_and(|text| text.contains("help:")));
    assert!(FrameFile::parse("x", "base = \"cognifly\"").is_ok());
}
