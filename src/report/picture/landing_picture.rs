//! A frame as it lands: sloped, one foot on the ground.

use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};

use super::scene;
use crate::frame::assembly::Design;
use crate::report::picture::image::{Bed, Item, View, corners, encoded, pixels};

/// Width and height of each of the two views, pixels.
const SIZE: [u32; 2] = [720, 540];
/// Side of the piece of ground, mm.
const GROUND_MM: f64 = 400.0;

/// The frame at first touch, from the side and from a raised corner, on a grid of 10 mm; the bytes of a PNG file.
///
/// The slopes, rad, are those along the first foot's diagonal, whose foot at the front right is the lower one, and along the other
/// diagonal. Turns about both are small and taken one after the other.
pub fn png(design: &Design, slopes_rad: [f64; 2]) -> Vec<u8> {
    let laid = scene::laid(design);
    let items = scene::assembled(design, &laid);
    // The foot at +x +y goes down when the frame turns about the horizontal axis across its diagonal.
    let across = |x: f64, y: f64| Unit::new_normalize(Vector3::new(x, y, 0.0));
    let turn = UnitQuaternion::from_axis_angle(&across(-1.0, 1.0), slopes_rad[0])
        * UnitQuaternion::from_axis_angle(&across(1.0, 1.0), slopes_rad[1]);
    let turned: Vec<Item> =
        items.iter().map(|item| Item { pose: Isometry3::from_parts(Translation3::identity(), turn) * item.pose, ..*item }).collect();
    let lowest_mm = corners(&turned).iter().map(|point| point.z).fold(f64::INFINITY, f64::min);
    let onto = Isometry3::translation(0.5 * GROUND_MM, 0.5 * GROUND_MM, -lowest_mm);
    let landed: Vec<Item> = turned.iter().map(|item| Item { pose: onto * item.pose, ..*item }).collect();
    let ground = Bed { low_mm: [0.0; 2], size_mm: [GROUND_MM; 2], round: false };
    let [side, raised] = [View::Front, View::Perspective].map(|view| pixels(&landed, &[ground], view, SIZE));
    let row = 3 * SIZE[0] as usize;
    let both: Vec<u8> = side.chunks_exact(row).zip(raised.chunks_exact(row)).flat_map(|(a, b)| [a, b].concat()).collect();
    encoded(&both, 2 * SIZE[0], SIZE[1])
}
