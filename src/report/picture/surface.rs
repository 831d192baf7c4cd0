//! From a mesh to what is drawn of it: shaded facets, and lines along its creases and outline.

use nalgebra::{Isometry3, Point3, Vector3};

use super::{camera::Camera, raster::Fill};
use crate::solid::Mesh;

/// Cosine of the angle between facets above which the edge between them is a crease (35°).
const CREASE_COSINE: f64 = 0.819_152_044_288_991_8;

/// A facet thinner than this has no direction worth drawing, mm.
const SLIVER_MM: f64 = 0.02;

/// Half the width of a line in a picture of the usual size, pixels.
const LINE_HALF_WIDTH: f64 = 0.5;

/// How far lines are lifted off the surface they lie on, pixels.
const LINE_LIFT: f64 = 1.2;

/// Directions to the lights (camera axes) and their brightness.
const LIGHTS: [([f64; 3], f64); 3] = [([-0.48, 0.64, 0.60], 0.95), ([0.80, 0.10, 0.59], 0.25), ([0.10, -0.90, 0.42], 0.10)];

/// Light from all around.
const AMBIENT: f64 = 0.16;

/// What is drawn of a mesh.
#[derive(Default)]
pub struct Drawn {
    /// Facets.
    pub facets: Vec<Fill>,
    /// Lines, already as triangles.
    pub lines: Vec<Fill>,
}

/// Shades a mesh that stands at a pose, for a camera.
pub fn drawn(mesh: &Mesh, pose: &Isometry3<f64>, colour: [f32; 4], camera: &Camera) -> Drawn {
    let count = mesh.vertices.len();
    let triangles: Vec<[usize; 3]> =
        mesh.triangles.iter().map(|t| t.map(|i| i as usize)).filter(|t| t.iter().all(|&i| i < count)).collect();
    let points: Vec<Point3<f64>> = mesh.vertices.iter().map(|v| pose * Point3::from(v.map(f64::from))).collect();
    let seen: Vec<[f64; 3]> = points.iter().map(|p| camera.project(p)).collect();
    let facets: Vec<Facet> = triangles.iter().map(|t| Facet::new(t, &points, &seen, camera)).collect();
    let paint = Paint::new(colour);
    let (edges, closed) = edges(&triangles, &facets);
    let one_sided = paint.alpha < 1.0 || (closed && triangles.len() == mesh.triangles.len() && mesh.volume_mm3() > 0.0);
    let mut drawn = Drawn { facets: shaded(&triangles, &facets, &seen, &paint, one_sided), lines: Vec::new() };
    for (corners, kind) in edges {
        let colour = if kind == Edge::Crease { paint.crease } else { paint.outline };
        drawn.lines.extend(line(corners.map(|i| seen[i]), colour, camera));
    }
    drawn
}

/// A line between two projected points as triangles, lifted a little towards the viewer; empty when it is seen end on.
pub fn line(ends: [[f64; 3]; 2], colour: [f32; 3], camera: &Camera) -> Vec<Fill> {
    let [a, b] = ends;
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = libm::sqrt(dx * dx + dy * dy);
    if !length.is_finite() || length < 1e-6 {
        return Vec::new();
    }
    let (ux, uy) = (dx / length * LINE_HALF_WIDTH, dy / length * LINE_HALF_WIDTH);
    let corner = |p: [f64; 3], along: f64, across: f64| {
        [p[0] + along * ux - across * uy, p[1] + along * uy + across * ux, camera.raised(p[2], LINE_LIFT)]
    };
    let [p, q, r, s] = [corner(a, -1.0, -1.0), corner(b, 1.0, -1.0), corner(b, 1.0, 1.0), corner(a, -1.0, 1.0)];
    [[p, q, r], [p, r, s]].map(|corners| Fill { corners, light: [1.0; 3], colour, alpha: 1.0 }).into()
}

/// Colours of an item: of its surface and of the lines on it.
struct Paint {
    surface: [f32; 3],
    alpha: f32,
    crease: [f32; 3],
    outline: [f32; 3],
}

impl Paint {
    /// Lines are darker than a bright surface; a dark one is lifted a little, and creases on it are brighter.
    fn new(colour: [f32; 4]) -> Self {
        let [r, g, b, alpha] = colour.map(|c| if c.is_finite() { c.clamp(0.0, 1.0) } else { 0.0 });
        let dark = r.max(g).max(b) < 0.08;
        let surface = [r, g, b].map(|c| if dark { c + 0.015 } else { c });
        let outline = surface.map(|c| c * 0.25);
        let crease = if dark { surface.map(|c| c + 0.16) } else { outline };
        if alpha < 1.0 { Self { surface, alpha, crease: surface, outline: surface } } else { Self { surface, alpha, crease, outline } }
    }
}

/// What is known of a triangle of the mesh.
struct Facet {
    /// Unit normal in camera axes; zero for a sliver.
    normal: Vector3<f64>,
    /// Area times the angle at each corner, the weight in a corner's normal.
    weights: [f64; 3],
    /// Whether its outside is seen.
    front: bool,
}

impl Facet {
    fn new(triangle: &[usize; 3], points: &[Point3<f64>], seen: &[[f64; 3]], camera: &Camera) -> Self {
        let p = triangle.map(|i| points[i]);
        let sides = [p[1] - p[0], p[2] - p[1], p[0] - p[2]];
        let cross = sides[0].cross(&sides[1]);
        let (area, longest) = (cross.norm(), sides.iter().map(Vector3::norm).fold(0.0, f64::max));
        let normal = if area > SLIVER_MM * longest { camera.turn(&(cross / area)) } else { Vector3::zeros() };
        let weights = [0, 1, 2].map(|i| {
            let (u, v) = (sides[i], -sides[(i + 2) % 3]);
            area * libm::atan2(area, u.dot(&v))
        });
        let [a, b, c] = triangle.map(|i| seen[i]);
        let front = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < -1e-9;
        Self { normal, weights, front }
    }
}

/// Facets with the brightness of the corners: smooth across edges, except creases. One-sided: those seen from inside
/// are left out, as a closed surface hides them itself.
fn shaded(triangles: &[[usize; 3]], facets: &[Facet], seen: &[[f64; 3]], paint: &Paint, one_sided: bool) -> Vec<Fill> {
    let around = Around::new(triangles, seen.len());
    let mut fills = Vec::with_capacity(triangles.len());
    for (triangle, facet) in triangles.iter().zip(facets).filter(|(_, facet)| facet.front || !one_sided) {
        let side = if facet.front { 1.0 } else { -1.0 };
        let light = triangle.map(|corner| {
            let mut sum = facet.normal * 1e-12;
            for &(other, place) in around.of(corner) {
                let other = &facets[other];
                if other.normal.dot(&facet.normal) > CREASE_COSINE {
                    sum += other.normal * other.weights[place];
                }
            }
            brightness(&sum, side)
        });
        fills.push(Fill { corners: triangle.map(|i| seen[i]), light, colour: paint.surface, alpha: paint.alpha });
    }
    fills
}

/// Brightness of a surface with this normal (any length), seen from its outside (1) or inside (-1).
fn brightness(normal: &Vector3<f64>, side: f64) -> f32 {
    let length = normal.norm();
    let unit = if length > 0.0 { normal * (side / length) } else { Vector3::z() };
    let lit: f64 = LIGHTS.iter().map(|(to, power)| power * unit.dot(&Vector3::from(*to)).max(0.0)).sum();
    (AMBIENT + lit) as f32
}

/// For each corner of a mesh the triangles around it.
struct Around {
    starts: Vec<usize>,
    entries: Vec<(usize, usize)>,
}

impl Around {
    fn new(triangles: &[[usize; 3]], corners: usize) -> Self {
        let mut starts = vec![0; corners + 2];
        triangles.iter().flatten().for_each(|&c| starts[c + 2] += 1);
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut entries = vec![(0, 0); triangles.len() * 3];
        for (t, triangle) in triangles.iter().enumerate() {
            for (place, &corner) in triangle.iter().enumerate() {
                entries[starts[corner + 1]] = (t, place);
                starts[corner + 1] += 1;
            }
        }
        Self { starts, entries }
    }

    /// Triangles around a corner, each with the place of the corner in it.
    fn of(&self, corner: usize) -> &[(usize, usize)] {
        &self.entries[self.starts[corner]..self.starts[corner + 1]]
    }
}

/// Why an edge is drawn.
#[derive(Clone, Copy, PartialEq)]
enum Edge {
    /// Its facets meet at an angle, both in sight.
    Crease,
    /// The surface turns away from the viewer here, or ends.
    Outline,
}

/// Edges to draw, in the order of their corners, and whether each edge of the mesh has two facets.
fn edges(triangles: &[[usize; 3]], facets: &[Facet]) -> (Vec<([usize; 2], Edge)>, bool) {
    let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(triangles.len() * 3);
    for (t, [a, b, c]) in triangles.iter().enumerate() {
        sides.extend([(a, b), (b, c), (c, a)].map(|(p, q)| ([*p.min(q) as u32, *p.max(q) as u32], t as u32)));
    }
    sides.sort_unstable();
    let (mut found, mut closed) = (Vec::new(), true);
    for group in sides.chunk_by(|a, b| a.0 == b.0) {
        let kind = match group {
            [(_, t), (_, u)] => between(&facets[*t as usize], &facets[*u as usize]),
            _ => {
                closed = false;
                group.iter().any(|(_, t)| facets[*t as usize].front).then_some(Edge::Outline)
            }
        };
        found.extend(kind.map(|kind| (group[0].0.map(|i| i as usize), kind)));
    }
    (found, closed)
}

fn between(a: &Facet, b: &Facet) -> Option<Edge> {
    let sliver = a.normal == Vector3::zeros() || b.normal == Vector3::zeros();
    if sliver || !(a.front || b.front) {
        None
    } else if a.front != b.front {
        Some(Edge::Outline)
    } else {
        (a.normal.dot(&b.normal) < CREASE_COSINE).then_some(Edge::Crease)
    }
}
