//! A frame, designed: skeleton, printed parts, and the bodies of the assembly.

use std::convert::Infallible;
use std::ops::ControlFlow;
use std::sync::Arc;

use rayon::prelude::*;

use super::body::{Body, BodyKind, Shape};
use super::not_printed::{NotPrinted, Plain};
use super::printed::{Printed, Recipe};
use crate::frame::parts::{MaterialClass, PrintedPart, catalogue, record};
use crate::frame::skeleton::Centre;
use crate::frame::skeleton::{BELOW_MM, ClosureError, Envelope, MODULE_NAMES, Skeleton, lengths_for};
use crate::memo::{Memo, Progress, Step};
use crate::params::frame::{NamedMaterial, TargetSize};
use crate::params::{BrokenRelation, Frame, PartName, lengths_hold};
use crate::solid::MeshSolid;
use crate::solid::gate::GateError;
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
    /// Lengths that give the wanted size leave no room for something.
    #[error(transparent)]
    Relation(#[from] BrokenRelation),
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
        let bodies = self.bodies.iter().filter(|body| body.module.is_some() && self.shape(body).kind != BodyKind::Propeller);
        let sides = bodies.map(|body| self.shape(body).solid.bounds_in_mm(&body.pose)).map(|[low, high]| [low[0], high[0]]);
        let [low, high] = sides.fold([0.0_f64; 2], |all, side| [all[0].min(side[0]), all[1].max(side[1])]);
        high - low
    }

    /// The shape of a body.
    pub fn shape(&self, body: &Body) -> &Shape {
        &self.shapes[body.shape]
    }

    /// Height of the ground under the standing frame: the lowest point of the lower corners in frame axes, mm; none without any.
    pub fn ground_mm(&self) -> Option<f64> {
        let corners = self.bodies.iter().filter(|body| self.shape(body).kind == BodyKind::Printed(PartName::BottomCorner));
        corners.map(|body| self.shape(body).solid.bounds_in_mm(&body.pose)[0][2]).reduce(f64::min)
    }

    /// A body's solid where it sits.
    pub fn placed(&self, body: &Body) -> MeshSolid {
        self.shape(body).solid.placed(&body.pose)
    }

    fn add_shape(&mut self, shape: Shape) -> usize {
        self.shapes.push(shape);
        self.shapes.len() - 1
    }

    fn place_printed(&mut self) {
        for index in 0..self.printed.len() {
            let part = &self.printed[index];
            let (name, solid, exact_mm3) = (part.name, part.folded.clone(), part.exact_volume_mm3);
            let material = self.material_of(name);
            let (material, colour) = (material.name.clone(), material.material.colour);
            let mesh = self.memo.get("mesh", name.slug(), &solid.key(), || solid.mesh());
            let feature = part.bends.is_empty().then(|| part.feature.clone());
            let kind = BodyKind::Printed(name);
            let shape = self.add_shape(Shape { name: name.slug().into(), kind, material, colour, solid, mesh, feature, exact_mm3 });
            for (module, pose) in self.printed[index].part.poses(&self.frame, &self.skeleton.closure, &self.centre) {
                let name = module.map_or(name.slug().into(), |module| format!("{name}_{}", MODULE_NAMES[module]));
                self.bodies.push(Body { name, shape, module, pose });
            }
        }
    }

    fn place_others(&mut self, others: Vec<NotPrinted>, made: &[Arc<Plain>]) {
        for (other, made) in others.into_iter().zip(made) {
            let (shape, places) = other.shape(made);
            let shape = self.add_shape(shape);
            self.bodies.extend(places.into_iter().map(|(name, module, pose)| Body { name, shape, module, pose }));
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
        // A target size may take the parts of two frames.
        let of = recipes.len() * if frame.target.is_some() { 2 } else { 1 };
        let make = |(part, recipe): (&'static PrintedPart, Recipe)| match (self.begins)(Step { name: part.name.slug(), of }) {
            ControlFlow::Break(ended) => Ok(ControlFlow::Break(ended)),
            ControlFlow::Continue(()) => Printed::by(part, recipe, self.memo)
                .map(ControlFlow::Continue)
                .map_err(|error| DesignError::Part { part: part.name, error }),
        };
        let others = NotPrinted::all(&frame, &skeleton, &centre);
        // Of several parts that cannot be made the first is named, whichever was tried first.
        let (made, made_others) = rayon::join(
            || recipes.into_par_iter().with_max_len(1).map(make).collect::<Vec<_>>(),
            || others.par_iter().with_max_len(1).map(|other| other.made(self.memo)).collect::<Vec<_>>(),
        );
        let mut printed = Vec::new();
        for part in made.into_iter().collect::<Result<Vec<_>, _>>()? {
            match part {
                ControlFlow::Continue(part) => printed.push(part),
                ControlFlow::Break(ended) => return Ok(ControlFlow::Break(ended)),
            }
        }
        let mut design = Design { frame, skeleton, centre, printed, shapes: Vec::new(), bodies: Vec::new(), memo: self.memo.clone() };
        design.place_printed();
        design.place_others(others, &made_others);
        Ok(ControlFlow::Continue(design))
    }
}

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
    Ok(lengths_hold(frame)?)
}
