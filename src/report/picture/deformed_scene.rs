//! Pictures of a frame that is bent: pressed down, in a mode, in an impact.

use nalgebra::{Isometry3, Point3};

use crate::frame::assembly::Design;
use crate::mechanics::result::deformed::DeformedBody;
use crate::report::picture::image::{self as picture, Item, View, corners, seen};
use crate::solid::{Feature, Mesh, MeshSolid};

/// Width and height, pixels.
const SIZE: [u32; 2] = [1024, 768];
/// How far the ground reaches beyond the frame, as a share of it, and how thick it is drawn, mm.
const BEYOND: f64 = 0.04;
const THICK_MM: f64 = 1.0;
/// Linear colour of the ground.
const GROUND: [f32; 4] = [0.35, 0.35, 0.35, 1.0];

/// A picture of bent bodies, in the colours of the design.
pub fn picture(design: &Design, bodies: &[DeformedBody], view: View) -> Vec<u8> {
    picture::png(&items(design, bodies), view, SIZE[0], SIZE[1])
}

/// Pictures of one frame bent in several ways on the ground, all by one camera: what moves in them has moved. The ground is where the lowest point
/// of the first is, and in sight from the side.
pub fn pictures_on_ground(design: &Design, shapes: &[Vec<DeformedBody>], view: View) -> Vec<Vec<u8>> {
    let all: Vec<Point3<f64>> = shapes.iter().flat_map(|bodies| corners(&items(design, bodies))).collect();
    let Some(ground) = shapes.first().and_then(|first| ground(&corners(&items(design, first)), &all)) else { return Vec::new() };
    let drawn = |bodies: &Vec<DeformedBody>| {
        let mut items = items(design, bodies);
        items.push(Item { mesh: &ground, pose: Isometry3::identity(), colour: GROUND });
        picture::encoded(&seen(&items, &[], &all, view, SIZE).0, SIZE[0], SIZE[1])
    };
    shapes.iter().map(drawn).collect()
}

fn items<'a>(design: &Design, bodies: &'a [DeformedBody]) -> Vec<Item<'a>> {
    let colour = |bent: &DeformedBody| design.shape(&design.bodies[bent.body]).colour;
    bodies.iter().map(|bent| Item { mesh: &bent.mesh, pose: Isometry3::identity(), colour: colour(bent) }).collect()
}

/// A plate under all points, its top at the lowest of the first ones; none without points.
fn ground(first: &[Point3<f64>], all: &[Point3<f64>]) -> Option<Mesh> {
    let top_mm = first.iter().map(|point| point.z).reduce(f64::min)?;
    let reach = |axis: usize| {
        let ends = all.iter().map(|point| point[axis]);
        let [low, high] = [ends.clone().fold(f64::INFINITY, f64::min), ends.fold(f64::NEG_INFINITY, f64::max)];
        let more = BEYOND * (high - low);
        [low - more, high + more]
    };
    let [[x0, x1], [y0, y1]] = [reach(0), reach(1)];
    Some(MeshSolid::build(&Feature::cuboid_between([x0, y0, top_mm - THICK_MM], [x1, y1, top_mm])).to_mesh())
}
