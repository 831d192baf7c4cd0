//! Whether the straight way of a part into its place is free of what is there already, by the meshes.
//!
//! A pair of bodies is compared in places [`STEP_MM`] apart, as a step of the fold is; where boxes around their facets are apart, places
//! are passed over. Two bodies may share what they share when they are home (a thread in its pilot hole), for that is judged by
//! the interference rule, and [`TOUCH_MM3`] of rounding.

use nalgebra::{Isometry3, Translation3, Vector3};
use serde::{Deserialize, Serialize};
use std::sync::{Arc, OnceLock};

use super::mount::{Fixing, Mount};
use crate::frame::assembly::press_fit::{ROUNDING, TOUCH_MM3};
use crate::frame::assembly::{Body, Design, Kind};
use crate::frame::fold::Meeting;
use crate::solid::BoxTree;

/// Farthest between two places of a way, mm.
const STEP_MM: f64 = 1.0;

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
    boxes: Vec<OnceLock<Arc<BoxTree>>>,
}

impl<'a> Ways<'a> {
    /// Of a design.
    pub(super) fn new(design: &'a Design) -> Self {
        Self { design, boxes: design.shapes.iter().map(|_| OnceLock::new()).collect() }
    }

    /// Bodies by their names, as far as the design has them.
    pub(super) fn bodies<'n>(&self, names: impl Iterator<Item = &'n str>) -> Vec<&'a Body> {
        let named = |name: &str| self.design.bodies.iter().find(|body| body.name == name);
        names.filter_map(named).collect()
    }

    /// The bodies of the modules; without what the propellers sweep.
    pub(super) fn modules(&self) -> Vec<&'a Body> {
        let kept = |body: &&Body| body.module.is_some() && self.design.shape(body).kind != Kind::Propeller;
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

    fn boxes(&self, body: &Body) -> &BoxTree {
        self.boxes[body.shape].get_or_init(|| Arc::new(BoxTree::of(&self.design.shape(body).solid)))
    }

    /// What a body meets of another on the way of a mount.
    pub(super) fn compared(&self, mount: &Mount, a: &Body, b: &Body) -> Compared {
        let Some(from) = mount.from.filter(|_| !squeezed(mount, a, b)) else {
            return Compared { comparisons: 0, places: 0, worst: None };
        };
        let read = (mount.from, self.key(a), self.key(b));
        let name = || format!("{}: {} and {}", mount.title, a.name, b.name);
        Compared::clone(&self.design.memo.get("way into place", &name(), &read, || self.way(Vector3::from(from), a, b)))
    }

    fn key(&self, body: &Body) -> impl std::fmt::Debug {
        (body.name.clone(), body.pose, self.design.shape(body).solid.key())
    }

    fn way(&self, from: Vector3<f64>, a: &Body, b: &Body) -> Compared {
        let travel_mm = self.travel_mm(&from, &[a], &[b]);
        let places = (travel_mm / STEP_MM).ceil() as usize + 1;
        let at = |mm: f64| (Isometry3::from_parts(Translation3::from(from * mm), Default::default()) * a.pose).inverse() * b.pose;
        let shared = |pose: &Isometry3<f64>| self.design.shape(a).solid.intersection(&self.design.shape(b).solid.placed(pose)).volume_mm3();
        let (mut comparisons, mut worst, mut mm, mut allowed_mm3) = (0, None::<Meeting>, 0.0, TOUCH_MM3);
        while mm <= travel_mm {
            let pose = at(mm);
            let free_mm = self.boxes(a).apart_mm(self.boxes(b), &pose);
            if free_mm <= 0.0 {
                comparisons += 1;
                let shared_mm3 = shared(&pose);
                if mm <= 0.0 {
                    allowed_mm3 += shared_mm3 * ROUNDING;
                }
                if shared_mm3 > worst.as_ref().map_or(allowed_mm3, |worst| worst.shared_mm3) {
                    let here = 1.0 - mm / travel_mm;
                    worst = Some(Meeting { bodies: [a.name.clone(), b.name.clone()], at: here, shared_mm3, allowed_mm3 });
                }
            }
            mm += free_mm.max(STEP_MM);
        }
        Compared { comparisons, places, worst }
    }
}

/// Rubber that is squeezed through what it is put into.
fn squeezed(mount: &Mount, a: &Body, b: &Body) -> bool {
    mount.fixing == Fixing::Squeezed && mount.brings.contains(&a.name.as_str()) && b.name == mount.onto
}
