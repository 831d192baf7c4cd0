//! Where bodies are seen in a picture, so that a line to one ends on it and not on what hides it.
//!
//! The picture is drawn a second time in flat colours, one for each body, and its pixels are read.

use nalgebra::{Point3, center};

use super::camera::Camera;
use super::image::{Item, fills_of};
use super::raster;

/// Levels of a channel's linear intensity.
const LEVELS: usize = 8;
/// Colours of bodies; one more is the white behind them.
const CODES: usize = LEVELS * LEVELS * LEVELS - 1;

/// A pixel of each body, as near to the middle of what is seen of it as can be; none of a body that is hidden. What lets others shine through
/// is pointed at in its own middle.
pub(super) fn seen_at(items: &[Item], camera: &Camera, size: [u32; 2]) -> Vec<Option<[f64; 2]>> {
    let hides = |at: usize| items[at].colour[3] >= 1.0 && at < CODES;
    let mut fills = Vec::new();
    for at in (0..items.len()).filter(|at| hides(*at)) {
        let own = fills_of(&items[at..=at], camera);
        fills.extend(own.into_iter().map(|fill| raster::Fill { light: [1.0; 3], colour: colour(at), ..fill }));
    }
    let [width, height] = size.map(|side| side as usize);
    let codes: Vec<usize> = raster::rgb(&fills, width, height).chunks_exact(3).map(code).collect();
    let mut pixels = vec![Vec::new(); items.len()];
    for at in (width..codes.len().saturating_sub(width)).filter(|at| (1..width - 1).contains(&(at % width))) {
        // On a border colours are mixed, and a mixture may be the colour of another body.
        let is_inside = [1, width].iter().all(|step| codes[at - step] == codes[at] && codes[at + step] == codes[at]);
        if is_inside && codes[at] < items.len() {
            pixels[codes[at]].push([(at % width) as f64 + 0.5, (at / width) as f64 + 0.5]);
        }
    }
    let middle = |at: usize| {
        let [low, high] = items[at].mesh.bounds_mm().map(Point3::from);
        let [x, y, _] = camera.project(&(items[at].pose * center(&low, &high)));
        [x, y]
    };
    pixels.iter().enumerate().map(|(at, own)| if hides(at) { central(own) } else { Some(middle(at)) }).collect()
}

/// The pixel that is nearest to the mean of all.
fn central(pixels: &[[f64; 2]]) -> Option<[f64; 2]> {
    let mean = [0, 1].map(|axis| pixels.iter().map(|pixel| pixel[axis]).sum::<f64>() / pixels.len() as f64);
    let off = |pixel: &[f64; 2]| libm::hypot(pixel[0] - mean[0], pixel[1] - mean[1]);
    pixels.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b)))
}

/// The colour of the body with this number, linear.
fn colour(number: usize) -> [f32; 3] {
    [number % LEVELS, number / LEVELS % LEVELS, number / (LEVELS * LEVELS)].map(|level| level as f32 / (LEVELS - 1) as f32)
}

/// The number of the body that a pixel has the colour of.
fn code(pixel: &[u8]) -> usize {
    let level = |value: u8| {
        let x = f64::from(value) / 255.0;
        let linear = if x <= 0.040_45 { x / 12.92 } else { libm::pow((x + 0.055) / 1.055, 2.4) };
        (linear * (LEVELS - 1) as f64).round() as usize
    };
    pixel.iter().rev().fold(0, |number, value| number * LEVELS + level(*value))
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use super::*;
    use crate::report::picture::camera::View;
    use crate::report::picture::image::corners;
    use crate::solid::{Feature, Mesh, MeshSolid};

    fn cuboid(low: [f64; 3], high: [f64; 3]) -> Mesh {
        MeshSolid::build(&Feature::cuboid_between(low, high)).to_mesh()
    }

    #[test]
    fn analytic_bodies_are_pointed_at_where_they_are_seen() {
        // From the front, where y is largest: a large plate hides the middle of a longer bar behind it, and all of a small block.
        let meshes = [
            cuboid([-30.0, 12.0, -20.0], [30.0, 14.0, 20.0]),
            cuboid([-30.0, 0.0, -4.0], [80.0, 4.0, 4.0]),
            cuboid([-5.0, 0.0, -15.0], [5.0, 4.0, -8.0]),
        ];
        let size = [400, 300];
        let items = [0, 1, 2].map(|at| Item { mesh: &meshes[at], pose: Isometry3::identity(), colour: [0.5, 0.5, 0.5, 1.0] });
        let camera = Camera::fit(View::Front, false, &corners(&items), size);
        let [plate, bar, block] = <[_; 3]>::try_from(seen_at(&items, &camera, size)).expect("three bodies");
        let [x, y, _] = camera.project(&Point3::new(0.0, 14.0, 0.0));
        let plate = plate.expect("nothing is before it");
        assert!((plate[0] - x).abs() < 2.0 && (plate[1] - y).abs() < 2.0, "{plate:?} {x} {y}");
        let [x, y, _] = camera.project(&Point3::new(55.0, 4.0, 0.0));
        let bar = bar.expect("half of it stands out");
        assert!((bar[0] - x).abs() < 3.0 && (bar[1] - y).abs() < 3.0, "{bar:?} {x} {y}");
        assert_eq!(block, None);
    }

    #[test]
    fn analytic_each_number_has_its_own_colour() {
        for number in 0..CODES {
            let display = colour(number).map(|c| {
                let c = f64::from(c);
                let value = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * libm::pow(c, 1.0 / 2.4) - 0.055 };
                (255.0 * value).round() as u8
            });
            assert_eq!(code(&display), number);
        }
    }
}
