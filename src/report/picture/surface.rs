//! From a mesh to what is drawn of it: shaded facets, and lines along its creases and outline.

use nalgebra::{Isometry3, Point3, Vector3};

use super::{
    camera::Camera,
    raster::{self, Fill},
};
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
    let fronts: Vec<bool> = triangles.iter().map(|triangle| is_front(triangle.map(|i| seen[i]))).collect();
    let around = Around::new(&triangles, count);
    let paint = Paint::new(colour);
    let (edges, closed) = edges(&triangles, &around, &fronts);
    let one_sided = paint.alpha < 1.0 || (closed && triangles.len() == mesh.triangles.len() && mesh.volume_mm3() > 0.0);
    // What lies about a corner in sight; of a closed surface the rest takes no part in the picture.
    let mut in_sight = vec![!one_sided; count];
    triangles.iter().zip(&fronts).filter(|(_, front)| **front).for_each(|(t, _)| t.iter().for_each(|&corner| in_sight[corner] = true));
    let facets: Vec<Facet> = triangles
        .iter()
        .map(|t| if t.iter().any(|&corner| in_sight[corner]) { Facet::new(t, &points, camera) } else { Facet::default() })
        .collect();
    let mut lines = Vec::new();
    for (corners, sides) in edges {
        let kind = sides.map_or(Some(Edge::Outline), |sides| between(sides.map(|t| (&facets[t], fronts[t]))));
        if let Some(kind) = kind {
            let colour = if kind == Edge::Crease { paint.crease } else { paint.outline };
            lines.extend(line(corners.map(|i| seen[i]), colour, camera));
        }
    }
    let mut shading = Shading { triangles: &triangles, points: &points, around: &around, facets };
    let mut facets = Vec::with_capacity(triangles.len());
    for t in (0..triangles.len()).filter(|&t| fronts[t] || !one_sided) {
        let corners = triangles[t].map(|i| seen[i]);
        if raster::covers_samples(&corners) {
            facets.push(Fill { corners, light: shading.light(t, fronts[t]), colour: paint.surface, alpha: paint.alpha });
        }
    }
    Drawn { facets, lines }
}

/// Whether the outside of a triangle is seen.
fn is_front([a, b, c]: [[f64; 3]; 3]) -> bool {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < -1e-9
}

/// A line between two projected points as triangles, lifted a little towards the viewer; nothing when it is seen end on.
pub fn line(ends: [[f64; 3]; 2], colour: [f32; 3], camera: &Camera) -> impl Iterator<Item = Fill> + use<> {
    stroke(ends, camera).into_iter().flatten().map(move |corners| Fill { corners, light: [1.0; 3], colour, alpha: 1.0 })
}

fn stroke(ends: [[f64; 3]; 2], camera: &Camera) -> Option<[[[f64; 3]; 3]; 2]> {
    let [a, b] = ends;
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = libm::sqrt(dx * dx + dy * dy);
    if !length.is_finite() || length < 1e-6 {
        return None;
    }
    let (ux, uy) = (dx / length * LINE_HALF_WIDTH, dy / length * LINE_HALF_WIDTH);
    let corner = |p: [f64; 3], along: f64, across: f64| {
        [p[0] + along * ux - across * uy, p[1] + along * uy + across * ux, camera.raised(p[2], LINE_LIFT)]
    };
    let [p, q, r, s] = [corner(a, -1.0, -1.0), corner(b, 1.0, -1.0), corner(b, 1.0, 1.0), corner(a, -1.0, 1.0)];
    Some([[p, q, r], [p, r, s]])
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
#[derive(Default)]
struct Facet {
    /// Unit normal in camera axes; zero for a sliver.
    normal: Vector3<f64>,
    /// Twice the area, mm².
    area: f64,
    /// Area times the angle at each corner, the weight in a corner's normal; none before it is asked for.
    weights: [Option<f64>; 3],
}

impl Facet {
    fn new(triangle: &[usize; 3], points: &[Point3<f64>], camera: &Camera) -> Self {
        let [a, b, c] = triangle.map(|i| points[i]);
        let (first, second, third) = (b - a, c - b, a - c);
        let cross = first.cross(&second);
        let (area, longest) = (cross.norm(), first.norm().max(second.norm()).max(third.norm()));
        let normal = if area > SLIVER_MM * longest { camera.turn(&(cross / area)) } else { Vector3::zeros() };
        Self { normal, area, weights: [None; 3] }
    }
}

/// What the brightness of a mesh's corners follows from.
struct Shading<'a> {
    triangles: &'a [[usize; 3]],
    points: &'a [Point3<f64>],
    around: &'a Around,
    facets: Vec<Facet>,
}

impl Shading<'_> {
    /// Brightness at the corners of a facet that is seen from its outside or its inside: smooth across edges, except creases.
    fn light(&mut self, t: usize, front: bool) -> [f32; 3] {
        let (normal, side) = (self.facets[t].normal, if front { 1.0 } else { -1.0 });
        self.triangles[t].map(|corner| {
            let mut sum = normal * 1e-12;
            for (other, place) in self.around.of(corner) {
                let direction = self.facets[other].normal;
                if direction.dot(&normal) > CREASE_COSINE {
                    sum += direction * self.weight(other, place);
                }
            }
            brightness(&sum, side)
        })
    }

    fn weight(&mut self, t: usize, place: usize) -> f64 {
        let Facet { area, weights, .. } = &mut self.facets[t];
        *weights[place].get_or_insert_with(|| {
            let [at, next, last] = [0, 1, 2].map(|step| self.points[self.triangles[t][(place + step) % 3]]);
            *area * libm::atan2(*area, (next - at).dot(&-(at - last)))
        })
    }
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
    /// Three times the triangle, and the place of the corner in it.
    entries: Vec<u32>,
}

impl Around {
    fn new(triangles: &[[usize; 3]], corners: usize) -> Self {
        let mut starts = vec![0; corners + 2];
        triangles.iter().flatten().for_each(|&c| starts[c + 2] += 1);
        (1..starts.len()).for_each(|i| starts[i] += starts[i - 1]);
        let mut entries = vec![0; triangles.len() * 3];
        for (entry, &corner) in (0..).zip(triangles.iter().flatten()) {
            entries[starts[corner + 1]] = entry;
            starts[corner + 1] += 1;
        }
        Self { starts, entries }
    }

    /// How many corners the mesh has.
    fn corners(&self) -> usize {
        self.starts.len() - 2
    }

    /// Triangles around a corner, each with the place of the corner in it.
    fn of(&self, corner: usize) -> impl Iterator<Item = (usize, usize)> + use<'_> {
        self.entries[self.starts[corner]..self.starts[corner + 1]].iter().map(|&entry| (entry as usize / 3, entry as usize % 3))
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

/// An edge in sight: its corners, and its facets where they are two.
type SeenEdge = ([usize; 2], Option<[usize; 2]>);

/// Edges with a facet in sight, in the order of their corners, and whether each edge of the mesh has two facets.
fn edges(triangles: &[[usize; 3]], around: &Around, fronts: &[bool]) -> (Vec<SeenEdge>, bool) {
    let (mut found, mut closed) = (Vec::new(), true);
    let mut sides: Vec<(u32, u32)> = Vec::new();
    for low in 0..around.corners() {
        sides.clear();
        for (t, place) in around.of(low) {
            let [next, last] = [1, 2].map(|step| triangles[t][(place + step) % 3]);
            // Each side once, at its lower corner, also where both are the same.
            sides.extend((next >= low).then_some((next as u32, t as u32)));
            sides.extend((last > low).then_some((last as u32, t as u32)));
        }
        sides.sort_unstable();
        for group in sides.chunk_by(|a, b| a.0 == b.0) {
            let pair = if let [(_, t), (_, u)] = group { Some([*t as usize, *u as usize]) } else { None };
            closed &= pair.is_some();
            if group.iter().any(|(_, t)| fronts[*t as usize]) {
                found.push(([low, group[0].0 as usize], pair));
            }
        }
    }
    (found, closed)
}

/// What an edge between two facets is drawn as, of which at least one is in sight.
fn between([(a, a_front), (b, b_front)]: [(&Facet, bool); 2]) -> Option<Edge> {
    if a.normal == Vector3::zeros() || b.normal == Vector3::zeros() {
        None
    } else if a_front != b_front {
        Some(Edge::Outline)
    } else {
        (a.normal.dot(&b.normal) < CREASE_COSINE).then_some(Edge::Crease)
    }
}
