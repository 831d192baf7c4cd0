//! Where the motors' and the battery's wires run: the same way is drawn as a tube and measured for the bill.
//!
//! A wire is soft, so its tube is no [`Body`]: no rule asks what it touches, and its mass is in the frame's `wiring`. The way is
//! the one of the instructions: a motor's three wires run along one arm, under hub joint and hub, and in between the bracket's uprights to
//! the controller; the battery's two from the connector to that edge of the controller that is nearest to it.

use nalgebra::{Point3, Vector3};

use super::body::Body;
use super::design::Design;
use crate::frame::skeleton::MODULE_NAMES;
use crate::solid::Mesh;
use crate::units::Angle;

/// Radius of the bundle of a motor's wires and of one of the battery's, mm: about 20 and 16 AWG in silicone.
const RADII_MM: [f64; 2] = [1.6, 1.5];
/// Linear colours of the motors' wires and of the battery's two.
const COLOURS: [[f32; 4]; 3] = [[0.02, 0.02, 0.02, 1.0], [0.6, 0.01, 0.01, 1.0], [0.01, 0.01, 0.01, 1.0]];

/// A wire, or the wires of a motor.
#[derive(Clone, Debug, PartialEq)]
pub struct Wire {
    /// Its name in files.
    pub name: String,
    /// Its line in the bill.
    pub role: &'static str,
    /// Along its middle, frame axes, mm.
    pub way: Vec<Point3<f64>>,
    /// Radius of the tube, mm.
    pub radius_mm: f64,
    /// Linear red, green, blue, alpha.
    pub colour: [f32; 4],
}

impl Wire {
    /// Length of its way, mm.
    pub fn length_mm(&self) -> f64 {
        self.way.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
    }

    /// A tube along the way, mitred where it turns. Made without the kernel, whose unions of tubes took longer than all else that a small change
    /// remakes.
    pub fn mesh(&self) -> Mesh {
        let mut way = self.way.clone();
        way.dedup_by(|next, last| (*next - *last).norm() < SHORTEST_MM);
        let along: Vec<Vector3<f64>> = way.windows(2).map(|pair| (pair[1] - pair[0]).normalize()).collect();
        let (Some(first), Some(last)) = (along.first(), along.last()) else { return Mesh::default() };
        let mut rings = vec![ring(way[0], first, self.radius_mm)];
        for (at, way_mm) in along.iter().enumerate() {
            // The plane between a segment and the next one; at the end of the wire straight across.
            let across = (way_mm + along.get(at + 1).unwrap_or(last)).normalize();
            let end = way[at + 1];
            let drawn = rings[at].iter().map(|p| p + way_mm * ((end - p).dot(&across) / way_mm.dot(&across).max(LEAST_COSINE))).collect();
            rings.push(drawn);
        }
        tube(&rings)
    }
}

/// Segments that are shorter are none, mm.
const SHORTEST_MM: f64 = 1e-3;
/// Corners of a tube's section.
const CORNERS: u32 = 16;
/// Of half the angle of a turn: a mitre is no longer than this allows.
const LEAST_COSINE: f64 = 0.4;

/// The section at the start of a segment, counter-clockwise seen against it.
fn ring(at: Point3<f64>, along: &Vector3<f64>, radius_mm: f64) -> Vec<Point3<f64>> {
    let aside = if along.z.abs() < 0.9 { Vector3::z() } else { Vector3::x() };
    let u = along.cross(&aside).normalize();
    let v = along.cross(&u);
    let corner = |k: u32| {
        let angle = Angle::deg(360.0 * f64::from(k) / f64::from(CORNERS));
        at + (u * angle.cos() + v * angle.sin()) * radius_mm
    };
    (0..CORNERS).map(corner).collect()
}

/// Rings joined to a closed mesh.
fn tube(rings: &[Vec<Point3<f64>>]) -> Mesh {
    let vertices = rings.iter().flatten().map(|p| [p.x as f32, p.y as f32, p.z as f32]).collect();
    let mut triangles = Vec::new();
    let segments = rings.len() as u32 - 1;
    for k in 0..CORNERS {
        let next = (k + 1) % CORNERS;
        for segment in 0..segments {
            let [a, b] = [segment * CORNERS, (segment + 1) * CORNERS];
            triangles.extend([[a + k, a + next, b + k], [a + next, b + next, b + k]]);
        }
        if k > 0 && next > 0 {
            let end = segments * CORNERS;
            triangles.extend([[0, next, k], [end, end + k, end + next]]);
        }
    }
    Mesh { vertices, triangles }
}

/// The wires of a design; without what it lacks.
pub fn wires(design: &Design) -> Vec<Wire> {
    let motors = (0..MODULE_NAMES.len()).filter_map(|module| motor(design, module));
    motors.chain(battery(design)).collect()
}

fn body<'a>(design: &'a Design, name: &str) -> Option<&'a Body> {
    design.bodies.iter().find(|body| body.name == name)
}

/// Lowest and highest corner of a body's box in frame axes, mm.
fn bounds_mm(design: &Design, name: &str) -> Option<[Point3<f64>; 2]> {
    let body = body(design, name)?;
    let [low, high] = design.shape(body).solid.bounds_in_mm(&body.pose);
    Some([low.into(), high.into()])
}

/// The same in the battery's axes.
fn own_bounds_mm(design: &Design, name: &str) -> Option<[Point3<f64>; 2]> {
    let [low, high] = bounds_mm(design, name)?;
    Some(design.centre.battery_axes.box_of([low.into(), high.into()]).map(Point3::from))
}

/// The board that the motors' wires end at.
fn controller(design: &Design) -> Option<[Point3<f64>; 2]> {
    bounds_mm(design, "motor_controller").or_else(|| bounds_mm(design, "flight_controller"))
}

fn motor(design: &Design, module: usize) -> Option<Wire> {
    let name = MODULE_NAMES[module];
    let seat = Point3::from(body(design, &format!("motor_{name}"))?.pose.translation.vector);
    let arm = design.skeleton.rods.iter().find(|rod| rod.name == format!("arm_{name}_left"))?;
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
    Some(Wire { name: format!("motor_wires_{name}"), role: "motor_wire", way, radius_mm, colour: COLOURS[0] })
}

/// Both leads of the battery: the side of the connector on which each is, and its colour.
const LEADS: [(&str, f64, [f32; 4]); 2] = [("plus", 1.0, COLOURS[1]), ("minus", -1.0, COLOURS[2])];
/// Each lead's distance from the connector's middle over its radius.
const LEADS_APART: f64 = 1.2;

fn battery(design: &Design) -> Vec<Wire> {
    let axes = design.centre.battery_axes;
    let board = own_bounds_mm(design, "motor_controller").or_else(|| own_bounds_mm(design, "flight_controller"));
    let (Some([low, high]), Some([board_low, board_high])) = (own_bounds_mm(design, "connector_bracket"), board) else {
        return Vec::new();
    };
    let (from, to) = (nalgebra::center(&low, &high), nalgebra::center(&board_low, &board_high));
    let (radius_mm, before) = (RADII_MM[1], 2.0 * RADII_MM[1]);
    let wire = |(name, side, colour): (&str, f64, [f32; 4])| {
        let x = side * LEADS_APART * radius_mm;
        let way = vec![
            Point3::new(from.x + x, high.y, from.z),
            Point3::new(from.x + x, high.y + before, from.z),
            Point3::new(to.x + x, board_low.y + before, to.z),
        ];
        let way = way.into_iter().map(|at| axes.point(at)).collect();
        Wire { name: format!("battery_wire_{name}"), role: "battery_wire", way, radius_mm, colour }
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
    let lead = |(name, side, colour): (&str, f64, [f32; 4])| {
        let x = middle.x + side * LEADS_APART * RADII_MM[1];
        let way = [from_y, to_y].map(|y| axes.point(Point3::new(x, y, middle.z))).into();
        Wire { name: format!("{connector}_{name}"), role: "battery_wire", way, radius_mm: RADII_MM[1], colour }
    };
    LEADS.into_iter().map(lead).collect()
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
            assert!((0..2).all(|axis| (low[axis]..=high[axis]).contains(&end[axis])), "{}: {end}", wire.name);
            assert!(design.bodies.iter().all(|body| body.name != wire.name), "{} is weighed", wire.name);
        }
        assert!(mass::table(&design).lines.iter().all(|line| !line.name.contains("wire_")));
    }

    #[test]
    fn planted_without_a_controller_there_are_none() {
        let mut frame = Frame::load("cognifly").expect("a preset").0;
        frame.bought.remove("motor_controller");
        frame.bought.remove("flight_controller");
        frame.bought.remove("damper");
        if let Ok(design) = Design::new(frame) {
            assert_eq!(wires(&design), []);
        }
    }
}
