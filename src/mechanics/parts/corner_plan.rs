//! The ring corners as beams: two cage sockets, the strut on its hinge, the leg on its web.

use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};

use super::plan::{NoSection, Plan, Port, Press, Stop, steps, straight};
use crate::frame::parts::corner::CornerSockets;
use crate::mechanics::settings::MechanicsSettings;
use crate::solid::{Bend, Feature, Mesh, MeshSolid};
use crate::units::Angle;

/// What the pieces of a corner are called.
pub struct Names {
    core: &'static str,
    cage: &'static str,
    strut_hinge: &'static str,
    strut: &'static str,
}

const TOP: Names = Names {
    core: "top corner core",
    cage: "top corner cage sockets",
    strut_hinge: "top corner strut hinge",
    strut: "top corner strut socket",
};
const BOTTOM: Names = Names {
    core: "bottom corner core",
    cage: "bottom corner cage sockets",
    strut_hinge: "bottom corner strut hinge",
    strut: "bottom corner strut socket",
};

/// A limb that folds at a web.
struct Limb<'a> {
    direction: Vector3<f64>,
    bend: Option<&'a Bend>,
    bottom_mm: f64,
    mouth_mm: f64,
    zones: Vec<(f64, &'static str)>,
}

/// The plan of a corner; the leg's bottom (mm from the node) and bend where it has one.
///
/// # Errors
/// When its mesh shows no section on a path.
pub fn plan(
    sockets: &CornerSockets,
    flat: &MeshSolid,
    bends: &[Bend],
    leg_bottom_mm: Option<f64>,
    settings: &MechanicsSettings,
) -> Result<Plan, NoSection> {
    let names = if leg_bottom_mm.is_some() { BOTTOM } else { TOP };
    let radius = sockets.radius_mm();
    let mut plan = Plan::default();
    let core = plan.node(Vector3::zeros());
    let strut = crate::frame::parts::corner::strut_direction();
    let socket =
        |direction, bottom_mm: f64, bend, zones| Limb { direction, bend, bottom_mm, mouth_mm: bottom_mm + sockets.depth_mm, zones };
    let cage = || vec![(0.0, names.core), (radius, names.cage)];
    let mut limbs = vec![socket(Vector3::x(), sockets.bottom_mm, None, cage()), socket(Vector3::y(), sockets.bottom_mm, None, cage())];
    limbs.push(socket(strut, sockets.bottom_mm, bends.first(), vec![(0.0, names.strut_hinge), (sockets.bottom_mm, names.strut)]));
    if let Some(leg_mm) = leg_bottom_mm {
        let zones = vec![(0.0, names.core), (radius, "bottom corner leg web"), (leg_mm, "bottom corner leg socket")];
        limbs.push(socket(-strut, leg_mm, bends.get(1), zones));
    }
    for limb in &limbs {
        let nodes = limb_nodes(&mut plan, limb, flat, radius, settings)?;
        plan.link(core, nodes[0]);
    }
    if let Some(bend @ Bend::Web { pivot, outward, towards, angle, .. }) = bends.first() {
        press(&mut plan, sockets, bend, [pivot.coords, outward.into_inner(), towards.into_inner()], *angle, core);
    }
    if leg_bottom_mm.is_some() {
        // The part's z points up when it is a bottom corner: the ground is below.
        plan.meetings.push(super::plan::Meeting { port: Port::Foot, node: core, place: -Vector3::z() * radius, length_mm: 0.0 });
    }
    Ok(plan)
}

/// The window of a limb: a cylinder around its axis, as wide as the limb.
fn window(flat: &MeshSolid, direction: Vector3<f64>, radius: f64, reach: f64) -> Mesh {
    let wide = 1.02 * radius;
    let cylinder = Feature::cylinder_between(Point3::from(direction * -radius), Point3::from(direction * (reach + 1.0)), wide);
    flat.intersection(&MeshSolid::build(&cylinder)).mesh()
}

fn limb_nodes(plan: &mut Plan, limb: &Limb, flat: &MeshSolid, radius: f64, settings: &MechanicsSettings) -> Result<Vec<usize>, NoSection> {
    let mesh = window(flat, limb.direction, radius, limb.mouth_mm);
    let fine = settings.element_mm;
    let pivot = limb.bend.map(|bend| match bend {
        Bend::Web { pivot, .. } => pivot.coords.norm(),
        Bend::Necks { .. } => 0.0,
    });
    let start = (settings.core_rigid * radius).min(pivot.map_or(radius, |p| 0.5 * p));
    let mut distances = Vec::new();
    let mut add = |more: Vec<f64>| distances.extend(more.into_iter().skip(usize::from(!distances.is_empty())));
    if let Some(pivot) = pivot {
        add(steps(start, pivot, fine));
        add(steps(pivot, limb.bottom_mm, fine));
    } else {
        add(steps(start, limb.bottom_mm, 2.0 * fine));
    }
    add(steps(limb.bottom_mm, limb.mouth_mm, (limb.mouth_mm - limb.bottom_mm) / settings.socket_elements));
    let mut stops = straight(Point3::origin(), limb.direction, &distances, &limb.zones, Isometry3::identity());
    if let (Some(bend), Some(pivot)) = (limb.bend, pivot) {
        stops = folded(stops, &distances, bend, pivot);
    }
    let nodes = plan.strand(&mesh, &stops, &Vector3::z())?;
    let in_bore = |at: &usize| (stops[*at].at.coords.norm() - limb.bottom_mm) > -1e-6;
    let bore: Vec<usize> = (0..stops.len()).filter(in_bore).collect();
    let places: Vec<Vector3<f64>> = bore.iter().map(|at| (stops[*at].motion * stops[*at].at).coords).collect();
    let bore: Vec<usize> = bore.iter().map(|at| nodes[*at]).collect();
    plan.meet(Port::Rod, &bore, &places);
    Ok(nodes)
}

/// Beyond the pivot everything turns; at the pivot the web is swept in steps.
fn folded(stops: Vec<Stop>, distances: &[f64], bend: &Bend, pivot: f64) -> Vec<Stop> {
    const SWEEP_DEG: f64 = 20.0;
    let mut all = Vec::new();
    for (mut stop, distance) in stops.into_iter().zip(distances) {
        if (distance - pivot).abs() < 1e-9 {
            let count = (bend.angle().to_deg() / SWEEP_DEG).ceil().max(1.0) as usize;
            // The part that follows the pivot is cut a little beyond it, where the notch has not opened yet.
            for step in 0..=count {
                let share = step as f64 / count as f64;
                all.push(Stop { motion: turned(bend, share), ..stop.clone() });
            }
            continue;
        }
        if *distance > pivot {
            stop.motion = bend.motion();
        }
        all.push(stop);
    }
    all
}

/// The motion of a share of a web's fold.
pub fn turned(bend: &Bend, share: f64) -> Isometry3<f64> {
    match bend {
        Bend::Web { pivot, outward, towards, angle, .. } => {
            let axis = Unit::new_normalize(outward.cross(towards));
            about(*pivot, axis, Angle::rad(angle.to_rad() * share))
        }
        Bend::Necks { pivot, axis, angle, .. } => about(*pivot, *axis, Angle::rad(angle.to_rad() * share)),
    }
}

fn about(pivot: Point3<f64>, axis: Unit<Vector3<f64>>, angle: Angle) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_axis_angle(&axis, angle.to_rad());
    Translation3::from(pivot.coords) * turn * Translation3::from(-pivot.coords)
}

/// The notch's faces, where the strut folds beyond their meeting: half a socket's section, pressed over a socket's diameter.
fn press(plan: &mut Plan, sockets: &CornerSockets, bend: &Bend, [pivot, outward, towards]: [Vector3<f64>; 3], angle: Angle, core: usize) {
    if angle.to_deg() <= 2.0 * sockets.notch_lean.to_deg() {
        return;
    }
    let radius = sockets.radius_mm();
    // Between the two faces, above the web: halfway round the fold, half a radius from the hinge's axis.
    let between = UnitQuaternion::from_axis_angle(&Unit::new_normalize(outward.cross(&towards)), 0.5 * angle.to_rad());
    let inner = between * towards;
    let place = pivot + inner * (0.5 * radius);
    let beyond = bend.motion() * Point3::from(outward * sockets.bottom_mm);
    let near = (0..plan.nodes.len()).filter(|at| *at != core);
    let nearest = near.min_by(|a, b| (plan.nodes[*a] - beyond.coords).norm().total_cmp(&(plan.nodes[*b] - beyond.coords).norm()));
    if let Some(node) = nearest {
        let area_mm2 = 0.5 * std::f64::consts::PI * radius * radius;
        plan.presses.push(Press { nodes: [core, node], place, area_mm2, length_mm: 2.0 * radius });
    }
}
