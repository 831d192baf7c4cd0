//! Frames for simulators: masses, thrusts, feet and contact shapes against the design, on the presets; `random_frames` asks the same of its own.

use flexframe::export::simulator::{ConvexShape, LegSpring, Motor, RigidBody, SimulatorFormat, SimulatorModel, files, model};
use flexframe::frame::assembly::{BodyKind, Design, mass};
use flexframe::params::{Frame, PartName, preset};
use nalgebra::{Matrix3, Point3, Vector3};
use quick_xml::events::Event;

use crate::common;

fn legs() -> LegSpring {
    LegSpring { from: "paper".into(), stiffness_n_m: 7040.0, damping_n_s_m: 46.0, doubt: None }
}

fn of(frame: Frame) -> (Design, SimulatorModel) {
    let design = Design::with(frame, common::memo()).expect("closes");
    let model = model(&design, &mass::table(&design), legs());
    (design, model)
}

fn of_text(text: &str) -> (Design, SimulatorModel) {
    of(common::resolve(text).expect("is read"))
}

/// The simulator's axes, m, of a point of the design, mm: front, left, up.
fn turned_m(mm: Point3<f64>) -> Vector3<f64> {
    Vector3::new(mm.y, -mm.x, mm.z) * 1e-3
}

/// Bodies together: mass, centre, and inertia about the origin.
fn together<'a>(bodies: impl Iterator<Item = &'a RigidBody>) -> (f64, Vector3<f64>, Matrix3<f64>) {
    bodies.fold((0.0, Vector3::zeros(), Matrix3::zeros()), |(mass, first, about), body| {
        let at = Vector3::from(body.centre_m);
        let own = Matrix3::from_fn(|i, j| body.inertia_kg_m2[i][j]);
        let moved = (Matrix3::identity() * at.norm_squared() - at * at.transpose()) * body.mass_kg;
        (mass + body.mass_kg, first + at * body.mass_kg, about + own + moved)
    })
}

/// The half-spaces that a convex shape is the intersection of: outward direction, and distance from the origin, m.
fn half_spaces(shape: &ConvexShape) -> Vec<(Vector3<f64>, f64)> {
    let corner = |at: u32| Vector3::from(shape.vertices_m[at as usize]);
    let half_space = |[a, b, c]: &[u32; 3]| {
        let normal = (corner(*b) - corner(*a)).cross(&(corner(*c) - corner(*a)));
        // A sliver's direction is that of its rounding.
        (normal.norm() > 1e-10).then(|| (normal.normalize(), normal.normalize().dot(&corner(*a))))
    };
    shape.triangles.iter().filter_map(half_space).collect()
}

/// What is wrong with the model that is made of a design.
pub(crate) fn faults_of(design: &Design) -> Vec<String> {
    faults(design, &model(design, &mass::table(design), legs()))
}

/// What is wrong with a model of a design.
fn faults(design: &Design, model: &SimulatorModel) -> Vec<String> {
    let mut faults = Vec::new();
    let mut near = |what: &str, found: f64, expected: f64, by: f64| {
        if (found - expected).abs() > by {
            faults.push(format!("{what}: {found}, not {expected}"));
        }
    };
    let table = mass::table(design);
    let (mass, first, about) = together(std::iter::once(&model.frame).chain(model.motors.iter().filter_map(|motor| motor.body.as_ref())));
    let (total, centre) = (table.total_g * 1e-3, turned_m(Point3::from(table.centre_of_mass_mm)));
    near("mass", mass, total, 1e-8);
    near("centre", (first / mass - centre).norm(), 0.0, 1e-8);
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = table.inertia_g_mm2;
    // Front is the design's y, left its minus x.
    let turned = Matrix3::new(yy, -xy, yz, -xy, xx, -xz, yz, -xz, zz) * 1e-9;
    let about_centre = about - (Matrix3::identity() * centre.norm_squared() - centre * centre.transpose()) * mass;
    near("inertia", (about_centre - turned).abs().max(), 0.0, 1e-7 * turned.max());
    // A hover: weight is carried, no axis through the centre of mass is turned about.
    let sum = |of: &dyn Fn(&Motor) -> f64| model.motors.iter().map(|motor| motor.hover_thrust_n * of(motor)).sum::<f64>();
    near("thrusts", sum(&|_| 1.0), total * 9.81, 1e-7);
    near("pitch", sum(&|motor| motor.position_m[0] - centre.x), 0.0, 1e-9);
    near("roll", sum(&|motor| motor.position_m[1] - centre.y), 0.0, 1e-9);
    near("yaw", sum(&|motor| motor.spin.reaction() * motor.torque_over_thrust_m), 0.0, 1e-9);
    for foot in &model.feet {
        near(&foot.name, foot.position_m[2] - foot.radius_m, -model.standing_height_m, 1e-9);
    }
    faults.extend(shape_faults(design, model));
    faults
}

/// Corners of the design that lie outside of their shapes.
fn shape_faults(design: &Design, model: &SimulatorModel) -> Vec<String> {
    let named = |name: &str| model.shapes.iter().find(|shape| shape.name == name);
    let parts = [
        ("cage", vec![PartName::TopCorner, PartName::BottomCorner, PartName::Knee]),
        ("hub", vec![PartName::Hub, PartName::BatteryBracket]),
        ("sleeve", vec![PartName::BatterySleeve, PartName::BatteryLid]),
    ];
    let mut faults = Vec::new();
    for (name, parts) in parts {
        let Some(shape) = named(name) else {
            faults.push(format!("no {name}"));
            continue;
        };
        let half_spaces = half_spaces(shape);
        let outside_m =
            |point: Vector3<f64>| half_spaces.iter().map(|(normal, at)| normal.dot(&point) - at).fold(f64::NEG_INFINITY, f64::max);
        let lowest_m = shape.vertices_m.iter().map(|v| v[2]).fold(f64::INFINITY, f64::min);
        for body in design.bodies.iter().filter(|body| matches!(design.shape(body).kind, BodyKind::Printed(part) if parts.contains(&part)))
        {
            let corners = design.shape(body).mesh.vertices.iter().map(|v| turned_m(body.pose * Point3::from(v.map(f64::from))));
            // The cage ends above the ground: what is lower is a foot's.
            let beyond = corners.map(|corner| outside_m(Vector3::new(corner.x, corner.y, corner.z.max(lowest_m))));
            let most = beyond.fold(f64::NEG_INFINITY, f64::max);
            if most > 2e-7 {
                faults.push(format!("{} reaches {most} m out of {name}", body.name));
            }
        }
    }
    faults
}

#[test]
fn analytic_presets_have_the_masses_and_shapes_of_their_design() {
    for name in preset::names() {
        let (design, model) = of_text(&format!("base = \"{name}\""));
        assert_eq!(faults(&design, &model), Vec::<String>::new(), "{name}");
    }
}

#[test]
fn planted_faults_of_a_model_are_found() {
    let (design, sound) = of_text("base = \"cognifly\"");
    let found = |change: &dyn Fn(&mut SimulatorModel)| {
        let mut model = sound.clone();
        change(&mut model);
        faults(&design, &model)
    };
    let says = |change: &dyn Fn(&mut SimulatorModel), what: &str| {
        let found = found(change);
        assert!(found.iter().any(|fault| fault.contains(what)), "{what}: {found:?}");
    };
    assert_eq!(found(&|_| ()), Vec::<String>::new());
    says(&|model| model.frame.mass_kg += 1e-6, "mass");
    says(&|model| model.frame.inertia_kg_m2[0][2] *= -1.0, "inertia");
    says(&|model| model.motors[0].position_m[0] += 1e-4, "pitch");
    says(&|model| model.motors[0].spin = model.motors[1].spin, "yaw");
    says(&|model| model.feet[2].position_m[2] += 1e-4, "foot_BL");
    says(&|model| model.shapes[0].vertices_m.iter_mut().flatten().for_each(|value| *value *= 0.999), "out of cage");
}

/// Values of the attributes of a document, in order, unescaped.
fn attributes(xml: &[u8]) -> Vec<String> {
    let mut reader = quick_xml::Reader::from_str(std::str::from_utf8(xml).expect("UTF-8"));
    let mut found = Vec::new();
    loop {
        match reader.read_event().expect("well-formed") {
            Event::Start(element) | Event::Empty(element) => found.extend(element.attributes().map(|attribute| {
                let value = attribute.expect("an attribute").normalized_value(quick_xml::XmlVersion::Implicit1_0);
                value.expect("is unescaped").into_owned()
            })),
            Event::Eof => return found,
            _ => {}
        }
    }
}

#[test]
fn planted_names_that_would_be_markup_are_escaped() {
    let (_, mut model) = of_text("base = \"cognifly\"");
    let hostile = "a\"><x/>&amp;'";
    model.name = hostile.into();
    model.description = "</description><x/>".into();
    model.motors.iter_mut().for_each(|motor| motor.propeller = Some(hostile.into()));
    let written = files(&model, &SimulatorFormat::ALL).expect("is written");
    let bytes = |path: &str| written.iter().find(|file| file.0 == path).expect("is written").1.clone();
    for (path, times) in [("frame.xml", 2), ("scene.xml", 1), ("frame.urdf", 1), ("model.sdf", 1), ("model.config", 0)] {
        let found = attributes(&bytes(path));
        assert_eq!(found.iter().filter(|value| value.starts_with(hostile)).count(), times, "{path}: {found:?}");
        assert!(!String::from_utf8_lossy(&bytes(path)).contains("<x/>"), "{path}");
    }
    assert!(String::from_utf8_lossy(&bytes("model.config")).contains("&lt;/description&gt;"));
}

#[test]
fn analytic_the_same_frame_gives_the_same_bytes() {
    let written = || {
        let design = Design::new(common::resolve("base = \"cognifly-mini\"").expect("a preset")).expect("closes");
        files(&model(&design, &mass::table(&design), legs()), &SimulatorFormat::ALL).expect("is written")
    };
    let (first, second) = (written(), written());
    assert!(first == second);
    assert_eq!(first.len(), 9);
}

#[test]
fn analytic_propellers_whose_mass_is_in_another_line_are_no_bodies() {
    let text = "base = \"cognifly\"\nextras.drive.mass_g = 30.0\nextras.drive.mass_basis = \"estimate\"\nextras.drive.source = \"a guess\"\n\
                extras.drive.covers = [\"propeller\"]\n";
    // Where its place is not stated, it is at the propellers.
    let (design, model) = of_text(text);
    assert!(model.motors.iter().all(|motor| motor.body.as_ref().is_some_and(|body| (body.mass_kg - 7.5e-3).abs() < 1e-9)));
    assert_eq!(faults(&design, &model), Vec::<String>::new());
    let (design, model) = of_text(&format!("{text}extras.drive.position_mm = [0.0, 0.0, 0.0]\n"));
    assert!(model.motors.iter().all(|motor| motor.body.is_none()));
    assert_eq!(faults(&design, &model), Vec::<String>::new());
    let written = files(&model, &SimulatorFormat::ALL).expect("is written");
    let text = |path: &str| String::from_utf8_lossy(&written.iter().find(|file| file.0 == path).expect("is written").1).into_owned();
    assert!(text("frame.urdf").contains("<joint name=\"motor_FR_joint\" type=\"fixed\">") && !text("frame.xml").contains("propeller_FR"));
}

#[test]
fn analytic_the_sensor_is_on_the_board_that_has_one_or_at_the_hub() {
    let (design, with) = of_text("base = \"cognifly\"");
    let board = design.bodies.iter().find(|body| body.name == "flight_controller").expect("has one");
    let [low, high] = design.shape(board).solid.bounds_in_mm(&board.pose);
    assert_eq!(with.imu.on, "flight_controller");
    assert!(low[2] < with.imu.position_m[2] * 1e3 && with.imu.position_m[2] * 1e3 < high[2], "{:?}", with.imu);
    let (design, all_in_one) =
        of_text("base = \"cognifly\"\nbought.flight_controller = \"none\"\nbought.motor_controller = \"aio-20x20\"\n");
    let board = design.bodies.iter().find(|body| body.name == "motor_controller").expect("has one");
    let [low, high] = design.shape(board).solid.bounds_in_mm(&board.pose);
    assert_eq!(all_in_one.imu.on, "motor_controller");
    assert!(low[2] < all_in_one.imu.position_m[2] * 1e3 && all_in_one.imu.position_m[2] * 1e3 < high[2], "{:?}", all_in_one.imu);
    let elsewhere = "base = \"cognifly\"\nbought.flight_controller = \"none\"\nextras.autopilot.mass_g = 9.0\n\
                     extras.autopilot.mass_basis = \"estimate\"\nextras.autopilot.source = \"a guess\"\nextras.autopilot.covers = [\"flight_controller\"]\n";
    let (_, without) = of_text(elsewhere);
    assert_eq!((without.imu.on.as_str(), without.imu.position_m), ("hub", [0.0; 3]));
    let (_, placed) = of_text(&format!("{elsewhere}extras.autopilot.position_mm = [0.0, 10.0, 30.0]\n"));
    assert_eq!(placed.imu.on, "autopilot");
    assert!((placed.imu.position_m[2] - 0.03).abs() < 1e-12, "{:?}", placed.imu);
}
