//! Whether the straight way of a part into its place is free of what is there already, by the meshes.
//!
//! A pair of bodies is compared in places [`STEP_MM`] apart, as a step of the fold is; places where boxes around their facets are apart are passed
//! over. Two bodies may share what they share when they are home (a thread in its pilot hole), for that is judged by
//! the interference rule, and [`TOUCH_MM3`] of rounding. What shares more than that at home slides in one bore and is compared in some
//! places only, as in a step of the fold. A propeller's disc is what it sweeps when it turns: on its way it is compared with
//! nothing.

use nalgebra::{Isometry3, Point3, Translation3, Vector3};
use serde::{Deserialize, Serialize};
use std::cell::OnceCell;

use super::mount::{Fixing, Mount};
use crate::frame::assembly::press_fit::{ROUNDING, TOUCH_MM3};
use crate::frame::assembly::{Body, BodyKind, Design};
use crate::frame::fold::{FITS_A_WAY, Meeting};
use crate::frame::skeleton::BatteryAxes;
use crate::solid::{BoxTree, MeshSolid, OrientedBox};

/// Farthest between two places of a way, mm.
const STEP_MM: f64 = 1.0;

/// What is cut off a body that the other does not reach is farther from it than this, mm.
const BESIDE_MM: f64 = 0.5;

/// Bodies of fewer facets are compared whole: to cut them takes longer than it saves.
const WORTH_CUTTING: usize = 500;

/// What was found of a pair of bodies.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Compared {
    /// Comparisons of two meshes.
    pub comparisons: usize,
    /// Places of the way.
    pub places: usize,
    /// The worst place.
    pub worst: Option<Meeting>,
}

/// The bodies of a design, ready to be moved past each other.
pub(super) struct Ways<'a> {
    design: &'a Design,
}

impl<'a> Ways<'a> {
    /// Of a design.
    pub(super) fn new(design: &'a Design) -> Self {
        Self { design }
    }

    /// The axes of the battery.
    pub(super) fn battery_axes(&self) -> BatteryAxes {
        self.design.centre.battery_axes
    }

    /// Bodies by their names, as far as the design has them.
    pub(super) fn bodies<'n>(&self, names: impl Iterator<Item = &'n str>) -> Vec<&'a Body> {
        let named = |name: &str| self.design.bodies.iter().find(|body| body.name == name);
        names.filter_map(named).collect()
    }

    /// The bodies of the modules; without what the propellers sweep.
    pub(super) fn modules(&self) -> Vec<&'a Body> {
        let kept = |body: &&Body| body.module.is_some() && self.design.shape(body).kind != BodyKind::Propeller;
        self.design.bodies.iter().filter(kept).collect()
    }

    /// Lowest and highest place of bodies along a direction, mm.
    fn reach_mm(&self, body: &Body, along: &Vector3<f64>) -> [f64; 2] {
        let bounds = self.boxes(body).bounds().map_or([0.0; 8], |bounds| bounds.corners().map(|c| along.dot(&(body.pose * c).coords)));
        [bounds.iter().copied().fold(f64::INFINITY, f64::min), bounds.iter().copied().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// How far bodies have to come along a direction to be clear of others, mm.
    pub(super) fn travel_mm(&self, from: &Vector3<f64>, moving: &[&Body], still: &[&Body]) -> f64 {
        let behind = moving.iter().map(|body| self.reach_mm(body, from)[0]).fold(f64::INFINITY, f64::min);
        let ahead = still.iter().map(|body| self.reach_mm(body, from)[1]).fold(f64::NEG_INFINITY, f64::max);
        (ahead - behind).max(0.0) + STEP_MM
    }

    fn boxes(&self, body: &Body) -> &'a BoxTree {
        self.design.shape(body).solid.boxes()
    }

    /// What a body meets of another on the way of a mount, up to the first place that bars it.
    pub(super) fn barred(&self, mount: &Mount, a: &Body, b: &Body) -> Compared {
        self.kept("bar on the way into place", mount, [a, b], Self::up_to_a_bar)
    }

    /// The same to the end of the way.
    pub(super) fn compared(&self, mount: &Mount, a: &Body, b: &Body) -> Compared {
        let barred = self.barred(mount, a, b);
        if barred.worst.is_none() { barred } else { self.kept("way into place", mount, [a, b], Self::whole) }
    }

    fn kept(
        &self,
        step: &'static str,
        mount: &Mount,
        [a, b]: [&Body; 2],
        way: fn(&Self, Vector3<f64>, [&Body; 2]) -> Compared,
    ) -> Compared {
        let free = squeezed(mount, a, b) || self.design.shape(a).kind == BodyKind::Propeller;
        let from = mount.from_in(self.battery_axes());
        let Some(towards) = from.filter(|_| !free) else {
            return Compared { comparisons: 0, places: 0, worst: None };
        };
        let read = (from, self.key(a), self.key(b));
        let name = || format!("{}: {} and {}", mount.title, a.name, b.name);
        let make = || way(self, Vector3::from(towards), [a, b]);
        Compared::clone(&self.design.memo.get_worth(step, &name(), &read, make, |found| found.comparisons > 0))
    }

    fn up_to_a_bar(&self, from: Vector3<f64>, bodies: [&Body; 2]) -> Compared {
        self.way(from, bodies, true)
    }

    fn whole(&self, from: Vector3<f64>, bodies: [&Body; 2]) -> Compared {
        self.way(from, bodies, false)
    }

    fn key(&self, body: &Body) -> impl std::fmt::Debug {
        (body.name.clone(), body.pose, self.design.shape(body).solid.key())
    }

    fn way(&self, from: Vector3<f64>, [a, b]: [&Body; 2], to_a_bar: bool) -> Compared {
        let travel_mm = self.travel_mm(&from, &[a], &[b]);
        let places = (travel_mm / STEP_MM).ceil() as usize + 1;
        let at = |mm: f64| (Isometry3::from_parts(Translation3::from(from * mm), Default::default()) * a.pose).inverse() * b.pose;
        let step = -(a.pose.rotation.inverse() * from) * STEP_MM;
        let meeting = self.boxes(a).meeting_places(self.boxes(b), &at(0.0), &step, places);
        let reached = OnceCell::new();
        let shared = |pose: &Isometry3<f64>| {
            let [a, b] = reached.get_or_init(|| self.reached([a, b], [at(0.0), at(travel_mm)]));
            a.shared_mm3(b, pose)
        };
        let (mut comparisons, mut worst, mut allowed_mm3) = (0, None::<Meeting>, TOUCH_MM3);
        let (mut next, mut stride) = (0, 1);
        for place in (0..places).filter(|place| meeting[*place]) {
            if place < next {
                continue;
            }
            comparisons += 1;
            let mm = place as f64 * STEP_MM;
            let shared_mm3 = shared(&at(mm));
            if place == 0 {
                allowed_mm3 += shared_mm3 * ROUNDING;
                stride = if shared_mm3 > TOUCH_MM3 { (places as f64 / FITS_A_WAY).ceil() as usize } else { 1 };
            }
            next = place + stride;
            if shared_mm3 > worst.as_ref().map_or(allowed_mm3, |worst| worst.shared_mm3) {
                let here = (1.0 - mm / travel_mm).max(0.0);
                worst = Some(Meeting { bodies: [a.name.clone(), b.name.clone()], at: here, shared_mm3, allowed_mm3 });
                if to_a_bar {
                    break;
                }
            }
        }
        Compared { comparisons, places, worst }
    }

    /// What of two bodies the other's box comes near to between two places of a straight way; each in its own axes. The places
    /// are the second's, in the axes of the first. A body of few facets stays whole.
    fn reached(&self, [a, b]: [&Body; 2], places: [Isometry3<f64>; 2]) -> [MeshSolid; 2] {
        let [one, two] = [a, b].map(|body| &self.design.shape(body).solid);
        let solid = |solid: &MeshSolid, other: &MeshSolid, poses: [Isometry3<f64>; 2]| {
            if solid.facet_count() < WORTH_CUTTING { solid.clone() } else { solid.in_boxes(&swept(other, poses)) }
        };
        [solid(one, two, places), solid(two, one, places.map(|pose| pose.inverse()))]
    }
}

/// Boxes around what a solid comes near to between two poses: one around each of its bodies (screws of one size are one solid) where these
/// are apart, else one around all.
fn swept(solid: &MeshSolid, poses: [Isometry3<f64>; 2]) -> Vec<OrientedBox> {
    let way = |corners: Vec<Point3<f64>>| {
        let corners = poses.iter().flat_map(|pose| corners.iter().map(move |corner| pose * corner)).collect::<Vec<_>>();
        OrientedBox::around(corners.iter()).grown(BESIDE_MM)
    };
    let bodies = solid.body_boxes();
    let each: Vec<OrientedBox> = bodies.iter().map(|body| way(body.corners().into())).collect();
    let apart = (1..each.len()).all(|at| each[..at].iter().all(|other| !each[at].touches(other)));
    if apart { each } else { vec![way(bodies.iter().flat_map(OrientedBox::corners).collect())] }
}

/// Rubber that is squeezed through what it is put into.
fn squeezed(mount: &Mount, a: &Body, b: &Body) -> bool {
    mount.fixing == Fixing::Squeezed && mount.brings.contains(&a.name.as_str()) && b.name == mount.onto
}
