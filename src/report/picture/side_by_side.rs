//! Two frames beside each other, seen alike and at one scale.

use super::camera::Camera;
use super::lettering::Lettering;
use super::{raster, scene};
use crate::frame::assembly::Design;
use crate::report::picture::image::{Item, View, corners, encoded, fills_of};

/// Width and height of one view of one frame, pixels.
const SIZE: [u32; 2] = [720, 600];

/// Height of the band with the names, and of its letters, pixels.
const BAND: usize = 40;
const LETTERS: f64 = 22.0;

/// How much of its side a name may take.
const ROOM: f64 = 0.94;

/// Both frames in perspective, and from above below that, under their names; the bytes of a PNG file.
pub fn png(designs: [&Design; 2], names: [&str; 2]) -> Vec<u8> {
    let laid = designs.map(scene::laid);
    let items = [0, 1].map(|side| scene::assembled(designs[side], &laid[side]));
    let both: Vec<Item> = items.iter().flatten().copied().collect();
    let points = corners(&both);
    let [width, height] = SIZE.map(|side| side as usize);
    let mut rgb = band(names, width);
    for view in [View::Perspective, View::Top] {
        let camera = Camera::fit(view, false, &points, SIZE);
        let [left, right] = [0, 1].map(|side| raster::rgb(&fills_of(&items[side], &camera), width, height));
        for (left, right) in left.chunks_exact(3 * width).zip(right.chunks_exact(3 * width)) {
            rgb.extend_from_slice(left);
            rgb.extend_from_slice(right);
        }
    }
    encoded(&rgb, 2 * SIZE[0], 2 * SIZE[1] + BAND as u32)
}

/// The names, each over the middle of its side.
fn band(names: [&str; 2], width: usize) -> Vec<u8> {
    let mut rgb = vec![255; 3 * 2 * width * BAND];
    if let Some(lettering) = Lettering::new() {
        for (side, name) in names.into_iter().enumerate() {
            // A long name is written smaller, and stays on its side.
            let size = LETTERS * (ROOM * width as f64 / lettering.width(name, LETTERS)).min(1.0);
            lettering.write(&mut rgb, 2 * width, name, size, [(0.5 + side as f64) * width as f64, 0.5 * BAND as f64]);
        }
    }
    rgb
}
