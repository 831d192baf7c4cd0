//! Hub joint, fork, knee and motor mount as beams.

use nalgebra::{Isometry3, Point3, Vector3};

use super::plan::{Meeting, NoSection, Plan, Port, Stop, steps, straight};
use crate::frame::parts::{Fork, HubJoint, Knee, MotorMount};
use crate::mechanics::settings::MechanicsSettings;
use crate::solid::{Bend, Feature, Mesh, MeshSolid};

/// A mesh within a window.
fn within(flat: &MeshSolid, window: &Feature) -> Mesh {
    flat.intersection(&MeshSolid::build(window)).mesh()
}

fn cylinder(from: Point3<f64>, to: Point3<f64>, radius: f64) -> Feature {
    Feature::cylinder_between(from, to, radius)
}

/// The hub joint: two arm sockets with plugs, the leg on its arch, whose necks twist.
///
/// # Errors
/// When its mesh shows no section on a path.
pub fn hub_joint(part: &HubJoint, flat: &MeshSolid, bend: Option<&Bend>, settings: &MechanicsSettings) -> Result<Plan, NoSection> {
    let mut plan = Plan::default();
    let (radius, y) = (part.radius_mm(), 0.5 * part.arm_pitch_mm);
    let arch = part.arch();
    let mean = 0.5 * (arch.inner_mm + arch.outer_mm);
    let on_arch = |y: f64| Point3::new(arch.centre_mm + libm::sqrt((mean * mean - y * y).max(0.0)), y, 0.0);
    let rigid = settings.core_rigid * radius;
    let leg = leg(&mut plan, part, flat, bend, on_arch(0.0).x, settings)?;
    let window = Feature::cylinder_between(
        Point3::new(arch.centre_mm, 0.0, -radius - 1.0),
        Point3::new(arch.centre_mm, 0.0, radius + 1.0),
        arch.outer_mm,
    );
    let hole = Feature::cylinder_between(
        Point3::new(arch.centre_mm, 0.0, -radius - 2.0),
        Point3::new(arch.centre_mm, 0.0, radius + 2.0),
        arch.inner_mm,
    );
    let ring = within(flat, &window.minus([hole]));
    // The arch lands on the arm socket's wall; what lies behind it holds the rod, and goes with the socket.
    let wall = part.inner_wall_mm();
    for side in [1.0, -1.0] {
        let (arm, at_landing) = arm(&mut plan, part, flat, side * y, on_arch(wall).x, settings)?;
        let stops: Vec<Stop> = steps(rigid, wall, settings.element_mm)
            .into_iter()
            .map(|along_y| {
                let at = on_arch(side * along_y);
                let zone = if along_y < radius - 1e-9 { "hub joint arch" } else { "hub joint necks" };
                Stop { at, along: Vector3::y() * side, motion: bend.map_or_else(Isometry3::identity, |bend| carried(bend, &at)), zone }
            })
            .collect();
        let nodes = plan.strand(&ring, &stops, &Vector3::z())?;
        plan.link(leg, nodes[0]);
        plan.link(arm[at_landing], nodes[nodes.len() - 1]);
    }
    Ok(plan)
}

/// The leg's root and socket; the node where the arch carries it.
fn leg(
    plan: &mut Plan,
    part: &HubJoint,
    flat: &MeshSolid,
    bend: Option<&Bend>,
    root_mm: f64,
    settings: &MechanicsSettings,
) -> Result<usize, NoSection> {
    let (bottom, mouth, radius) = (part.leg_bottom_mm(), part.leg_mouth_mm, part.radius_mm());
    let mesh = within(flat, &cylinder(Point3::new(root_mm - radius, 0.0, 0.0), Point3::new(mouth + 1.0, 0.0, 0.0), 1.02 * radius));
    let mut distances = steps(root_mm, bottom, 2.0 * settings.element_mm);
    distances.extend(steps(bottom, mouth, (mouth - bottom) / settings.socket_elements).into_iter().skip(1));
    let zones = [(0.0, "hub joint leg root"), (bottom, "hub joint leg socket")];
    let stops = straight(Point3::origin(), Vector3::x(), &distances, &zones, bend.map_or_else(Isometry3::identity, Bend::motion));
    let nodes = plan.strand(&mesh, &stops, &Vector3::z())?;
    let bore: Vec<usize> = (0..stops.len()).filter(|at| distances[*at] > bottom - 1e-6).collect();
    let places: Vec<Vector3<f64>> = bore.iter().map(|at| (stops[*at].motion * stops[*at].at).coords).collect();
    plan.meet(Port::Rod, &bore.iter().map(|at| nodes[*at]).collect::<Vec<_>>(), &places);
    Ok(nodes[0])
}

/// An arm's plug and socket; its nodes, and which of them lies where the arch lands.
fn arm(
    plan: &mut Plan,
    part: &HubJoint,
    flat: &MeshSolid,
    y: f64,
    landing: f64,
    settings: &MechanicsSettings,
) -> Result<(Vec<usize>, usize), NoSection> {
    let (plug, depth, radius) = (part.plug_length_mm, part.arm_depth_mm, part.radius_mm());
    let axis = |x: f64| Point3::new(x, y, 0.0);
    let mesh = within(flat, &cylinder(axis(-plug - 1.0), axis(depth + 1.0), 1.02 * radius));
    let landing = landing.clamp(0.2, depth - 0.2);
    let mut distances = steps(-plug, 0.0, plug / settings.socket_elements);
    distances.extend(steps(0.0, landing, depth / settings.socket_elements).into_iter().skip(1));
    let at_landing = distances.len() - 1;
    distances.extend(steps(landing, depth, depth / settings.socket_elements).into_iter().skip(1));
    let zones = [(-plug, "hub joint plugs"), (0.0, "hub joint arm sockets")];
    let stops = straight(axis(0.0), Vector3::x(), &distances, &zones, Isometry3::identity());
    let nodes = plan.strand(&mesh, &stops, &Vector3::z())?;
    for (port, inside) in [(Port::Hub, -1.0), (Port::Rod, 1.0)] {
        let of: Vec<usize> = (0..nodes.len()).filter(|at| inside * distances[*at] > -1e-6).collect();
        let places: Vec<Vector3<f64>> = of.iter().map(|at| axis(distances[*at]).coords).collect();
        plan.meet(port, &of.iter().map(|at| nodes[*at]).collect::<Vec<_>>(), &places);
    }
    Ok((nodes, at_landing))
}

/// What twisting the necks does to a place.
fn carried(bend: &Bend, at: &Point3<f64>) -> Isometry3<f64> {
    match bend {
        Bend::Necks { pivot, axis, inner_mm, outer_mm, .. } => {
            let along = (at - pivot).dot(axis).abs();
            super::corner_plan::turned(bend, ((outer_mm - along) / (outer_mm - inner_mm)).clamp(0.0, 1.0))
        }
        Bend::Web { .. } => Isometry3::identity(),
    }
}

/// The fork: two sockets, two legs, and the bar.
///
/// # Errors
/// When its mesh shows no section on a path.
pub fn fork(part: &Fork, flat: &MeshSolid, settings: &MechanicsSettings) -> Result<Plan, NoSection> {
    let mut plan = Plan::default();
    let (radius, y) = (part.radius_mm(), 0.5 * part.arm_pitch_mm);
    let bar = Point3::new(part.bar.offset_mm, 0.0, 0.0);
    let knuckle = 0.5 * (part.cheek_gap_mm + part.finger_width_mm);
    let fine = settings.element_mm;
    let mut middle = None;
    for side in [1.0, -1.0] {
        let axis = |x: f64| Point3::new(x, side * y, 0.0);
        let (mouth, bottom, elbow) = (part.mouth_mm(), -part.reach_mm, part.leg_axis_x_mm(y));
        let mesh = within(flat, &cylinder(axis(mouth - 1.0), axis(elbow + radius), 1.02 * radius));
        let mut distances = steps(mouth, bottom, part.depth_mm / settings.socket_elements);
        let in_bore = distances.len();
        distances.extend(steps(bottom, elbow.max(bottom + 0.1), 2.0 * fine).into_iter().skip(1));
        let zones = [(mouth, "fork sockets"), (bottom, "fork legs")];
        let stops = straight(axis(0.0), Vector3::x(), &distances, &zones, Isometry3::identity());
        let socket = plan.strand(&mesh, &stops, &Vector3::z())?;
        let places: Vec<Vector3<f64>> = distances[..in_bore].iter().map(|d| axis(*d).coords).collect();
        plan.meet(Port::Rod, &socket[..in_bore], &places);
        let (from, to) = (axis(elbow), Point3::new(part.leg_axis_x_mm(knuckle), side * knuckle, 0.0));
        let way = to - from;
        let mesh = within(flat, &cylinder(from - way.normalize() * radius, to + way.normalize() * radius, 1.02 * radius));
        let stops = straight(from, way.normalize(), &steps(0.0, way.norm(), 2.0 * fine), &[(0.0, "fork legs")], Isometry3::identity());
        let leg = plan.strand(&mesh, &stops, &Vector3::z())?;
        plan.link(socket[socket.len() - 1], leg[0]);
        let gap = 0.5 * part.cheek_gap_mm;
        let tall = part.bar.size_z_mm;
        let box_low = [part.bar.offset_mm - 0.51 * part.bar.size_x_mm, -gap, -tall];
        let box_high = [part.bar.offset_mm + 0.51 * part.bar.size_x_mm, gap, tall];
        let mesh = within(flat, &Feature::cuboid_between(box_low, box_high));
        let stops = straight(bar, Vector3::y() * side, &steps(0.0, 0.98 * gap, fine), &[(0.0, "fork bar")], Isometry3::identity());
        let nodes = plan.strand(&mesh, &stops, &Vector3::z())?;
        plan.link(nodes[nodes.len() - 1], leg[leg.len() - 1]);
        match middle {
            None => middle = Some(nodes[0]),
            Some(first) => plan.link(first, nodes[0]),
        }
    }
    if let Some(node) = middle {
        plan.meetings.push(Meeting { port: Port::Bar, node, place: bar.coords, length_mm: part.cheek_gap_mm });
    }
    Ok(plan)
}

/// The knee: two columns beside the window as one, a strut socket above and one below.
///
/// # Errors
/// When its mesh shows no section on a path.
pub fn knee(part: &Knee, flat: &MeshSolid, settings: &MechanicsSettings) -> Result<Plan, NoSection> {
    let mut plan = Plan::default();
    let mesh = flat.mesh();
    let middle = Vector3::new(part.window.centre_mm, 0.0, 0.0);
    let window = plan.node(middle);
    let top = part.window.half_z_mm() + part.window.flare_mm;
    for side in [1.0, -1.0] {
        let up = Vector3::z() * side;
        let stops =
            straight(Point3::from(middle), up, &steps(0.0, top, 2.0 * settings.element_mm), &[(0.0, "knee window")], Isometry3::identity());
        let columns = plan.strand(&mesh, &stops, &Vector3::x())?;
        plan.link(window, columns[0]);
        let strut = Vector3::new(part.strut_tilt.sin(), 0.0, side * part.strut_tilt.cos());
        let (bottom, mouth) = (part.bottom_mm, part.bottom_mm + part.depth_mm);
        let start = (top / part.strut_tilt.cos()).min(bottom - 0.05);
        let mut distances = steps(start, bottom, 2.0 * settings.element_mm);
        // The plate ends a little below the mouth on one side; cuts lie between the stops.
        distances.extend(steps(bottom, mouth, part.depth_mm / settings.socket_elements).into_iter().skip(1));
        let zones = [(0.0, "knee struts"), (bottom, "knee sockets")];
        let stops = straight(Point3::origin(), strut, &distances, &zones, Isometry3::identity());
        let nodes = plan.strand(&mesh, &stops, &Vector3::y())?;
        plan.link(columns[columns.len() - 1], nodes[0]);
        let bore: Vec<usize> = (0..nodes.len()).filter(|at| distances[*at] > bottom - 1e-6).collect();
        let places: Vec<Vector3<f64>> = bore.iter().map(|at| strut * distances[*at]).collect();
        plan.meet(Port::Rod, &bore.iter().map(|at| nodes[*at]).collect::<Vec<_>>(), &places);
    }
    plan.meetings.push(Meeting { port: Port::Window, node: window, place: middle, length_mm: 2.0 * part.window.half_z_mm() });
    Ok(plan)
}

/// The motor mount: a bridge from ring to ring.
///
/// # Errors
/// When its mesh shows no section on a path.
pub fn motor_mount(part: &MotorMount, flat: &MeshSolid, settings: &MechanicsSettings) -> Result<Plan, NoSection> {
    let mut plan = Plan::default();
    let mesh = flat.mesh();
    let y = 0.5 * part.arm_pitch_mm;
    let edge = y - 0.5 * part.ring_diameter_mm;
    let height = part.top_mm - 0.5 * part.plate_mm;
    let mut distances = steps(-edge, 0.0, 2.0 * settings.element_mm);
    let half = distances.len() - 1;
    distances.extend(steps(0.0, edge, 2.0 * settings.element_mm).into_iter().skip(1));
    let from = Point3::new(0.0, 0.0, height);
    let stops = straight(from, Vector3::y(), &distances, &[(-edge, "motor mounts")], Isometry3::identity());
    let bridge = plan.strand(&mesh, &stops, &Vector3::z())?;
    for (node, side) in [(bridge[0], -1.0), (bridge[bridge.len() - 1], 1.0)] {
        let place = Vector3::new(0.0, side * y, 0.0);
        let ring = plan.node(place);
        plan.link(ring, node);
        plan.meetings.push(Meeting { port: Port::Rod, node: ring, place, length_mm: part.ring_width_mm });
    }
    let middle = bridge[half];
    plan.meetings.push(Meeting { port: Port::Motor, node: middle, place: Vector3::new(0.0, 0.0, part.top_mm), length_mm: 0.0 });
    Ok(plan)
}
