//! The parts of the rigid centre together: printed ones and bought ones, in their places.

use crate::frame::assembly::CentreBody;
use crate::frame::assembly::screw_solids::threads_mm3;
use crate::frame::parts::gauges::{Gauged, v8};
use crate::frame::parts::{Seat, record};
use crate::frame::skeleton::{Centre, Skeleton};
use crate::params::{Frame, PartName};
use crate::solid::{Feature, MeshSolid};

/// A printed part of the centre where it sits.
fn placed(name: PartName, frame: &Frame, centre: &Centre) -> Feature {
    let (part, skeleton) = (record(name), Skeleton::new(frame).expect("closes"));
    let pose = part.poses(frame, &skeleton.closure, centre)[0].1;
    (part.feature)(frame, &skeleton.closure, centre).placed(pose)
}

fn all(frame: &Frame, centre: &Centre) -> Vec<(String, Feature)> {
    let standing = PartName::ALL.into_iter().filter(|name| matches!(record(*name).seat, Seat::Centre(_)) && (record(*name).needed)(frame));
    let printed = standing.map(|name| (name.to_string(), placed(name, frame, centre)));
    let bought = CentreBody::ALL.into_iter().filter_map(|part| Some((part.slug().to_string(), part.feature(frame, centre)?)));
    printed.chain(bought).collect()
}

#[test]
fn analytic_nothing_in_the_centre_overlaps() {
    let (mut frame, _) = v8();
    for (connector, magnet) in [([10.55, 5.55], 3.0), ([16.4, 8.6], 2.0)] {
        [frame.bracket.connector_width_mm, frame.bracket.connector_height_mm] = connector;
        frame.bracket.magnet_thickness_mm = magnet;
        let centre = Centre::new(&frame);
        let solids: Vec<_> = all(&frame, &centre).into_iter().map(|(name, feature)| (name, Gauged::new(&feature).0)).collect();
        for (i, (name, solid)) in solids.iter().enumerate() {
            for (other_name, other) in &solids[i + 1..] {
                let overlap = solid.intersection(other).volume_mm3();
                // The stack's screws cut their thread into the hub.
                let meant = if name == "hub" && other_name == "stack_screw" { threads_mm3(&frame, &centre)[1] } else { 0.0 };
                assert!(overlap < meant + 0.001, "{name} and {other_name} share {overlap} mm³, {meant} are meant");
            }
        }
    }
}

#[test]
fn measured_heights_are_those_of_the_assembly() {
    let (frame, centre) = v8();
    let named = |name: &str| all(&frame, &centre).into_iter().find(|(n, _)| n == name).map(|(_, f)| Gauged::new(&f).0.bounds_mm());
    let z = |name: &str| named(name).map(|[low, high]| [low[2], high[2]]).unwrap_or_default();
    let close = |name: &str, low: f64, high: f64| {
        let [l, h] = z(name);
        assert!((l - low).abs() < 0.05 && (h - high).abs() < 0.05, "{name}: {l} to {h}");
    };
    close("hub", -4.6, 4.6);
    close("pi_carrier", 4.6, 6.6);
    close("battery_bracket", -26.3, -4.8);
    close("battery_sleeve", -45.3, -24.8);
}

#[test]
fn measured_magnet_faces_keep_their_gap() {
    let (frame, centre) = v8();
    let solid = |part: CentreBody| MeshSolid::build(&part.feature(&frame, &centre).expect("the frame has it"));
    let gap = solid(CentreBody::MagnetBracket).gap_mm(&solid(CentreBody::MagnetLid), 5.0);
    assert!((gap - 0.29).abs() < 1e-6, "{gap}");
    let lid = Gauged::new(&placed(PartName::BatteryLid, &frame, &centre));
    let y = -centre.bracket_half_mm - 0.29;
    let z = centre.magnet_z_mm + centre.bracket_z_mm();
    lid.pocket([-5.1, y - 3.0, z - 2.6], [5.1, y + 0.2, z + 2.6], "xXyzZ");
}

#[test]
fn analytic_lid_slides_out_without_touching() {
    let (mut frame, _) = v8();
    for (length, width, height) in [(58.0, 31.0, 16.0), (70.0, 35.0, 18.0)] {
        (frame.battery.battery_length_mm, frame.battery.battery_width_mm, frame.battery.battery_height_mm) = (length, width, height);
        let centre = Centre::new(&frame);
        let of = |part| MeshSolid::build(&placed(part, &frame, &centre));
        let stays = of(PartName::BatteryBracket).union(&of(PartName::Hub)).union(&of(PartName::BatterySleeve));
        let carried = [CentreBody::Battery, CentreBody::ConnectorLid, CentreBody::MagnetLid];
        let slides = carried
            .iter()
            .filter_map(|part| part.feature(&frame, &centre))
            .fold(of(PartName::BatteryLid), |solid, part| solid.union(&MeshSolid::build(&part)));
        for step in 0..20 {
            let away = nalgebra::Isometry3::translation(0.0, -4.0 * f64::from(step), 0.0);
            let shared = slides.placed(&away).intersection(&stays);
            let overlap = shared.volume_mm3();
            // The kernel rounds to some 1e-9 mm, and the battery has 5000 mm² of faces in the sleeve.
            assert!(overlap < 1e-5, "{overlap} mm³ after {} mm, within {:?}", 4 * step, shared.bounds_mm());
        }
    }
}

#[test]
fn analytic_bought_parts_have_their_catalogued_size() {
    for name in crate::params::preset::names() {
        let (frame, _) = Frame::load(name).expect("a preset");
        let centre = Centre::new(&frame);
        let size = |part: CentreBody| {
            let [low, high] = MeshSolid::build(&part.feature(&frame, &centre).expect("the frame has it")).bounds_mm();
            [0, 1, 2].map(|axis| high[axis] - low[axis])
        };
        let stated = |role: &str| frame.bought[role].part.size_mm;
        let close = |part: CentreBody, [x, y, z]: [f64; 3]| {
            let own = size(part);
            assert!(
                own.iter().zip([x, y, z]).all(|(a, b)| (a - b).abs() < 0.02),
                "{name}: {part:?} is {own:?}, {:?} are stated",
                [x, y, z]
            );
        };
        let [length, width, height] = stated("computer");
        close(CentreBody::Computer, [width, length, height]);
        let [length, width, height] = stated("battery");
        close(CentreBody::Battery, [width, length, height]);
        close(CentreBody::FlightController, stated("flight_controller"));
        close(CentreBody::MotorController, stated("motor_controller"));
        close(CentreBody::FlowSensor, stated("flow_sensor"));
        let [width, height, deep] = stated("camera");
        close(CentreBody::Camera, [width, deep, height]);
        let [length, width, thick] = stated("magnet");
        close(CentreBody::MagnetLid, [length, thick, width]);
        let [across, _, height] = stated("damper");
        let pattern = frame.hub.stack_pattern_mm;
        close(CentreBody::Dampers, [pattern + across, pattern + across, height]);
        let [corners, flats, height] = stated("stack_nut");
        close(CentreBody::StackNuts, [pattern + corners, pattern + flats, height]);
        let screw = &frame.bought["stack_screw"].part;
        let long = screw.length_mm.expect("is stated") + screw.head_height_mm.expect("is stated");
        assert!((size(CentreBody::StackScrews)[2] - long).abs() < 1e-4, "{name}");
    }
}

/// Dampers that the bill has are drawn, also at a board whose holes let no neck of theirs pass: a rim above it and one below.
#[test]
fn regress_dampers_are_drawn_at_holes_that_are_too_small_for_them() {
    let (mut frame, _) = Frame::load("examples/frames/whoop-aio-fpv.toml").expect("a frame");
    let pieces = |frame: &Frame| {
        let dampers = CentreBody::Dampers.feature(frame, &Centre::new(frame)).expect("are drawn");
        MeshSolid::build(&dampers).body_boxes().len()
    };
    assert_eq!(pieces(&frame), 4);
    frame.bought.get_mut("motor_controller").expect("has one").part.hole_diameter_mm = Some(2.0);
    assert_eq!(pieces(&frame), 8);
}

/// From the hub to the nuts nothing slides along a screw: each body on it touches the next, and none reaches into another.
#[test]
fn regress_nothing_slides_along_the_screws_of_the_stack() {
    for (name, on_screws) in [
        ("cognifly", vec!["hub", "stack_spacer_hub", "damper", "stack_spacer_boards", "motor_controller", "stack_nut"]),
        ("examples/frames/whoop-aio-fpv.toml", vec!["hub", "stack_spacer_hub", "damper", "stack_nut"]),
    ] {
        let (frame, _) = Frame::load(name).expect("a frame");
        let centre = Centre::new(&frame);
        let solids = all(&frame, &centre);
        let solid = |name: &str| MeshSolid::build(&solids.iter().find(|(other, _)| other == name).unwrap_or_else(|| panic!("no {name}")).1);
        for pair in on_screws.windows(2) {
            let [above, below] = [pair[0], pair[1]].map(solid);
            assert!(above.gap_mm(&below, 5.0) < 1e-4, "{name}: {pair:?}: {}", above.gap_mm(&below, 5.0));
            let shared_mm3 = above.intersection(&below).volume_mm3();
            assert!(shared_mm3 < 1e-3, "{name}: {pair:?}: {shared_mm3}");
        }
    }
}

/// The nuts touch what the screws hold, and are on the screws by their whole height: below the lowest board, or below its dampers.
#[test]
fn regress_nuts_hold_the_lowest_board() {
    for (name, held, clear) in
        [("cognifly", "motor_controller", "damper"), ("examples/frames/whoop-aio-fpv.toml", "damper", "motor_controller")]
    {
        let (frame, _) = Frame::load(name).expect("a frame");
        let solids: Vec<(String, Feature)> = all(&frame, &Centre::new(&frame));
        let solid = |name: &str| MeshSolid::build(&solids.iter().find(|(other, _)| other == name).expect("has it").1);
        let [nuts, screws, board] = ["stack_nut", "stack_screw", held].map(solid);
        assert_eq!(nuts.body_boxes().len(), 4, "{name}");
        assert!(nuts.gap_mm(&board, 5.0) < 1e-4, "{name}: {}", nuts.gap_mm(&board, 5.0));
        assert!(nuts.gap_mm(&solid(clear), 5.0) > 0.5, "{name}");
        let ([low, _], [end, _]) = (nuts.bounds_mm(), screws.bounds_mm());
        assert!(low[2] >= end[2] - 1e-4, "{name}: nuts to {}, screws to {}", low[2], end[2]);
    }
}
