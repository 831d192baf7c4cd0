//! The sequence as motion: where every member of the first module stands at each moment of each step.

use nalgebra::{Isometry3, Translation3, Vector3};

use super::member::Member;
use super::posture::{Module, Posture};
use super::rules::{Done, Rules};
use super::task::{FoldMotion, Task};

/// How long a step is shown, seconds.
pub const STEP_S: f64 = 2.5;

/// Pictures of a bend; the closing of the triangle, where everything moves, has twice as many.
const BEND_FRAMES: u32 = 24;

/// Everything at one moment.
pub struct Moment {
    /// Since the step began, seconds.
    pub at_s: f64,
    /// Place of each member of the first module.
    pub poses: Vec<(Member, Isometry3<f64>)>,
    /// Folds of the flexible members, degrees.
    pub folds: Vec<(Member, Vec<f64>)>,
}

impl Moment {
    /// Where a member stands.
    pub fn pose(&self, member: Member) -> Isometry3<f64> {
        self.poses.iter().find(|(m, _)| *m == member).map_or_else(Isometry3::identity, |(_, pose)| *pose)
    }

    /// Fold of one of its hinges, degrees.
    pub fn fold_deg(&self, member: Member, index: usize) -> f64 {
        let folds = self.folds.iter().find(|(m, _)| *m == member);
        folds.and_then(|(_, folds)| folds.get(index)).copied().unwrap_or(0.0)
    }
}

/// How far the top ring is over its place when all is taken apart, mm.
const APART_MM: f64 = 45.0;

/// How far from its place a member waits, mm: rods and what comes onto them lie beyond each other.
fn waits_mm(member: Member) -> f64 {
    match member {
        Member::Arm(_) => 50.0,
        Member::Leg => 60.0,
        Member::Mount => 140.0,
        Member::Fork => 180.0,
        Member::Cage(_) => 25.0,
        Member::MotorScrews => 25.0,
        _ => 40.0,
    }
}

/// The moments of a task, from the state after those that are done.
pub fn moments(rules: &Rules, order: &[Task], done: &Done, task: Task) -> Vec<Moment> {
    let frames = match task.motion() {
        FoldMotion::Push | FoldMotion::Slide => 1,
        FoldMotion::Bend => BEND_FRAMES,
        FoldMotion::Close => 2 * BEND_FRAMES,
    };
    (0..=frames).map(|i| moment(rules, order, done, (task, f64::from(i) / f64::from(frames)))).collect()
}

/// The moment at a share of a task's way, after those that are done.
pub fn moment(rules: &Rules, order: &[Task], done: &Done, (task, way): (Task, f64)) -> Moment {
    let posture = rules.posture(done, Some((task, way)));
    Moment {
        at_s: STEP_S * way,
        poses: Member::ALL.iter().map(|m| (*m, waiting(rules, order, *m, done, (task, way), &posture))).collect(),
        folds: [Member::HubJoint, Member::Corner(true), Member::Corner(false)].map(|m| (m, Module::folds(m, &posture))).into(),
    }
}

/// Where each member stands when all is folded and nothing is joined yet: off what it will be joined to, by what it waits.
pub fn exploded(rules: &Rules, order: &[Task]) -> Vec<(Member, Isometry3<f64>)> {
    let posture = Posture { off_hub_mm: rules.off_hub_mm[0], top_lift_mm: APART_MM, ..rules.module.closed() };
    let nothing = (Task::SeatMotor, 0.0);
    Member::ALL.iter().map(|m| (*m, waiting(rules, order, *m, &Done::new(), nothing, &posture))).collect()
}

/// A member's place, off what it will be joined to by what is left of its way.
fn waiting(rules: &Rules, order: &[Task], member: Member, done: &Done, doing: (Task, f64), posture: &Posture) -> Isometry3<f64> {
    let off = off_mm(rules, order, member, done, doing, posture);
    Translation3::from(off) * rules.module.pose(member, posture)
}

fn off_mm(rules: &Rules, order: &[Task], member: Member, done: &Done, doing: (Task, f64), posture: &Posture) -> Vector3<f64> {
    let brings = |task: &&Task| task.brings().contains(&member);
    let Some(task) = order.iter().find(brings) else { return Vector3::zeros() };
    let Some((_, onto)) = task.contacts().into_iter().find(|(mover, _)| *mover == member) else { return Vector3::zeros() };
    let base = off_mm(rules, order, onto, done, doing, posture);
    let left = match doing {
        (t, way) if t == *task => 1.0 - way,
        _ if done.contains(task) => 0.0,
        _ => 1.0,
    };
    let turned = rules.module.pose(onto, posture).rotation * rules.module.place(onto).rotation.inverse();
    base + turned * rules.along(*task, member) * (left * waits_mm(member))
}
