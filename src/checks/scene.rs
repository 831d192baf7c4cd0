//! The assembly as the rules see it: every body in its place, with its box.

use nalgebra::Isometry3;
use rayon::prelude::*;

use super::bounds::Bounds;
use crate::assembly::mass::MassTable;
use crate::assembly::{Body, Design, Kind, Shape};
use crate::params::PartName;
use crate::solid::MeshSolid;

/// A body in its place.
pub(super) struct Placed<'a> {
    pub body: &'a Body,
    pub shape: &'a Shape,
    pub solid: MeshSolid,
    pub bounds: Bounds,
}

impl Placed<'_> {
    /// Moved along y.
    pub fn shifted_y(&self, by_mm: f64) -> MeshSolid {
        self.solid.placed(&Isometry3::translation(0.0, by_mm, 0.0))
    }

    pub fn is_part(&self, name: PartName) -> bool {
        self.shape.kind == Kind::Printed(name)
    }

    pub fn is_propeller(&self) -> bool {
        self.shape.kind == Kind::Propeller
    }

    /// Shortest distance to another body, mm, at most the reach.
    pub fn gap_mm(&self, other: &Placed, reach_mm: f64) -> f64 {
        if self.bounds.distance_mm(&other.bounds) >= reach_mm {
            return reach_mm;
        }
        self.solid.gap_mm(&other.solid, reach_mm)
    }

    /// Volume in common, mm³.
    pub fn shared_mm3(&self, other: &Placed) -> f64 {
        if self.bounds.distance_mm(&other.bounds) > 0.0 {
            return 0.0;
        }
        self.solid.intersection(&other.solid).volume_mm3()
    }
}

/// Everything the rules read.
pub(super) struct Scene<'a> {
    pub design: &'a Design,
    pub masses: &'a MassTable,
    pub placed: Vec<Placed<'a>>,
}

impl<'a> Scene<'a> {
    pub fn new(design: &'a Design, masses: &'a MassTable) -> Self {
        let place = |body: &'a Body| {
            let solid = design.placed(body);
            let [low, high] = solid.bounds_mm();
            Placed { body, shape: design.shape(body), solid, bounds: Bounds { low, high } }
        };
        Self { design, masses, placed: design.bodies.par_iter().map(place).collect() }
    }

    /// A printed part of a module, or of the centre.
    pub fn part(&self, name: PartName, module: Option<usize>) -> Option<&Placed<'a>> {
        self.placed.iter().find(|p| p.is_part(name) && p.body.module == module)
    }

    /// Something bought in the centre.
    pub fn bought(&self, name: &str) -> Option<&Placed<'a>> {
        self.placed.iter().find(|p| matches!(p.shape.kind, Kind::Bought(bought) if bought == name))
    }

    /// Pairs of bodies that stand for all pairs: the four modules are one, turned, so of two modules' bodies one may
    /// be taken from the first; the centre is not symmetric and is paired with everything.
    pub fn pairs(&self) -> Vec<(&Placed<'a>, &Placed<'a>)> {
        let mut pairs = Vec::new();
        for (i, a) in self.placed.iter().enumerate() {
            for b in &self.placed[i + 1..] {
                let modules = [a.body.module, b.body.module];
                if modules.contains(&None) || modules.contains(&Some(0)) {
                    pairs.push((a, b));
                }
            }
        }
        pairs
    }
}

/// The box around bodies.
pub(super) fn bounds_of<'b>(bodies: impl Iterator<Item = &'b Placed<'b>>) -> Option<Bounds> {
    bodies.map(|p| p.bounds).reduce(|a, b| a.around(&b))
}
