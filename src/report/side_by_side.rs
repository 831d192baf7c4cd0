//! Two frames beside each other, seen alike and at one scale.

use super::camera::Camera;
use super::lettering::Lettering;
use super::picture::{Item, View, corners, encoded, fills_of};
use super::{raster, scene};
use crate::assembly::Design;

/// Width and height of one frame's picture, pixels.
const SIZE: [u32; 2] = [720, 600];

/// Height of the letters, pixels.
const LETTERS: f64 = 22.0;

/// Both frames in perspective, and from above below that, with their names; the bytes of a PNG file.
pub fn png(designs: [&Design; 2], names: [&str; 2]) -> Vec<u8> {
    let items = designs.map(scene::assembled);
    let both: Vec<Item> = items.iter().flatten().copied().collect();
    let points = corners(&both);
    let lettering = Lettering::new();
    let [width, height] = SIZE.map(|side| side as usize);
    let mut rgb = Vec::with_capacity(3 * 4 * width * height);
    for view in [View::Perspective, View::Top] {
        let camera = Camera::fit(view, false, &points, SIZE);
        let [left, right] = [0, 1].map(|side| {
            let mut rgb = raster::rgb(&fills_of(&items[side], &camera), width, height);
            if let Some(lettering) = &lettering {
                lettering.write(&mut rgb, width, names[side], LETTERS, [0.5 * width as f64, LETTERS]);
            }
            rgb
        });
        for (left, right) in left.chunks_exact(3 * width).zip(right.chunks_exact(3 * width)) {
            rgb.extend_from_slice(left);
            rgb.extend_from_slice(right);
        }
    }
    encoded(&rgb, 2 * SIZE[0], 2 * SIZE[1])
}
