//! The two kernels against each other, and both against the formulas of geometry.

use crate::common;
use std::f64::consts::{PI, TAU};

use flexframe::frame::assembly::CentreBody;
use flexframe::frame::assembly::Design;
use flexframe::params::{Frame, preset};
use flexframe::solid::{Brep, Contour, Feature, MeshSolid, Profile, SEGMENTS_PER_TURN, Segment, gate};
use flexframe::units::Angle;
use nalgebra::{Point2, Vector3};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use rayon::prelude::*;

/// Segments on a circle.
const N: f64 = SEGMENTS_PER_TURN as f64;

/// Relative difference that is rounding.
const ROUNDING: f64 = 1e-9;

fn mesh_mm3(feature: &Feature) -> f64 {
    MeshSolid::build(feature).volume_mm3()
}

fn brep_mm3(feature: &Feature) -> f64 {
    Brep::build(feature).unwrap_or_else(|| panic!("no boolean in {feature:?}")).volume_mm3()
}

fn assert_close(what: &str, found: f64, exact: f64, tolerance: f64) {
    assert!((found / exact - 1.0).abs() <= tolerance, "{what}: {found}, by the formula {exact}");
}

/// Area between an arc and the chords that stand for it, mm².
fn chord_error_mm2(radius_mm: f64, sweep_rad: f64) -> f64 {
    let steps = (sweep_rad / TAU * N).ceil().max(1.0);
    let step = sweep_rad / steps;
    0.5 * steps * radius_mm * radius_mm * (step - libm::sin(step))
}

/// Sweep of an arc, rad, positive.
fn sweep(from: Point2<f64>, to: Point2<f64>, centre: Point2<f64>, counter_clockwise: bool) -> f64 {
    let (a, b) = (from - centre, to - centre);
    let left = (libm::atan2(b.y, b.x) - libm::atan2(a.y, a.x)).rem_euclid(TAU);
    if counter_clockwise { left } else { TAU - left }
}

/// The most by which the polygon of a contour can be off its area, mm².
fn contour_error_mm2(contour: &Contour) -> f64 {
    match contour {
        Contour::Circle { radius_mm, bore: true, .. } => radius_mm * radius_mm * (N * libm::tan(PI / N) - PI),
        Contour::Circle { radius_mm, .. } => chord_error_mm2(*radius_mm, TAU),
        Contour::Path { start, segments } => {
            let mut from = *start;
            let mut error = 0.0;
            for segment in segments {
                match segment {
                    Segment::Line { to } => from = *to,
                    Segment::Arc { to, centre, counter_clockwise } => {
                        error += chord_error_mm2((from - centre).norm(), sweep(from, *to, *centre, *counter_clockwise));
                        from = *to;
                    }
                }
            }
            error
        }
    }
}

/// The most by which the mesh of a solid without booleans can be off its volume, mm³.
fn chord_error_mm3(feature: &Feature) -> f64 {
    match feature {
        Feature::Extrude { profile, height_mm } => {
            let all = std::iter::once(&profile.outer).chain(&profile.holes);
            height_mm * all.map(contour_error_mm2).sum::<f64>()
        }
        Feature::Cylinder { radius_mm, height_mm } => height_mm * chord_error_mm2(*radius_mm, TAU),
        Feature::Bore { radius_mm, height_mm } => height_mm * contour_error_mm2(&Contour::bore([0.0, 0.0], *radius_mm)),
        Feature::Placed { of, .. } => chord_error_mm3(of),
        Feature::Union(of) if of.len() == 1 => chord_error_mm3(&of[0]),
        other => panic!("no bound is known for {other:?}"),
    }
}

/// Every solid of a frame: printed parts, bought parts, rods, motors and propellers.
fn solids(design: &Design) -> Vec<(String, Feature)> {
    let (frame, centre) = (&design.frame, &design.centre);
    let mut solids: Vec<(String, Feature)> = design.printed.iter().map(|part| (part.name.to_string(), part.feature.clone())).collect();
    solids.extend(CentreBody::ALL.into_iter().filter_map(|part| Some((part.slug().to_string(), part.feature(frame, centre)?))));
    let radius = 0.5 * frame.rods.rod_diameter_mm;
    solids.extend(
        design
            .skeleton
            .roles()
            .into_iter()
            .map(|role| (format!("{} rod", role.slug()), Feature::cylinder(radius, design.skeleton.length_mm(role)))),
    );
    solids.push(("propeller".into(), Feature::cylinder(0.5 * frame.motor_mount.propeller_diameter_mm, 4.0)));
    solids
}

#[test]
fn analytic_both_kernels_agree_on_every_solid_that_needs_no_boolean() {
    let one = |preset: &str| {
        let design = Design::with(Frame::load(preset).expect("a preset is valid").0, common::memo()).expect("can be made");
        let mut compared = Vec::new();
        for (name, feature) in solids(&design) {
            let Some(brep) = Brep::build(&feature) else { continue };
            assert!(brep.is_closed(), "{preset}: {name}");
            let (exact, mesh) = (brep.volume_mm3(), mesh_mm3(&feature));
            let bound = chord_error_mm3(&feature) + ROUNDING * exact;
            assert!((mesh - exact).abs() <= bound, "{preset}: {name}: mesh {mesh}, B-rep {exact}, chords explain {bound}");
            assert!(bound < 0.004 * exact, "{preset}: {name}: a bound of {bound} mm³ bounds nothing");
            compared.push(name);
        }
        for expected in ["pi_carrier", "battery", "flow_sensor", "connector_bracket", "magnet_lid", "arm rod", "leg rod"] {
            assert!(compared.iter().any(|name| name == expected), "{preset}: {expected} was not compared: {compared:?}");
        }
    };
    preset::names().collect::<Vec<_>>().into_par_iter().for_each(one);
}

#[test]
fn analytic_what_a_part_says_of_its_exact_volume_is_the_kernels() {
    let design = Design::with(Frame::load("cognifly").expect("a preset is valid").0, common::memo()).expect("can be made");
    for part in &design.printed {
        let brep = Brep::build(&part.feature).map(|brep| brep.volume_mm3());
        assert_eq!(part.exact_volume_mm3, brep, "{}", part.name);
    }
}

/// A placement that leaves nothing along an axis.
fn askew(feature: Feature) -> Feature {
    feature.turned(Vector3::new(1.0, 2.0, -0.5), Angle::deg(37.0)).at(3.0, -7.0, 11.0)
}

fn size() -> impl Strategy<Value = f64> {
    0.5..40.0f64
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn analytic_box(x in size(), y in size(), z in size()) {
        let feature = Feature::cuboid([x, y, z]);
        assert_close("mesh", mesh_mm3(&feature), x * y * z, ROUNDING);
        assert_close("mesh, askew", mesh_mm3(&askew(feature.clone())), x * y * z, ROUNDING);
        assert_close("B-rep", brep_mm3(&feature), x * y * z, ROUNDING);
        let between = Feature::cuboid_between([-x, 0.0, 1.0], [y, z, 2.0]);
        assert_close("between", mesh_mm3(&between), (x + y) * z, ROUNDING);
    }

    #[test]
    fn analytic_cylinder_and_bore(radius in size(), height in size()) {
        // Areas of the polygons of n corners on the circle and around it.
        let inscribed = 0.5 * N * radius * radius * libm::sin(TAU / N);
        let around = N * radius * radius * libm::tan(PI / N);
        let (cylinder, bore) = (Feature::cylinder(radius, height), Feature::bore(radius, height));
        assert_close("cylinder", mesh_mm3(&cylinder), inscribed * height, ROUNDING);
        assert_close("bore", mesh_mm3(&bore), around * height, ROUNDING);
        assert_close("cylinder, B-rep", brep_mm3(&cylinder), PI * radius * radius * height, 1e-8);
        assert_close("bore, B-rep", brep_mm3(&bore), PI * radius * radius * height, 1e-8);
    }

    #[test]
    fn analytic_cone(bottom in size(), top in size(), height in size()) {
        let polygon = |radius: f64| 0.5 * N * radius * radius * libm::sin(TAU / N);
        let (a, b) = (polygon(bottom), polygon(top));
        let exact = height / 3.0 * (a + b + (a * b).sqrt());
        assert_close("frustum", mesh_mm3(&Feature::cone(bottom, top, height)), exact, ROUNDING);
        assert_close("cone", mesh_mm3(&Feature::cone(bottom, 0.0, height)), height / 3.0 * a, ROUNDING);
    }

    #[test]
    fn analytic_rounded_plate_with_holes(x in 10.0..40.0f64, y in 10.0..40.0f64, round in 0.5..4.0f64, hole in 0.5..2.0f64, z in size()) {
        let outline = Contour::rounded_rectangle([2.0, 1.0], [x, y], round);
        let profile = Profile::new(outline).with_hole(Contour::circle([4.0, 1.0], hole)).with_hole(Contour::circle([-1.0, 1.0], hole));
        let area = x * y - (4.0 - PI) * round * round - TAU * hole * hole;
        assert_close("area", profile.area_mm2(), area, ROUNDING);
        let plate = Feature::extrude(profile, z);
        assert_close("B-rep", brep_mm3(&askew(plate.clone())), area * z, 1e-8);
        let lost = chord_error_mm3(&plate);
        prop_assert!((mesh_mm3(&plate) - area * z).abs() <= lost + ROUNDING * area * z);
    }

    #[test]
    fn analytic_rounded_regular_polygon(corners in 3usize..9, circumradius in 5.0..30.0f64, share in 0.05..0.9f64, z in size()) {
        let n = corners as f64;
        let corner = |i: usize| {
            let angle = TAU * i as f64 / n;
            [circumradius * libm::cos(angle), circumradius * libm::sin(angle)]
        };
        // A radius up to that of the inscribed circle fits.
        let round = share * circumradius * libm::cos(PI / n);
        let contour = Contour::rounded(&(0..corners).map(corner).collect::<Vec<_>>(), round);
        // Each corner loses its tip, tan(pi/n) - pi/n times the radius squared.
        let area = 0.5 * n * circumradius * circumradius * libm::sin(TAU / n) - n * round * round * (libm::tan(PI / n) - PI / n);
        assert_close("area", contour.area_mm2(), area, ROUNDING);
        let prism = Feature::extrude(Profile::new(contour), z);
        assert_close("B-rep", brep_mm3(&prism), area * z, 1e-8);
        prop_assert!((mesh_mm3(&prism) - area * z).abs() <= chord_error_mm3(&prism) + ROUNDING * area * z);
    }

    #[test]
    fn analytic_revolved_ring(inner in size(), wide in size(), high in size()) {
        let profile = Profile::new(Contour::rectangle([inner + 0.5 * wide, 0.0], [wide, high]));
        // Two polygons, one inside the other.
        let ring = 0.5 * N * libm::sin(TAU / N) * ((inner + wide).powi(2) - inner * inner);
        assert_close("ring", mesh_mm3(&Feature::revolve(profile)), ring * high, ROUNDING);
    }

    #[test]
    fn analytic_overlapping_boxes(a in 2.0..20.0f64, b in 2.0..20.0f64, overlap in 0.1..1.9f64) {
        let one = Feature::cuboid_between([0.0, 0.0, 0.0], [a, 5.0, 5.0]);
        let two = Feature::cuboid_between([a - overlap, 1.0, 1.0], [a - overlap + b, 4.0, 4.0]);
        let both = 9.0 * overlap;
        assert_close("union", mesh_mm3(&askew(Feature::union([one.clone(), two.clone()]))), 25.0 * a + 9.0 * b - both, ROUNDING);
        assert_close("difference", mesh_mm3(&askew(one.clone().minus([two.clone()]))), 25.0 * a - both, ROUNDING);
        assert_close("intersection", mesh_mm3(&askew(Feature::intersection([one.clone(), two.clone()]))), both, 1e-8);
        assert_close("mirror", mesh_mm3(&one.clone().minus([two]).mirrored(Vector3::new(1.0, 1.0, 0.3))), 25.0 * a - both, ROUNDING);
        // The hull of two shifted copies is the copy drawn out.
        let hull = Feature::hull([one.clone(), one.at(b, 0.0, 0.0)]);
        assert_close("hull", mesh_mm3(&hull), 25.0 * (a + b), ROUNDING);
    }

    #[test]
    fn analytic_meshes_pass_the_gate_and_keep_their_volume(x in 10.0..40.0f64, y in 10.0..40.0f64, radius in 1.0..4.0f64) {
        let plate = askew(Feature::cuboid([x, y, 3.0]).minus([Feature::bore(radius, 10.0).at(0.0, 0.0, -5.0)]));
        let solid = MeshSolid::build(&plate);
        let mesh = solid.to_mesh();
        let seen = gate::pass(&mesh).expect("a plate with a hole");
        prop_assert_eq!(seen.euler, 0);
        // Coordinates are written on a grid of 15 nm.
        assert_close("written", mesh.volume_mm3(), solid.volume_mm3(), 1e-5);
    }
}

#[test]
fn analytic_sphere() {
    for radius in [0.5, 2.9, 20.0] {
        let exact = 4.0 / 3.0 * PI * radius * radius * radius;
        let mesh = mesh_mm3(&Feature::sphere(radius));
        // A chord s of a circle of radius 1 makes facets that lose 3/8 s² of the volume; those in the middle of an octant
        // have up to twice its square.
        let chord = TAU / N;
        assert!(mesh < exact && mesh > exact * (1.0 - 0.75 * chord * chord), "{radius}: {mesh} {exact}");
    }
    let brep = brep_mm3(&Feature::sphere(20.0));
    assert_close("B-rep", brep, 4.0 / 3.0 * PI * 8000.0, 1e-12);
}
