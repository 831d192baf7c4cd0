//! The record of a printed part: everything that is needed to make, place, weigh, fold and print it, beside its shape. Its beam model is
//! in `mechanics/parts`.

use nalgebra::{Isometry3, UnitQuaternion};

use crate::frame::skeleton::{Centre, Closure, MODULE_NAMES};
use crate::params::{Frame, PartName};
use crate::solid::{Bend, Feature};

/// A printed part.
pub struct PrintedPart {
    /// Its name; parameters that drive it name it by this.
    pub name: PartName,
    /// Its shape as printed, in its own axes.
    pub feature: fn(&Frame, &Closure, &Centre) -> Feature,
    /// What it is printed of.
    pub material: MaterialClass,
    /// Where it sits, and how many there are.
    pub seat: Seat,
    /// What becomes of it when the frame is folded.
    pub fold: Fold,
    /// The turn that lays it on the bed.
    pub print_turn: fn() -> UnitQuaternion<f64>,
    /// Whether a frame has a use for it.
    pub needed: fn(&Frame) -> bool,
    /// Its walls: the first that is at a place has the keys for it.
    pub walls: &'static [Wall],
}

/// Walls of a part, and what makes them thicker.
#[derive(Debug)]
pub struct Wall {
    /// Keys, three at the most.
    pub keys: &'static [&'static str],
    /// Whether they are at a place.
    pub is_at: fn(&Frame, &Centre, &WallPlace) -> bool,
}

/// Where a wall was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallPlace {
    /// A point of one of its faces, in the part's own axes, mm.
    pub at_mm: [f64; 3],
    /// How thick it is, mm.
    pub thick_mm: f64,
}

impl Wall {
    /// Walls that are at every place of a part.
    pub const fn anywhere(keys: &'static [&'static str]) -> Self {
        Self { keys, is_at: |_, _, _| true }
    }
}

/// Which of a frame's two materials a part is printed of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaterialClass {
    /// `materials.flexible`: it is part of the structure that deforms.
    Flexible,
    /// `materials.rigid`.
    Rigid,
}

/// Where a part sits: poses from its own axes to the frame's, all of them worked out by the skeleton.
#[derive(Clone, Copy)]
pub enum Seat {
    /// One in each module; the pose is that in a module's axes.
    Modules(fn(&Frame, &Closure) -> Isometry3<f64>),
    /// One in the rigid centre.
    Centre(fn(&Centre) -> Isometry3<f64>),
}

/// What becomes of a part when the frame is folded.
#[derive(Clone, Copy)]
pub enum Fold {
    /// It moves with its module and bends at its hinges, the first of them first.
    Bends(fn(&Frame, &Closure) -> Vec<Bend>),
    /// It moves with its module and keeps its shape.
    Moves,
    /// It is the hub, or stands still with it.
    Stands,
}

impl PrintedPart {
    /// How many a frame has.
    pub fn quantity(&self) -> u32 {
        match self.seat {
            Seat::Modules(_) => MODULE_NAMES.len() as u32,
            Seat::Centre(_) => 1,
        }
    }

    /// Whether it is printed of the flexible material.
    pub fn is_flexible(&self) -> bool {
        self.material == MaterialClass::Flexible
    }

    /// What makes its wall at a place thicker.
    pub fn wall_keys(&self, frame: &Frame, centre: &Centre, place: &WallPlace) -> &'static [&'static str] {
        self.walls.iter().find(|wall| (wall.is_at)(frame, centre, place)).map_or(&[], |wall| wall.keys)
    }

    /// How it bends when the frame is folded.
    pub fn bends(&self, frame: &Frame, closure: &Closure) -> Vec<Bend> {
        match self.fold {
            Fold::Bends(bends) => bends(frame, closure),
            Fold::Moves | Fold::Stands => Vec::new(),
        }
    }

    /// Where each copy sits, with its module; none in the centre.
    pub fn poses(&self, frame: &Frame, closure: &Closure, centre: &Centre) -> Vec<(Option<usize>, Isometry3<f64>)> {
        match self.seat {
            Seat::Modules(pose) => {
                let first = pose(frame, closure);
                (0..MODULE_NAMES.len()).map(|module| (Some(module), closure.places.pose(module, &first))).collect()
            }
            Seat::Centre(pose) => vec![(None, pose(centre))],
        }
    }
}

/// A part that every frame needs.
pub(super) fn always(_: &Frame) -> bool {
    true
}
