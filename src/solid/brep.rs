//! The B-rep kernel: exact solids of the features that need no boolean.

use nalgebra::{Isometry3, Point2};
use truck_modeling::{
    BoundedCurve, Curve, InnerSpace, Matrix4, ParametricCurve, ParametricSurface, Point3, Rad, SearchNearestParameter, Shell,
    ShellCondition, Solid, Surface, Vector3, Wire, builder,
};

use super::feature::Feature;
use super::profile::{Contour, Profile, Segment};

/// Pieces of an edge over which its enclosed area is summed, each by a Gauss rule of two points: an arc of half a turn
/// is right to 1e-9 of its area.
const AREA_PIECES: u32 = 64;

/// Farthest that an edge may lie off a surface beside it, mm; the search for the nearest point ends within a tenth of it.
const CRACK_MM: f64 = 1e-5;

/// Pieces of an edge between whose ends its distance from a surface is looked at.
const EDGE_PIECES: u32 = 6;

/// Newton steps of a search for the nearest point of a surface.
const TRIALS: usize = 100;

/// An exact solid.
#[derive(Clone, Debug)]
pub struct Brep {
    solid: Solid,
    volume_mm3: f64,
}

impl Brep {
    /// The exact solid of a feature tree; `None` where a boolean, a hull or a mirror would be needed: this
    /// kernel's booleans are not reliable enough to ship (see `docs/decisions/`).
    pub fn build(feature: &Feature) -> Option<Self> {
        build(feature)
    }

    /// The solid in the kernel's own type.
    pub fn solid(&self) -> &Solid {
        &self.solid
    }

    /// Volume, mm³: of a sweep by its face's edges, of a ball by the formula.
    pub fn volume_mm3(&self) -> f64 {
        self.volume_mm3
    }

    /// Whether the boundary is one closed shell without a crack: every edge joins two faces that run it in opposite directions,
    /// no two parts of the shell meet in a single vertex, every edge ends in its vertices and lies in the surfaces beside it. Tests ask it of every
    /// part; the program only compares volumes.
    pub fn is_closed(&self) -> bool {
        let [shell] = &self.solid.boundaries()[..] else { return false };
        let sealed = |edge: &truck_modeling::Edge, surface: &Surface| edge.is_geometric_consistent() && lies_in(&edge.curve(), surface);
        is_whole(shell) && shell.iter().all(|face| face.boundaries().iter().flatten().all(|edge| sealed(edge, &face.surface())))
    }
}

/// Whether a curve lies in a surface. (The kernel's own `include` denies it of surfaces of revolution that were moved.)
fn lies_in(curve: &Curve, surface: &Surface) -> bool {
    let (start, end) = curve.range_tuple();
    let mut last = None;
    (0..=EDGE_PIECES).all(|piece| {
        let point = curve.subs(start + (end - start) * f64::from(piece) / f64::from(EDGE_PIECES));
        let meets = |at: &(f64, f64)| (surface.subs(at.0, at.1) - point).magnitude() <= CRACK_MM;
        // Beside the last point first: a search of the whole surface takes long.
        last = last
            .and_then(|near: (f64, f64)| surface.search_nearest_parameter(point, near, TRIALS))
            .filter(meets)
            .or_else(|| surface.search_nearest_parameter(point, None, TRIALS).filter(meets));
        last.is_some()
    })
}

/// Whether the faces of a shell are joined without a gap, an overhang or a pinched vertex.
fn is_whole(shell: &Shell) -> bool {
    shell.shell_condition() == ShellCondition::Closed && shell.is_connected() && shell.singular_vertices().is_empty()
}

fn build(feature: &Feature) -> Option<Brep> {
    match feature {
        Feature::Extrude { profile, height_mm } => extruded(profile, *height_mm),
        Feature::Cylinder { radius_mm, height_mm } | Feature::Bore { radius_mm, height_mm } => {
            extruded(&Profile::new(Contour::circle([0.0, 0.0], *radius_mm)), *height_mm)
        }
        Feature::Sphere { radius_mm } => Some(ball(*radius_mm)),
        Feature::Placed { pose, of } => build(of).map(|brep| Brep { solid: builder::transformed(&brep.solid, matrix(pose)), ..brep }),
        Feature::Union(of) if of.len() == 1 => build(&of[0]),
        Feature::Difference { base, cuts } if cuts.is_empty() => build(base),
        _ => None,
    }
}

fn extruded(profile: &Profile, height_mm: f64) -> Option<Brep> {
    let outer = wire(&profile.outer, true);
    let mut wires = vec![outer];
    wires.extend(profile.holes.iter().map(|hole| wire(hole, false)));
    let face = builder::try_attach_plane(&wires).ok()?;
    // A sweep along the face's normal must leave the bottom face looking down.
    let solid = builder::tsweep(&face, Vector3::unit_z() * height_mm);
    let area_mm2: f64 = wires.iter().flat_map(|wire| wire.edge_iter()).map(|edge| area_beside(&edge.oriented_curve())).sum();
    Some(Brep { solid, volume_mm3: area_mm2.abs() * height_mm })
}

/// Area between the origin and a curve of the xy plane, mm², positive when it runs counter-clockwise.
fn area_beside(curve: &Curve) -> f64 {
    let (start, end) = curve.range_tuple();
    let half = 0.5 * (end - start) / f64::from(AREA_PIECES);
    let at = |t: f64| {
        let (p, along) = (curve.subs(t), curve.der(t));
        0.5 * (p.x * along.y - p.y * along.x)
    };
    let off = half / 3f64.sqrt();
    (0..AREA_PIECES)
        .map(|piece| {
            let middle = start + half * f64::from(2 * piece + 1);
            half * (at(middle - off) + at(middle + off))
        })
        .sum()
}

fn ball(radius_mm: f64) -> Brep {
    let top = builder::vertex(Point3::new(0.0, 0.0, radius_mm));
    let bottom = builder::vertex(Point3::new(0.0, 0.0, -radius_mm));
    let meridian: Wire = vec![builder::circle_arc(&top, &bottom, Point3::new(radius_mm, 0.0, 0.0))].into();
    let shell = builder::cone(&meridian, Vector3::unit_z(), Rad(std::f64::consts::TAU));
    Brep { solid: Solid::new(vec![shell]), volume_mm3: 4.0 / 3.0 * std::f64::consts::PI * radius_mm.powi(3) }
}

/// A contour as edges in the xy plane, counter-clockwise or clockwise.
fn wire(contour: &Contour, counter_clockwise: bool) -> Wire {
    let (start, segments) = as_path(contour);
    let first = builder::vertex(at(start));
    let mut edges = Vec::new();
    let (mut from, mut from_vertex) = (start, first.clone());
    for (i, segment) in segments.iter().enumerate() {
        let (Segment::Line { to } | Segment::Arc { to, .. }) = segment;
        let vertex = if i + 1 == segments.len() { first.clone() } else { builder::vertex(at(*to)) };
        edges.push(match segment {
            Segment::Line { .. } => builder::line(&from_vertex, &vertex),
            Segment::Arc { centre, counter_clockwise, .. } => {
                let half = 0.5 * super::profile::sweep_angle(from, *to, *centre, *counter_clockwise);
                let (sin, cos) = libm::sincos(half);
                let arm = from - centre;
                let middle = centre + nalgebra::Vector2::new(cos * arm.x - sin * arm.y, sin * arm.x + cos * arm.y);
                builder::circle_arc(&from_vertex, &vertex, at(middle))
            }
        });
        (from, from_vertex) = (*to, vertex);
    }
    let wire: Wire = edges.into();
    if (signed_area(contour) > 0.0) == counter_clockwise { wire } else { wire.inverse() }
}

/// A circle as two half turns; a path as it is.
fn as_path(contour: &Contour) -> (Point2<f64>, Vec<Segment>) {
    match contour {
        Contour::Path { start, segments } => (*start, segments.clone()),
        Contour::Circle { centre, radius_mm, .. } => {
            let (right, left) = (Point2::new(centre.x + radius_mm, centre.y), Point2::new(centre.x - radius_mm, centre.y));
            let half = |to| Segment::Arc { to, centre: *centre, counter_clockwise: true };
            (right, vec![half(left), half(right)])
        }
    }
}

fn signed_area(contour: &Contour) -> f64 {
    let points = contour.points(48);
    (0..points.len())
        .map(|i| {
            let (a, b) = (points[i], points[(i + 1) % points.len()]);
            a.x * b.y - b.x * a.y
        })
        .sum()
}

fn at(p: Point2<f64>) -> Point3 {
    Point3::new(p.x, p.y, 0.0)
}

fn matrix(pose: &Isometry3<f64>) -> Matrix4 {
    let m = pose.to_homogeneous();
    Matrix4::new(
        m[(0, 0)],
        m[(1, 0)],
        m[(2, 0)],
        0.0,
        m[(0, 1)],
        m[(1, 1)],
        m[(2, 1)],
        0.0,
        m[(0, 2)],
        m[(1, 2)],
        m[(2, 2)],
        0.0,
        m[(0, 3)],
        m[(1, 3)],
        m[(2, 3)],
        1.0,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::MeshSolid;

    fn plate() -> Feature {
        let outline = Contour::rounded_rectangle([1.0, 2.0], [20.0, 12.0], 3.0);
        let profile = Profile::new(outline).with_hole(Contour::circle([4.0, 2.0], 2.0)).with_hole(Contour::circle([-4.0, 2.0], 1.0));
        Feature::extrude(profile, 2.5).turned_x(crate::units::Angle::deg(30.0)).at(3.0, 1.0, -2.0)
    }

    #[test]
    fn analytic_plate_with_holes_is_closed_and_has_its_volume() {
        let brep = Brep::build(&plate()).expect("no boolean in it");
        let pi = std::f64::consts::PI;
        let exact = 2.5 * (240.0 - (4.0 - pi) * 9.0 - 5.0 * pi);
        assert!(brep.is_closed());
        assert!((brep.volume_mm3() / exact - 1.0).abs() < 1e-3, "{} {exact}", brep.volume_mm3());
    }

    #[test]
    fn analytic_the_two_kernels_agree_within_the_chord_error() {
        // A circle of 48 pieces lacks 0.285 % of its area; on a ball the chords of both directions add up to 1.001 %.
        let features = [(plate(), 0.0, 0.003), (Feature::cylinder(1.5, 80.0), 0.002_854, 1e-6), (Feature::sphere(2.9), 0.010_01, 1e-5)];
        for (feature, lacks, within) in features {
            let exact = Brep::build(&feature).expect("no boolean in it").volume_mm3();
            let mesh = MeshSolid::build(&feature).volume_mm3();
            assert!((1.0 - mesh / exact - lacks).abs() < within, "{mesh} {exact}");
        }
    }

    #[test]
    fn analytic_a_ball_is_closed_and_has_its_volume() {
        let brep = Brep::build(&Feature::sphere(3.0).at(1.0, 2.0, 3.0)).expect("no boolean in it");
        assert!(brep.is_closed());
        for edge in brep.solid.edge_iter() {
            let (curve, centre) = (edge.curve(), Point3::new(1.0, 2.0, 3.0));
            let (start, end) = curve.range_tuple();
            let off = |piece: u32| (curve.subs(start + (end - start) * f64::from(piece) / 8.0) - centre).magnitude() - 3.0;
            assert!((0..=8).all(|piece| off(piece).abs() < 1e-12), "{curve:?}");
        }
        assert!((brep.volume_mm3() / (36.0 * std::f64::consts::PI) - 1.0).abs() < 1e-15, "{}", brep.volume_mm3());
    }

    #[test]
    fn analytic_a_missing_face_an_open_corner_and_a_strayed_edge_are_cracks() {
        let built = || Brep::build(&plate()).expect("no boolean in it");
        let mut missing = built();
        let mut shell = missing.solid.boundaries()[0].clone();
        shell.pop();
        missing.solid = Solid::new_unchecked(vec![shell]);
        assert!(!missing.is_closed());
        let corner = built();
        let vertex = corner.solid.vertex_iter().next().expect("a plate has vertices");
        vertex.set_point(vertex.point() + Vector3::unit_z() * 1e-3);
        assert!(!corner.is_closed());
        let strayed = built();
        let edge = strayed.solid.edge_iter().next().expect("a plate has edges");
        let (front, back) = (edge.absolute_front().point(), edge.absolute_back().point());
        let aside = builder::vertex(front + (back - front) * 0.5 + Vector3::new(0.3, -0.2, 0.1));
        let bulge = builder::circle_arc(&builder::vertex(front), &builder::vertex(back), aside.point());
        edge.set_curve(bulge.curve());
        assert!(!strayed.is_closed());
    }

    #[test]
    fn analytic_a_boolean_is_declined() {
        assert!(Brep::build(&plate().minus([Feature::sphere(1.0)])).is_none());
    }
}
