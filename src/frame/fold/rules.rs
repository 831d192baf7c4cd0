//! What may be done when: read from the geometry of what is there, not from a list.

use std::collections::BTreeSet;

use nalgebra::{Isometry3, Translation3, Vector3};

use super::linkage::{FREE_WAY, Stance};
use super::member::{Capsule, Member, capsules, distance_mm};
use super::posture::{Module, Posture};
use super::task::{FoldMotion, Task};
use crate::frame::skeleton::Skeleton;
use crate::params::Frame;
use crate::units::Angle;

/// Members this much inside each other are in each other's way, mm: the capsules of a press fit or a fold touch.
const OVERLAP_MM: f64 = 0.2;
/// Places at which a way is looked at.
const SAMPLES: u32 = 8;
/// How far a bore may be off the axis of what comes into it.
const FACING_DEG: f64 = 1.0;
/// A rod's end this near its bore's mouth meets it, mm.
const MEETING_MM: f64 = 1.0;
/// A part is put on from this far outside the mouth, mm.
const BEFORE_MM: f64 = 1.0;

/// Why a task cannot be done.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BrokenConstraint {
    /// The task is missing or occurs twice.
    #[error("{} is done {times} times", task.title())]
    Times {
        /// The task.
        task: Task,
        /// How often it occurs.
        times: usize,
    },
    /// Both are held already: a rod cannot be pushed along its axis within a closed loop.
    #[error("{mover} and {onto} are already held by the rest: no part can move along the bore")]
    LoopShut {
        /// What moves.
        mover: String,
        /// What it is joined to.
        onto: String,
    },
    /// A rod between two blind bores that both stay where they are.
    #[error("{rod} would have to pass through the bottom of its bore in {part}: both its ends are closed")]
    BetweenBottoms {
        /// The rod.
        rod: String,
        /// The part at its other end.
        part: String,
    },
    /// What slides along a rail finds no open end.
    #[error("{mover} slides on along {rail}, but {} and {} close both its ends", by[0], by[1])]
    EndsClosed {
        /// What slides.
        mover: String,
        /// The rail.
        rail: String,
        /// What closes it.
        by: [String; 2],
    },
    /// Nothing to turn the hinge with.
    #[error("{part} cannot be bent: {lever} is not in it, and springs back")]
    NoLever {
        /// The part.
        part: String,
        /// What it is turned by.
        lever: String,
    },
    /// The hinge is in a closed loop.
    #[error("{part} cannot be bent any more: the loop through it is closed and rigid")]
    Rigid {
        /// The part.
        part: String,
    },
    /// The bend would close nothing.
    #[error("the bend closes nothing: {missing} is not joined")]
    LoopOpen {
        /// What is missing.
        missing: String,
    },
    /// The rod does not meet the bore.
    #[error("{rod} ends {gap_mm:.1} mm beside the mouth of its bore in {part}")]
    DoesNotMeet {
        /// The rod.
        rod: String,
        /// The part.
        part: String,
        /// Distance, mm.
        gap_mm: f64,
    },
    /// Bores that do not look at each other.
    #[error("the cage bores of {part} are {off_deg:.0} deg off those of the next module")]
    NotFacing {
        /// The part.
        part: String,
        /// Angle, degrees.
        off_deg: f64,
    },
    /// Something is in the way.
    #[error("{mover} runs into {other} on its way, {overlap_mm:.1} mm deep")]
    Blocked {
        /// What moves.
        mover: String,
        /// What it meets.
        other: String,
        /// How deep, mm.
        overlap_mm: f64,
    },
}

/// What is asked about a sequence.
pub struct Rules<'a> {
    /// The module.
    pub module: &'a Module,
    /// The stance before the leg enters the foot.
    pub entry: Stance,
    /// How far a module stands off the hub before its plugs enter, and when the bottom ring's rods stand before their bores, mm.
    pub off_hub_mm: [f64; 2],
    /// How far the top ring is held over its place, along the struts, while its corners bend, mm.
    pub top_lift_mm: f64,
    solids: Vec<(Member, Vec<Capsule>)>,
    far_sockets: Vec<(Member, Member)>,
    /// What is joined in the end, in both orders.
    joined: BTreeSet<(Member, Member)>,
}

/// Tasks that are done.
pub type Done = BTreeSet<Task>;

fn name(member: Member) -> String {
    member.body(0)
}

impl<'a> Rules<'a> {
    /// The rules of a frame.
    pub fn new(frame: &Frame, skeleton: &Skeleton, module: &'a Module, entry: Stance) -> Self {
        let solids = Member::ALL.iter().map(|m| (*m, capsules(*m, frame, skeleton))).collect();
        let plug_mm = frame.hub_joint.plug_length_mm;
        let off_hub_mm = [plug_mm + OFF_HUB_MM, 0.5 * (plug_mm + rods_enter_mm(frame))];
        let top_lift_mm = frame.corner.corner_socket_depth_mm + OVER_STRUT_MM;
        let joined = Task::ALL.iter().flat_map(|task| task.contacts()).flat_map(|(a, b)| [(a, b), (b, a)]).collect();
        Self { module, entry, off_hub_mm, top_lift_mm, solids, far_sockets: far_sockets(skeleton), joined }
    }

    /// The posture after some tasks, in the middle of one.
    ///
    /// The closing is followed by its linkage; a closure that is lost is drawn where it began.
    pub fn posture(&self, done: &Done, doing: Option<(Task, f64)>) -> Posture {
        let way = |task: Task| match doing {
            Some((t, way)) if t == task => way,
            _ => f64::from(u8::from(done.contains(&task))),
        };
        let closed = self.module.closed();
        let closing = way(Task::CloseTriangle);
        let stance = self.module.linkage.closing(&self.entry, closing).unwrap_or(self.entry);
        let [far, started] = self.off_hub_mm;
        let hub_deg = if closing > FREE_WAY { stance.hub_deg } else { self.entry.hub_deg * way(Task::BendLeg) };
        Posture {
            hub_deg,
            strut_deg: stance.strut_deg,
            foot_deg: stance.foot_deg,
            top_deg: closed.top_deg * (way(Task::CloseTop) / TOP_BENT).min(1.0),
            top_lift_mm: self.top_lift_mm * ((1.0 - way(Task::CloseTop)) / (1.0 - TOP_BENT)).min(1.0),
            pulled: stance.pulled,
            off_hub_mm: far + (started - far) * way(Task::PlugHub) - started * way(Task::CloseRing),
        }
    }

    /// Everything that is joined to a member.
    pub fn component(&self, of: Member, done: &Done) -> BTreeSet<Member> {
        let mut contacts: Vec<(Member, Member)> = done.iter().flat_map(|task| task.contacts()).collect();
        // The neighbours' cage rods hold this module's corners.
        let rings = [(Task::CloseTop, true), (Task::CloseRing, false)].into_iter().filter(|(task, _)| done.contains(task));
        contacts.extend(rings.map(|(_, up)| (Member::Corner(up), Member::Hub)));
        let mut found = BTreeSet::from([of]);
        loop {
            let before = found.len();
            for (a, b) in &contacts {
                if found.contains(a) || found.contains(b) {
                    found.extend([*a, *b]);
                }
            }
            if found.len() == before {
                return found;
            }
        }
    }

    /// What keeps a task from being done after those that are.
    pub fn broken(&self, done: &Done, task: Task) -> Option<BrokenConstraint> {
        match task.motion() {
            FoldMotion::Push | FoldMotion::Slide => self.broken_push(done, task),
            FoldMotion::Bend => self.broken_bend(done, task),
            FoldMotion::Close => match task {
                Task::CloseTriangle => self.broken_triangle(done),
                Task::PlugHub => self.broken_plug(done),
                Task::CloseRing => self.broken_ring(done),
                _ => self.broken_top(done),
            },
        }
    }

    /// Everything that is wrong with an order of tasks, with the task before which it is.
    pub fn check(&self, order: &[Task]) -> Vec<(Task, BrokenConstraint)> {
        let mut done = Done::new();
        let mut found = Vec::new();
        for task in Task::ALL {
            let times = order.iter().filter(|t| **t == task).count();
            if times != 1 {
                found.push((task, BrokenConstraint::Times { task, times }));
            }
        }
        for task in order {
            found.extend(self.broken(&done, *task).map(|broken| (*task, broken)));
            done.insert(*task);
        }
        found
    }

    /// An order that breaks nothing: the frame is taken apart, each time by the last of the candidates that can be undone,
    /// and that read backwards. Taking apart only frees what is left, so no way back is needed.
    ///
    /// # Errors
    /// What keeps the remaining tasks from being undone.
    pub fn order(&self, candidates: &[Task]) -> Result<Vec<Task>, Vec<(Task, BrokenConstraint)>> {
        let mut left: Done = candidates.iter().copied().collect();
        let mut order = Vec::new();
        while !left.is_empty() {
            let without = |task: &Task| left.iter().copied().filter(|t| t != task).collect::<Done>();
            let undone = candidates
                .iter()
                .rev()
                .filter(|t| left.contains(*t))
                .find(|t| self.broken(&without(t), **t).is_none() && self.holds(&without(t)));
            let Some(task) = undone else {
                return Err(left.iter().filter_map(|t| self.broken(&without(t), *t).map(|broken| (*t, broken))).collect());
            };
            left.remove(task);
            order.push(*task);
        }
        order.reverse();
        Ok(order)
    }

    /// Whether every bend among these tasks still has what it is turned by: nothing else holds a hinge that springs back.
    fn holds(&self, done: &Done) -> bool {
        done.iter().filter_map(|task| task.lever()).all(|(part, lever)| self.component(part, done).contains(&lever))
    }

    fn broken_push(&self, done: &Done, task: Task) -> Option<BrokenConstraint> {
        for rail in task.rails() {
            let closed = |end: &(Member, Member)| done.iter().any(|t| t.contacts().contains(end));
            if rail.iter().all(closed) {
                let (mover, onto) = task.contacts()[0];
                let other = |end: &(Member, Member)| name(if end.0 == onto { end.1 } else { end.0 });
                return Some(BrokenConstraint::EndsClosed { mover: name(mover), rail: name(onto), by: [other(&rail[0]), other(&rail[1])] });
            }
        }
        for (mover, onto) in task.contacts() {
            let held = self.component(onto, done);
            if held.contains(&mover) {
                return Some(BrokenConstraint::LoopShut { mover: name(mover), onto: name(onto) });
            }
            if let Some(part) = self.shut_far_end(mover, onto, &held, done) {
                return Some(BrokenConstraint::BetweenBottoms { rod: name(mover), part });
            }
        }
        self.swept_push(done, task)
    }

    /// The part with the bore for a rod's other end, when it stays where it is while the rod is pushed in here.
    fn shut_far_end(&self, rod: Member, onto: Member, held: &BTreeSet<Member>, done: &Done) -> Option<String> {
        if let Member::Cage(up) = rod {
            // The other corner is the next module's: that of the bottom ring is held by the hub, that of the top by the ring.
            let closes = if up { Task::CloseTop } else { Task::PlugHub };
            return done.contains(&closes).then(|| Member::Corner(up).body(1));
        }
        let far = self.far_sockets.iter().find(|(member, part)| *member == rod && *part != onto);
        far.filter(|(_, part)| held.contains(part)).map(|(_, part)| name(*part))
    }

    fn swept_push(&self, done: &Done, task: Task) -> Option<BrokenConstraint> {
        let posture = self.posture(done, None);
        for (mover, onto) in task.contacts() {
            let (moving, still) = (self.component(mover, done), self.component(onto, done));
            let along = self.module.pose(onto, &posture).rotation * self.module.place(onto).rotation.inverse() * self.along(task, mover);
            for sample in 0..SAMPLES {
                let off = Translation3::from(along * ((WAY_MM + BEFORE_MM) * f64::from(sample) / f64::from(SAMPLES)));
                let hit = self.first_overlap(&moving, &still, &posture, &Isometry3::from_parts(off, Default::default()));
                if hit.is_some() {
                    return hit;
                }
            }
        }
        None
    }

    /// The direction from which a task's member comes, in the assembled module.
    pub fn along(&self, task: Task, mover: Member) -> Vector3<f64> {
        task.comes_along(mover, |up| self.module.place(Member::Strut(up)) * Vector3::z())
    }

    fn broken_bend(&self, done: &Done, task: Task) -> Option<BrokenConstraint> {
        let (part, lever) = task.lever()?;
        if !self.component(part, done).contains(&lever) {
            return Some(BrokenConstraint::NoLever { part: name(part), lever: name(lever) });
        }
        if done.contains(&Task::CloseTriangle) {
            return Some(BrokenConstraint::Rigid { part: name(part) });
        }
        self.swept_bend(done, task, &self.component(part, done))
    }

    fn broken_triangle(&self, done: &Done) -> Option<BrokenConstraint> {
        let (foot, leg) = (Member::Corner(false), Member::Leg);
        let reached = self.component(leg, done);
        if !reached.contains(&foot) {
            let chain = [Member::HubJoint, Member::Arm(true), Member::Fork, Member::Knee, Member::Strut(false), foot];
            let missing = chain.into_iter().find(|m| !reached.contains(m)).unwrap_or(foot);
            return Some(BrokenConstraint::LoopOpen { missing: name(missing) });
        }
        if done.contains(&Task::PlugHub) {
            return Some(BrokenConstraint::Rigid { part: name(foot) });
        }
        let before = self.posture(done, Some((Task::CloseTriangle, FREE_WAY)));
        let gap_mm = self.leg_gap_mm(&before);
        if gap_mm > MEETING_MM {
            return Some(BrokenConstraint::DoesNotMeet { rod: name(leg), part: name(foot), gap_mm });
        }
        self.swept_bend(done, Task::CloseTriangle, &reached)
    }

    /// How far the leg's end is beside where it enters the foot, mm.
    fn leg_gap_mm(&self, posture: &Posture) -> f64 {
        let linkage = &self.module.linkage;
        let stance = Stance { hub_deg: posture.hub_deg, strut_deg: posture.strut_deg, pulled: posture.pulled, ..self.entry };
        linkage.gap(&stance).norm()
    }

    /// The plugs lead the modules while the bottom ring closes, so its rods have to be there by then.
    fn broken_plug(&self, done: &Done) -> Option<BrokenConstraint> {
        let rod = || self.without(done, Member::HubJoint, Member::Cage(false));
        shut_by(done, &[Task::CloseRing, Task::CloseTop]).or_else(rod).or_else(|| self.not_facing(done))
    }

    fn broken_ring(&self, done: &Done) -> Option<BrokenConstraint> {
        let missing = [Member::Hub, Member::Cage(false)].into_iter().find_map(|member| self.without(done, Member::HubJoint, member));
        shut_by(done, &[Task::CloseTop]).or(missing).or_else(|| self.not_facing(done))
    }

    /// What a closing lacks that has to hang on a member.
    fn without(&self, done: &Done, of: Member, member: Member) -> Option<BrokenConstraint> {
        (!self.component(of, done).contains(&member)).then(|| BrokenConstraint::LoopOpen { missing: name(member) })
    }

    fn not_facing(&self, done: &Done) -> Option<BrokenConstraint> {
        let foot = Member::Corner(false);
        let stands = |posture: &Posture| self.module.pose(foot, posture).rotation;
        let turned = stands(&self.posture(done, None)).angle_to(&stands(&self.module.closed()));
        let off_deg = Angle::rad(turned).to_deg();
        (off_deg > FACING_DEG).then(|| BrokenConstraint::NotFacing { part: name(foot), off_deg })
    }

    /// The top ring goes onto struts that stand where they will be: on modules that are home.
    fn broken_top(&self, done: &Done) -> Option<BrokenConstraint> {
        let top = Member::Corner(true);
        if !done.contains(&Task::CloseRing) {
            return Some(BrokenConstraint::LoopOpen { missing: name(Member::Corner(false)) });
        }
        let missing = self.without(done, Member::Hub, Member::Strut(true)).or_else(|| self.without(done, top, Member::Cage(true)));
        let within: BTreeSet<Member> = [Member::Hub, top].into_iter().flat_map(|member| self.component(member, done)).collect();
        missing.or_else(|| self.swept_bend(done, Task::CloseTop, &within))
    }

    fn swept_bend(&self, done: &Done, task: Task, within: &BTreeSet<Member>) -> Option<BrokenConstraint> {
        (0..=2 * SAMPLES).find_map(|sample| {
            let posture = self.posture(done, Some((task, f64::from(sample) / f64::from(2 * SAMPLES))));
            self.first_overlap(within, within, &posture, &Isometry3::identity())
        })
    }

    fn first_overlap(
        &self,
        moving: &BTreeSet<Member>,
        still: &BTreeSet<Member>,
        posture: &Posture,
        off: &Isometry3<f64>,
    ) -> Option<BrokenConstraint> {
        // What is joined in the end touches there; whether it gets there is asked where it is joined.
        let touch = |a: Member, b: Member| a == b || self.joined.contains(&(a, b));
        let placed = |m: Member, off: &Isometry3<f64>| -> Vec<_> {
            let all = self.solids.iter().find(|(member, _)| *member == m).map_or(&[][..], |(_, all)| all);
            all.iter().map(|c| (c.placed(&(off * self.module.side_pose(m, c.side, posture))), c.radius_mm)).collect()
        };
        let fixed: Vec<(Member, Vec<_>)> = still.iter().map(|m| (*m, placed(*m, &Isometry3::identity()))).collect();
        for a in moving {
            let mine = placed(*a, off);
            for (b, theirs) in fixed.iter().filter(|(b, _)| !touch(*a, *b)) {
                for ((axis, r), (other, s)) in mine.iter().flat_map(|x| theirs.iter().map(move |y| (x, y))) {
                    let overlap_mm = r + s - distance_mm(axis, other);
                    if overlap_mm > OVERLAP_MM {
                        return Some(BrokenConstraint::Blocked { mover: name(*a), other: name(*b), overlap_mm });
                    }
                }
            }
        }
        None
    }
}

/// A part comes from at least this far, mm: the length of a rod's free way beside others.
const WAY_MM: f64 = 70.0;

/// What a module stands off the hub beyond its plugs, mm.
const OFF_HUB_MM: f64 = 30.0;
/// What the top corners' sockets are held over the ends of the struts while they bend, mm.
const OVER_STRUT_MM: f64 = 3.0;
/// Share of the way of the top ring at which its corners are bent; then it comes down.
pub const TOP_BENT: f64 = 0.5;

/// The modules are pressed in along their diagonals: each rod of the bottom ring enters the next corner when both stand off by its hold
/// over √2.
pub fn rods_enter_mm(frame: &Frame) -> f64 {
    frame.corner.corner_socket_depth_mm * std::f64::consts::FRAC_1_SQRT_2
}

/// What keeps modules from being pressed in: a ring that is closed already.
fn shut_by(done: &Done, rings: &[Task]) -> Option<BrokenConstraint> {
    let shut = rings.iter().any(|ring| done.contains(ring));
    shut.then(|| BrokenConstraint::LoopShut { mover: name(Member::HubJoint), onto: name(Member::Hub) })
}

/// For each rod the parts at its ends, as members.
fn far_sockets(skeleton: &Skeleton) -> Vec<(Member, Member)> {
    let mut found = Vec::new();
    for member in Member::ALL.into_iter().filter(|m| m.rod().is_some()) {
        let Some(rod) = skeleton.rods.iter().find(|rod| rod.name == member.body(0)) else { continue };
        for socket in &rod.sockets {
            let part = Member::ALL.into_iter().find(|m| m.part() == Some(socket.part));
            found.extend(part.filter(|_| socket.module == 0 || rod.role.is_cage()).map(|part| (member, part)));
        }
    }
    found
}
