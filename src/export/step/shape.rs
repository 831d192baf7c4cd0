//! A boundary as the entities of a manifold solid B-rep (ISO 10303-42 and -514).

use nalgebra::{Point3, Unit, Vector3};

use super::writer::{Decimal, Id, Writer, angle, length, list, radius};
use crate::solid::{Boundary, Curve, Edge, Face, Surface, square_to};

/// The name of a face that lies on no surface of the features.
pub(super) const FACET: &str = "facet";

/// Writes each piece of a boundary as a solid: a closed shell of advanced faces. A shell has to be connected (ISO 10303-42), so
/// the four screws of a motor are four solids.
pub(super) fn solids(writer: &mut Writer, name: &str, boundary: &Boundary) -> Vec<Id> {
    let boundary = &boundary.with_seams();
    let points: Vec<Id> = boundary.vertices.iter().map(|p| writer.point(p)).collect();
    let vertices: Vec<Id> = points.iter().map(|point| writer.add(format_args!("VERTEX_POINT('',{point})"))).collect();
    let edges: Vec<Id> = boundary
        .edges
        .iter()
        .map(|edge| {
            let curve = curve(writer, boundary, edge, &points);
            writer.add(format_args!("EDGE_CURVE('',{},{},{curve},.T.)", vertices[edge.from], vertices[edge.to]))
        })
        .collect();
    let faces: Vec<Id> = boundary.faces.iter().map(|face| advanced_face(writer, boundary, face, &edges)).collect();
    let mut solid = |piece: Vec<usize>| {
        let faces: Vec<Id> = piece.into_iter().map(|at| faces[at]).collect();
        let shell = writer.add(format_args!("CLOSED_SHELL('',{})", list(&faces)));
        writer.add(format_args!("MANIFOLD_SOLID_BREP({},{shell})", super::writer::string(name)))
    };
    boundary.pieces().into_iter().map(&mut solid).collect()
}

fn curve(writer: &mut Writer, boundary: &Boundary, edge: &Edge, points: &[Id]) -> Id {
    let (from, to) = (boundary.vertices[edge.from], boundary.vertices[edge.to]);
    match &edge.curve {
        Curve::Line => {
            let direction = writer.direction(&(to - from).try_normalize(0.0).unwrap_or_else(Vector3::z));
            let vector = writer.add(format_args!("VECTOR('',{direction},1.)"));
            writer.add(format_args!("LINE('',{},{vector})", points[edge.from]))
        }
        Curve::Ellipse { centre, axis, major, radii_mm: [a, b], .. } => {
            let place = writer.placement(centre, axis, major);
            if a == b {
                writer.add(format_args!("CIRCLE('',{place},{})", radius(*a)))
            } else {
                writer.add(format_args!("ELLIPSE('',{place},{},{})", radius(*a), radius(*b)))
            }
        }
        Curve::Spline { points, tangents } => spline(writer, points, tangents),
    }
}

/// Hermite pieces as one B-spline: each inner knot stands twice, between the Bézier points beside it.
fn spline(writer: &mut Writer, points: &[Point3<f64>], tangents: &[Unit<Vector3<f64>>]) -> Id {
    let mut controls = vec![writer.point(&points[0])];
    let mut knots: Vec<Decimal> = vec![length(0.0)];
    let mut at = 0.0;
    for i in 1..points.len() {
        let reach = (points[i] - points[i - 1]).norm();
        controls.push(writer.point(&(points[i - 1] + tangents[i - 1].into_inner() * (reach / 3.0))));
        controls.push(writer.point(&(points[i] - tangents[i].into_inner() * (reach / 3.0))));
        at += reach;
        knots.push(length(at));
    }
    controls.push(writer.point(&points[points.len() - 1]));
    let last = knots.len() - 1;
    let times: Vec<&str> = (0..=last).map(|i| if i == 0 || i == last { "4" } else { "2" }).collect();
    let knots: Vec<String> = knots.iter().map(ToString::to_string).collect();
    writer.add(format_args!(
        "B_SPLINE_CURVE_WITH_KNOTS('',3,{},.UNSPECIFIED.,.F.,.F.,({}),({}),.UNSPECIFIED.)",
        list(&controls),
        times.join(","),
        knots.join(","),
    ))
}

fn advanced_face(writer: &mut Writer, boundary: &Boundary, face: &Face, edges: &[Id]) -> Id {
    let surface = match &face.surface {
        Surface::Plane { point, normal } => {
            let place = writer.placement(point, normal, &square_to(normal));
            writer.add(format_args!("PLANE('',{place})"))
        }
        Surface::Cylinder { point, axis, radius_mm } => {
            let place = writer.placement(point, axis, &seam(boundary, face, point, axis));
            writer.add(format_args!("CYLINDRICAL_SURFACE('',{place},{})", radius(*radius_mm)))
        }
        Surface::Cone { point, axis, radius_mm, half_angle_rad } => {
            let place = writer.placement(point, axis, &seam(boundary, face, point, axis));
            writer.add(format_args!("CONICAL_SURFACE('',{place},{},{})", radius(*radius_mm), angle(*half_angle_rad)))
        }
        Surface::Sphere { centre, axis, radius_mm } => {
            let place = writer.placement(centre, axis, &seam(boundary, face, centre, axis));
            writer.add(format_args!("SPHERICAL_SURFACE('',{place},{})", radius(*radius_mm)))
        }
        Surface::Torus { centre, axis, radius_mm, minor_radius_mm } => {
            let place = writer.placement(centre, axis, &seam(boundary, face, centre, axis));
            let radii = format!("{},{}", radius(*radius_mm), radius(*minor_radius_mm));
            if radius_mm < minor_radius_mm {
                writer.add(format_args!("DEGENERATE_TOROIDAL_SURFACE('',{place},{radii},.T.)"))
            } else {
                writer.add(format_args!("TOROIDAL_SURFACE('',{place},{radii})"))
            }
        }
    };
    let is_plane = matches!(face.surface, Surface::Plane { .. });
    let bounds: Vec<Id> = face
        .loops
        .iter()
        .enumerate()
        .map(|(at, sides)| {
            let way = |forward| if forward { ".T." } else { ".F." };
            let sides: Vec<Id> = sides
                .iter()
                .map(|side| writer.add(format_args!("ORIENTED_EDGE('',*,*,{},{})", edges[side.edge], way(side.forward))))
                .collect();
            let ring = writer.add(format_args!("EDGE_LOOP('',{})", list(&sides)));
            // Around a cylinder neither of two loops is the outer one, where no seam joins them.
            let outer = at == 0 && (is_plane || face.loops.len() == 1 || face.seam().is_some());
            writer.add(format_args!("FACE_{}BOUND('',{ring},.T.)", if outer { "OUTER_" } else { "" }))
        })
        .collect();
    let (name, outward) = (if face.is_exact { "" } else { FACET }, if face.outward { ".T." } else { ".F." });
    writer.add(format_args!("ADVANCED_FACE('{name}',{},{surface},{outward})", list(&bounds)))
}

/// The direction from an axis in which the parameters of a round face begin: that of its seam, or else where its corners leave most room. Readers
/// cut a face there, and OCCT reads a wrong face where the cut runs through a corner.
fn seam(boundary: &Boundary, face: &Face, point: &Point3<f64>, axis: &Unit<Vector3<f64>>) -> Unit<Vector3<f64>> {
    let x = square_to(axis);
    let y = axis.cross(&x);
    if let Some(seam) = face.seam() {
        let arm = boundary.vertices[boundary.edges[seam].from] - point;
        return Unit::new_normalize(arm - axis.into_inner() * axis.dot(&arm));
    }
    let edges = || face.loops.iter().flatten().map(|side| &boundary.edges[side.edge]);
    if edges().all(|edge| edge.from == edge.to) {
        return x;
    }
    let angle = |vertex: usize| {
        let arm = boundary.vertices[vertex] - point;
        libm::atan2(arm.dot(&y), arm.dot(&x))
    };
    let mut angles: Vec<f64> = edges().flat_map(|edge| [angle(edge.from), angle(edge.to)]).collect();
    angles.sort_by(f64::total_cmp);
    angles.push(angles[0] + std::f64::consts::TAU);
    let widest = angles.windows(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
    let (sin, cos) = libm::sincos(widest.map_or(0.0, |gap| 0.5 * (gap[0] + gap[1])));
    Unit::new_normalize(x.into_inner() * cos + y * sin)
}
