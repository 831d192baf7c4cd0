//! A mount as a picture: what comes, off its place, with an arrow to it.
//!
//! What comes from below is shown turned over, what comes from the rear or from the right turned around, so that the place it goes to is seen.

use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};

use super::arrow::Arrow;
use super::camera::{Camera, View};
use super::fold_scene::{ARROW_PLACES, COLOUR_WORDS, COLOURS, Picture, Shown, draw, items};
use super::image::corners;
use super::propeller_scene;
use crate::frame::assembly::wire::Wire;
use crate::frame::assembly::wires::{lead_ends, leads_out, wires};
use crate::frame::assembly::{Body, BodyKind, Design};
use crate::frame::mounting::{Fixing, MountStep, PartLine, RADIO};
use crate::solid::{Feature, MeshSolid};

/// Width and height, pixels.
const SIZE: [u32; 2] = [960, 640];
/// Share of the way along which the arrow lies.
const ARROW: [f64; 2] = [0.15, 0.85];

/// How the assembly is held in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// As it flies, seen from the front left and above.
    Upright,
    /// Upside down, its front still to the lower left.
    TurnedOver,
    /// Seen from the rear right and above.
    TurnedAround,
    /// Seen from above, the front up.
    FromAbove,
}

impl Held {
    /// How it is held for what comes from somewhere.
    pub fn of(step: &MountStep) -> Self {
        match step.from {
            None if step.fixing == Fixing::Solder => Self::TurnedOver,
            _ if step.fixing == Fixing::Shaft => Self::FromAbove,
            Some([_, _, z]) if z < -0.5 => Self::TurnedOver,
            Some([x, y, _]) if y < -0.5 || x > 0.5 => Self::TurnedAround,
            _ => Self::Upright,
        }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Upright => "Seen from the front left and above.",
            Self::TurnedOver => "Turned over, the underside up: seen from the front right and below.",
            Self::TurnedAround => "Seen from the rear right and above.",
            Self::FromAbove => "Seen from above: the front is up.",
        }
    }

    fn turn(self) -> UnitQuaternion<f64> {
        match self {
            Self::Upright | Self::FromAbove => UnitQuaternion::identity(),
            Self::TurnedOver => UnitQuaternion::from_axis_angle(&Vector3::y_axis(), std::f64::consts::PI),
            Self::TurnedAround => UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::PI),
        }
    }
}

/// Width and height of the picture of a part beside a step, pixels.
const PART_SIZE: [u32; 2] = [320, 240];

/// The part that a line of parts is about, alone; a printed one as it lies on the bed.
pub fn part(design: &Design, line: &PartLine) -> Option<Picture> {
    let printed = design.printed.iter().find(|part| part.name.slug() == line.part).map(|part| part.mesh.clone());
    let named = || design.bodies.iter().find(|body| line.body.as_ref() == Some(&body.name));
    let alone = |mesh, colour| Shown { mesh, pose: Isometry3::identity(), colour };
    let shown = match (printed, named()) {
        (None, Some(body)) if design.shape(body).kind == BodyKind::Propeller => {
            propeller_scene::blades_of(design, body.module?).map(|(mesh, colour)| alone(mesh.into(), colour)).into()
        }
        (printed, body) => vec![alone(printed.or_else(|| body.map(|body| design.shape(body).mesh.clone()))?, COLOURS[1])],
    };
    let camera = Camera::fit(View::Perspective, false, &corners(&items(&shown)), PART_SIZE);
    Some(draw(&shown, &[], &camera, PART_SIZE))
}

/// Length, width and height that a receiver without a body is drawn with, mm: those of the catalogue's own.
const RECEIVER_MM: [f64; 3] = [18.0, 12.0, 4.0];
/// How far above its place it is drawn, mm.
const RECEIVER_OFF_MM: f64 = 25.0;

/// A receiver above its place in the middle of the hub's plate, and the arrow to that.
fn receiver(design: &Design) -> (Shown, Arrow) {
    let ([long, wide, high], base_mm) = (RECEIVER_MM, design.centre.plate_top_mm);
    let body = Feature::cuboid_between([-0.5 * wide, -0.5 * long, base_mm], [0.5 * wide, 0.5 * long, base_mm + high]);
    let at = |share: f64| Point3::new(0.0, 0.0, base_mm + RECEIVER_OFF_MM * (1.0 - share));
    let place = |i: usize| at(ARROW[0] + (ARROW[1] - ARROW[0]) * i as f64 / ARROW_PLACES as f64);
    let pose = Translation3::new(0.0, 0.0, RECEIVER_OFF_MM).into();
    let shown = Shown { mesh: Arc::new(MeshSolid::build(&body).mesh()), pose, colour: COLOURS[0] };
    (shown, Arrow { way: (0..=ARROW_PLACES).map(place).collect() })
}

/// What a caption says beside how the picture is held: the colours of the cables and wires, in words, and as what a thing without a body is drawn.
pub fn key(design: &Design, step: &MountStep) -> String {
    let [long, wide, high] = RECEIVER_MM;
    let of_receiver =
        if step.mount == RADIO { format!(" The receiver is drawn as one of {long} x {wide} x {high} mm.") } else { String::new() };
    format!("{}{of_receiver}", colours(design, step))
}

/// The colours of the cables and wires in the picture of a step, in words; nothing where there are none.
fn colours(design: &Design, step: &MountStep) -> String {
    let mut told: Vec<String> = Vec::new();
    for wire in laid(design, step, Vector3::zeros()) {
        let (name, word) = (wire.role.replace('_', " "), wire.colour_word);
        match told.iter_mut().find(|line| line.starts_with(&name)) {
            Some(line) if line.ends_with(word) => (),
            Some(line) => *line += &format!(" and {word}"),
            None => told.push(format!("{name}: {word}")),
        }
    }
    if told.is_empty() { String::new() } else { format!(" Colours: {}.", told.join("; ")) }
}

/// The wires that a step is about, as they run while its parts are off their place: those of a connector end where it is then.
fn laid(design: &Design, step: &MountStep, off: Vector3<f64>) -> Vec<Wire> {
    let of = |role: &str| wires(design).into_iter().filter(|wire| wire.role == role).collect::<Vec<_>>();
    let mut found = match step.mount {
        "wiring" => {
            let shown = |wire| Wire { colour: COLOURS[0], colour_word: COLOUR_WORDS[0][0], ..wire };
            of("motor_wire").into_iter().map(shown).collect()
        }
        "bracket" => of("battery_wire"),
        "bracket_alone" => leads_out(design),
        "connector_in_bracket" => lead_ends(design, "connector_bracket"),
        "connector_in_lid" => lead_ends(design, "connector_lid"),
        _ => Vec::new(),
    };
    for wire in found.iter_mut().filter(|wire| wire.role == "battery_wire") {
        wire.way.iter_mut().take(wire.begins).for_each(|point| *point += off);
    }
    found.extend(wires(design).into_iter().filter_map(|cable| drawn_out(cable, step, off)));
    found
}

/// A cable whose ends a step brings together, from where its moving end is then; none of others.
fn drawn_out(mut cable: Wire, step: &MountStep, off: Vector3<f64>) -> Option<Wire> {
    let end = step.joined_end(cable.joins?)?;
    let moved = if end == 0 { 0..cable.begins } else { cable.begins..cable.way.len() };
    cable.way[moved].iter_mut().for_each(|point| *point += off);
    Some(cable)
}

/// The picture of a mount; of the propellers it says which way each turns.
pub fn mount(design: &Design, step: &MountStep) -> Picture {
    if step.fixing == Fixing::Shaft {
        return propeller_scene::rotations(design, &step.taken_out);
    }
    let (held, off) = (Held::of(step).turn(), step.shown_off_mm());
    let pose = |body: &Body, off: Vector3<f64>| Isometry3::from_parts(Translation3::identity(), held) * Translation3::from(off) * body.pose;
    let named = |name: &String| design.bodies.iter().find(|body| body.name == *name);
    let shown = |body: &Body, off: Vector3<f64>, colour: usize| Shown {
        mesh: design.shape(body).mesh.clone(),
        pose: pose(body, off),
        colour: COLOURS[colour],
    };
    let mut all = Vec::new();
    for body in step.there.iter().filter_map(named) {
        all.push(shown(body, Vector3::zeros(), if body.name == step.onto { 1 } else { 2 }));
    }
    let mut arrows = Vec::new();
    for body in step.moves.iter().filter_map(named) {
        let brought = step.brings.contains(&body.name);
        all.push(shown(body, off, if brought { 0 } else { 2 }));
        if brought && step.from.is_some() {
            let [low, high] = design.shape(body).mesh.bounds_mm();
            let middle = Point3::from((Vector3::from(low) + Vector3::from(high)) * 0.5);
            let at = |share: f64| held * (Translation3::from(off * (1.0 - share)) * body.pose * middle);
            let place = |i: usize| ARROW[0] + (ARROW[1] - ARROW[0]) * i as f64 / ARROW_PLACES as f64;
            arrows.push((Arrow { way: (0..=ARROW_PLACES).map(|i| at(place(i))).collect() }, String::new()));
        }
    }
    if step.mount == RADIO {
        let (shown, arrow) = receiver(design);
        all.push(shown);
        arrows.push((arrow, String::new()));
    }
    let turned = Isometry3::from_parts(Translation3::identity(), held);
    all.extend(laid(design, step, off).into_iter().map(|wire| Shown { mesh: wire.mesh().into(), pose: turned, colour: wire.colour }));
    let camera = Camera::fit(View::Perspective, false, &corners(&items(&all)), SIZE);
    draw(&all, &arrows, &camera, SIZE)
}
