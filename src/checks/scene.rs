//! The assembly as the rules see it: every body in its place, with its box.

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use rayon::prelude::*;

use super::bounds::Bounds;
use crate::frame::assembly::mass::MassTable;
use crate::frame::assembly::rod_piece::piece_between;
use crate::frame::assembly::{Body, BodyKind, Design, Shape};
use crate::memo::Memo;
use crate::params::PartName;
use crate::solid::MeshSolid;

/// A body in its place.
pub(super) struct Placed<'a> {
    pub body: &'a Body,
    pub shape: &'a Shape,
    pub bounds: Bounds,
    memo: &'a Memo,
}

impl<'a> Placed<'a> {
    fn new(design: &'a Design, body: &'a Body) -> Self {
        let shape = design.shape(body);
        let [low, high] = shape.solid.bounds_in_mm(&body.pose);
        Self { body, shape, bounds: Bounds { low, high }, memo: &design.memo }
    }

    pub fn is_part(&self, name: PartName) -> bool {
        self.shape.kind == BodyKind::Printed(name)
    }

    pub fn is_propeller(&self) -> bool {
        self.shape.kind == BodyKind::Propeller
    }

    fn is_rod(&self) -> bool {
        matches!(self.shape.kind, BodyKind::Rod(_))
    }

    /// Shortest distance to another body, mm, at most the reach.
    pub fn gap_mm(&self, other: &Self, reach_mm: f64) -> f64 {
        if self.bounds.distance_mm(&other.bounds) > reach_mm {
            return reach_mm;
        }
        let pair = Pair::of(self, other);
        let gap_mm = || pair.near(reach_mm).map_or(reach_mm, |[a, b]| a.gap_mm(&b.placed(&pair.pose), reach_mm));
        *self.memo.get("gap", &pair.name(), &(pair.key(), reach_mm), gap_mm)
    }

    /// Volume in common, mm³.
    pub fn shared_mm3(&self, other: &Self) -> f64 {
        if self.bounds.distance_mm(&other.bounds) > 0.0 {
            return 0.0;
        }
        let pair = Pair::of(self, other);
        let shared_mm3 = || if pair.is_apart() { 0.0 } else { pair.near(0.0).map_or(0.0, |[a, b]| a.shared_mm3(&b, &pair.pose)) };
        *self.memo.get("shared volume", &pair.name(), &pair.key(), shared_mm3)
    }

    /// Whose axes two bodies are compared in: the smaller's.
    fn rank(&self) -> u8 {
        match (&self.shape.kind, self.body.module) {
            (BodyKind::Rod(_), _) => 0,
            (BodyKind::Printed(_), Some(_)) => 1,
            _ => 2,
        }
    }

    /// What of this can be within reach of the other, in its own axes: of a rod only that length. `pose` is the other's in these axes.
    fn near(&self, other: &Self, pose: &Isometry3<f64>, reach_mm: f64) -> Option<MeshSolid> {
        if !self.is_rod() {
            return Some(self.shape.solid.clone());
        }
        let [low, high] = other.shape.solid.bounds_in_mm(pose).map(|corner| corner[2]);
        piece_between(&self.shape.solid, [low - reach_mm, high + reach_mm])
    }
}

/// Two bodies, in the axes of one of them, along which long facets lie: the boxes by which the kernel sorts facets are then small.
/// Distances and volumes are the same in all axes.
struct Pair<'a> {
    still: &'a Placed<'a>,
    other: &'a Placed<'a>,
    /// The other's, in the axes of the first.
    pose: Isometry3<f64>,
}

impl<'a> Pair<'a> {
    fn of(a: &'a Placed<'a>, b: &'a Placed<'a>) -> Self {
        let [still, other] = if b.rank() < a.rank() { [b, a] } else { [a, b] };
        Self { still, other, pose: rounded_pose(&(still.body.pose.inverse() * other.body.pose)) }
    }

    /// Whether the two surely share nothing: boxes around their facets are apart, and neither can lie within the other.
    fn is_apart(&self) -> bool {
        let [still, other] = [self.still, self.other].map(|placed| placed.shape.solid.boxes());
        let within = |a: &Bounds, b: &Bounds| (0..3).all(|axis| b.low[axis] <= a.low[axis] && a.high[axis] <= b.high[axis]);
        let nested = within(&self.still.bounds, &self.other.bounds) || within(&self.other.bounds, &self.still.bounds);
        !nested && still.apart_mm(other, &self.pose) > 0.0
    }

    fn name(&self) -> String {
        format!("{} and {}", self.still.body.name, self.other.body.name)
    }

    /// All that a distance or a volume of the two depends on.
    fn key(&self) -> impl std::fmt::Debug {
        (self.still.shape.solid.key(), self.other.shape.solid.key(), [self.still.is_rod(), self.other.is_rod()], self.pose)
    }

    /// Both in their own axes, as far as they can be within reach of each other.
    fn near(&self, reach_mm: f64) -> Option<[MeshSolid; 2]> {
        let still = self.still.near(self.other, &self.pose, reach_mm)?;
        let other = self.other.near(self.still, &self.pose.inverse(), reach_mm)?;
        Some([still, other])
    }
}

/// Parts of a millimetre, and of a quaternion's unit, to which a pose between two bodies is rounded: 10⁻⁹ mm, and by the turn some
/// 10⁻⁷ mm at 100 mm from the axis, a hundred-thousandth of what a printer can place.
const GRID_PER_MM: f64 = (1_u64 << 30) as f64;

/// A pose rounded so far that it is the same wherever in the frame the two bodies are.
pub(super) fn rounded_pose(pose: &Isometry3<f64>) -> Isometry3<f64> {
    let rounded = |number: f64| (number * GRID_PER_MM).round() / GRID_PER_MM + 0.0;
    // A turn is the same with all four numbers negated.
    let turn = pose.rotation.coords.map(rounded) * if pose.rotation.w < 0.0 { -1.0 } else { 1.0 };
    let rotation = UnitQuaternion::new_normalize(Quaternion::from(turn));
    Isometry3::from_parts(Translation3::from(pose.translation.vector.map(rounded)), rotation)
}

/// Everything the rules read.
pub(super) struct Scene<'a> {
    pub design: &'a Design,
    pub masses: &'a MassTable,
    pub placed: Vec<Placed<'a>>,
}

impl<'a> Scene<'a> {
    pub fn new(design: &'a Design, masses: &'a MassTable) -> Self {
        Self { design, masses, placed: design.bodies.par_iter().map(|body| Placed::new(design, body)).collect() }
    }

    /// A printed part of a module, or of the centre.
    pub fn part(&self, name: PartName, module: Option<usize>) -> Option<&Placed<'a>> {
        self.placed.iter().find(|p| p.is_part(name) && p.body.module == module)
    }

    /// Something bought in the centre.
    pub fn bought(&self, name: &str) -> Option<&Placed<'a>> {
        self.placed.iter().find(|p| matches!(p.shape.kind, BodyKind::Bought(bought) if bought == name))
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
