//! Pictures of meshes: from values to the bytes of a PNG file, without a display.
//!
//! World axes: X right, Y front, Z up, lengths in mm. Surfaces are shaded smoothly except across edges sharper than
//! 35°, which are drawn as thin lines, as are outlines. The same input gives the same bytes on every machine.

use nalgebra::{Isometry3, Point3};

pub use super::camera::View;
use super::{
    camera::Camera,
    raster::{self, Fill},
    surface::{self, Drawn},
};
use crate::params::catalogue::{self, Printer};
use crate::solid::Mesh;

/// Distance between the lines of the bed's grid, mm; every fifth is stronger.
const GRID_MM: f64 = 10.0;

/// Corners of a round bed as it is drawn.
const DISC_CORNERS: usize = 96;

/// Linear intensity of the bed, of the shadow on it, and of its thin and strong lines.
const BED: [f32; 4] = [0.88, 0.50, 0.70, 0.42];

/// How far a shadow on the bed lies from the point that casts it, per mm of height.
const SHADOW_SLANT: [f64; 2] = [0.25, 0.15];

/// A thing in a picture.
#[derive(Clone, Copy, Debug)]
pub struct Item<'a> {
    /// Its surface, in its own axes, mm.
    pub mesh: &'a Mesh,
    /// Where it stands in the world, mm.
    pub pose: Isometry3<f64>,
    /// Linear red, green, blue and opacity, 0 to 1; below 1 what is behind shines through.
    pub colour: [f32; 4],
}

impl Item<'_> {
    /// Whether the other is drawn as this one is, to the last bit.
    fn looks_like(&self, other: &Self) -> bool {
        let bits = |item: &Self| {
            let Isometry3 { rotation, translation } = item.pose;
            (rotation.coords.map(f64::to_bits), translation.vector.map(f64::to_bits), item.colour.map(f32::to_bits))
        };
        bits(self) == bits(other) && (std::ptr::eq(self.mesh, other.mesh) || self.mesh == other.mesh)
    }
}

/// The bed of a printer in the plane Z = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bed {
    /// Front left corner of the square or rectangle around it, mm.
    pub low_mm: [f64; 2],
    /// Extent along X and Y, mm.
    pub size_mm: [f64; 2],
    /// Whether it is the disc in that square.
    pub round: bool,
}

impl Bed {
    /// A printer's, its corner in the origin.
    pub fn of(printer: &Printer) -> Self {
        Self { low_mm: [0.0; 2], size_mm: printer.size_mm, round: printer.bed == catalogue::Bed::Round }
    }

    /// Width and depth as they are drawn, mm.
    fn drawn_mm(&self) -> [f64; 2] {
        self.size_mm.map(|s| if s.is_finite() { s.clamp(0.0, 5000.0) } else { 0.0 })
    }

    /// Corners, counter-clockwise, mm.
    fn outline(&self) -> Vec<Point3<f64>> {
        let ([x0, y0], [x, y]) = (self.low_mm, self.drawn_mm());
        if !self.round {
            return [[x0, y0], [x0 + x, y0], [x0 + x, y0 + y], [x0, y0 + y]].map(|[x, y]| Point3::new(x, y, 0.0)).into();
        }
        let radius = 0.5 * x.min(y);
        let on = |turn: usize| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * turn as f64 / DISC_CORNERS as f64);
            Point3::new(x0 + 0.5 * x + radius * cos, y0 + 0.5 * y + radius * sin, 0.0)
        };
        (0..DISC_CORNERS).map(on).collect()
    }

    /// From where to where a line of the grid lies on the bed: at this place of one axis, along the other, from the corner, mm.
    fn along(&self, axis: usize, at: f64) -> [f64; 2] {
        let size = self.drawn_mm();
        if !self.round {
            return [0.0, size[1 - axis]];
        }
        let (radius, off) = (0.5 * size[0].min(size[1]), at - 0.5 * size[axis]);
        let half = (radius * radius - off * off).max(0.0).sqrt();
        [0.5 * size[1 - axis] - half, 0.5 * size[1 - axis] + half]
    }
}

/// A picture of the items on white, all of them within it, as the bytes of a PNG file; size in pixels (at least 1).
pub fn png(items: &[Item], view: View, width: u32, height: u32) -> Vec<u8> {
    encoded(&pixels(items, &[], view, [width, height]), width, height)
}

/// The same with a printer's bed under the items: a grid, and their shadows. From below the bed is not drawn.
pub fn png_on_bed(items: &[Item], bed: &Bed, view: View, width: u32, height: u32) -> Vec<u8> {
    encoded(&pixels(items, &[*bed], view, [width, height]), width, height)
}

/// Red, green, blue bytes of the picture.
pub(in crate::report) fn pixels(items: &[Item], beds: &[Bed], view: View, size: [u32; 2]) -> Vec<u8> {
    seen(items, beds, &[], view, size).0
}

/// The same with points that lie within the picture, too, and the camera that sees it.
pub(in crate::report) fn seen(items: &[Item], beds: &[Bed], points: &[Point3<f64>], view: View, size: [u32; 2]) -> (Vec<u8>, Camera) {
    let size = size.map(|s| s.max(1));
    let mut all = corners(items);
    all.extend(beds.iter().flat_map(Bed::outline));
    all.extend(points);
    let camera = Camera::fit(view, !beds.is_empty(), &all, size);
    let mut fills = bed_fills(beds, items, view, &camera);
    fills.extend(fills_of(items, &camera));
    (raster::rgb(&fills, size[0] as usize, size[1] as usize), camera)
}

/// All corners of the items, mm.
pub(in crate::report) fn corners(items: &[Item]) -> Vec<Point3<f64>> {
    items.iter().flat_map(|item| item.mesh.vertices.iter().map(|v| item.pose * Point3::from(v.map(f64::from)))).collect()
}

/// What is drawn of the items: surfaces, lines, and last what lets others shine through, the farthest first.
pub(in crate::report) fn fills_of(items: &[Item], camera: &Camera) -> Vec<Fill> {
    Sketches::new(camera).fills_of(items)
}

/// What is drawn of items in several pictures by one camera: of those that stand in several, once.
pub(in crate::report) struct Sketches<'a> {
    camera: &'a Camera,
    drawn: Vec<(Item<'a>, Drawn)>,
}

impl<'a> Sketches<'a> {
    /// None yet.
    pub fn new(camera: &'a Camera) -> Self {
        Self { camera, drawn: Vec::new() }
    }

    /// As [`fills_of`].
    pub fn fills_of(&mut self, items: &[Item<'a>]) -> Vec<Fill> {
        let (mut fills, mut lines, mut translucent) = (Vec::new(), Vec::new(), Vec::new());
        for item in items {
            let Drawn { facets, lines: own } = self.drawn(item);
            if item.colour[3] < 1.0 { &mut translucent } else { &mut fills }.extend_from_slice(facets);
            lines.extend_from_slice(own);
        }
        let nearness = |f: &Fill| f.corners[0][2] + f.corners[1][2] + f.corners[2][2];
        translucent.sort_by(|a, b| nearness(a).total_cmp(&nearness(b)));
        fills.extend(lines);
        fills.extend(translucent);
        fills
    }

    fn drawn(&mut self, item: &Item<'a>) -> &Drawn {
        let at = self.drawn.iter().position(|(other, _)| other.looks_like(item)).unwrap_or_else(|| {
            self.drawn.push((*item, surface::drawn(item.mesh, &item.pose, item.colour, self.camera)));
            self.drawn.len() - 1
        });
        &self.drawn[at].1
    }
}

/// The beds, their grids, and the shadows on them.
fn bed_fills(beds: &[Bed], items: &[Item], view: View, camera: &Camera) -> Vec<Fill> {
    if view == View::Bottom || beds.is_empty() {
        return Vec::new();
    }
    let grey = |corners, shade: f32| Fill { corners, light: [1.0; 3], colour: [shade; 3], alpha: 1.0 };
    let mut fills = Vec::new();
    for bed in beds {
        let outline: Vec<[f64; 3]> = bed.outline().iter().map(|p| camera.project(p)).collect();
        fills.extend(outline.windows(2).skip(1).map(|pair| grey([outline[0], pair[0], pair[1]], BED[0])));
    }
    for item in items.iter().filter(|item| item.colour[3] >= 1.0) {
        let cast: Vec<[f64; 3]> =
            item.mesh.vertices.iter().map(|v| shadow(&(item.pose * Point3::from(v.map(f64::from))), camera)).collect();
        let whole = item.mesh.triangles.iter().filter(|t| t.iter().all(|&i| (i as usize) < cast.len()));
        fills.extend(whole.map(|t| grey(t.map(|i| cast[i as usize]), BED[1])));
    }
    fills.extend(beds.iter().flat_map(|bed| grid(bed, camera)));
    fills
}

/// The lines on a bed, and its rim.
fn grid(bed: &Bed, camera: &Camera) -> Vec<Fill> {
    let mut fills = Vec::new();
    let mut line = |ends: [Point3<f64>; 2], strong: bool| {
        let ends = ends.map(|point| camera.project(&point));
        fills.extend(surface::line(ends, [if strong { BED[3] } else { BED[2] }; 3], camera));
    };
    let [x0, y0] = bed.low_mm;
    for (axis, length) in bed.drawn_mm().into_iter().enumerate() {
        for step in 0..=(length / GRID_MM).ceil() as usize {
            let at = (step as f64 * GRID_MM).min(length);
            let point = |t: f64| if axis == 0 { Point3::new(x0 + at, y0 + t, 0.0) } else { Point3::new(x0 + t, y0 + at, 0.0) };
            line(bed.along(axis, at).map(point), step % 5 == 0 || at == length && !bed.round);
        }
    }
    if bed.round {
        let rim = bed.outline();
        (0..rim.len()).for_each(|at| line([rim[at], rim[(at + 1) % rim.len()]], true));
    }
    fills
}

/// The projected shadow of a point on the plane of the bed, a little above it.
fn shadow(point: &Point3<f64>, camera: &Camera) -> [f64; 3] {
    let height = point.z.max(0.0);
    let [x, y, near] = camera.project(&Point3::new(point.x + SHADOW_SLANT[0] * height, point.y + SHADOW_SLANT[1] * height, 0.0));
    [x, y, camera.raised(near, 0.3)]
}

/// The bytes of a PNG file; empty if the encoder refuses, which it does not for these values.
pub(in crate::report) fn encoded(rgb: &[u8], width: u32, height: u32) -> Vec<u8> {
    let write = || -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width.max(1), height.max(1));
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        // Takes a fraction of the time of the usual level; files grow by two thirds.
        encoder.set_compression(png::Compression::Fast);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(rgb)?;
        writer.finish()?;
        Ok(bytes)
    };
    write().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use std::{f64::consts::PI, io::Cursor};

    use super::*;

    const VIEWS: [View; 5] = [View::Front, View::Right, View::Top, View::Bottom, View::Perspective];

    fn decoded(bytes: &[u8]) -> Vec<[u8; 3]> {
        let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut rgb).unwrap();
        rgb.chunks(3).map(|p| [p[0], p[1], p[2]]).collect()
    }

    fn sphere(radius: f64, rings: u32) -> Mesh {
        let (turns, mut points, mut triangles) = (2 * rings, Vec::new(), Vec::new());
        for ring in 0..=rings {
            for turn in 0..turns {
                let (sin, cos) = libm::sincos(PI * f64::from(ring) / f64::from(rings));
                let (s, c) = libm::sincos(2.0 * PI * f64::from(turn) / f64::from(turns));
                points.push(Point3::new(radius * sin * c, radius * sin * s, radius * cos));
                if ring < rings {
                    let (a, b) = (ring * turns + turn, ring * turns + (turn + 1) % turns);
                    triangles.extend([[a, a + turns, b], [b, a + turns, b + turns]]);
                }
            }
        }
        Mesh::canonical(&points, &triangles)
    }

    fn cuboid(half: [f64; 3]) -> Mesh {
        let corner = |i: u8| Point3::from([0, 1, 2].map(|axis| half[axis] * (2.0 * f64::from(i >> axis & 1) - 1.0)));
        let points: Vec<Point3<f64>> = (0..8).map(corner).collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles: Vec<[u32; 3]> = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        Mesh::canonical(&points, &triangles)
    }

    fn at(mesh: &Mesh, place: [f64; 3], colour: [f32; 4]) -> Item<'_> {
        Item { mesh, pose: Isometry3::translation(place[0], place[1], place[2]), colour }
    }

    const RED: [f32; 4] = [0.8, 0.02, 0.02, 1.0];
    const BLUE: [f32; 4] = [0.02, 0.02, 0.8, 1.0];

    #[test]
    fn analytic_sphere_covers_a_circle() {
        let ball = sphere(25.0, 96);
        for view in &VIEWS[..4] {
            let pixels = decoded(&png(&[at(&ball, [3.0, -7.0, 11.0], RED)], *view, 800, 600));
            let covered = pixels.iter().filter(|p| p[1] < 188).count() as f64 / pixels.len() as f64;
            let radius = 600.0 * (0.5 - 0.04) + 0.5;
            let expected = PI * radius * radius / (800.0 * 600.0);
            assert!((covered / expected - 1.0).abs() < 0.003, "{view:?}: {covered} against {expected}");
        }
    }

    #[test]
    fn analytic_sphere_is_smooth_and_round_in_perspective() {
        let ball = sphere(25.0, 96);
        let pixels = decoded(&png(&[at(&ball, [0.0; 3], RED)], View::Perspective, 400, 400));
        let covered = pixels.iter().filter(|p| p[1] < 188).count() as f64;
        let radius = 400.0 * (0.5 - 0.04) + 0.5;
        assert!((covered / (PI * radius * radius) - 1.0).abs() < 0.005, "{covered}");
    }

    #[test]
    fn analytic_nearer_box_hides_the_farther() {
        let cube = cuboid([10.0, 10.0, 10.0]);
        for (view, towards) in
            VIEWS.iter().zip([[0.0, 30.0, 0.0], [30.0, 0.0, 0.0], [0.0, 0.0, 30.0], [0.0, 0.0, -30.0], [-25.5, 30.0, 24.6]])
        {
            for order in [[0, 1], [1, 0]] {
                let items = [at(&cube, towards, RED), at(&cube, [0.0; 3], BLUE)];
                let pixels = decoded(&png(&order.map(|i| items[i]), *view, 200, 200));
                let blue = pixels.iter().filter(|p| p[2] > p[0] && p[2] < 255).count();
                let red = pixels.iter().filter(|p| p[0] > p[2] && p[1] < 100).count();
                assert!(red > 5000, "{view:?} {red}");
                assert!(*view == View::Perspective || blue == 0, "{view:?} {blue}");
                let [r, _, b] = pixels[100 * 200 + 90];
                assert!(r > b, "{view:?}");
            }
        }
    }

    #[test]
    fn analytic_disc_shines_through() {
        let (cube, plate) = (cuboid([10.0, 10.0, 10.0]), cuboid([10.0, 10.0, 0.5]));
        let glass = [0.5, 0.5, 0.0, 0.5];
        let only = decoded(&png(&[at(&cube, [0.0; 3], BLUE)], View::Top, 100, 100))[50 * 100 + 40];
        let both = decoded(&png(&[at(&plate, [0.0, 0.0, 20.0], glass), at(&cube, [0.0; 3], BLUE)], View::Top, 100, 100))[50 * 100 + 40];
        assert!(both[0] > only[0] && both[2] < only[2] && both[2] > 60, "{only:?} {both:?}");
    }

    #[test]
    fn analytic_same_bytes_twice() {
        let (ball, cube) = (sphere(9.0, 24), cuboid([10.0, 4.0, 2.0]));
        let items = [at(&ball, [5.0, 0.0, 0.0], RED), at(&cube, [0.0; 3], [0.1, 0.4, 0.1, 0.4])];
        let bed = Bed { low_mm: [0.0; 2], size_mm: [40.0, 30.0], round: false };
        for view in VIEWS {
            assert_eq!(png(&items, view, 160, 120), png(&items, view, 160, 120));
            assert_eq!(png_on_bed(&items, &bed, view, 160, 120), png_on_bed(&items, &bed, view, 160, 120));
        }
    }

    #[test]
    fn analytic_what_stands_in_two_pictures_looks_the_same_in_both() {
        let (ball, cube) = (sphere(9.0, 24), cuboid([10.0, 4.0, 2.0]));
        let same = ball.clone();
        let first = [at(&ball, [5.0, 0.0, 0.0], RED), at(&cube, [0.0; 3], BLUE)];
        let second = [at(&same, [5.0, 0.0, 0.0], RED), at(&cube, [1.0, 0.0, 0.0], BLUE), at(&ball, [5.0, 0.0, 0.0], BLUE)];
        let camera = Camera::fit(View::Perspective, false, &corners(&second), [160, 120]);
        let mut sketches = Sketches::new(&camera);
        for items in [&first[..], &second[..]] {
            assert_eq!(raster::rgb(&sketches.fills_of(items), 160, 120), raster::rgb(&fills_of(items, &camera), 160, 120));
        }
        assert_eq!(sketches.drawn.len(), 4);
    }

    #[test]
    fn analytic_a_round_bed_covers_a_disc_of_its_square() {
        let covered = |round: bool| {
            let bed = Bed { low_mm: [10.0, -5.0], size_mm: [200.0, 200.0], round };
            decoded(&png_on_bed(&[], &bed, View::Top, 400, 400)).iter().filter(|p| **p != [255; 3]).count() as f64
        };
        assert!((covered(true) / covered(false) - 0.25 * PI).abs() < 0.01, "{} {}", covered(true), covered(false));
    }

    #[test]
    fn analytic_empty_scene_is_white() {
        let nothing = Mesh::default();
        for view in VIEWS {
            assert!(decoded(&png(&[], view, 64, 48)).iter().all(|p| *p == [255; 3]));
            assert!(decoded(&png(&[at(&nothing, [0.0; 3], RED)], view, 64, 48)).iter().all(|p| *p == [255; 3]));
            assert_eq!(decoded(&png(&[], view, 0, 0)).len(), 1);
        }
    }

    #[test]
    fn analytic_nothing_non_finite_comes_in() {
        let cube = cuboid([10.0, 10.0, 10.0]);
        let mut broken = cube.clone();
        broken.vertices[3] = [f32::NAN, 0.0, f32::INFINITY];
        broken.triangles.push([0, 1, 99]);
        let flat = Mesh { vertices: vec![[1.0, 2.0, 3.0]; 3], triangles: vec![[0, 1, 2]] };
        for view in VIEWS {
            let items = [at(&broken, [0.0; 3], [f32::NAN, 0.5, f32::INFINITY, 1.0]), at(&cube, [30.0, 0.0, 0.0], RED)];
            let pixels = decoded(&png(&items, view, 64, 48));
            assert!(pixels.iter().any(|p| p[0] > 100 && p[1] < 100), "{view:?}");
            assert_eq!(decoded(&png(&[at(&flat, [0.0; 3], RED)], view, 64, 48)).len(), 64 * 48);
            for round in [false, true] {
                let bed = Bed { low_mm: [0.0; 2], size_mm: [f64::NAN, f64::INFINITY], round };
                assert_eq!(decoded(&png_on_bed(&[at(&cube, [0.0; 3], RED)], &bed, view, 64, 48)).len(), 64 * 48);
            }
        }
    }
}
