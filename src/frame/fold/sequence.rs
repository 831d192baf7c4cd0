//! The fold sequence of a frame: steps with their joins, bends, checks and what they wait for.

use std::borrow::Cow;

use serde::Serialize;

use super::depth::depth;
use super::hinge::{self, HingeLoad};
use super::linkage::{FREE_WAY, Linkage, LinkageError, Stance};
use super::member::Member;
use super::posture::{Module, Posture};
use super::rules::{BrokenConstraint, Done, Rules, rods_enter_mm};
use super::task::{FoldMotion, Task, is_seated_early};
use super::tool::{Tool, in_words};
use crate::figures::told_apart;
use crate::frame::skeleton::{Centre, MODULE_NAMES, MODULE_WORDS, ModulePlaces, RodRole, Skeleton};
use crate::memo::Key;
use crate::params::Frame;
use crate::solid::Bend;
use crate::units::Angle;

/// The module whose corners take the ends of the first one's cage rods.
pub const NEXT_MODULE: usize = 1;

/// Why a frame cannot be folded.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FoldError {
    /// The triangle cannot be closed.
    #[error(transparent)]
    Linkage(#[from] LinkageError),
    /// No order exists.
    #[error("there is no order in which the frame can be put together: {}", listed(blocked))]
    NoOrder {
        /// What keeps each remaining task.
        blocked: Vec<(Task, BrokenConstraint)>,
    },
    /// The plugs are too short to guide the modules while the rings close.
    #[error("the cage rods enter the next corner {} mm before the modules are home, the plugs reach only {} mm",
        told_apart(*.needed_mm, *.plug_mm, 1)[0], told_apart(*.needed_mm, *.plug_mm, 1)[1])]
    PlugTooShort {
        /// Way of the modules from where rods enter, mm.
        needed_mm: f64,
        /// Length of the plugs, mm.
        plug_mm: f64,
    },
}

fn listed(blocked: &[(Task, BrokenConstraint)]) -> String {
    blocked.iter().map(|(task, broken)| format!("{}: {broken}", task.title())).collect::<Vec<_>>().join("; ")
}

/// A step that has to come before or after another.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Dependence {
    /// The other step.
    pub task: Task,
    /// What breaks otherwise.
    pub because: String,
}

/// A hinge that a step bends.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FoldBend {
    /// The body of the first module.
    pub body: String,
    /// What folds.
    pub hinge: &'static str,
    /// A point of the hinge's axis in the axes of the flat part, mm.
    pub pivot_mm: [f64; 3],
    /// The axis.
    pub axis: [f64; 3],
    /// Fold before, degrees from flat.
    pub from_deg: f64,
    /// Fold after, degrees from flat.
    pub to_deg: f64,
    /// Fold of the assembled frame, degrees from flat.
    pub assembled_deg: f64,
    /// Strain and moment after.
    pub load: HingeLoad,
    /// Elongation at break over the frame's factor, %; none without an elongation.
    pub allowed_strain_percent: Option<f64>,
    /// Fold at which the notch's faces meet, degrees; none for necks.
    pub notch_closes_deg: Option<f64>,
    /// How far the fold goes beyond it, degrees.
    pub preload_deg: f64,
}

/// A member that a step brings.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Join {
    /// The body of the first module that moves.
    pub body: String,
    /// What it is joined to.
    pub onto: String,
    /// Where it comes from, in frame axes of the first module.
    pub from: [f64; 3],
    /// How far a rod stays out of the bottom of its bore until the triangle is closed, mm.
    pub left_out_mm: f64,
    /// How deep a rod is in its bore when it is at the bottom, mm; none without a rod.
    pub depth_mm: Option<f64>,
}

/// A step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Step {
    /// From 1.
    pub number: usize,
    /// What is done.
    pub task: Task,
    /// In a few words.
    pub title: &'static str,
    /// In sentences.
    pub text: Cow<'static, str>,
    /// What it takes; nothing of what hands do.
    #[serde(rename = "tool", serialize_with = "in_a_row")]
    pub tools: Vec<Tool>,
    /// What to take care of.
    pub caution: Option<Cow<'static, str>>,
    /// How often: once a module, or once.
    pub repeats: usize,
    /// All repeats together, minutes; an estimate.
    pub minutes: f64,
    /// What is joined.
    pub joins: Vec<Join>,
    /// What is bent.
    pub bends: Vec<FoldBend>,
    /// Largest distance of the leg's end from its place in the foot while the loop is followed, mm; none for other steps.
    pub loop_error_mm: Option<f64>,
    /// Steps that have to be done before it.
    pub after: Vec<Dependence>,
    /// Steps that it has to come before.
    pub before: Vec<Dependence>,
}

/// A frame's fold.
pub struct FoldSequence {
    /// The first module and its hinges; the others are the same, turned.
    pub module: Module,
    /// Stance before the leg enters the foot.
    pub entry: Stance,
    /// How far a module stands off the hub before its plugs enter, and before the bottom ring is closed, mm.
    pub off_hub_mm: [f64; 2],
    /// The steps.
    pub steps: Vec<Step>,
}

/// All that a frame's fold follows from, and what its motions follow from.
pub fn inputs(frame: &Frame, skeleton: &Skeleton) -> Key {
    let parts = (&frame.corner, &frame.hub, &frame.hub_joint, &frame.fork, &frame.knee, &frame.motor_mount);
    let all = (
        parts,
        &frame.rods,
        &frame.fit,
        &frame.flexible,
        frame.limits.hinge_strain_factor,
        is_seated_early(frame),
        Centre::new(frame),
        skeleton,
    );
    Key::of("fold", &all)
}

impl FoldSequence {
    /// Finds the sequence of a frame.
    ///
    /// # Errors
    /// When it cannot be folded.
    pub fn new(frame: &Frame, skeleton: &Skeleton) -> Result<Self, FoldError> {
        let linkage = Linkage::new(frame, skeleton)?;
        let entry = linkage.entry()?;
        let module = Module::new(frame, skeleton, linkage);
        ring_can_close(frame)?;
        let rules = Rules::new(frame, skeleton, &module, entry);
        let order = rules.order(&Task::candidates(frame)).map_err(|blocked| FoldError::NoOrder { blocked })?;
        let off_hub_mm = rules.off_hub_mm;
        let steps = (0..order.len()).map(|at| step(&rules, frame, skeleton, &order, at)).collect();
        Ok(Self { module, entry, off_hub_mm, steps })
    }

    /// Tasks in their order.
    pub fn order(&self) -> Vec<Task> {
        self.steps.iter().map(|step| step.task).collect()
    }

    /// The rules that it was found by.
    pub fn rules(&self, frame: &Frame, skeleton: &Skeleton) -> Rules<'_> {
        Rules::new(frame, skeleton, &self.module, self.entry)
    }
}

/// The plugs have to be in the hub before the bottom ring's rods enter.
fn ring_can_close(frame: &Frame) -> Result<(), FoldError> {
    let needed_mm = rods_enter_mm(frame);
    let plug_mm = frame.hub_joint.plug_length_mm;
    if needed_mm > plug_mm { Err(FoldError::PlugTooShort { needed_mm, plug_mm }) } else { Ok(()) }
}

/// A task's sentences; where cage rods have two lengths, with the modules that each of them goes into.
fn text(task: Task, frame: &Frame, skeleton: &Skeleton) -> Cow<'static, str> {
    let is_cage = |(member, _): (Member, Member)| member.rod().is_some_and(RodRole::is_cage);
    if !skeleton.closure.places.are_apart() || task == Task::CloseRing || !task.contacts().into_iter().any(is_cage) {
        return task.text(frame).into();
    }
    let modules = |front: bool| {
        let of = |module: &usize| ModulePlaces::carries_side_rods(*module) != front;
        (0..MODULE_NAMES.len()).filter(of).map(|module| MODULE_WORDS[module]).collect::<Vec<_>>().join(" and ")
    };
    let [across_mm, along_mm] = [RodRole::Cage, RodRole::CageSide].map(|role| skeleton.sawn_mm(role));
    let (across, along) = (modules(true), modules(false));
    format!("{} The modules {across} take a rod of {across_mm:.1} mm, the modules {along} one of {along_mm:.1} mm.", task.text(frame))
        .into()
}

/// What the ring on a rod that tells its depth is marked with.
const MARKING: [Tool; 2] = [Tool::Ruler, Tool::Pen];

/// What a task takes, with what marks the rods whose depths it tells; each once.
fn tools(task: Task, frame: &Frame, joins: &[Join]) -> Vec<Tool> {
    let marking = if joins.iter().any(|join| join.depth_mm.is_some()) { &MARKING[..] } else { &[] };
    let own = task.tools(frame).iter().filter(|tool| !marking.contains(tool));
    marking.iter().chain(own).copied().collect()
}

fn in_a_row<S: serde::Serializer>(tools: &[Tool], to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(&in_words(tools))
}

fn step(rules: &Rules, frame: &Frame, skeleton: &Skeleton, order: &[Task], at: usize) -> Step {
    let task = order[at];
    let done: Done = order[..at].iter().copied().collect();
    let repeats = if task == Task::PlugHub || task.closes_ring().is_some() { 1 } else { MODULE_NAMES.len() };
    let (after, before) = dependences(rules, order, at, &done);
    let joins = joins(rules, skeleton, task);
    Step {
        number: at + 1,
        task,
        title: task.title(),
        text: text(task, frame, skeleton),
        tools: tools(task, frame, &joins),
        caution: task.caution(frame),
        repeats,
        minutes: task.minutes() * repeats as f64,
        joins,
        bends: bends(rules, frame, task, &done),
        loop_error_mm: (task == Task::CloseTriangle).then(|| loop_error_mm(rules, skeleton, &done)),
        after,
        before,
    }
}

fn dependences(rules: &Rules, order: &[Task], at: usize, done: &Done) -> (Vec<Dependence>, Vec<Dependence>) {
    let task = order[at];
    let depends = |other: Task, broken: BrokenConstraint| Dependence { task: other, because: broken.to_string() };
    let after = order[..at].iter().filter_map(|other| {
        let without: Done = done.iter().copied().filter(|t| t != other).collect();
        rules.broken(&without, task).map(|broken| depends(*other, broken))
    });
    let before = order[at + 1..].iter().filter_map(|other| {
        let with: Done = done.iter().copied().chain([*other]).collect();
        rules.broken(&with, task).map(|broken| depends(*other, broken))
    });
    (after.collect(), before.collect())
}

fn joins(rules: &Rules, skeleton: &Skeleton, task: Task) -> Vec<Join> {
    let depth_of = |a: Member, b: Member, module: usize| depth(skeleton, a, (b, module)).map(|depth| depth.mm);
    let own = task.contacts().into_iter().map(|(mover, onto)| {
        let depth_mm = depth_of(mover, onto, 0).or_else(|| depth_of(onto, mover, 0));
        Join { depth_mm, ..join(rules, task, mover, onto) }
    });
    let ring = task.closes_ring().map(|up| {
        let (rod, corner) = (Member::Cage(up), Member::Corner(up));
        let next = NEXT_MODULE;
        Join { body: rod.body(0), onto: corner.body(next), from: [0.0; 3], left_out_mm: 0.0, depth_mm: depth_of(rod, corner, next) }
    });
    own.chain(ring).collect()
}

fn join(rules: &Rules, task: Task, mover: Member, onto: Member) -> Join {
    let linkage = &rules.module.linkage;
    let [arm_hub, arm_fork] = linkage.arm_holds_mm.map(|hold| hold * rules.entry.pulled);
    let [strut, corner] = linkage.strut_out_mm(rules.entry.pulled);
    let left_out_mm = match task {
        Task::PushArms => arm_hub,
        Task::PushFork => arm_fork,
        Task::PushStruts => strut,
        Task::PushFoot => corner,
        _ => 0.0,
    };
    let from = if task.motion() == FoldMotion::Close { nalgebra::Vector3::zeros() } else { rules.along(task, mover) };
    Join { body: mover.body(0), onto: onto.body(0), from: from.into(), left_out_mm, depth_mm: None }
}

fn bends(rules: &Rules, frame: &Frame, task: Task, done: &Done) -> Vec<FoldBend> {
    let (from, to) = (rules.posture(done, None), rules.posture(done, Some((task, 1.0))));
    let mut found = Vec::new();
    for member in [Member::HubJoint, Member::Corner(false), Member::Corner(true)] {
        let folds = [from, to, rules.module.closed()].map(|p| Module::folds(member, &p));
        for (index, bend) in rules.module.bends(member).iter().enumerate() {
            let [from_deg, to_deg, assembled_deg] = [0, 1, 2].map(|i| folds[i][index]);
            if (to_deg - from_deg).abs() > 1e-6 {
                found.push(fold_bend(frame, (member, index), bend, [from_deg, to_deg, assembled_deg]));
            }
        }
    }
    found
}

fn fold_bend(frame: &Frame, (member, index): (Member, usize), bend: &Bend, [from_deg, to_deg, assembled_deg]: [f64; 3]) -> FoldBend {
    let (hinge, pivot, axis, load, closes) = match bend {
        Bend::Web { pivot, outward, towards, .. } => {
            let lean = if index == 0 { frame.corner.notch_half_angle_deg } else { frame.corner.corner_leg_face_deg };
            let hinge = if index == 0 { "strut" } else { "leg" };
            (hinge, pivot, outward.cross(towards), hinge::web(frame, Angle::deg(to_deg)), Some(2.0 * lean))
        }
        Bend::Necks { pivot, axis, .. } => ("necks", pivot, axis.into_inner(), hinge::necks(frame, Angle::deg(to_deg)), None),
    };
    let allowed = frame.flexible.material.elongation_at_break_percent.map(|e| e / frame.limits.hinge_strain_factor);
    FoldBend {
        body: member.body(0),
        hinge,
        pivot_mm: pivot.coords.into(),
        axis: axis.into(),
        from_deg,
        to_deg,
        assembled_deg,
        load,
        allowed_strain_percent: allowed,
        notch_closes_deg: closes,
        preload_deg: closes.map_or(0.0, |closes| (to_deg - closes).max(0.0)),
    }
}

/// Places at which the closing is compared with the poses of the bodies.
const LOOP_SAMPLES: u32 = 40;

/// Largest distance between the leg's end and where it is in the foot's bore, from the bodies' poses, mm.
fn loop_error_mm(rules: &Rules, skeleton: &Skeleton, done: &Done) -> f64 {
    let at = |sample: u32| {
        let way = FREE_WAY + (1.0 - FREE_WAY) * f64::from(sample) / f64::from(LOOP_SAMPLES);
        let posture: Posture = rules.posture(done, Some((Task::CloseTriangle, way)));
        let out = rules.module.linkage.closing(&rules.entry, way).map_or(f64::INFINITY, |stance| stance.leg_out_mm);
        rules.module.loop_error_mm(&posture, out, skeleton)
    };
    (0..=LOOP_SAMPLES).map(at).fold(0.0, f64::max)
}
