//! The fold sequence: its order, its checker, its closure, and the animation that shows it.

use crate::common;
use std::collections::BTreeMap;
use std::sync::Arc;

use flexframe::export::{fold_glb, glb, stl};
use flexframe::frame::assembly::{Design, mass};
use flexframe::frame::fold::{BrokenConstraint, FlatError, FlatState, FoldError, FoldSequence, Member, STEP_S, TABLE_MM, Task, sweeps};
use flexframe::frame::mounting::{Mounting, PartLine};
use flexframe::frame::skeleton::Skeleton;
use flexframe::params::{Frame, PartName};
use flexframe::report::booklet::content::Booklet;
use flexframe::report::booklet::{booklet_html, booklet_pdf};
use flexframe::solid::{Feature, Mesh, MeshSolid};
use gltf::animation::util::ReadOutputs;
use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

fn preset(name: &str) -> (Frame, Skeleton) {
    let frame = Frame::load(name).expect("a preset").0;
    let skeleton = Skeleton::new(&frame).expect("closes");
    (frame, skeleton)
}

#[test]
fn analytic_whatever_the_candidates_order_a_valid_sequence_is_found() {
    let (frame, skeleton) = preset("cognifly-v8");
    let fold = FoldSequence::new(&frame, &skeleton).expect("can be folded");
    let rules = fold.rules(&frame, &skeleton);
    assert_eq!(rules.check(&fold.order()), []);
    let mut candidates = Task::ALL.to_vec();
    for turn in 0..candidates.len() {
        candidates.rotate_left(1);
        candidates.swap(turn, (7 * turn + 3) % Task::ALL.len());
        let order = rules.order(&candidates).expect("there is an order");
        assert_eq!(rules.check(&order), [], "{order:?}");
    }
}

/// One of three screws is above the leg once the mount is on the arms.
#[test]
fn planted_a_motor_with_three_holes_is_seated_before_its_mount_goes_onto_the_arms() {
    let mut frame = Frame::load("cognifly").expect("a preset").0;
    let of = |frame: &Frame| {
        let design = Design::with(frame.clone(), common::memo()).expect("designs");
        let fold = FoldSequence::new(frame, &design.skeleton).expect("can be folded");
        assert_eq!(fold.rules(frame, &design.skeleton).check(&fold.order()), []);
        let at = |task: Task| fold.steps.iter().position(|step| step.task == task).expect("a step");
        let [motor, mount, triangle] = [Task::SeatMotor, Task::SlideMount, Task::CloseTriangle].map(at);
        let takes = Mounting::new(&design, &fold).fold_parts;
        let lists = |step: usize, part: &str| takes[step].iter().any(|line| line.part == part);
        let listed = ["motor", "motor_screw", "motor_mount"].map(|part| lists(motor, part) && !lists(mount, part));
        let placed = [motor, triangle].map(|step| fold.steps[step].caution.as_ref().is_some_and(|text| text.contains("cyanoacrylate")));
        (motor < mount, listed, placed, met(&design))
    };
    assert_eq!(of(&frame), (false, [true, true, false], [true, false], Vec::new()));
    frame.bought.get_mut("motor").expect("has one").part.hole_count = Some(3);
    assert_eq!(of(&frame), (true, [true, true, true], [false, true], Vec::new()));
}

#[test]
fn measured_the_hinges_fold_as_those_of_the_real_frame() {
    let (frame, skeleton) = preset("cognifly-v8");
    let fold = FoldSequence::new(&frame, &skeleton).expect("can be folded");
    let ends: BTreeMap<String, f64> =
        fold.steps.iter().flat_map(|s| &s.bends).map(|b| (format!("{} {}", b.body, b.hinge), b.to_deg)).collect();
    let expected =
        [("bottom_corner_FR leg", 28.1), ("bottom_corner_FR strut", 115.0), ("hub_joint_FR necks", 28.1), ("top_corner_FR strut", 115.0)];
    for (hinge, deg) in expected {
        assert!((ends[hinge] - deg).abs() < 0.1, "{hinge}: {}", ends[hinge]);
    }
    assert_eq!(ends.len(), expected.len());
}

#[test]
fn planted_swapped_and_missing_steps_break_a_named_constraint() {
    let (frame, skeleton) = preset("cognifly");
    let fold = FoldSequence::new(&frame, &skeleton).expect("can be folded");
    let rules = fold.rules(&frame, &skeleton);
    let without = |task: Task| fold.order().into_iter().filter(|t| *t != task).collect::<Vec<_>>();
    let moved = |task: Task, before: Option<Task>| {
        let mut order = without(task);
        let at = before.map_or(order.len(), |before| order.iter().position(|t| *t == before).expect("is there"));
        order.insert(at, task);
        rules.check(&order).into_iter().map(|(_, broken)| broken).collect::<Vec<_>>()
    };
    let says =
        |found: &[BrokenConstraint], words: &str| assert!(found.iter().any(|b| b.to_string().contains(words)), "{words}: {found:#?}");
    says(&moved(Task::SlideMount, None), "close both its ends");
    says(&moved(Task::ThreadKnee, None), "close both its ends");
    says(&moved(Task::PushTopCage, None), "both its ends are closed");
    says(&moved(Task::BendLeg, Some(Task::PushLeg)), "springs back");
    says(&moved(Task::BendLeg, Some(Task::CloseTriangle)), "runs into");
    says(&moved(Task::CloseTriangle, Some(Task::PushFoot)), "closes nothing");
    says(&moved(Task::CloseTriangle, Some(Task::CloseRing)), "closed and rigid");
    says(&moved(Task::PlugHub, None), "already held");
    says(&moved(Task::CloseTop, Some(Task::CloseRing)), "closes nothing");
    says(&moved(Task::PushBottomCage, Some(Task::CloseRing)), "both its ends are closed");
    says(&moved(Task::PushFoot, None), "already held");
    for task in Task::ALL {
        let found = rules.check(&without(task));
        assert!(found.contains(&(task, BrokenConstraint::Times { task, times: 0 })), "{task:?}: {found:?}");
    }
}

/// Frames drawn with a fixed seed, about one number in six of a preset changed.
fn random_frames(count: usize) -> Vec<Frame> {
    let mut runner = TestRunner::new_with_rng(Config::default(), TestRng::from_seed(RngAlgorithm::ChaCha, &[3; 32]));
    let mut frames = Vec::new();
    for base in ["cognifly", "cognifly-v8", "cognifly-mini", "cognifly-1106"].iter().cycle() {
        let preset = common::resolve(&common::toml(base, &[])).expect("a preset");
        let mut changes = Vec::new();
        for p in flexframe::params::parameters().filter(|p| p.table != "limits") {
            let (lot, way) = (0..6u32, -0.4..0.4f64).new_tree(&mut runner).expect("a strategy").current();
            let Some(value) = preset.value(p.table, p.key).filter(|_| lot == 0) else { continue };
            let room = if way > 0.0 { p.max - value } else { value - p.min };
            changes.push((format!("{}.{}", p.table, p.key), ((value + way * room) * 1000.0).round() / 1000.0));
        }
        frames.extend(common::resolve(&common::toml(base, &changes)).ok().filter(|frame| Skeleton::new(frame).is_ok()));
        if frames.len() == count {
            return frames;
        }
    }
    frames
}

#[test]
fn analytic_random_frames_fold_or_say_why_not() {
    let (mut folded, mut refused) = (0, BTreeMap::<String, usize>::new());
    for frame in random_frames(160) {
        let skeleton = Skeleton::new(&frame).expect("closes");
        let fold = match FoldSequence::new(&frame, &skeleton) {
            Ok(fold) => fold,
            Err(error) => {
                let kind = match &error {
                    FoldError::Linkage(_) => "linkage".into(),
                    FoldError::PlugTooShort { .. } => "plug".into(),
                    FoldError::NoOrder { .. } => error.to_string(),
                };
                *refused.entry(kind).or_insert(0) += 1;
                continue;
            }
        };
        folded += 1;
        assert_eq!(fold.rules(&frame, &skeleton).check(&fold.order()), []);
        let error_mm = fold.steps.iter().filter_map(|s| s.loop_error_mm).fold(0.0, f64::max);
        assert!(error_mm < 0.05, "{error_mm}");
        let closed = fold.module.closed();
        for rod in skeleton.rods.iter().filter(|r| r.sockets[0].module == 0) {
            let member = Member::ALL.into_iter().find(|m| m.body(0) == rod.name).expect("a member");
            let start = fold.module.modules.pose(0, &fold.module.pose(member, &closed)) * Point3::origin();
            assert!((start - rod.start).norm() < 1e-6, "{}", rod.name);
        }
    }
    println!("{folded} folded, refused: {refused:#?}");
    assert!(folded >= 100, "{folded} folded, refused: {refused:#?}");
}

/// The transforms of a file's nodes at a time of an animation, evaluated here and not by the program.
struct Played<'a> {
    document: &'a gltf::Document,
    blob: &'a [u8],
}

impl Played<'_> {
    fn local(&self, animation: Option<(&str, f32)>) -> BTreeMap<usize, Isometry3<f64>> {
        let rest = |node: gltf::Node| {
            let (at, turn, _) = node.transform().decomposed();
            (node.index(), (at, turn))
        };
        let mut locals: BTreeMap<usize, ([f32; 3], [f32; 4])> = self.document.nodes().map(rest).collect();
        if let Some((name, time)) = animation {
            let animation = self.document.animations().find(|a| a.name() == Some(name)).expect("the animation");
            for channel in animation.channels() {
                let reader = channel.reader(|_| Some(self.blob));
                let times: Vec<f32> = reader.read_inputs().expect("times").collect();
                let after = times.iter().position(|t| *t >= time).unwrap_or(times.len() - 1);
                let before = after.saturating_sub(1);
                let span = times[after] - times[before];
                let t = if span > 0.0 { ((time - times[before]) / span).clamp(0.0, 1.0) } else { 1.0 };
                let local = locals.get_mut(&channel.target().node().index()).expect("a node");
                match reader.read_outputs().expect("values") {
                    ReadOutputs::Translations(all) => {
                        let all: Vec<[f32; 3]> = all.collect();
                        local.0 = [0, 1, 2].map(|i| all[before][i] + t * (all[after][i] - all[before][i]));
                    }
                    ReadOutputs::Rotations(all) => {
                        let all: Vec<[f32; 4]> = all.into_f32().collect();
                        let q = |v: [f32; 4]| UnitQuaternion::from_quaternion(Quaternion::new(v[3], v[0], v[1], v[2]));
                        let turned = q(all[before]).slerp(&q(all[after]), t);
                        local.1 = [turned.i, turned.j, turned.k, turned.w];
                    }
                    // What is hidden has no size; where it stands is the same.
                    ReadOutputs::Scales(_) => {}
                    _ => panic!("only turns, moves and sizes"),
                }
            }
        }
        let pose = |(at, turn): ([f32; 3], [f32; 4])| {
            let [x, y, z, w] = turn.map(f64::from);
            Isometry3::from_parts(Translation3::from(at.map(f64::from)), UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)))
        };
        locals.into_iter().map(|(index, local)| (index, pose(local))).collect()
    }

    fn global(&self, animation: Option<(&str, f32)>) -> BTreeMap<String, Isometry3<f64>> {
        let locals = self.local(animation);
        let mut found = BTreeMap::new();
        let scene = self.document.default_scene().expect("a scene");
        let mut open: Vec<(gltf::Node, Isometry3<f64>)> = scene.nodes().map(|node| (node, Isometry3::identity())).collect();
        while let Some((node, above)) = open.pop() {
            let pose = above * locals[&node.index()];
            found.insert(node.name().unwrap_or_default().to_string(), pose);
            open.extend(node.children().map(|child| (child, pose)));
        }
        found
    }
}

#[test]
fn analytic_the_animation_ends_in_the_assembled_frame() {
    let design = Design::with(Frame::load("cognifly").expect("a preset").0, common::memo()).expect("designs");
    let sequence = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
    let bytes = fold_glb::fold(&design, &sequence).expect("a file");
    let still = glb::frame(&design, &mass::table(&design)).expect("a file");
    let (moving, frame) = (gltf::Gltf::from_slice(&bytes).expect("reads"), gltf::Gltf::from_slice(&still).expect("reads"));
    let played = Played { document: &moving.document, blob: moving.blob.as_deref().expect("a chunk") };
    let stands = Played { document: &frame.document, blob: frame.blob.as_deref().expect("a chunk") };
    let mounts = Mounting::new(&design, &sequence).steps().count();
    assert_eq!(moving.animations().count(), mounts + sequence.steps.len() + 1);
    let wanted = stands.global(None);
    for shown in [played.global(Some(("all", 1e9))), played.global(None)] {
        for body in &design.bodies {
            let (a, b) = (shown[&body.name], wanted[&body.name]);
            for corner in [Point3::origin(), Point3::from(Vector3::repeat(0.05))] {
                assert!((a * corner - b * corner).norm() < 1e-5, "{}", body.name);
            }
        }
    }
    strut_side_follows(&played, &design);
    let (from, to) = (played.global(Some(("all", 0.0))), played.global(Some(("all", 1e9))));
    assert!((from["fork_FR"].translation.vector - to["fork_FR"].translation.vector).norm() > 0.05, "it moves");
}

/// The last joint of a chain stands where the rigid motion of the bend takes the strut's side.
fn strut_side_follows(played: &Played, design: &Design) {
    let shown = played.global(Some(("all", 1e9)));
    let part = design.part(PartName::TopCorner).expect("is printed");
    let joint = shown
        .iter()
        .filter(|(name, _)| name.starts_with("top_corner_FR_strut_"))
        .max_by_key(|(name, _)| name.len() * 100 + name.chars().last().map_or(0, |c| c as usize));
    let (_, last) = joint.expect("has a chain");
    let motion = shown["top_corner_FR"].rotation * part.bends[0].motion().rotation;
    assert!(motion.angle_to(&last.rotation) < 1e-4, "{}", motion.angle_to(&last.rotation));
}

/// Corners of a skin at a time, mm, evaluated here.
fn skinned(played: &Played, node: &str, at: Option<(&str, f32)>) -> Vec<Point3<f64>> {
    let node = played.document.nodes().find(|n| n.name() == Some(node)).expect("a node");
    let (mesh, skin) = (node.mesh().expect("a mesh"), node.skin().expect("a skin"));
    let global = played.global(at);
    let reader = skin.reader(|_| Some(played.blob));
    let binds: Vec<[[f32; 4]; 4]> = reader.read_inverse_bind_matrices().expect("matrices").collect();
    let joints: Vec<Isometry3<f64>> = skin
        .joints()
        .zip(binds)
        .map(|(joint, bind)| {
            global[joint.name().expect("named")] * Translation3::new(bind[3][0].into(), bind[3][1].into(), bind[3][2].into())
        })
        .collect();
    let primitive = mesh.primitives().next().expect("a primitive");
    let reader = primitive.reader(|_| Some(played.blob));
    let weights = reader.read_weights(0).expect("weights").into_f32();
    let places = reader.read_joints(0).expect("joints").into_u16();
    let corners = reader.read_positions().expect("positions");
    let moved = corners.zip(places).zip(weights).map(|((p, joint), weight)| {
        let p = Point3::from(p.map(f64::from));
        let sum: Vector3<f64> = (0..4).map(|i| (joints[usize::from(joint[i])] * p).coords * f64::from(weight[i])).sum();
        Point3::from(sum * 1000.0)
    });
    moved.collect()
}

#[test]
fn analytic_skins_bend_into_the_folded_parts() {
    let design = Design::with(Frame::load("cognifly").expect("a preset").0, common::memo()).expect("designs");
    let sequence = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
    let bytes = fold_glb::fold(&design, &sequence).expect("a file");
    let moving = gltf::Gltf::from_slice(&bytes).expect("reads");
    let played = Played { document: &moving.document, blob: moving.blob.as_deref().expect("a chunk") };
    for name in ["hub_joint", "top_corner", "bottom_corner"] {
        let points = skinned(&played, &format!("{name}_FR_skin"), Some(("all", 1e9)));
        let body = design.bodies.iter().find(|b| b.name == format!("{name}_FR")).expect("a body");
        let [low, high] = design.placed(body).bounds_mm();
        // The file's axes: X left, Y up, Z front.
        for (axis, sign, along) in [(0, -1.0, 0), (1, 1.0, 2), (2, 1.0, 1)] {
            let values: Vec<f64> = points.iter().map(|p| sign * p[along]).collect();
            let (least, most) = values.iter().fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(*v), b.max(*v)));
            assert!((least - low[axis]).abs() < 0.3 && (most - high[axis]).abs() < 0.3, "{name} {axis}: {least} {most} {low:?} {high:?}");
        }
    }
}

/// Steps of a design in which bodies meet, with their names.
fn met(design: &Design) -> Vec<(Task, [String; 2])> {
    let sequence = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
    let found = sweeps(design, &sequence);
    let steps = sequence.steps.iter().zip(found);
    steps.flat_map(|(step, sweep)| sweep.meetings.into_iter().map(|m| (step.task, m.bodies))).collect()
}

fn designed(name: &str) -> Design {
    Design::with(Frame::load(name).expect("a preset").0, common::memo()).expect("designs")
}

#[test]
fn analytic_nothing_is_in_the_way() {
    for preset in ["cognifly", "cognifly-v8"] {
        assert_eq!(met(&designed(preset)), [], "{preset}");
    }
}

#[test]
fn planted_something_is_in_the_way() {
    // A lump on the motor mount, where the leg swings and the arms end.
    let mut lump = designed("cognifly");
    let mount = lump.printed.iter_mut().find(|part| part.name == PartName::MotorMount).expect("is printed");
    mount.flat = mount.flat.union(&MeshSolid::build(&Feature::sphere(9.0).at(0.0, 0.0, -20.0)));
    let found = met(&lump);
    assert!(found.iter().any(|(task, [a, b])| *task == Task::SlideMount && a.contains("mount") != b.contains("mount")), "{found:?}");
    // Something of the centre where a hub joint comes in: seen only while the ring is closed.
    let mut centre = designed("cognifly");
    let body = centre.bodies.iter_mut().find(|body| body.name == "battery").expect("has one");
    body.pose.translation.vector += Vector3::new(40.0, 40.0, 30.0);
    let found = met(&centre);
    let ring = [Task::PlugHub, Task::CloseRing];
    assert!(!found.is_empty() && found.iter().all(|(task, _)| ring.contains(task)), "{found:?}");
    assert!(found.iter().all(|(_, bodies)| bodies.contains(&"battery".into())), "{found:?}");
}

#[test]
fn planted_flat_states() {
    let design = designed("cognifly");
    let flat = FlatState::new(&design);
    assert_eq!(flat.check(&design), []);
    let at = |name: &str| flat.lying.iter().position(|l| l.body == name).expect("lies there");
    let (knee, corner) = (at("knee_FR"), at("top_corner_FR"));
    let changed = |change: &dyn Fn(&mut FlatState)| {
        let mut state = flat.clone();
        change(&mut state);
        state.check(&design)
    };
    let off = changed(&|s| s.lying[knee].at.translation.vector.y += TABLE_MM[1]);
    assert!(matches!(&off[..], [FlatError::OffTable { body, .. }] if body == "knee_FR"), "{off:?}");
    let high = changed(&|s| s.lying[knee].at.translation.vector.z += 1.0);
    assert!(matches!(&high[..], [FlatError::NotResting { .. }]), "{high:?}");
    let both = changed(&|s| s.lying[knee].at = s.lying[corner].at);
    assert!(both.iter().any(|e| matches!(e, FlatError::Overlap { bodies, .. } if bodies.contains(&"top_corner_FR".into()))), "{both:?}");
    let folded: Arc<Mesh> = design.part(PartName::TopCorner).expect("is printed").folded.mesh().into();
    let bent = changed(&|s| s.lying[corner].mesh = folded.clone());
    assert!(bent.iter().any(|e| matches!(e, FlatError::NotAsPrinted { part: "top_corner", .. })), "{bent:?}");
    for lying in &flat.lying {
        let name = lying.body.trim_end_matches("_FR");
        let Some(part) = design.printed.iter().find(|part| part.name.slug() == name) else { continue };
        let (lies, written) = (stl::binary(&lying.mesh).expect("bytes"), stl::binary(&part.mesh).expect("bytes"));
        assert!(lies == written, "{name}");
    }
}

/// When a body changes between hidden and seen in an animation, s: empty for one that is seen throughout.
fn sizes(moving: &gltf::Gltf, animation: &str, body: &str) -> Vec<(f32, f32)> {
    let animation = moving.animations().find(|other| other.name() == Some(animation)).expect("the animation");
    let found = animation.channels().find_map(|channel| {
        let reader = channel.reader(|_| moving.blob.as_deref());
        let of = channel.target().node().name() == Some(body);
        match reader.read_outputs().filter(|_| of)? {
            ReadOutputs::Scales(sizes) => Some(reader.read_inputs()?.zip(sizes.map(|size| size[0])).collect::<Vec<_>>()),
            _ => None,
        }
    });
    found.unwrap_or_default()
}

/// Nothing is seen before its step; from then on it is, unless a step has it out of the frame; in the end all is.
#[test]
fn analytic_things_are_seen_from_their_step_on_unless_they_are_out() {
    let design = Design::with(Frame::load("cognifly").expect("a preset").0, common::memo()).expect("designs");
    let sequence = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
    let mounting = Mounting::new(&design, &sequence);
    let moving = gltf::Gltf::from_slice(&fold_glb::fold(&design, &sequence).expect("a file")).expect("reads");
    let last = mounting.before.len() + sequence.steps.len() + mounting.after.len() - 1;
    let out = &mounting.after.last().expect("a step").taken_out;
    assert!(out.iter().any(|body| body == "battery"), "{out:?}");
    for body in &design.bodies {
        let first = mounting.first_step(&sequence, &body.name).expect("a step is about it");
        let is_out = out.contains(&body.name);
        let seen_in = |step: usize| step >= first && !(is_out && step == last);
        for (at_s, size) in sizes(&moving, "all", &body.name) {
            let step = (f64::from(at_s) / STEP_S).round() as usize;
            assert_eq!(size == 1.0, seen_in(step), "{} in step {step}", body.name);
        }
        assert_eq!(sizes(&moving, "all", &body.name).is_empty(), first == 0 && !is_out, "{}", body.name);
        let of_last: Vec<f32> =
            sizes(&moving, &format!("{:02} Propellers", last + 1), &body.name).into_iter().map(|(_, size)| size).collect();
        assert_eq!(of_last, if is_out { vec![0.0; 2] } else { Vec::new() }, "{}", body.name);
    }
}

#[test]
fn regress_instructions_have_every_step_and_need_nothing_else() {
    let design = designed("cognifly-mini");
    let sequence = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
    let mounting = Mounting::new(&design, &sequence);
    let booklet = Booklet::new(&design, &mass::table(&design), &sequence, &[]);
    let page = booklet_html::html(&booklet);
    assert!(!page.contains("http") && !page.contains("<script"), "fetches something");
    assert_eq!(page.matches("<section>").count(), sequence.steps.len());
    assert_eq!(page.matches("<section class=\"parts-and-rods\">").count(), 1);
    assert_eq!(page.matches("<section class=\"assembly\">").count(), 3);
    assert_eq!(page.matches("<section class=\"half\">").count(), mounting.steps().count());
    // No step of the wires stands below the heading of the cartridge.
    let heading = page.find("The battery cartridge").expect("has a heading");
    assert!(page.find(". Motor wires</h2>").is_some_and(|wires| wires < heading), "the wires come after the heading");
    for step in &sequence.steps {
        assert!(page.contains(step.title) && step.caution.as_deref().is_none_or(|caution| page.contains(caution)), "{}", step.title);
    }
    for bend in sequence.steps.iter().flat_map(|s| &s.bends) {
        assert!(page.contains(&format!("to {:.0}°", bend.to_deg)), "{bend:?}");
    }
    assert!(page.contains("of carbon. Its dust harms lungs") && page.contains("Never glue"));
    // A screw is drawn beside the step that takes it, and on the page of its sub-assembly.
    let is_screw = |line: &&PartLine| line.screw_mm.is_some();
    let in_steps = mounting.parts().filter(is_screw).count();
    let in_assemblies = booklet.assemblies.iter().flat_map(|of| &of.parts).map(|(_, line)| line).filter(is_screw).count();
    assert!(in_steps > 1, "{in_steps}");
    assert_eq!(page.matches("<svg class=\"screw\"").count(), in_steps + in_assemblies);
    let (once, again) = (booklet_pdf::pdf(&booklet).expect("a file"), booklet_pdf::pdf(&booklet).expect("a file"));
    assert!(once.starts_with(b"%PDF-") && once == again);
}

/// The distance that a person measures is that between the meshes of mount and fork, beside the rods that both stand on.
#[test]
fn analytic_the_mount_stands_where_the_instructions_say() {
    for name in ["cognifly", "cognifly-mini"] {
        let design = designed(name);
        let sequence = FoldSequence::new(&design.frame, &design.skeleton).expect("can be folded");
        let step = sequence.steps.iter().find(|step| step.title == "Motor onto its mount").expect("a step");
        let caution = step.caution.as_deref().expect("says where");
        let told_mm: f64 =
            caution.split("until ").nth(1).and_then(|rest| rest.split(' ').next()).expect("a number").parse().expect("a number");
        let half_pitch_mm = 0.5 * design.frame.hub_joint.arm_pitch_mm;
        // Along the diagonal to the front right, of what lies at the height of the arms beside one of them.
        let reach = |body: &str| -> [f64; 2] {
            let mesh = design.placed(design.bodies.iter().find(|one| one.name == body).expect("a body")).mesh();
            let corners = mesh.vertices.iter().map(|v| v.map(f64::from)).filter_map(|[x, y, z]| {
                let [along, aside] = [x + y, y - x].map(|sum| std::f64::consts::FRAC_1_SQRT_2 * sum);
                (z.abs() < 0.5 && (aside.abs() - half_pitch_mm).abs() < 3.0).then_some(along)
            });
            corners.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
        };
        let gap_mm = reach("fork_FR")[0] - reach("motor_mount_FR")[1];
        assert!((gap_mm - told_mm).abs() < 0.1, "{name}: {gap_mm}, told {told_mm}");
    }
}
