//! What of the assembly is not printed: rods, motors with their screws, the discs that propellers sweep, and what is bought for the centre.

use std::sync::Arc;

use nalgebra::Isometry3;
use serde::{Deserialize, Serialize};

use super::body::{BodyKind, Shape};
use super::centre_body::CentreBody;
use super::screw_solids::motor_screws;
use crate::frame::skeleton::{Centre, MODULE_NAMES, RodRole, Skeleton, placement};
use crate::memo::Memo;
use crate::params::Frame;
use crate::params::catalogue::BoughtPart;
use crate::solid::{Brep, Feature, Mesh, MeshSolid};

/// Where a body is: its name, its module and its pose.
pub(super) type Place = (String, Option<usize>, Isometry3<f64>);

/// A shape that is not printed, before it is made.
pub(super) struct NotPrinted {
    name: String,
    kind: BodyKind,
    material: String,
    colour: [f32; 4],
    feature: Feature,
    /// Its bodies.
    pub(super) places: Vec<Place>,
}

/// What is made of it.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Plain {
    solid: MeshSolid,
    mesh: Arc<Mesh>,
    exact_mm3: Option<f64>,
}

impl NotPrinted {
    /// Everything that a frame has of it: rods, what the motors carry, then the centre.
    pub(super) fn all(frame: &Frame, skeleton: &Skeleton, centre: &Centre) -> Vec<Self> {
        let rods = skeleton.roles().into_iter().map(|role| rods(frame, skeleton, role));
        let bought = CentreBody::ALL.into_iter().filter_map(|part| bought(frame, centre, part));
        rods.chain(motors(frame, skeleton)).chain(bought).collect()
    }

    /// Makes it, unless it was made before.
    pub(super) fn made(&self, memo: &Memo) -> Arc<Plain> {
        memo.get("plain shape", &self.name, &self.feature, || Plain::of(&self.feature))
    }

    /// The shape, with what was made of it, and its bodies' places.
    pub(super) fn shape(self, made: &Plain) -> (Shape, Vec<Place>) {
        let Self { name, kind, material, colour, feature, places } = self;
        let Plain { solid, mesh, exact_mm3 } = made.clone();
        (Shape { name, kind, material, colour, solid, mesh, feature: Some(feature), exact_mm3 }, places)
    }
}

impl Plain {
    fn of(feature: &Feature) -> Self {
        let solid = MeshSolid::build(feature).simplified().reimported();
        let exact_mm3 = Brep::build(feature).map(|brep| brep.volume_mm3());
        Self { mesh: Arc::new(solid.mesh()), solid, exact_mm3 }
    }
}

/// The rods of a role.
fn rods(frame: &Frame, skeleton: &Skeleton, role: RodRole) -> NotPrinted {
    let places = skeleton.rods_of(role).map(|rod| (rod.name.clone(), Some(rod.sockets[0].module), rod.pose()));
    NotPrinted {
        name: format!("{}_rod", role.slug()),
        kind: BodyKind::Rod(role),
        material: frame.rod_material.name.clone(),
        colour: frame.rod_material.material.colour,
        feature: rod_solid(frame, skeleton.length_mm(role)),
        places: places.collect(),
    }
}

/// Motors on their mounts, the discs that their propellers sweep, and their screws.
fn motors(frame: &Frame, skeleton: &Skeleton) -> Vec<NotPrinted> {
    let [motor, propeller, screw] = ["motor", "propeller", "motor_screw"].map(|role| frame.bought.get(role));
    let mount = &frame.motor_mount;
    let on_axes = |name: &str, above_seat_mm: f64| -> Vec<Place> {
        let seats = MODULE_NAMES.iter().enumerate().filter_map(|(module, quadrant)| {
            let seat = skeleton.node(&format!("M_{quadrant}"))?;
            let pose = Isometry3::translation(seat.x, seat.y, seat.z + above_seat_mm);
            Some((format!("{name}_{quadrant}"), Some(module), pose))
        });
        seats.collect()
    };
    let motors = motor.map(|motor| {
        let through_mm = propeller.map_or(0.0, |propeller| mount.propeller_height_mm + 0.5 * propeller.part.hub_mm());
        NotPrinted {
            name: "motor".into(),
            kind: BodyKind::Motor,
            material: motor.name.clone(),
            colour: [0.12, 0.12, 0.13, 1.0],
            feature: motor_solid(&motor.part, through_mm),
            places: on_axes("motor", 0.0),
        }
    });
    let discs = propeller.map(|propeller| {
        let height_mm = propeller.part.hub_mm();
        NotPrinted {
            name: "propeller".into(),
            kind: BodyKind::Propeller,
            material: propeller.name.clone(),
            colour: [0.9, 0.62, 0.05, 0.35],
            feature: Feature::cylinder(0.5 * mount.propeller_diameter_mm, height_mm),
            places: on_axes("propeller", mount.propeller_height_mm - 0.5 * height_mm),
        }
    });
    let screws = screw.and_then(|screw| {
        let first = placement::motor_mount(frame, &skeleton.closure);
        let place = |(module, quadrant): (usize, &&str)| {
            (format!("motor_screw_{quadrant}"), Some(module), skeleton.closure.places.pose(module, &first))
        };
        Some(NotPrinted {
            name: "motor_screw".into(),
            kind: BodyKind::Bought("motor_screw"),
            material: screw.name.clone(),
            colour: STEEL,
            feature: motor_screws(&screw.part, frame)?,
            places: MODULE_NAMES.iter().enumerate().map(place).collect(),
        })
    });
    [motors, discs, screws].into_iter().flatten().collect()
}

/// What is bought for a place in the centre; none of what the frame has not.
fn bought(frame: &Frame, centre: &Centre, part: CentreBody) -> Option<NotPrinted> {
    Some(NotPrinted {
        name: part.slug().into(),
        kind: BodyKind::Bought(part.slug()),
        feature: part.feature(frame, centre)?,
        material: frame.bought.get(part.role())?.name.clone(),
        colour: colour(part),
        places: vec![(part.slug().into(), None, Isometry3::identity())],
    })
}

/// Linear colour of steel: red, green, blue, alpha.
const STEEL: [f32; 4] = [0.35, 0.35, 0.37, 1.0];

/// A motor's body, on its shaft where that is catalogued. The shaft reaches this far above the seat, mm: through its propeller.
fn motor_solid(part: &BoughtPart, through_mm: f64) -> Feature {
    let height = part.motor_height_mm();
    let body = Feature::cylinder(0.5 * part.body_diameter_mm.unwrap_or(part.size_mm[0]), height);
    match part.shaft_diameter_mm.filter(|_| through_mm > height) {
        Some(shaft) => Feature::union([body, Feature::cylinder(0.5 * shaft, through_mm - 0.5 * height).at(0.0, 0.0, 0.5 * height)]),
        None => body,
    }
}

/// A rod along z, hollow where it is catalogued as a tube.
fn rod_solid(frame: &Frame, length_mm: f64) -> Feature {
    let rod = Feature::cylinder(0.5 * frame.rods.rod_diameter_mm, length_mm);
    match frame.rod_bore_mm() {
        bore if bore > 0.0 => rod.minus([Feature::bore(0.5 * bore, length_mm + 2.0).at(0.0, 0.0, -1.0)]),
        _ => rod,
    }
}

/// Linear colour of a bought part in the centre.
fn colour(part: CentreBody) -> [f32; 4] {
    match part {
        CentreBody::Battery => [0.35, 0.36, 0.45, 1.0],
        CentreBody::Computer => [0.01, 0.25, 0.06, 1.0],
        CentreBody::FlightController => [0.05, 0.06, 0.1, 1.0],
        CentreBody::MotorController => [0.1, 0.05, 0.12, 1.0],
        CentreBody::ConnectorBracket | CentreBody::ConnectorLid => [0.85, 0.6, 0.02, 1.0],
        CentreBody::MagnetBracket | CentreBody::MagnetLid => [0.5, 0.5, 0.52, 1.0],
        CentreBody::FlowSensor => [0.01, 0.08, 0.35, 1.0],
        CentreBody::Camera => [0.01, 0.22, 0.05, 1.0],
        CentreBody::StackScrews | CentreBody::StackNuts => STEEL,
        CentreBody::SpacersUnderHub | CentreBody::SpacersBetweenBoards => [0.8, 0.8, 0.75, 1.0],
        CentreBody::Dampers => [0.45, 0.03, 0.03, 1.0],
        CentreBody::Ties => [0.02, 0.02, 0.02, 1.0],
        CentreBody::Receiver => [0.02, 0.05, 0.2, 1.0],
        CentreBody::Buzzer => [0.03, 0.03, 0.03, 1.0],
        CentreBody::Gps => [0.45, 0.36, 0.2, 1.0],
        CentreBody::FpvCamera => [0.25, 0.02, 0.02, 1.0],
    }
}
