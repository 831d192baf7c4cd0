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
use crate::solid::Mesh;

/// Distance between the lines of the bed's grid, mm; every fifth is stronger.
const GRID_MM: f64 = 10.0;

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

/// The bed of a printer: the plane Z = 0 from the origin, its front left corner, to the size along X and Y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bed {
    /// Extent along X and Y, mm.
    pub size_mm: [f64; 2],
}

/// A picture of the items on white, all of them within it, as the bytes of a PNG file; size in pixels (at least 1).
pub fn png(items: &[Item], view: View, width: u32, height: u32) -> Vec<u8> {
    encoded(&pixels(items, None, view, [width, height]), width, height)
}

/// The same with a printer's bed under the items: a grid, and their shadows. From below the bed is not drawn.
pub fn png_on_bed(items: &[Item], bed: &Bed, view: View, width: u32, height: u32) -> Vec<u8> {
    encoded(&pixels(items, Some(bed), view, [width, height]), width, height)
}

/// Red, green, blue bytes of the picture.
pub(in crate::report) fn pixels(items: &[Item], bed: Option<&Bed>, view: View, size: [u32; 2]) -> Vec<u8> {
    let size = size.map(|s| s.max(1));
    let mut points = corners(items);
    points.extend(bed.iter().flat_map(|b| rectangle(b)));
    let camera = Camera::fit(view, bed.is_some(), &points, size);
    let mut fills = bed.map(|b| bed_fills(b, items, view, &camera)).unwrap_or_default();
    fills.extend(fills_of(items, &camera));
    raster::rgb(&fills, size[0] as usize, size[1] as usize)
}

/// All corners of the items, mm.
pub(in crate::report) fn corners(items: &[Item]) -> Vec<Point3<f64>> {
    items.iter().flat_map(|item| item.mesh.vertices.iter().map(|v| item.pose * Point3::from(v.map(f64::from)))).collect()
}

/// What is drawn of the items: surfaces, lines, and last what lets others shine through, the farthest first.
pub(in crate::report) fn fills_of(items: &[Item], camera: &Camera) -> Vec<Fill> {
    let (mut fills, mut lines, mut translucent) = (Vec::new(), Vec::new(), Vec::new());
    for item in items {
        let Drawn { facets, lines: own } = surface::drawn(item.mesh, &item.pose, item.colour, camera);
        if item.colour[3] < 1.0 { &mut translucent } else { &mut fills }.extend(facets);
        lines.extend(own);
    }
    let nearness = |f: &Fill| f.corners[0][2] + f.corners[1][2] + f.corners[2][2];
    translucent.sort_by(|a, b| nearness(a).total_cmp(&nearness(b)));
    fills.extend(lines);
    fills.extend(translucent);
    fills
}

/// Corners of the bed, counter-clockwise from the origin, mm.
fn rectangle(bed: &Bed) -> [Point3<f64>; 4] {
    let [x, y] = bed.size_mm.map(|s| if s.is_finite() { s.clamp(0.0, 5000.0) } else { 0.0 });
    [[0.0, 0.0], [x, 0.0], [x, y], [0.0, y]].map(|[x, y]| Point3::new(x, y, 0.0))
}

/// The bed, its grid, and the shadows on it.
fn bed_fills(bed: &Bed, items: &[Item], view: View, camera: &Camera) -> Vec<Fill> {
    if view == View::Bottom {
        return Vec::new();
    }
    let grey = |corners, shade: f32| Fill { corners, light: [1.0; 3], colour: [shade; 3], alpha: 1.0 };
    let corners = rectangle(bed);
    let [p, q, r, s] = corners.map(|p| camera.project(&p));
    let mut fills = vec![grey([p, q, r], BED[0]), grey([p, r, s], BED[0])];
    for item in items.iter().filter(|item| item.colour[3] >= 1.0) {
        let cast: Vec<[f64; 3]> =
            item.mesh.vertices.iter().map(|v| shadow(&(item.pose * Point3::from(v.map(f64::from))), camera)).collect();
        let whole = item.mesh.triangles.iter().filter(|t| t.iter().all(|&i| (i as usize) < cast.len()));
        fills.extend(whole.map(|t| grey(t.map(|i| cast[i as usize]), BED[1])));
    }
    let far = corners[2];
    for (axis, length) in [(0, far.x), (1, far.y)] {
        for step in 0..=(length / GRID_MM).ceil() as usize {
            let along = (step as f64 * GRID_MM).min(length);
            let strong = step % 5 == 0 || along == length;
            let ends = [0.0, [far.y, far.x][axis]].map(|t| if axis == 0 { [along, t] } else { [t, along] });
            let ends = ends.map(|[x, y]| camera.project(&Point3::new(x, y, 0.0)));
            fills.extend(surface::line(ends, [if strong { BED[3] } else { BED[2] }; 3], camera));
        }
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
        let bed = Bed { size_mm: [40.0, 30.0] };
        for view in VIEWS {
            assert_eq!(png(&items, view, 160, 120), png(&items, view, 160, 120));
            assert_eq!(png_on_bed(&items, &bed, view, 160, 120), png_on_bed(&items, &bed, view, 160, 120));
        }
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
            let bed = Bed { size_mm: [f64::NAN, f64::INFINITY] };
            assert_eq!(decoded(&png_on_bed(&[at(&cube, [0.0; 3], RED)], &bed, view, 64, 48)).len(), 64 * 48);
        }
    }
}
