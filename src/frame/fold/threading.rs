//! The fork's way through the knee's window half done: one leg squeezed flat and pulled through, pliers at its end.
//!
//! The rest of the fold moves rigid pieces; a leg is wider than the window, so here its mesh is squeezed. It shows what a hand does and is
//! compared with nothing.

use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};

use super::member::Member;
use crate::frame::assembly::Design;
use crate::frame::parts::fork::Fork;
use crate::frame::parts::knee::Knee;
use crate::solid::{Feature, Mesh, MeshSolid};
use crate::units::Angle;

/// From the leg's end to the middle of the window, mm.
const WINDOW_MM: f64 = 10.0;
/// Room that the squeezed leg leaves in the window, mm.
const ROOM_MM: f64 = 0.3;
/// Half thickness and half height of a jaw at its tip and at the pivot, mm.
const JAW_MM: [[f64; 2]; 2] = [[0.8, 1.5], [3.0, 4.0]];
/// From the jaws' tips back to the pivot, and on to the ends of the handles that are drawn, mm.
const REACH_MM: [f64; 2] = [24.0, 20.0];
/// How far the handles' ends are off the middle, mm.
const OPEN_MM: f64 = 11.0;
/// How far the pliers' handles hang down, so that they hide neither leg nor window.
const HANG_DEG: f64 = 65.0;

/// A mesh, and where it stands.
type Standing = (Arc<Mesh>, Isometry3<f64>);

/// Knee, fork and pliers of the first module; none where a design lacks them. The knee stands as it does before and after, with its window to
/// the viewer; the fork is turned, as its leg runs through the window.
pub fn threading(design: &Design, place: &Isometry3<f64>) -> Option<[Standing; 3]> {
    let fork = Fork::from_frame(&design.frame);
    let knee = Knee::from_frame(&design.frame, design.skeleton.closure.strut_tilt);
    let mesh = |member: Member| {
        let body = design.bodies.iter().find(|body| body.name == member.body(0))?;
        Some(design.shape(body).mesh.clone())
    };
    let (leg_y, end) = (0.5 * fork.arm_pitch_mm, fork.mouth_mm());
    let flat = (knee.window.size_x_mm - ROOM_MM) / (2.0 * fork.radius_mm());
    let fork_mesh = mesh(Member::Fork)?;
    let squeezed = squeezed(&fork_mesh, |x, y| {
        let share = ((fork.leg_axis_x_mm(leg_y) - x) / (fork.leg_axis_x_mm(leg_y) - end)).clamp(0.0, 1.0);
        if y > 0.0 { leg_y + (y - leg_y) * (1.0 + (flat - 1.0) * share) } else { y }
    });
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
    let node = Vector3::new(end + WINDOW_MM, leg_y - knee.window.centre_mm, 0.0);
    let fork_pose = place * Isometry3::from_parts(Translation3::from(node), turn).inverse();
    let grip = Vector3::new(end, leg_y, 0.0);
    let hang = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -Angle::deg(HANG_DEG).to_rad());
    let pliers_pose = fork_pose * Translation3::from(grip) * hang * Translation3::from(-grip);
    let pliers = MeshSolid::build(&pliers(end, leg_y, flat * fork.radius_mm())).mesh();
    Some([(mesh(Member::Knee)?, *place), (squeezed.into(), fork_pose), (Arc::new(pliers), pliers_pose)])
}

/// A mesh whose corners are moved along y.
fn squeezed(mesh: &Mesh, y_of: impl Fn(f64, f64) -> f64) -> Mesh {
    let moved = |[x, y, z]: &[f32; 3]| [*x, y_of(f64::from(*x), f64::from(*y)) as f32, *z];
    Mesh { vertices: mesh.vertices.iter().map(moved).collect(), triangles: mesh.triangles.clone() }
}

/// Pliers whose jaws are on both sides of a leg's end, mm in the fork's axes.
fn pliers(end: f64, leg_y: f64, half: f64) -> Feature {
    let [tip, root] = JAW_MM;
    let [jaw, handle] = REACH_MM;
    let cube = |x: f64, y: f64, [thin, high]: [f64; 2]| {
        Feature::cuboid_between([x - 1.0, leg_y + y - thin, -high], [x + 1.0, leg_y + y + thin, high])
    };
    let arm = |side: f64| {
        let pivot = cube(end - jaw, side * root[0], root);
        let beak = Feature::hull([cube(end + 1.0, side * (half + tip[0]), tip), pivot.clone()]);
        Feature::union([beak, Feature::hull([pivot, cube(end - jaw - handle, side * OPEN_MM, [2.5, 3.0])])])
    };
    let from = Point3::new(end - jaw, leg_y, -root[1] - 1.0);
    let rivet = Feature::cylinder_between(from, from + Vector3::z() * (2.0 * root[1] + 2.0), root[0]);
    Feature::union([arm(1.0), arm(-1.0), rivet])
}
