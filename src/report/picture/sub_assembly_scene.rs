//! A sub-assembly alone, put together, with the names of its parts.

use super::camera::{Camera, View};
use super::fold_scene::{Picture, Shown, draw, items, words_of};
use super::image::corners;
use super::labels::Labels;
use super::visible::seen_at;
use crate::frame::assembly::{Body, BodyKind, Design};

/// Width and height, pixels.
const SIZE: [u32; 2] = [960, 720];
/// Height of the letters, pixels.
const NAMES: f64 = 20.0;

/// The picture of these bodies; of parts with one name one that is seen is named.
pub fn together(design: &Design, bodies: &[&Body]) -> Picture {
    let shown: Vec<Shown> = bodies
        .iter()
        .map(|body| {
            let shape = design.shape(body);
            Shown { mesh: shape.mesh.clone(), pose: body.pose, colour: shape.colour }
        })
        .collect();
    let camera = Camera::fit(View::Perspective, false, &corners(&items(&shown)), SIZE);
    let mut picture = draw(&shown, &[], &camera, SIZE);
    let points = seen_at(&items(&shown), &camera, SIZE);
    let Some(mut labels) = Labels::on(&mut picture.rgb, SIZE[0]) else { return picture };
    let mut seen: Vec<String> = Vec::new();
    for (body, point) in bodies.iter().zip(points).filter_map(|(body, point)| Some((body, point?))) {
        let shape = design.shape(body);
        let words = words_of(&body.name, body.module, matches!(shape.kind, BodyKind::Rod(_)));
        if !seen.contains(&words) {
            labels.put(&words, NAMES, point);
            seen.push(words);
        }
    }
    picture
}
