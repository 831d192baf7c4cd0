//! The assembly as the rules see it: every body in its place, with its box.

use std::borrow::Cow;

use nalgebra::{Isometry3, Point3};
use rayon::prelude::*;

use super::bounds::Bounds;
use crate::frame::assembly::mass::MassTable;
use crate::frame::assembly::{Body, Design, Kind, Shape};
use crate::params::PartName;
use crate::solid::{Feature, MeshSolid};

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
        self.both_near(other, reach_mm).map_or(reach_mm, |(a, b)| a.gap_mm(&b, reach_mm))
    }

    /// Volume in common, mm³.
    pub fn shared_mm3(&self, other: &Placed) -> f64 {
        self.both_near(other, 0.0).map_or(0.0, |(a, b)| a.intersection(&b).volume_mm3())
    }

    /// Both bodies, as far as they can be within reach of each other, in axes along which long facets lie: the boxes by
    /// which the kernel sorts facets are then small. Distances and volumes are the same in all axes.
    fn both_near(&self, other: &Placed, reach_mm: f64) -> Option<(MeshSolid, MeshSolid)> {
        if self.bounds.distance_mm(&other.bounds) > reach_mm {
            return None;
        }
        let leading = [self, other].into_iter().min_by_key(|p| p.rank()).filter(|p| p.body.module.is_some());
        let axes = leading.map_or_else(Isometry3::identity, |p| p.body.pose.inverse());
        Some((self.near(other, reach_mm)?.placed(&(axes * self.body.pose)), other.near(self, reach_mm)?.placed(&(axes * other.body.pose))))
    }

    /// Whose axes two bodies are compared in: the smaller's.
    fn rank(&self) -> u8 {
        match (&self.shape.kind, self.body.module) {
            (Kind::Rod(_), _) => 0,
            (Kind::Printed(_), Some(_)) => 1,
            _ => 2,
        }
    }

    /// What of this can be within reach of the other's box, in its own axes: of a rod only that length.
    fn near(&self, other: &Placed, reach_mm: f64) -> Option<Cow<'_, MeshSolid>> {
        if !matches!(self.shape.kind, Kind::Rod(_)) {
            return Some(Cow::Borrowed(&self.shape.solid));
        }
        let [_, [radius, _, length]] = self.shape.solid.bounds_mm();
        let [start, end] = [0.0, length].map(|z| self.body.pose * Point3::new(0.0, 0.0, z));
        let [from, to] = other.bounds.crossed_by(&start, &end, reach_mm + radius)?;
        let (from, to) = ((from * length - END_MM).max(0.0), (to * length + END_MM).min(length));
        Some(Cow::Owned(MeshSolid::build(&Feature::cylinder(radius, to - from).at(0.0, 0.0, from))))
    }
}

/// A rod's piece is longer by this at both ends than it must be, mm.
const END_MM: f64 = 0.5;

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
    /// be taken from the first. The hub turns with the modules; the rest of the centre is paired with everything.
    pub fn pairs(&self) -> Vec<(&Placed<'a>, &Placed<'a>)> {
        let mut pairs = Vec::new();
        for (i, a) in self.placed.iter().enumerate() {
            for b in &self.placed[i + 1..] {
                let modules = [a.body.module, b.body.module];
                let apart = [a, b].iter().any(|p| p.body.module.is_none() && !p.is_part(PartName::Hub)) || modules == [None, None];
                if apart || modules.contains(&Some(0)) {
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
