//! The mounts as motion: when a body is first seen, and how far off its place it waits until then.

use nalgebra::Vector3;

use crate::frame::assembly::Design;
use crate::frame::assembly::wire::Wire;
use crate::frame::fold::FoldSequence;
use crate::frame::mounting::{MountStep, Mounting};

/// The mounts of a design around its fold.
pub(super) struct MountMotion {
    mounting: Mounting,
    /// How many mounts come before the fold.
    pub before: usize,
    folds: usize,
    /// For each body the step, from 0, in which it is first taken in hand.
    pub first: Vec<usize>,
}

impl MountMotion {
    pub(super) fn new(design: &Design, fold: &FoldSequence) -> Self {
        let mounting = Mounting::new(design, fold);
        let first = design.bodies.iter().map(|body| mounting.first_step(fold, &body.name).unwrap_or(0)).collect();
        Self { before: mounting.before.len(), folds: fold.steps.len(), first, mounting }
    }

    /// Titles of all steps.
    pub(super) fn titles(&self, fold: &FoldSequence) -> Vec<&'static str> {
        let mounts = |steps: &[MountStep]| steps.iter().map(|step| step.title).collect::<Vec<_>>();
        let folds = fold.steps.iter().map(|step| step.title);
        mounts(&self.mounting.before).into_iter().chain(folds).chain(mounts(&self.mounting.after)).collect()
    }

    /// The step, from 0, of a mount; 0 of one that there is not.
    pub(super) fn step_of(&self, mount: &str) -> usize {
        let at = |steps: &[MountStep]| steps.iter().position(|step| step.mount == mount);
        let after = || at(&self.mounting.after).map(|at| self.before + self.folds + at);
        at(&self.mounting.before).or_else(after).unwrap_or(0)
    }

    /// The step, from 0, that lays a wire: that which brings together what a cable joins.
    pub(super) fn step_of_wire(&self, wire: &Wire) -> usize {
        match wire.joins {
            None => self.step_of(if wire.role == "motor_wire" { "wiring" } else { "bracket" }),
            Some(ends) => self.mounting.steps().find(|step| step.joined_end(ends).is_some()).map_or(0, |step| self.step_of(step.mount)),
        }
    }

    /// Whether a body is not seen in a step, from 0: no step has taken it in hand yet, or it is out of the frame again.
    pub(super) fn is_hidden(&self, body: &str, first: usize, step: usize) -> bool {
        let mount = match step.checked_sub(self.before) {
            None => self.mounting.before.get(step),
            Some(at) => at.checked_sub(self.folds).and_then(|at| self.mounting.after.get(at)),
        };
        step < first || mount.is_some_and(|mount| mount.taken_out.iter().any(|name| name == body))
    }

    /// How far a mounted body is off its place when so many steps are done, mm.
    pub(super) fn off_mm(&self, body: &str, done: usize) -> Vector3<f64> {
        let mounts = self.mounting.before.iter().enumerate();
        let later = self.mounting.after.iter().enumerate().map(|(at, step)| (self.before + self.folds + at, step));
        let brings = mounts.chain(later).find(|(_, step)| step.brings.iter().any(|name| name == body));
        let Some((at, step)) = brings else { return Vector3::zeros() };
        let own = if at < done { Vector3::zeros() } else { step.shown_off_mm() };
        own + self.off_mm(step.onto, done)
    }
}
