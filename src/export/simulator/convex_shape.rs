//! Convex shapes for contact: cage, hub and sleeve.

use nalgebra::Point3;
use serde::Serialize;

use super::axes::point_m;
use crate::frame::assembly::{Body, BodyKind, Design};
use crate::params::PartName;
use crate::solid::MeshSolid;

/// A convex solid, corners and outward facets.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ConvexShape {
    /// What it stands for.
    pub name: String,
    /// Its file in the folder.
    pub file: String,
    /// Corners, m; in JSON its file has them.
    #[serde(skip)]
    pub vertices_m: Vec<[f64; 3]>,
    /// Corners of the facets, counter-clockwise seen from outside.
    #[serde(skip)]
    pub triangles: Vec<[u32; 3]>,
}

/// Which shape a body belongs to; none for what is inside of the cage: arms, motors, propellers.
fn shape_of(design: &Design, body: &Body) -> Option<&'static str> {
    match design.shape(body).kind {
        BodyKind::Printed(PartName::TopCorner | PartName::BottomCorner | PartName::Knee) => Some("cage"),
        BodyKind::Printed(PartName::BatterySleeve | PartName::BatteryLid) | BodyKind::Bought("battery" | "flow_sensor") => Some("sleeve"),
        _ if body.module.is_none() => Some("hub"),
        _ => None,
    }
}

/// Corners of all bodies of a shape where they sit, mm.
fn corners_mm(design: &Design, name: &str) -> Vec<Point3<f64>> {
    let bodies = design.bodies.iter().filter(|body| shape_of(design, body) == Some(name));
    let corner = |v: &[f32; 3]| Point3::from(v.map(f64::from));
    bodies.flat_map(|body| design.shape(body).mesh.vertices.iter().map(move |v| body.pose * corner(v))).collect()
}

/// The shapes. The cage's ends at the height of the lowest body of the centre: below it the frame gives, and its feet stand there.
pub(super) fn shapes(design: &Design) -> Vec<ConvexShape> {
    let [hub, sleeve, mut cage] = ["hub", "sleeve", "cage"].map(|name| corners_mm(design, name));
    let lowest_mm = hub.iter().chain(&sleeve).map(|p| p.z).fold(f64::INFINITY, f64::min);
    for corner in &mut cage {
        corner.z = corner.z.max(lowest_mm);
    }
    let shapes = [("cage", cage), ("hub", hub), ("sleeve", sleeve)];
    shapes.into_iter().filter_map(|(name, corners)| hull(name, &corners)).collect()
}

/// The hull of points, mm; none where they enclose nothing.
fn hull(name: &str, corners_mm: &[Point3<f64>]) -> Option<ConvexShape> {
    let solid = MeshSolid::hull_of(corners_mm);
    if solid.is_empty() {
        return None;
    }
    let mesh = solid.mesh();
    let vertices_m = mesh.vertices.iter().map(|v| point_m(Point3::from(v.map(f64::from)))).collect();
    Some(ConvexShape { name: name.into(), file: format!("meshes/{name}.obj"), vertices_m, triangles: mesh.triangles })
}
