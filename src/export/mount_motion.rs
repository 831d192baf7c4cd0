//! The mounts as motion: when a body is first seen, and how far off its place it waits until then.

use nalgebra::Vector3;

use crate::frame::assembly::Design;
use crate::frame::assembly::wire::Wire;
use crate::frame::fold::FoldSequence;
use crate::frame::mounting::{MountStep, Mounting};

/// How far off its place a group of parts waits at least while others are put there from the same side, mm: clear of those that stand off it themselves.
const WAITS_MM: f64 = 80.0;

/// The same direction, and far enough to wait there.
fn waiting_off_mm(shown_mm: Vector3<f64>) -> Vector3<f64> {
    shown_mm.try_normalize(0.0).map_or(shown_mm, |along| along * shown_mm.norm().max(WAITS_MM))
}

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

    /// The mounts, each with its step, from 0.
    fn numbered(&self) -> impl Iterator<Item = (usize, &MountStep)> {
        let later = self.mounting.after.iter().enumerate().map(|(at, step)| (self.before + self.folds + at, step));
        self.mounting.before.iter().enumerate().chain(later)
    }

    /// How far a mounted body is off its place when so many steps are done, mm.
    pub(super) fn off_mm(&self, body: &str, done: usize) -> Vector3<f64> {
        let Some((at, step)) = self.numbered().find(|(_, step)| step.brings.iter().any(|name| name == body)) else {
            return Vector3::zeros();
        };
        let is_in_its_way = |(other_at, other): (usize, &MountStep)| {
            (done..at).contains(&other_at) && !other.brings.is_empty() && (other.onto, other.from) == (step.onto, step.from)
        };
        let own = if at < done {
            Vector3::zeros()
        } else if self.numbered().any(is_in_its_way) {
            waiting_off_mm(step.shown_off_mm())
        } else {
            step.shown_off_mm()
        };
        own + self.off_mm(step.onto, done)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Frame;

    /// Dampers are put into the flight controller under the hub while the bracket with its sleeve still waits below.
    #[test]
    fn regress_what_waits_is_clear_of_what_is_put_together_meanwhile() {
        let design = Design::new(Frame::load("cognifly").expect("a preset").0).expect("closes");
        let fold = FoldSequence::new(&design.frame, &design.skeleton).expect("folds");
        let motion = MountMotion::new(&design, &fold);
        let step = motion.step_of("dampers");
        let span_mm = |name: &str, done: usize| {
            let body = design.bodies.iter().find(|body| body.name == name).expect("is there");
            let [low, high] = design.shape(body).solid.bounds_in_mm(&body.pose);
            [low[2], high[2]].map(|z| z + motion.off_mm(name, done).z)
        };
        let ([_, sleeve_top], [dampers_low, _]) = (span_mm("battery_sleeve", step), span_mm("damper", step));
        assert!(sleeve_top < dampers_low - 20.0, "{sleeve_top} {dampers_low}");
        // It comes near when the last of them is in its place, and is in its own after its step.
        let [nuts, bracket] = ["stack_nuts", "bracket"].map(|mount| motion.step_of(mount));
        let off = |done: usize| motion.off_mm("battery_bracket", done).norm();
        assert!(off(0) >= WAITS_MM && off(nuts) >= WAITS_MM && off(nuts + 1) < 30.0 && off(bracket) > 0.0 && off(bracket + 1) == 0.0);
        assert!(motion.off_mm("flight_controller", step).norm() < WAITS_MM);
    }
}
