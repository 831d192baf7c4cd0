//! Which way each propeller turns: the frame from above, its front up, on each motor its blades and an arrow around them.
//!
//! Of the two directions one is dark and one is less dark, as [`key`] says; the edge of a blade that goes first, which is the raised one, is white.

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};

use super::arrow::Arrow;
use super::blades::propeller;
use super::camera::{Camera, View};
use super::fold_scene::{ARROW_PLACES, COLOUR_WORDS, COLOURS, Picture, Shown, colour_words, draw, items};
use super::image::corners;
use crate::frame::assembly::{BodyKind, Design};
use crate::frame::skeleton::{MODULE_NAMES, ROTORS, Spin};
use crate::solid::Mesh;

/// Width and height, pixels.
const SIZE: [u32; 2] = [960, 640];
/// Radius of an arrow over that of the propeller.
const RADIUS: f64 = 1.06;
/// How far around an arrow goes, radians.
const AROUND: f64 = 4.4;

/// Which of the colours the motors have.
const MOTOR: usize = 0;
/// Linear colour of the edge of a blade that goes first: black, on paper and on grey parts, however it is lit.
const FIRST_EDGE: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

/// The propeller of a module, its middle in the origin: blades, and the edges that go first, with their colours.
pub(super) fn blades_of(design: &Design, module: usize) -> [(Mesh, [f32; 4]); 2] {
    let spin = ROTORS[module].spin;
    let [blades, edges] = propeller(design.frame.motor_mount.propeller_diameter_mm, spin);
    [(blades, COLOURS[colour_of(spin)]), (edges, FIRST_EDGE)]
}

/// Which of the colours the blades of a direction have.
fn colour_of(spin: Spin) -> usize {
    match spin {
        Spin::Clockwise => 0,
        Spin::CounterClockwise => 1,
    }
}

/// What the colours of the blades mean.
pub fn key() -> String {
    let blades = |spin: Spin| format!("in {} turn {}", colour_words(colour_of(spin)), spin.words());
    format!(
        "Blades {}, {}. Their raised edge, in black, goes first. The motors are {}, too.",
        blades(Spin::Clockwise),
        blades(Spin::CounterClockwise),
        COLOUR_WORDS[MOTOR][0]
    )
}

/// The picture, without what is out of the frame.
pub fn rotations(design: &Design, taken_out: &[String]) -> Picture {
    let mut shown = Vec::new();
    for body in design.bodies.iter().filter(|body| !taken_out.contains(&body.name)) {
        let shape = design.shape(body);
        let colour = match shape.kind {
            BodyKind::Propeller => continue,
            BodyKind::Motor => COLOURS[MOTOR],
            _ => COLOURS[2],
        };
        shown.push(Shown { mesh: shape.mesh.clone(), pose: body.pose, colour });
    }
    let mount = &design.frame.motor_mount;
    let radius = RADIUS * 0.5 * mount.propeller_diameter_mm;
    let mut arrows = Vec::new();
    for (module, name) in MODULE_NAMES.iter().enumerate() {
        let Some(seat) = design.skeleton.node(&format!("M_{name}")) else { continue };
        let turns = ROTORS[module].spin;
        // Each blade lies across the way from the hub: it hides least of the frame.
        let across = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), libm::atan2(seat.y, seat.x) + std::f64::consts::FRAC_PI_2);
        let pose = Isometry3::from_parts(Translation3::new(seat.x, seat.y, seat.z + mount.propeller_height_mm), across);
        for (mesh, colour) in blades_of(design, module) {
            shown.push(Shown { mesh: mesh.into(), pose, colour });
        }
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
