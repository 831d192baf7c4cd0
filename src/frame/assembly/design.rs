//! A frame, designed: skeleton, printed parts, and the bodies of the assembly.

use std::convert::Infallible;
use std::ops::ControlFlow;
use std::sync::Arc;

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::body::{Body, Kind, Shape};
use super::bought_solids::BoughtPart;
use super::printed::{Printed, Recipe};
use super::screw_solids::motor_screws;
use crate::frame::parts::{MaterialClass, PrintedPart, catalogue, record};
use crate::frame::skeleton::Centre;
use crate::frame::skeleton::{ClosureError, Envelope, MODULE_NAMES, Skeleton, lengths_for, placement};
use crate::memo::{Memo, Progress, Step};
use crate::params::catalogue::BoughtPart as Entry;
use crate::params::frame::{NamedMaterial, TargetSize};
use crate::params::{Frame, PartName};
use crate::solid::gate::GateError;
use crate::solid::{Brep, Feature, Mesh, MeshSolid};
use crate::units::Angle;

/// Why a frame cannot be designed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DesignError {
    /// The rods do not close.
    #[error(transparent)]
    Closure(#[from] ClosureError),
    /// A part's parameters contradict each other.
    #[error("{part} cannot be made: {}", .error.meaning())]
    Part {
        /// Which.
        part: PartName,
        /// What is wrong with its mesh.
        error: GateError,
    },
    /// The wanted size needs a rod that no rod can be.
    #[error("the target size needs {key} = {value:.2} mm, outside {min} to {max} mm")]
    Target {
        /// Which rod.
        key: &'static str,
        /// Its length.
        value: f64,
        /// Shortest.
        min: f64,
        /// Longest.
        max: f64,
    },
}

/// A frame with everything that follows from it.
pub struct Design {
    /// The parameters; rod lengths are solved when a target size was given.
    pub frame: Frame,
    /// Nodes and rods.
    pub skeleton: Skeleton,
    /// Derived dimensions of the rigid centre.
    pub centre: Centre,
    /// Printed parts, in the order of [`PartName::ALL`]; what would carry nothing is left out.
    pub printed: Vec<Printed>,
    /// Shapes of the assembly.
    pub shapes: Vec<Shape>,
    /// Bodies of the assembly.
    pub bodies: Vec<Body>,
    /// What was computed of this design and of others.
    pub memo: Arc<Memo>,
}

impl Design {
    /// Designs a frame.
    ///
    /// # Errors
    /// When it cannot close or a part cannot be made.
    pub fn new(frame: Frame) -> Result<Self, DesignError> {
        Self::with(frame, &Arc::default())
    }

    /// Designs a frame with what was computed of former ones where it is the same; the result is that of [`Design::new`].
    ///
    /// # Errors
    /// When it cannot close or a part cannot be made.
    pub fn with(frame: Frame, memo: &Arc<Memo>) -> Result<Self, DesignError> {
        memo.changed();
        Self::of_parts(frame, &catalogue(), memo)
    }

    /// A sketch of a frame: its parts are bent as those of a known frame are, and moved to where its own rods put them. What else its numbers say
    /// of a part is made. Where only rods and motors change, no part is: what was computed of the known frame is used. It does not count as a change
    /// of the memo.
    ///
    /// # Errors
    /// When it cannot close or a part cannot be made.
    pub fn sketched(frame: Frame, known: &Skeleton, memo: &Arc<Memo>) -> Result<Self, DesignError> {
        whole(Making { parts: &catalogue(), memo, bent_in: Some(known), begins: &|_| ControlFlow::Continue(()) }.design(frame)?)
    }

    /// Designs a frame of these parts, as far as it has a use for them.
    ///
    /// # Errors
    /// When it cannot close or a part cannot be made.
    pub(super) fn of_parts(frame: Frame, parts: &[&'static PrintedPart], memo: &Arc<Memo>) -> Result<Self, DesignError> {
        whole(Making { parts, memo, bent_in: None, begins: &|_| ControlFlow::Continue(()) }.design(frame)?)
    }

    /// The same with somebody who follows it, part by part; none when that one ended it.
    ///
    /// # Errors
    /// When it cannot close or a part cannot be made.
    pub fn followed(frame: Frame, memo: &Arc<Memo>, progress: &dyn Progress) -> Result<Option<Self>, DesignError> {
        memo.changed();
        Ok(Making { parts: &catalogue(), memo, bent_in: None, begins: &|step| progress.begins(step) }.design(frame)?.continue_value())
    }

    /// A printed part by name.
    pub fn part(&self, name: PartName) -> Option<&Printed> {
        self.printed.iter().find(|part| part.name == name)
    }

    /// What a printed part is made of.
    pub fn material_of(&self, name: PartName) -> &NamedMaterial {
        match self.part(name).map_or_else(|| record(name), |made| made.part).material {
            MaterialClass::Flexible => &self.frame.flexible,
            MaterialClass::Rigid => &self.frame.rigid,
        }
    }

    /// Width of all that the four modules are made of, without what the propellers sweep, mm.
    fn modules_width_mm(&self) -> f64 {
        let bodies = self.bodies.iter().filter(|body| body.module.is_some() && self.shape(body).kind != Kind::Propeller);
        let sides = bodies.map(|body| self.shape(body).solid.bounds_in_mm(&body.pose)).map(|[low, high]| [low[0], high[0]]);
        let [low, high] = sides.fold([0.0_f64; 2], |all, side| [all[0].min(side[0]), all[1].max(side[1])]);
        high - low
    }

    /// The shape of a body.
    pub fn shape(&self, body: &Body) -> &Shape {
        &self.shapes[body.shape]
    }

    /// A body's solid where it sits.
    pub fn placed(&self, body: &Body) -> MeshSolid {
        self.shape(body).solid.placed(&body.pose)
    }

    fn add_shape(&mut self, shape: Shape) -> usize {
        self.shapes.push(shape);
        self.shapes.len() - 1
    }

    /// A shape that is not printed.
    fn add_plain(&mut self, name: &str, kind: Kind, material: &str, colour: [f32; 4], feature: &Feature) -> usize {
        let plain = self.memo.get("plain shape", name, feature, || Plain::of(feature));
        let Plain { solid, mesh, exact_mm3 } = Plain::clone(&plain);
        self.add_shape(Shape {
            name: name.into(),
            kind,
            material: material.into(),
            colour,
            solid,
            mesh,
            feature: Some(feature.clone()),
            exact_mm3,
        })
    }

    fn place_printed(&mut self) {
        for index in 0..self.printed.len() {
            let part = &self.printed[index];
            let (name, solid, exact_mm3) = (part.name, part.folded.clone(), part.exact_volume_mm3);
            let material = self.material_of(name);
            let (material, colour) = (material.name.clone(), material.material.colour);
            let mesh = self.memo.get("mesh", name.slug(), &solid.key(), || solid.mesh());
            let feature = part.bends.is_empty().then(|| part.feature.clone());
            let kind = Kind::Printed(name);
            let shape = self.add_shape(Shape { name: name.slug().into(), kind, material, colour, solid, mesh, feature, exact_mm3 });
            for (module, pose) in self.printed[index].part.poses(&self.frame, &self.skeleton.closure, &self.centre) {
                let name = module.map_or(name.slug().into(), |module| format!("{name}_{}", MODULE_NAMES[module]));
                self.bodies.push(Body { name, shape, module, pose });
            }
        }
    }

    fn place_rods(&mut self) {
        let material = self.frame.rod_material.clone();
        for role in self.skeleton.roles() {
            let length = self.skeleton.length_mm(role);
            let name = format!("{}_rod", role.slug());
            let feature = rod_solid(&self.frame, length);
            let shape = self.add_plain(&name, Kind::Rod(role), &material.name, material.material.colour, &feature);
            let bodies: Vec<Body> = self
                .skeleton
                .rods_of(role)
                .map(|rod| {
                    let turn = UnitQuaternion::rotation_between(&Vector3::z(), &(rod.end - rod.start))
                        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
                    let pose = Isometry3::from_parts(Translation3::from(rod.start.coords), turn);
                    Body { name: rod.name.clone(), shape, module: Some(rod.sockets[0].module), pose }
                })
                .collect();
            self.bodies.extend(bodies);
        }
    }

    /// Motors on their mounts with their screws, and the discs that the propellers sweep.
    fn place_motors(&mut self) {
        let [motor, propeller, screw] = ["motor", "propeller", "motor_screw"].map(|role| self.frame.bought.get(role).cloned());
        let mount = self.frame.motor_mount.clone();
        if let Some(motor) = motor {
            let through_mm = propeller.as_ref().map_or(0.0, |propeller| mount.propeller_height_mm + 0.5 * propeller.part.hub_mm());
            let feature = motor_solid(&motor.part, through_mm);
            let shape = self.add_plain("motor", Kind::Motor, &motor.name, [0.12, 0.12, 0.13, 1.0], &feature);
            self.on_motor_axes("motor", shape, 0.0);
        }
        if let Some(propeller) = propeller {
            let height = propeller.part.hub_mm();
            let feature = Feature::cylinder(0.5 * mount.propeller_diameter_mm, height);
            let shape = self.add_plain("propeller", Kind::Propeller, &propeller.name, [0.9, 0.62, 0.05, 0.35], &feature);
            self.on_motor_axes("propeller", shape, mount.propeller_height_mm - 0.5 * height);
        }
        let Some(screw) = screw else { return };
        if let Some(feature) = motor_screws(&screw.part, &self.frame) {
            let shape = self.add_plain("motor_screw", Kind::Bought("motor_screw"), &screw.name, STEEL, &feature);
            let first = placement::motor_mount(&self.frame, &self.skeleton.closure);
            self.bodies.extend(MODULE_NAMES.iter().enumerate().map(|(module, quadrant)| Body {
                name: format!("motor_screw_{quadrant}"),
                shape,
                module: Some(module),
                pose: self.skeleton.closure.places.pose(module, &first),
            }));
        }
    }

    fn on_motor_axes(&mut self, name: &str, shape: usize, above_seat_mm: f64) {
        for (module, quadrant) in MODULE_NAMES.iter().enumerate() {
            let Some(seat) = self.skeleton.node(&format!("M_{quadrant}")) else { continue };
            let pose = Isometry3::translation(seat.x, seat.y, seat.z + above_seat_mm);
            self.bodies.push(Body { name: format!("{name}_{quadrant}"), shape, module: Some(module), pose });
        }
    }

    fn place_bought(&mut self) {
        for part in BoughtPart::ALL {
            let Some(feature) = part.feature(&self.frame, &self.centre) else { continue };
            let Some(material) = self.frame.bought.get(part.role()).map(|item| item.name.clone()) else { continue };
            let colour = colour(part);
            let shape = self.add_plain(part.slug(), Kind::Bought(part.slug()), &material, colour, &feature);
            self.bodies.push(Body { name: part.slug().into(), shape, module: None, pose: Isometry3::identity() });
        }
    }
}

/// What nobody ended.
fn whole<T, E>(made: ControlFlow<Infallible, T>) -> Result<T, E> {
    match made {
        ControlFlow::Continue(made) => Ok(made),
        ControlFlow::Break(never) => match never {},
    }
}

/// How a design comes about.
struct Making<'a, B> {
    parts: &'a [&'static PrintedPart],
    memo: &'a Arc<Memo>,
    /// The frame as whose parts these are bent; the frame itself when none.
    bent_in: Option<&'a Skeleton>,
    /// Whether it goes on, asked before each part.
    begins: &'a (dyn Fn(Step) -> ControlFlow<B> + Sync),
}

impl<B: Send> Making<'_, B> {
    /// A frame's design, unless it was ended.
    fn design(&self, mut frame: Frame) -> Result<ControlFlow<B, Design>, DesignError> {
        let Some(target) = frame.target else { return self.of_lengths(frame) };
        solve_target(&mut frame, target)?;
        let design = match self.of_lengths(frame.clone())? {
            ControlFlow::Continue(design) => design,
            ended => return Ok(ended),
        };
        let over_mm = design.modules_width_mm() - target.width_mm;
        if over_mm <= 0.0 {
            return Ok(ControlFlow::Continue(design));
        }
        // With steep struts the knees are outermost, not the corners; they move with the rods as the corners do.
        solve_target(&mut frame, TargetSize { width_mm: target.width_mm - over_mm - BELOW_MM, ..target })?;
        self.of_lengths(frame)
    }

    fn of_lengths(&self, frame: Frame) -> Result<ControlFlow<B, Design>, DesignError> {
        let skeleton = Skeleton::new(&frame)?;
        let centre = Centre::new(&frame);
        let (needed, bent_in) = (self.parts.iter().filter(|part| (part.needed)(&frame)), self.bent_in.unwrap_or(&skeleton));
        let recipes: Vec<(&'static PrintedPart, Recipe)> = needed.map(|part| (*part, Recipe::of(part, &frame, bent_in, &centre))).collect();
        let of = recipes.len();
        let make = |(part, recipe): (&'static PrintedPart, Recipe)| match (self.begins)(Step { name: part.name.slug(), of }) {
            ControlFlow::Break(ended) => Ok(ControlFlow::Break(ended)),
            ControlFlow::Continue(()) => Printed::by(part, recipe, self.memo)
                .map(ControlFlow::Continue)
                .map_err(|error| DesignError::Part { part: part.name, error }),
        };
        // Of several parts that cannot be made the first is named, whichever was tried first.
        let made: Vec<Result<ControlFlow<B, Printed>, DesignError>> = recipes.into_par_iter().with_max_len(1).map(make).collect();
        let mut printed = Vec::new();
        for part in made.into_iter().collect::<Result<Vec<_>, _>>()? {
            match part {
                ControlFlow::Continue(part) => printed.push(part),
                ControlFlow::Break(ended) => return Ok(ControlFlow::Break(ended)),
            }
        }
        let mut design = Design { frame, skeleton, centre, printed, shapes: Vec::new(), bodies: Vec::new(), memo: self.memo.clone() };
        design.place_printed();
        design.place_rods();
        design.place_motors();
        design.place_bought();
        Ok(ControlFlow::Continue(design))
    }
}

/// A shape that is not printed, made.
#[derive(Clone, Serialize, Deserialize)]
struct Plain {
    solid: MeshSolid,
    mesh: Arc<Mesh>,
    exact_mm3: Option<f64>,
}

impl Plain {
    fn of(feature: &Feature) -> Self {
        let solid = MeshSolid::build(feature).simplified().reimported();
        let exact_mm3 = Brep::build(feature).map(|brep| brep.volume_mm3());
        Self { mesh: Arc::new(solid.mesh()), solid, exact_mm3 }
    }
}

/// Linear colour of steel: red, green, blue, alpha.
const STEEL: [f32; 4] = [0.35, 0.35, 0.37, 1.0];

/// A motor's body, on its shaft where that is catalogued. The shaft reaches this far above the seat, mm: through its propeller.
fn motor_solid(part: &Entry, through_mm: f64) -> Feature {
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
fn colour(part: BoughtPart) -> [f32; 4] {
    match part {
        BoughtPart::Battery => [0.35, 0.36, 0.45, 1.0],
        BoughtPart::Computer => [0.01, 0.25, 0.06, 1.0],
        BoughtPart::FlightController => [0.05, 0.06, 0.1, 1.0],
        BoughtPart::MotorController => [0.1, 0.05, 0.12, 1.0],
        BoughtPart::ConnectorBracket | BoughtPart::ConnectorLid => [0.85, 0.6, 0.02, 1.0],
        BoughtPart::MagnetBracket | BoughtPart::MagnetLid => [0.5, 0.5, 0.52, 1.0],
        BoughtPart::FlowSensor => [0.01, 0.08, 0.35, 1.0],
        BoughtPart::Camera => [0.01, 0.22, 0.05, 1.0],
        BoughtPart::StackScrews | BoughtPart::StackNuts => STEEL,
        BoughtPart::SpacersUnderHub | BoughtPart::SpacersBetweenBoards => [0.8, 0.8, 0.75, 1.0],
        BoughtPart::Dampers => [0.45, 0.03, 0.03, 1.0],
        BoughtPart::Ties => [0.02, 0.02, 0.02, 1.0],
        BoughtPart::Receiver => [0.02, 0.05, 0.2, 1.0],
        BoughtPart::Buzzer => [0.03, 0.03, 0.03, 1.0],
        BoughtPart::Gps => [0.45, 0.36, 0.2, 1.0],
        BoughtPart::FpvCamera => [0.25, 0.02, 0.02, 1.0],
    }
}

/// The second solution is narrower than wanted by this, mm: meshes have rounded corners, and the size is a limit.
const BELOW_MM: f64 = 0.002;

/// Replaces the rod lengths by those that give the target size.
fn solve_target(frame: &mut Frame, target: TargetSize) -> Result<(), DesignError> {
    let envelope = Envelope { width_mm: target.width_mm, height_mm: target.height_mm, strut_tilt: Angle::deg(target.strut_tilt_deg) };
    let lengths = lengths_for(&envelope, frame);
    for (value, key) in lengths.into_iter().zip(["cage_rod_length_mm", "arm_rod_length_mm", "strut_rod_length_mm"]) {
        let bounds = crate::params::groups::RodParameters::CATALOGUE.iter().find(|p| p.key == key);
        let (min, max) = bounds.map_or((0.0, f64::INFINITY), |p| (p.min, p.max));
        if !(min..=max).contains(&value) {
            return Err(DesignError::Target { key, value, min, max });
        }
    }
    [frame.rods.cage_rod_length_mm, frame.rods.arm_rod_length_mm, frame.rods.strut_rod_length_mm] = lengths;
    Ok(())
}
