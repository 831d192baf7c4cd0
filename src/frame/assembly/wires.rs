//! Where wires and cables run: the same way is drawn as a tube and measured for the bill. The cables between boards are in
//! [`cables`](super::cables).
//!
//! A wire is soft, so its tube is no body of the design: no rule asks what it touches, and its mass is in the frame's `wiring`. The way is
//! the one of the instructions: a motor's three wires run along one arm, under hub joint and hub, and in between the bracket's uprights to
//! the controller; the battery's two from the connector to that edge of the controller that is nearest to it.

use nalgebra::{Point3, Vector3};

use super::body_box::{body, bounds_mm, controller};
use super::cables::cables;
use super::design::Design;
use super::wire::{Section, Wire};
use crate::frame::skeleton::{MODULE_NAMES, Rod};

/// Radius of the bundle of a motor's wires and of one of the battery's, mm: about 20 and 16 AWG in silicone.
const RADII_MM: [f64; 2] = [1.6, 1.5];
/// Linear colours of the motors' wires and of the battery's two.
const COLOURS: [[f32; 4]; 3] = [[0.02, 0.02, 0.02, 1.0], [0.6, 0.01, 0.01, 1.0], [0.01, 0.01, 0.01, 1.0]];

/// The wires and cables of a design; without what it lacks.
pub fn wires(design: &Design) -> Vec<Wire> {
    let motors = (0..MODULE_NAMES.len()).filter_map(|module| motor(design, module));
    motors.chain(battery(design)).chain(cables(design)).collect()
}

/// Lowest and highest corner of a body's box in the battery's axes, mm.
fn own_bounds_mm(design: &Design, name: &str) -> Option<[Point3<f64>; 2]> {
    let [low, high] = bounds_mm(design, name)?;
    Some(design.centre.battery_axes.box_of([low.into(), high.into()]).map(Point3::from))
}

fn motor(design: &Design, module: usize) -> Option<Wire> {
    let name = MODULE_NAMES[module];
    let seat = Point3::from(body(design, &format!("motor_{name}"))?.pose.translation.vector);
    // Along the arm that enters the hub nearer to where the bracket is open: its uprights stand before and behind the battery.
    let off_middle_mm = |rod: &&Rod| design.centre.battery_axes.box_of([rod.start.coords.into(); 2])[0][0].abs();
    let arms = ["left", "right"].map(|side| format!("arm_{name}_{side}"));
    let arm = design.skeleton.rods.iter().filter(|rod| arms.contains(&rod.name));
    let arm = arm.max_by(|a, b| off_middle_mm(a).total_cmp(&off_middle_mm(b)))?;
    let ([board_low, board_high], [hub_low, _]) = (controller(design)?, bounds_mm(design, "hub")?);
    let (frame, radius_mm) = (&design.frame, RADII_MM[0]);
    // From the hub outwards.
    let out = (arm.end - arm.start).normalize();
    let at_motor = arm.start + out * out.dot(&(seat - arm.start));
    let under = |at: Point3<f64>, z: f64| Point3::new(at.x, at.y, z - radius_mm);
    let rod_z = arm.start.z - 0.5 * frame.rods.rod_diameter_mm;
    let low_z = (arm.start.z - 0.5 * frame.hub_joint.hub_joint_diameter_mm).min(hub_low.z);
    let clear_mm = 0.5 * frame.motor_mount.motor_ring_width_mm + 2.0 * radius_mm;
    let mouth = arm.start + out * frame.hub_joint.hub_arm_socket_depth_mm;
    let inside = arm.start - out * frame.hub_joint.plug_length_mm;
    let board = nalgebra::center(&board_low, &board_high);
    let half = 0.5 * (board_high - board_low);
    let towards = Vector3::new((inside.x - board.x).signum() * half.x, (inside.y - board.y).signum() * half.y, 0.0);
    let way = vec![
        seat,
        under(at_motor - out * clear_mm, rod_z),
        under(mouth + out * 4.0, rod_z),
        under(mouth - out * 2.0, low_z),
        under(inside, low_z),
        board + towards * 0.8,
    ];
    Some(Wire {
        name: format!("motor_wires_{name}"),
        role: "motor_wire",
        way,
        begins: 2,
        section: Section::Round(radius_mm),
        joins: None,
        plugging: "",
        colour: COLOURS[0],
        colour_word: "black",
    })
}

/// Both leads of the battery: the side of the connector on which each is, its colour, and that in a word.
const LEADS: [(&str, f64, [f32; 4], &str); 2] = [("plus", 1.0, COLOURS[1], "red"), ("minus", -1.0, COLOURS[2], "black")];
/// Each lead's distance from the connector's middle over its radius.
const LEADS_APART: f64 = 1.2;

fn battery(design: &Design) -> Vec<Wire> {
    let axes = design.centre.battery_axes;
    let board = own_bounds_mm(design, "motor_controller");
    let (Some([low, high]), Some([board_low, board_high])) = (own_bounds_mm(design, "connector_bracket"), board) else {
        return Vec::new();
    };
    let (from, to) = (nalgebra::center(&low, &high), nalgebra::center(&board_low, &board_high));
    let (radius_mm, before) = (RADII_MM[1], 2.0 * RADII_MM[1]);
    let wire = |(name, side, colour, colour_word): (&str, f64, [f32; 4], &'static str)| {
        let x = side * LEADS_APART * radius_mm;
        let way = vec![
            Point3::new(from.x + x, high.y, from.z),
            Point3::new(from.x + x, high.y + before, from.z),
            Point3::new(to.x + x, board_low.y + before, to.z),
        ];
        let way = way.into_iter().map(|at| axes.point(at)).collect();
        Wire {
            name: format!("battery_wire_{name}"),
            role: "battery_wire",
            way,
            begins: 2,
            section: Section::Round(radius_mm),
            joins: None,
            plugging: "",
            colour,
            colour_word,
        }
    };
    LEADS.into_iter().map(wire).collect()
}

/// How much of a lead is shown beside a connector, mm.
const LEAD_MM: f64 = 22.0;

/// The first piece of both leads of a half of the power connector: the bracket's leave it into the bay, the lid's away from it. Where the lid's
/// go on to is the battery's own affair.
pub fn lead_ends(design: &Design, connector: &str) -> Vec<Wire> {
    let axes = design.centre.battery_axes;
    let Some([low, high]) = own_bounds_mm(design, connector) else { return Vec::new() };
    let (middle, is_lid) = (nalgebra::center(&low, &high), connector == "connector_lid");
    let [from_y, to_y] = if is_lid { [low.y, low.y - LEAD_MM] } else { [high.y, high.y + LEAD_MM] };
    let lead = |(name, side, colour, colour_word): (&str, f64, [f32; 4], &'static str)| {
        let x = middle.x + side * LEADS_APART * RADII_MM[1];
        let way = [from_y, to_y].map(|y| axes.point(Point3::new(x, y, middle.z))).into();
        Wire {
            name: format!("{connector}_{name}"),
            role: "battery_wire",
            way,
            begins: 2,
            section: Section::Round(RADII_MM[1]),
            joins: None,
            plugging: "",
            colour,
            colour_word,
        }
    };
    LEADS.into_iter().map(lead).collect()
}

/// Both leads of the half of the power connector in the bracket where no board is under the hub for them: out of the bay at one of its open sides,
/// the second farther in. Where they go on to is not known.
pub fn leads_out(design: &Design) -> Vec<Wire> {
    let axes = design.centre.battery_axes;
    let Some([_, high]) = own_bounds_mm(design, "battery_bracket") else { return Vec::new() };
    let led = |(at, mut wire): (usize, Wire)| {
        let farther_mm = at as f64 * 2.0 * LEADS_APART * RADII_MM[1];
        if let Some(end) = wire.way.pop() {
            let [x, y, z] = axes.box_of([end.coords.into(); 2])[0];
            wire.way.extend([x, high.x + LEAD_MM].map(|x| axes.point(Point3::new(x, y + farther_mm, z))));
        }
        wire.begins = wire.way.len();
        wire
    };
    lead_ends(design, "connector_bracket").into_iter().enumerate().map(led).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::assembly::mass;
    use crate::params::Frame;
    use crate::solid::gate;

    #[test]
    fn analytic_wires_run_from_motor_and_connector_to_the_controller() {
        let design = Design::new(Frame::load("cognifly").expect("a preset").0).expect("designs");
        let all = wires(&design);
        assert_eq!(all.iter().filter(|wire| wire.role == "motor_wire").count(), 4);
        assert_eq!(all.iter().filter(|wire| wire.role == "battery_wire").count(), 2);
        let lengths: Vec<f64> = all.iter().map(Wire::length_mm).collect();
        assert!(lengths[..4].iter().all(|mm| (mm - lengths[0]).abs() < 1.5), "{lengths:?}");
        let [low, high] = controller(&design).expect("has one").map(|corner| corner.coords);
        for wire in &all {
            let mesh = wire.mesh();
            gate::pass(&mesh).expect("one closed tube");
            let end = wire.way.last().expect("has an end").coords;
            let ends_here = (0..2).all(|axis| (low[axis]..=high[axis]).contains(&end[axis]));
            assert!(ends_here || wire.joins.is_some(), "{}: {end}", wire.name);
            assert!(design.bodies.iter().all(|body| body.name != wire.name), "{} is weighed", wire.name);
        }
        assert!(mass::table(&design).lines.iter().all(|line| !line.name.contains("wire_")));
    }

    /// What a caption names has to be seen: within the bay the leads are behind the bracket.
    #[test]
    fn analytic_leads_without_a_board_leave_the_bay_side_by_side() {
        let design = Design::new(Frame::load("cognifly").expect("a preset").0).expect("designs");
        let [_, high] = own_bounds_mm(&design, "battery_bracket").expect("has one");
        let leads = leads_out(&design);
        let ends: Vec<Point3<f64>> = leads.iter().filter_map(|lead| lead.way.last().copied()).collect();
        assert!(ends.len() == 2 && ends.iter().all(|end| end.x > high.x + 20.0) && ends[1].y - ends[0].y > 2.0 * RADII_MM[1], "{ends:?}");
        assert!(leads.iter().all(|lead| lead.begins == lead.way.len() && gate::pass(&lead.mesh()).is_ok()), "{leads:?}");
    }

    #[test]
    fn planted_without_a_controller_there_are_none() {
        let mut frame = Frame::load("cognifly").expect("a preset").0;
        frame.bought.remove("motor_controller");
        frame.bought.remove("flight_controller");
        frame.bought.remove("damper");
        let design = Design::new(frame).expect("designs");
        assert!(wires(&design).iter().all(|wire| wire.role == "camera_cable"));
    }
}
