//! Pictures of the fold: each step before and after, and the frame taken apart.
//!
//! They are read without colours, too: what moves is dark, what it is joined to or turned by is of middle brightness, the rest is
//! pale; arrows are black with a white rim.

use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Translation3, Vector3};

use super::arrow::Arrow;
use super::camera::{Camera, View};
use super::labels::Labels;
use super::raster::{self, Fill};
use super::visible::seen_at;
use crate::frame::assembly::{BodyKind, Design};
use crate::frame::fold::{Done, FREE_WAY, FoldBend, FoldSequence, Member, Moment, NEXT_MODULE, Step, TOP_BENT, Task};
use crate::frame::fold::{bent_by, depth, exploded, mesh_at, moment, threading};
use crate::frame::skeleton::{MODULE_NAMES, MODULE_WORDS};
use crate::report::picture::image::{Item, Sketches, corners, encoded, fills_of};
use crate::solid::{Feature, Mesh, MeshSolid};

/// Width and height of a step's picture, pixels.
pub const STEP_SIZE: [u32; 2] = [960, 600];
/// Width and height of the picture of the frame taken apart, pixels.
const EXPLODED_SIZE: [u32; 2] = [1600, 1200];
/// Height of the letters in a picture, pixels.
const LETTERS: f64 = 26.0;
/// Height of the letters beside the parts of the frame taken apart, and of those beside its corners, pixels.
const NAMES: [f64; 2] = [21.0, 30.0];
/// Linear colours of what moves, of what it meets, and of the rest.
pub(super) const COLOURS: [[f32; 4]; 3] = [[0.015, 0.05, 0.2, 1.0], [0.62, 0.33, 0.06, 1.0], [0.86, 0.86, 0.84, 1.0]];
/// What each of these colours is called, and how it is told from the others without colours.
pub(super) const COLOUR_WORDS: [[&str; 2]; 3] =
    [["blue", "the darker in black and white"], ["orange", "the less dark"], ["pale grey", "the palest"]];
/// Places along an arrow.
pub(super) const ARROW_PLACES: usize = 16;
/// Share of the way at which the closing of the bottom ring is shown half done: its rods have entered.
const RING_MEETS: f64 = 0.6;
/// Length of a mark on a rod and how far it stands out of it, mm.
const MARK_MM: [f64; 2] = [1.6, 0.25];
/// Linear colours of a mark on a dark rod and on a pale one.
const MARKS: [[f32; 4]; 2] = [[1.0, 1.0, 1.0, 1.0], [0.0, 0.0, 0.0, 1.0]];
/// Room between layers of the centre when it is taken apart, mm.
const LAYER_MM: f64 = 45.0;

/// Linear colour of a tool.
const PLIERS: [f32; 4] = [0.2, 0.2, 0.2, 1.0];

/// What one of [`COLOURS`] is called, with what it is in black and white.
pub(super) fn colour_words(at: usize) -> String {
    let [colour, in_grey] = COLOUR_WORDS[at];
    format!("{colour} ({in_grey})")
}

/// What the colours of the steps' pictures mean.
pub fn key() -> String {
    let [moves, meets, rest] = [0, 1, 2].map(colour_words);
    format!(
        "In the pictures of the steps what a step brings or bends is {moves}, what that is joined to is {meets}, and the rest is {rest}. A part \
         alone is {}, too. Arrows are black with a white rim, rings that mark a depth are white or black, pliers are dark grey. Cables and wires \
         have colours of their own, which the caption names. Where the frame or a sub-assembly is shown whole, each part has its own colour.",
        COLOUR_WORDS[1][0]
    )
}

/// A picture: red, green, blue bytes, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Its bytes.
    pub rgb: Vec<u8>,
    /// Width and height, pixels.
    pub size: [u32; 2],
}

impl Picture {
    /// As a PNG file.
    pub fn png(&self) -> Vec<u8> {
        encoded(&self.rgb, self.size[0], self.size[1])
    }
}

/// A body in a picture, with a mesh of its own.
pub(super) struct Shown {
    /// In its own axes.
    pub mesh: Arc<Mesh>,
    /// Where it stands.
    pub pose: Isometry3<f64>,
    /// Linear red, green, blue, alpha.
    pub colour: [f32; 4],
}

/// Everything about a step that its pictures need.
struct Stage<'a> {
    design: &'a Design,
    fold: &'a FoldSequence,
    order: Vec<Task>,
    at: usize,
}

/// What is shown of a task between its beginning and its end, as a share of its way, and in words.
pub fn half_way(task: Task) -> Option<(f64, &'static str)> {
    match task {
        Task::ThreadKnee => Some((0.5, "Half done: the leg squeezed flat, the window over it")),
        Task::CloseTriangle => Some((FREE_WAY, "Half done: the leg stands before its bore")),
        Task::CloseRing => Some((RING_MEETS, "Half done: the rods have entered")),
        Task::CloseTop => Some((TOP_BENT, "Half done: the sockets stand over the struts")),
        _ => None,
    }
}

/// A step before and after; with arrows in the first. Between the two, of a step that needs it, half done.
pub fn step(design: &Design, fold: &FoldSequence, at: usize) -> Vec<Picture> {
    let stage = Stage { design, fold, order: fold.order(), at };
    let [before, after] = [stage.moment(0.0), stage.moment(1.0)];
    let [from, to] = [stage.shown(&before), stage.shown(&after)];
    let arrows = stage.arrows();
    let threaded = stage.threaded(&before);
    let between = half_way(stage.step().task).map(|(way, _)| stage.shown(&stage.moment(way))).filter(|_| threaded.is_none());
    let all = [&from, &to].into_iter().chain(&between);
    let mut points: Vec<Point3<f64>> = all.flat_map(|shown| corners(&items(shown))).collect();
    points.extend(arrows.iter().flat_map(|(arrow, _)| &arrow.way));
    let camera = Camera::fit(View::Perspective, false, &points, STEP_SIZE);
    // What does not move is drawn once.
    let mut sketches = Sketches::new(&camera);
    let mut pictures = vec![finished(sketches.fills_of(&items(&from)), &arrows, &camera, STEP_SIZE)];
    pictures.extend(between.iter().map(|shown| finished(sketches.fills_of(&items(shown)), &[], &camera, STEP_SIZE)));
    // Pliers are larger than what they hold: the same direction, and all of them in the picture.
    pictures.extend(threaded.iter().map(|shown| {
        let camera = Camera::fit(View::Perspective, false, &corners(&items(shown)), STEP_SIZE);
        draw(shown, &[], &camera, STEP_SIZE)
    }));
    pictures.push(finished(sketches.fills_of(&items(&to)), &[], &camera, STEP_SIZE));
    pictures
}

/// The frame taken apart, with the names of its parts: those of the centre, and those of the first module, as the others are like it.
pub fn apart(design: &Design, fold: &FoldSequence) -> Picture {
    let rules = fold.rules(&design.frame, &design.skeleton);
    let places = exploded(&rules, &fold.order());
    let mut layers: Vec<(f64, usize)> = Vec::new();
    for (index, body) in design.bodies.iter().enumerate().filter(|(_, body)| body.module.is_none()) {
        let [low, high] = design.placed(body).bounds_mm();
        layers.push((0.5 * (low[2] + high[2]), index));
    }
    layers.sort_by(|a, b| a.0.total_cmp(&b.0));
    let hub = layers.iter().position(|(_, index)| design.bodies[*index].name == Member::Hub.body(0)).unwrap_or(0) as f64;
    let (mut shown, mut named) = (Vec::new(), Vec::new());
    for (index, body) in design.bodies.iter().enumerate() {
        let shape = design.shape(body);
        let layer = layers.iter().position(|(_, i)| *i == index).map_or(0.0, |layer| layer as f64 - hub);
        let member = Member::ALL.into_iter().find(|m| body.module.is_some_and(|module| m.body(module) == body.name));
        let pose = match (member.and_then(|m| places.iter().find(|(p, _)| *p == m)), body.module) {
            (Some((_, pose)), Some(module)) => fold.module.modules.pose(module, pose),
            (None, Some(module)) => over_motor(fold, &places, module) * body.pose,
            _ => Isometry3::translation(0.0, 0.0, layer * LAYER_MM) * body.pose,
        };
        named.push((words_of(&body.name, body.module, matches!(shape.kind, BodyKind::Rod(_))), body.module));
        shown.push(Shown { mesh: shape.mesh.clone(), pose, colour: shape.colour });
    }
    let camera = Camera::fit(View::Perspective, false, &corners(&items(&shown)), EXPLODED_SIZE);
    let mut picture = draw(&shown, &[], &camera, EXPLODED_SIZE);
    let points = seen_at(&items(&shown), &camera, EXPLODED_SIZE);
    let Some(mut labels) = Labels::on(&mut picture.rgb, EXPLODED_SIZE[0]) else { return picture };
    for (module, words) in MODULE_WORDS.iter().enumerate() {
        let corner = Member::Corner(true).body(module);
        let at = design.bodies.iter().position(|body| body.name == corner);
        at.and_then(|at| points[at]).into_iter().for_each(|point| labels.put(words, NAMES[1], point));
    }
    let mut seen: Vec<&str> = Vec::new();
    for ((words, _), point) in named.iter().zip(&points).filter(|((_, module), _)| module.is_none_or(|module| module == 0)) {
        if let (Some(point), false) = (point, seen.contains(&words.as_str())) {
            seen.push(words);
            labels.put(words, NAMES[0], *point);
        }
    }
    picture
}

/// Room between a motor and what is put onto its shaft when all is taken apart, mm.
const OVER_MOTOR_MM: f64 = 25.0;

/// How far what is put onto a motor is off its place when all is taken apart.
fn over_motor(fold: &FoldSequence, places: &[(Member, Isometry3<f64>)], module: usize) -> Isometry3<f64> {
    let home = fold.module.modules.pose(module, &fold.module.place(Member::Motor));
    let apart = places.iter().find(|(member, _)| *member == Member::Motor).map(|(_, pose)| fold.module.modules.pose(module, pose));
    let off = apart.map_or_else(Vector3::zeros, |apart| apart.translation.vector - home.translation.vector);
    Translation3::from(off + Vector3::z() * OVER_MOTOR_MM).into()
}

/// A body's name as words: without its module, and without the number of one among several; a rod is called one.
pub(super) fn words_of(name: &str, module: Option<usize>, is_rod: bool) -> String {
    let own = |part: &&str| module.is_none_or(|module| *part != MODULE_NAMES[module]) && part.parse::<u32>().is_err();
    let mut words: Vec<&str> = name.split('_').filter(own).collect();
    if is_rod {
        words.insert(words.len().min(1), "rod");
    }
    words.join(" ")
}

fn middle_of(mesh: &Mesh) -> Point3<f64> {
    let [low, high] = mesh.bounds_mm();
    Point3::from((Vector3::from(low) + Vector3::from(high)) * 0.5)
}

/// Bodies as the rasteriser takes them.
pub(super) fn items(shown: &[Shown]) -> Vec<Item<'_>> {
    shown.iter().map(|s| Item { mesh: &s.mesh, pose: s.pose, colour: s.colour }).collect()
}

/// Bodies with arrows, each with a label or none.
pub(super) fn draw(shown: &[Shown], arrows: &[(Arrow, String)], camera: &Camera, size: [u32; 2]) -> Picture {
    finished(fills_of(&items(shown), camera), arrows, camera, size)
}

/// A picture of what is drawn of its bodies, with its arrows.
fn finished(mut fills: Vec<Fill>, arrows: &[(Arrow, String)], camera: &Camera, size: [u32; 2]) -> Picture {
    fills.extend(arrows.iter().flat_map(|(arrow, _)| arrow.fills(camera)));
    let [width, height] = size.map(|s| s as usize);
    let mut rgb = raster::rgb(&fills, width, height);
    if let Some(mut labels) = Labels::on(&mut rgb, size[0]) {
        for (arrow, label) in arrows.iter().filter(|(_, label)| !label.is_empty()) {
            let [x, y, _] = camera.project(&arrow.way[(arrow.way.len() - 1) / 2]);
            labels.put(label, LETTERS, [x, y]);
        }
    }
    Picture { rgb, size }
}

impl Stage<'_> {
    fn step(&self) -> &Step {
        &self.fold.steps[self.at]
    }

    fn done(&self) -> Done {
        self.order[..self.at].iter().copied().collect()
    }

    fn moment(&self, way: f64) -> Moment {
        let rules = self.fold.rules(&self.design.frame, &self.design.skeleton);
        moment(&rules, &self.order, &self.done(), (self.order[self.at], way))
    }

    /// The fork's leg on its way through the window, with the pliers that pull it; none of other steps.
    fn threaded(&self, before: &Moment) -> Option<Vec<Shown>> {
        let all = (self.step().task == Task::ThreadKnee).then(|| threading(self.design, &before.pose(Member::Fork))).flatten()?;
        let colours = [COLOURS[0], COLOURS[1], PLIERS];
        Some(all.into_iter().zip(colours).map(|((mesh, pose), colour)| Shown { mesh, pose, colour }).collect())
    }

    /// Whether the step is about the whole frame.
    fn is_whole(&self) -> bool {
        self.order[..=self.at].contains(&Task::PlugHub)
    }

    /// What moves, and what it meets.
    fn actors(&self) -> [Vec<Member>; 2] {
        let task = self.step().task;
        let mut moving: Vec<Member> = task.contacts().into_iter().map(|(mover, _)| mover).collect();
        let mut meets: Vec<Member> = task.contacts().into_iter().map(|(_, onto)| onto).collect();
        if let Some((part, lever)) = task.lever() {
            moving.push(part);
            meets.push(lever);
        }
        match task {
            Task::PlugHub => moving.push(Member::Cage(false)),
            Task::CloseRing => {
                moving.extend([Member::HubJoint, Member::Cage(false)]);
                meets.extend([Member::Hub, Member::Corner(false)]);
            }
            Task::CloseTop => moving.push(Member::Cage(true)),
            _ => {}
        }
        [moving, meets]
    }

    fn shown(&self, moment: &Moment) -> Vec<Shown> {
        let rules = self.fold.rules(&self.design.frame, &self.design.skeleton);
        let done: Done = self.order[..=self.at].iter().copied().collect();
        let [moving, meets] = self.actors();
        let anchors = moving.iter().chain(&meets);
        let members: Vec<Member> = anchors.flat_map(|m| rules.component(*m, &done)).collect();
        let modules = if self.is_whole() { MODULE_NAMES.len() } else { 1 };
        let mut shown = Vec::new();
        for member in Member::ALL.into_iter().filter(|m| members.contains(m) && *m != Member::Hub) {
            let folds = moment.folds.iter().find(|(m, _)| *m == member).map_or(&[][..], |(_, folds)| folds);
            let mesh_in = |module| mesh_at(self.design, &self.fold.module, (member, module), folds);
            let Some(first) = mesh_in(0) else { continue };
            let colour = COLOURS[if moving.contains(&member) {
                0
            } else if meets.contains(&member) {
                1
            } else {
                2
            }];
            shown.extend((0..modules).map(|module| {
                // Cage rods may be of two lengths.
                let mesh = if matches!(member, Member::Cage(_)) { mesh_in(module) } else { None };
                let pose = self.fold.module.modules.pose(module, &moment.pose(member));
                Shown { mesh: mesh.unwrap_or_else(|| first.clone()), pose, colour }
            }));
            for at in self.marks(member) {
                let mark = Arc::new(mark(0.5 * self.design.frame.rods.rod_diameter_mm).mesh());
                shown.extend((0..modules).map(|module| {
                    let pose = self.fold.module.modules.pose(module, &moment.pose(member)) * Isometry3::translation(0.0, 0.0, at);
                    Shown { mesh: mark.clone(), pose, colour: MARKS[usize::from(!moving.contains(&member))] }
                }));
            }
        }
        for body in self.design.bodies.iter().filter(|body| self.is_whole() && body.module.is_none()) {
            let colour = COLOURS[if meets.contains(&Member::Hub) && body.name == Member::Hub.body(0) { 1 } else { 2 }];
            shown.push(Shown { mesh: self.design.shape(body).mesh.clone(), pose: body.pose, colour });
        }
        shown
    }

    /// Places along a rod of the first module, from its start, at which the mouths of the bores are that it is pushed into, mm.
    fn marks(&self, member: Member) -> Vec<f64> {
        let (task, skeleton) = (self.step().task, &self.design.skeleton);
        let own = task.contacts().into_iter().filter_map(|(a, b)| if a == member { Some(b) } else { (b == member).then_some(a) });
        let next = task.closes_ring().filter(|up| member == Member::Cage(*up)).map(|up| (Member::Corner(up), NEXT_MODULE));
        let all = own.map(|part| (part, 0)).chain(next);
        all.filter_map(|(part, module)| depth(skeleton, member, (part, module))).map(|depth| depth.along_mm).collect()
    }

    /// Arrows of the step's moves, with the angles of its bends.
    fn arrows(&self) -> Vec<(Arrow, String)> {
        let straight = |member: Member| {
            let way = along(&self.traced(member, self.middle(member)));
            (if member.rod().is_some() { beside(&way) } else { way }, String::new())
        };
        let ways = match self.step().task {
            Task::BendLeg => {
                let leg = Point3::new(0.0, 0.0, 0.6 * self.rod_mm(Member::Leg));
                vec![(self.traced(Member::Leg, leg), self.angle(Member::HubJoint, 0))]
            }
            Task::CloseTriangle => {
                let foot = Member::Corner(false);
                vec![
                    (self.traced(foot, cage_tip()), self.angle(foot, 0)),
                    (self.bent(foot, 1), self.angle(foot, 1)),
                    (along(&self.traced(Member::Fork, Point3::origin())), String::new()),
                ]
            }
            Task::CloseTop => {
                let top = Member::Corner(true);
                vec![(self.bent(top, 0), self.angle(top, 0)), straight(top)]
            }
            Task::PlugHub | Task::CloseRing => vec![straight(Member::HubJoint)],
            _ => self.actors()[0].iter().map(|member| straight(*member)).collect(),
        };
        let modules = if self.is_whole() { MODULE_NAMES.len() } else { 1 };
        let in_module = |module: usize, way: &[Point3<f64>]| {
            let there = self.fold.module.modules.pose(module, &Isometry3::identity());
            Arrow { way: way.iter().map(|p| there * p).collect() }
        };
        let all = ways.iter().flat_map(|(way, label)| (0..modules).map(move |module| (in_module(module, way), label.clone())));
        all.collect()
    }

    /// The way of a point of a member.
    fn traced(&self, member: Member, point: Point3<f64>) -> Vec<Point3<f64>> {
        (0..=ARROW_PLACES).map(|i| self.moment(i as f64 / ARROW_PLACES as f64).pose(member) * point).collect()
    }

    /// The way of a socket beyond a hinge while that alone is bent.
    fn bent(&self, member: Member, index: usize) -> Vec<Point3<f64>> {
        let (pose, module) = (self.moment(0.0).pose(member), &self.fold.module);
        let (Some(bend), Some(fold)) = (module.bends(member).get(index), self.fold_of(member, index)) else { return Vec::new() };
        let tip = if index == 0 { -SOCKET_TIP_MM } else { SOCKET_TIP_MM };
        let deg = |i: usize| fold.from_deg + (fold.to_deg - fold.from_deg) * i as f64 / ARROW_PLACES as f64;
        (0..=ARROW_PLACES).map(|i| pose * bent_by(bend, deg(i)).motion() * Point3::new(tip, tip, 0.0)).collect()
    }

    /// What the step does to a member's hinge.
    fn fold_of(&self, member: Member, index: usize) -> Option<&FoldBend> {
        self.step().bends.iter().filter(|bend| bend.body == member.body(0)).nth(index)
    }

    /// By how much the step bends a member's hinge, in words.
    fn angle(&self, member: Member, index: usize) -> String {
        self.fold_of(member, index).map_or(String::new(), |bend| format!("{:.0}°", bend.to_deg - bend.from_deg))
    }

    fn rod_mm(&self, member: Member) -> f64 {
        member.rod().map_or(0.0, |role| self.design.skeleton.length_mm(role))
    }

    /// Middle of a member in its own axes.
    fn middle(&self, member: Member) -> Point3<f64> {
        let body = self.design.bodies.iter().find(|body| body.name == member.body(0));
        body.map_or(Point3::origin(), |body| middle_of(&self.design.shape(body).mesh))
    }
}

/// Along both axes of a corner: the end of the socket of its strut (negative) and of its leg, mm.
const SOCKET_TIP_MM: f64 = 20.0;

/// From the axis of a rod to the arrow beside it, mm.
const BESIDE_MM: f64 = 5.0;

/// A straight way beside itself as it is seen: along a rod an arrow would cover the rod's end and the ring on it.
fn beside(way: &[Point3<f64>]) -> Vec<Point3<f64>> {
    let (Some(first), Some(last)) = (way.first(), way.last()) else { return Vec::new() };
    let aside = (last - first).cross(&View::Perspective.towards()).try_normalize(1e-9).unwrap_or_default() * BESIDE_MM;
    way.iter().map(|point| point + aside).collect()
}

/// A place of a corner that shows how it turns: beyond a cage socket.
fn cage_tip() -> Point3<f64> {
    Point3::new(0.0, 24.0, 0.0)
}

/// A ring around a rod.
fn mark(radius_mm: f64) -> MeshSolid {
    let [length, out] = MARK_MM;
    MeshSolid::build(&Feature::cylinder(radius_mm + out, length).at(0.0, 0.0, -0.5 * length))
}

/// Shortest arrow, mm.
const SHORTEST_MM: f64 = 30.0;

/// The middle half of a straight way; a very short one longer, around its middle.
fn along(way: &[Point3<f64>]) -> Vec<Point3<f64>> {
    let (Some(first), Some(last)) = (way.first(), way.last()) else { return Vec::new() };
    let whole = last - first;
    let grown = (SHORTEST_MM / whole.norm().max(1e-9)).max(0.6);
    let middle = nalgebra::center(first, last);
    (0..=ARROW_PLACES).map(|i| middle + whole * (grown * (i as f64 / ARROW_PLACES as f64 - 0.5))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The words are those of the colours: which part is strongest, and which is darker.
    #[test]
    fn analytic_colours_are_what_their_words_say() {
        let [[red, green, blue, _], [warm_red, warm_green, warm_blue, _], [pale_red, _, pale_blue, _]] = COLOURS;
        let brightness = COLOURS.map(|[r, g, b, _]| 0.21 * r + 0.72 * g + 0.07 * b);
        assert_eq!(COLOUR_WORDS.map(|[colour, _]| colour), ["blue", "orange", "pale grey"]);
        assert!(blue > 2.0 * red.max(green) && warm_red > 1.5 * warm_green && warm_green > 2.0 * warm_blue);
        assert!((pale_red - pale_blue).abs() < 0.05 && brightness[0] < brightness[1] && brightness[1] < brightness[2]);
        assert!(COLOUR_WORDS.iter().flatten().all(|word| key().contains(word)));
    }
}
