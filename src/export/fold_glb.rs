//! The fold as an animated binary glTF: one track a moving body, webs and necks bend by chains of joints.
//!
//! A hinged part is a skin over its flat mesh: its root joint is the body's node, and along each web or neck a chain of
//! joints, all on the hinge's axis, shares the fold. The mesh has more corners there than the STL, on the same surface.
//! The nodes rest in the assembled frame, so that a viewer without animation shows that.

use gltf::json::Index;
use gltf::json::accessor::{Accessor, ComponentType, Type};
use gltf::json::animation::{Animation, Channel, Interpolation, Property, Sampler, Target as Track};
use gltf::json::buffer::Target;
use gltf::json::mesh::Semantic;
use gltf::json::scene::{Node, UnitQuaternion as Turn};
use gltf::json::skin::Skin;
use gltf::json::validation::Checked;
use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use serde_json::json;

use super::fold_skin::{Hinge, hinges};
use super::glb::{GlbError, GlbFile, MM_PER_M, accessor};
use super::mount_motion::MountMotion;
use crate::frame::assembly::wires::wires;
use crate::frame::assembly::{Body, BodyKind, Design};
use crate::frame::fold::{Done, FoldSequence, Member, Moment, STEP_S, Task, moments};
use crate::frame::skeleton::ModulePlaces;

/// Folded, flexible members.
const HINGED: [Member; 3] = [Member::HubJoint, Member::Corner(true), Member::Corner(false)];

/// The hinges of a body, each with the joints of its chain.
type Chains = Vec<(Hinge, Vec<Index<Node>>)>;

/// A body's node and, when it bends, the chains of its hinges.
struct Actor {
    member: Member,
    module: usize,
    /// From the first module's member, turned, to the body: a rod of another module is rolled about its axis.
    roll: Isometry3<f64>,
    node: Index<Node>,
    chains: Chains,
}

/// The mounts' motion, and the node of each body.
struct Stage {
    motion: MountMotion,
    nodes: Vec<Index<Node>>,
    /// The wires, each with the step that lays it.
    wires: Vec<(Index<Node>, usize)>,
}

/// The fold of a design, with what is mounted before and after it.
///
/// # Errors
/// When the header cannot be written as JSON.
pub fn fold(design: &Design, fold: &FoldSequence) -> Result<Vec<u8>, GlbError> {
    let motion = MountMotion::new(design, fold);
    let mut file = GlbFile::new();
    file.describe(&json!({
        "frame": design.frame.name,
        "units": "metre; the frame's own axes, X right, Y front, Z up, hang below the node `frame`",
        "steps": motion.titles(fold),
    }))?;
    let hinged: Vec<(Member, Vec<Hinge>)> = HINGED.iter().map(|m| (*m, hinges(&design.frame, fold.module.bends(*m)))).collect();
    for shape in &design.shapes {
        let member = HINGED.into_iter().find(|m| matches!(shape.kind, BodyKind::Printed(name) if Some(name) == m.part()));
        match member.and_then(|m| hinged.iter().find(|(h, _)| *h == m).zip(m.part().and_then(|name| design.part(name)))) {
            Some(((_, hinges), part)) => file.add_bending(shape, &part.flat.mesh(), hinges),
            None => file.add_shape(shape),
        }
    }
    let (mut children, mut actors, mut skinned) = (Vec::new(), Vec::new(), Vec::new());
    for body in &design.bodies {
        let member = member_of(body);
        let hinges = member.and_then(|(m, _)| hinged.iter().find(|(h, _)| *h == m)).map(|(_, hinges)| hinges.clone());
        let (node, chains) = match hinges {
            Some(hinges) => file.add_skinned(body, hinges, &mut skinned),
            None => (file.root.push(placed(&body.name, &body.pose, Some(Index::new(body.shape as u32)))), Vec::new()),
        };
        actors.extend(member.map(|(member, module)| {
            let roll = fold.module.modules.pose(module, &fold.module.place(member)).inverse() * body.pose;
            Actor { member, module, roll, node, chains }
        }));
        children.push(node);
    }
    let mut laid = Vec::new();
    for wire in wires(design) {
        laid.push((file.add_wire(&wire)?, motion.step_of_wire(&wire)));
    }
    file.add_frame_node(&design.frame.name, children.iter().chain(laid.iter().map(|(node, _)| node)).copied().collect());
    file.add_to_scene(skinned);
    file.animate(design, fold, &actors, &Stage { motion, nodes: children, wires: laid });
    file.into_bytes()
}

/// The member and module that a body is.
fn member_of(body: &Body) -> Option<(Member, usize)> {
    let module = body.module?;
    Member::ALL.into_iter().find(|m| m.body(module) == body.name).map(|m| (m, module))
}

fn placed(name: &str, pose: &Isometry3<f64>, mesh: Option<Index<gltf::json::Mesh>>) -> Node {
    Node {
        mesh,
        name: Some(name.into()),
        rotation: Some(Turn(turn(&pose.rotation))),
        translation: Some(metres(&pose.translation.vector)),
        ..Node::default()
    }
}

fn turn(q: &UnitQuaternion<f64>) -> [f32; 4] {
    [q.i as f32, q.j as f32, q.k as f32, q.w as f32]
}

fn metres(v: &Vector3<f64>) -> [f32; 3] {
    [v.x, v.y, v.z].map(|c| (c / MM_PER_M) as f32)
}

/// Turn of one joint of a chain when its hinge is folded.
fn share(hinge: &Hinge, fold_deg: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_scaled_axis(hinge.axis.into_inner() * (fold_deg.to_radians() / f64::from(hinge.joints)))
}

impl GlbFile {
    /// A hinged part: its flat mesh, finer in the hinges, with each corner's share of their folds.
    fn add_bending(&mut self, shape: &crate::frame::assembly::Shape, flat: &crate::solid::Mesh, hinges: &[Hinge]) {
        let mesh = hinges.iter().fold(flat.clone(), |mesh, hinge| hinge.refined(&mesh));
        let mesh_index = self.add_mesh(shape, &mesh);
        let (mut joints, mut weights) = (Vec::new(), Vec::new());
        for vertex in &mesh.vertices {
            let (joint, weight) = weighted(&vertex.map(f64::from).into(), hinges);
            joints.extend(joint);
            weights.extend(weight.iter().flat_map(|w| w.to_le_bytes()));
        }
        let count = mesh.vertices.len();
        let joints = self.add_data(&joints, count, ComponentType::U8, Type::Vec4, Some(Target::ArrayBuffer));
        let weights = self.add_data(&weights, count, ComponentType::F32, Type::Vec4, Some(Target::ArrayBuffer));
        let attributes = &mut self.root.meshes[mesh_index.value()].primitives[0].attributes;
        attributes.insert(Checked::Valid(Semantic::Joints(0)), joints);
        attributes.insert(Checked::Valid(Semantic::Weights(0)), weights);
    }

    /// A hinged body: its node with the chains below it, and a node at the root of the scene that carries the skin.
    fn add_skinned(&mut self, body: &Body, hinges: Vec<Hinge>, roots: &mut Vec<Index<Node>>) -> (Index<Node>, Chains) {
        let (mut chains, mut firsts) = (Vec::new(), Vec::new());
        for hinge in hinges {
            let mut below: Option<Index<Node>> = None;
            let mut nodes = Vec::new();
            for joint in (0..hinge.joints).rev() {
                let at = if joint == 0 { hinge.pivot.coords } else { Vector3::zeros() };
                let pose = Isometry3::from_parts(at.into(), share(&hinge, hinge.assembled_deg));
                let name = format!("{}_{}_{}", body.name, hinge.name, joint + 1);
                let node = Node { children: below.map(|node| vec![node]), ..placed(&name, &pose, None) };
                let node = self.root.push(node);
                nodes.push(node);
                below = Some(node);
            }
            nodes.reverse();
            firsts.extend(below);
            chains.push((hinge, nodes));
        }
        let root = self.root.push(Node { children: Some(firsts), ..placed(&body.name, &body.pose, None) });
        let joints: Vec<Index<Node>> = std::iter::once(root).chain(chains.iter().flat_map(|(_, nodes)| nodes.iter().copied())).collect();
        let skin = self.add_skin(&body.name, joints, &chains);
        let mesh = Some(Index::new(body.shape as u32));
        roots.push(self.root.push(Node { mesh, skin: Some(skin), name: Some(format!("{}_skin", body.name)), ..Node::default() }));
        (root, chains)
    }

    fn add_skin(&mut self, name: &str, joints: Vec<Index<Node>>, chains: &[(Hinge, Vec<Index<Node>>)]) -> Index<Skin> {
        let mut bytes = Vec::new();
        let pivots = chains.iter().flat_map(|(hinge, nodes)| nodes.iter().map(|_| hinge.pivot.coords));
        for at in std::iter::once(Vector3::zeros()).chain(pivots) {
            let [x, y, z] = metres(&-at);
            let columns = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, x, y, z, 1.0];
            bytes.extend(columns.iter().flat_map(|c: &f32| c.to_le_bytes()));
        }
        let matrices = self.add_data(&bytes, joints.len(), ComponentType::F32, Type::Mat4, None);
        let skeleton = Some(joints[0]);
        self.root.push(Skin {
            extensions: None,
            extras: None,
            inverse_bind_matrices: Some(matrices),
            joints,
            name: Some(name.into()),
            skeleton,
        })
    }

    fn add_data(&mut self, bytes: &[u8], count: usize, component: ComponentType, kind: Type, target: Option<Target>) -> Index<Accessor> {
        let offset = self.binary.len();
        self.binary.extend_from_slice(bytes);
        let view = self.view(offset, target);
        self.root.push(accessor(view, count, component, kind))
    }

    fn add_numbers(&mut self, rows: &[Vec<f32>], kind: Type) -> Index<Accessor> {
        let bytes: Vec<u8> = rows.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        self.add_data(&bytes, rows.len(), ComponentType::F32, kind, None)
    }

    fn add_times(&mut self, times: &[f64]) -> Index<Accessor> {
        let rows: Vec<Vec<f32>> = times.iter().map(|t| vec![*t as f32]).collect();
        let (first, last) = (times.first().map_or(0.0, |t| *t as f32), times.last().map_or(0.0, |t| *t as f32));
        let index = self.add_numbers(&rows, Type::Scalar);
        let times = &mut self.root.accessors[index.value()];
        (times.min, times.max) = (Some(json!([first])), Some(json!([last])));
        index
    }

    /// One animation a step and one with all of them.
    fn animate(&mut self, design: &Design, fold: &FoldSequence, actors: &[Actor], stage: &Stage) {
        let rules = fold.rules(&design.frame, &design.skeleton);
        let order: Vec<Task> = fold.order();
        let titles = stage.motion.titles(fold);
        let begins = stage.motion.before;
        let mut all: Vec<Moment> = Vec::new();
        let mut done = Done::new();
        for (number, title) in titles.iter().enumerate() {
            let mut animation = named(format!("{:02} {title}", number + 1));
            if let Some(step) = number.checked_sub(begins).and_then(|at| fold.steps.get(at)) {
                let shown = moments(&rules, &order, &done, step.task);
                self.add_fold(&mut animation, &fold.module.modules, &shown, actors);
                let start_s = STEP_S * number as f64;
                // A step begins where the last one ended.
                let fresh = shown.into_iter().skip(usize::from(number > begins));
                all.extend(fresh.map(|moment| Moment { at_s: start_s + moment.at_s, ..moment }));
                done.insert(step.task);
            }
            self.add_stage(&mut animation, design, stage, [number, number + 1]);
            self.root.push(animation);
        }
        let mut animation = named("all".into());
        self.add_fold(&mut animation, &fold.module.modules, &all, actors);
        self.add_stage(&mut animation, design, stage, [0, titles.len()]);
        self.root.push(animation);
    }

    /// The motion of the modules.
    fn add_fold(&mut self, animation: &mut Animation, modules: &ModulePlaces, shown: &[Moment], actors: &[Actor]) {
        let times: Vec<f64> = shown.iter().map(|moment| moment.at_s).collect();
        let input = self.add_times(&times);
        for actor in actors {
            let pose = |moment: &Moment| modules.pose(actor.module, &moment.pose(actor.member)) * actor.roll;
            let poses: Vec<Isometry3<f64>> = shown.iter().map(pose).collect();
            let places: Vec<Vec<f32>> = poses.iter().map(|pose| metres(&pose.translation.vector).to_vec()).collect();
            let turns = steady(poses.iter().map(|pose| pose.rotation));
            self.add_track(animation, input, actor.node, Property::Translation, &places);
            self.add_track(animation, input, actor.node, Property::Rotation, &turns);
            for (index, (hinge, nodes)) in actor.chains.iter().enumerate() {
                let turns = steady(shown.iter().map(|moment| share(hinge, moment.fold_deg(actor.member, index))));
                for node in nodes {
                    self.add_track(animation, input, *node, Property::Rotation, &turns);
                }
            }
        }
    }

    /// The motion of what is mounted from one step to another; what no step has taken in hand yet is hidden, and what is out of the frame.
    fn add_stage(&mut self, animation: &mut Animation, design: &Design, stage: &Stage, [first, last]: [usize; 2]) {
        let steps: Vec<usize> = (first..=last).collect();
        let times: Vec<f64> = steps.iter().map(|step| STEP_S * (step - first) as f64).collect();
        let input = self.add_times(&times);
        for ((index, body), node) in design.bodies.iter().enumerate().zip(&stage.nodes) {
            if member_of(body).is_none() {
                let at = |step: &usize| metres(&(body.pose.translation.vector + stage.motion.off_mm(&body.name, *step))).to_vec();
                let places: Vec<Vec<f32>> = steps.iter().map(at).collect();
                self.add_track(animation, input, *node, Property::Translation, &places);
            }
            self.add_hidden(animation, input, *node, &steps, |step| stage.motion.is_hidden(&body.name, stage.motion.first[index], step));
        }
        for (node, appears) in &stage.wires {
            self.add_hidden(animation, input, *node, &steps, |step| step < *appears);
        }
    }

    /// What is hidden in some of the steps. A step's own animation ends as it is in that step.
    fn add_hidden(
        &mut self,
        animation: &mut Animation,
        input: Index<Accessor>,
        node: Index<Node>,
        steps: &[usize],
        is_hidden: impl Fn(usize) -> bool,
    ) {
        let shown = |step: &usize| if steps.len() == 2 { steps[0] } else { *step };
        let hidden: Vec<bool> = steps.iter().map(|step| is_hidden(shown(step))).collect();
        if hidden.contains(&true) {
            let sizes: Vec<Vec<f32>> = hidden.iter().map(|hidden| vec![if *hidden { 0.0 } else { 1.0 }; 3]).collect();
            self.add_track(animation, input, node, Property::Scale, &sizes);
        }
    }

    fn add_track(&mut self, animation: &mut Animation, input: Index<Accessor>, node: Index<Node>, path: Property, rows: &[Vec<f32>]) {
        let kind = if path == Property::Rotation { Type::Vec4 } else { Type::Vec3 };
        let output = self.shared_numbers(rows, kind);
        let sampler = Index::new(animation.samplers.len() as u32);
        // What appears does so at once.
        let between = if path == Property::Scale { Interpolation::Step } else { Interpolation::Linear };
        let interpolation = Checked::Valid(between);
        animation.samplers.push(Sampler { extensions: None, extras: None, input, interpolation, output });
        let target = Track { extensions: None, extras: None, node, path: Checked::Valid(path) };
        animation.channels.push(Channel { sampler, target, extensions: None, extras: None });
    }

    /// Numbers that were the last ones written are not written again: the joints of a chain turn alike.
    fn shared_numbers(&mut self, rows: &[Vec<f32>], kind: Type) -> Index<Accessor> {
        if let Some((index, _)) = self.last_numbers.as_ref().filter(|(_, last)| last == rows) {
            return *index;
        }
        let index = self.add_numbers(rows, kind);
        self.last_numbers = Some((index, rows.to_vec()));
        index
    }
}

fn named(name: String) -> Animation {
    Animation { extensions: None, extras: None, channels: Vec::new(), name: Some(name), samplers: Vec::new() }
}

/// Quaternions of a motion, each on the side of the one before: q and -q are the same turn but not between them.
fn steady(turns: impl Iterator<Item = UnitQuaternion<f64>>) -> Vec<Vec<f32>> {
    let mut rows: Vec<Vec<f32>> = Vec::new();
    for q in turns {
        let mut row = turn(&q).to_vec();
        let against = rows.last().is_some_and(|last| last.iter().zip(&row).map(|(a, b)| a * b).sum::<f32>() < 0.0);
        if against {
            row.iter_mut().for_each(|c| *c = -*c);
        }
        rows.push(row);
    }
    rows
}

/// Joints and weights of a corner: the root, or two neighbours of the chain of the hinge that moves it.
fn weighted(p: &nalgebra::Point3<f64>, hinges: &[Hinge]) -> ([u8; 4], [f32; 4]) {
    let mut first = 1;
    for hinge in hinges {
        let place = hinge.share(p) * f64::from(hinge.joints);
        if place > 0.0 {
            let low = (place.floor() as u32).min(hinge.joints - 1);
            let upper = (place - f64::from(low)) as f32;
            let below = if low == 0 { 0 } else { (first + low - 1) as u8 };
            let above = (first + low) as u8;
            return match upper {
                u if u >= 1.0 => ([above, 0, 0, 0], [1.0, 0.0, 0.0, 0.0]),
                u if u <= 0.0 => ([below, 0, 0, 0], [1.0, 0.0, 0.0, 0.0]),
                u => ([below, above, 0, 0], [1.0 - u, u, 0.0, 0.0]),
            };
        }
        first += hinge.joints;
    }
    ([0; 4], [1.0, 0.0, 0.0, 0.0])
}
