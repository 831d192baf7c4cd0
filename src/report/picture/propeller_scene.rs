//! Which way each propeller turns: the frame from above, its front up, an arrow around each motor.

use nalgebra::Point3;

use super::arrow::Arrow;
use super::camera::{Camera, View};
use super::fold_scene::{ARROW_PLACES, COLOURS, Picture, Shown, draw, items};
use super::image::corners;
use crate::frame::assembly::{Design, Kind};
use crate::frame::skeleton::{MODULE_NAMES, ROTORS};

/// Width and height, pixels.
const SIZE: [u32; 2] = [960, 640];
/// Radius of an arrow over that of the propeller.
const RADIUS: f64 = 0.75;
/// How far around an arrow goes, radians.
const AROUND: f64 = 4.4;

/// The picture.
pub fn rotations(design: &Design) -> Picture {
    let mut shown = Vec::new();
    for body in &design.bodies {
        let shape = design.shape(body);
        let colour = match shape.kind {
            Kind::Propeller => continue,
            Kind::Motor => COLOURS[0],
            _ => COLOURS[2],
        };
        shown.push(Shown { mesh: shape.mesh.clone(), pose: body.pose, colour });
    }
    let radius = RADIUS * 0.5 * design.frame.motor_mount.propeller_diameter_mm;
    let mut arrows = Vec::new();
    for (module, name) in MODULE_NAMES.iter().enumerate() {
        let Some(seat) = design.skeleton.node(&format!("M_{name}")) else { continue };
        let turns = ROTORS[module].spin;
        // The label stands beside the arrow, outside of it.
        let begins = libm::atan2(seat.y, seat.x) - turns.sign() * 0.43 * AROUND;
        let way = (0..=2 * ARROW_PLACES).map(|i| {
            let angle = begins + turns.sign() * AROUND * i as f64 / (2 * ARROW_PLACES) as f64;
            Point3::new(seat.x + radius * libm::cos(angle), seat.y + radius * libm::sin(angle), seat.z)
        });
        arrows.push((Arrow { way: way.collect() }, ROTORS[module].number.to_string()));
    }
    let mut points = corners(&items(&shown));
    points.extend(arrows.iter().flat_map(|(arrow, _)| &arrow.way));
    let camera = Camera::fit(View::Top, false, &points, SIZE);
    draw(&shown, &arrows, &camera, SIZE)
}
