//! The design's bodies as a state of the model bends them.
//!
//! Each corner of a mesh goes with the nearest nodes of its body, each weighing as its distance to the power of -4: right on
//! the beams, a blend between them. For pictures, not for measuring.

use nalgebra::Vector3;

use crate::frame::assembly::{BodyKind, Design};
use crate::mechanics::model::frame_model::{Extent, FrameModel};
use crate::mechanics::system::structure::State;
use crate::solid::Mesh;

/// Nodes that a corner goes with.
const NEAREST: usize = 3;
/// Distances below this are alike, mm.
const CLOSE_MM: f64 = 0.5;

/// A body, deformed.
#[derive(Clone, Debug)]
pub struct DeformedBody {
    /// Index among the design's bodies.
    pub body: usize,
    /// Its mesh in frame axes, mm, corner by corner as the shape's.
    pub mesh: Mesh,
}

/// Weights of a body's corners.
struct Binding {
    body: usize,
    mesh: Mesh,
    corners: Vec<[(usize, f64); NEAREST]>,
}

/// The bodies of a design bound to a model of the whole frame.
pub struct Bound {
    bindings: Vec<Binding>,
    rest: Vec<Vector3<f64>>,
}

impl Bound {
    /// Binds every body but the propellers' discs; `None` for a model of a quarter.
    pub fn new(design: &Design, model: &FrameModel) -> Option<Self> {
        if model.extent != Extent::Whole {
            return None;
        }
        let rest: Vec<Vector3<f64>> = model.system.structure.nodes.iter().map(|node| node.place).collect();
        let mut bindings = Vec::new();
        for (index, body) in design.bodies.iter().enumerate() {
            let shape = design.shape(body);
            let nodes: Vec<usize> = match (shape.kind, body.module) {
                (BodyKind::Propeller, _) => continue,
                (BodyKind::Motor | BodyKind::Bought(_), Some(module)) => model.motors.get(module).copied().into_iter().collect(),
                _ => model.skins.iter().find(|skin| skin.body == index).map_or(vec![model.hub], |skin| skin.nodes.clone()),
            };
            let flexible = shape.kind.is_flexible();
            let nodes = if nodes.is_empty() && !flexible { vec![model.hub] } else { nodes };
            let mesh = shape.mesh.placed(&body.pose);
            let corners = mesh.vertices.iter().map(|v| weights(&Vector3::from(v.map(f64::from)), &nodes, &rest)).collect();
            bindings.push(Binding { body: index, mesh, corners });
        }
        Some(Self { bindings, rest })
    }

    /// The bodies in a state, its displacements so many times as large.
    pub fn deformed(&self, state: &State) -> Vec<DeformedBody> {
        let moved = |binding: &Binding| {
            let mut mesh = binding.mesh.clone();
            for (vertex, corner) in mesh.vertices.iter_mut().zip(&binding.corners) {
                let at = Vector3::from(vertex.map(f64::from));
                let place: Vector3<f64> = corner
                    .iter()
                    .map(|(node, weight)| (state.places[*node] + state.turns[*node] * (at - self.rest[*node])) * *weight)
                    .sum();
                *vertex = [place.x as f32, place.y as f32, place.z as f32];
            }
            DeformedBody { body: binding.body, mesh }
        };
        self.bindings.iter().map(moved).collect()
    }
}

fn weights(at: &Vector3<f64>, nodes: &[usize], rest: &[Vector3<f64>]) -> [(usize, f64); NEAREST] {
    let mut near: Vec<(usize, f64)> = nodes.iter().map(|node| (*node, (rest[*node] - at).norm_squared())).collect();
    near.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    let mut all = [(nodes.first().copied().unwrap_or(0), 0.0); NEAREST];
    for (weight, (node, square)) in all.iter_mut().zip(&near) {
        let close = square + CLOSE_MM * CLOSE_MM;
        *weight = (*node, 1.0 / (close * close));
    }
    let sum: f64 = all.iter().map(|w| w.1).sum();
    if sum > 0.0 {
        all.iter_mut().for_each(|w| w.1 /= sum);
    }
    all
}

impl FrameModel {
    /// A state of the quarter as one of the whole frame: each module by the first's, turned and mirrored.
    ///
    /// Both models hold the same parts in the same order; rods of the ring are found by their mirrored places. A whole frame's
    /// state stays as it is.
    pub fn unfolded(&self, quarter: &FrameModel, state: &State) -> State {
        if quarter.extent == Extent::Whole {
            return state.clone();
        }
        let mut whole = self.system.rest();
        let rest = &quarter.system.structure.nodes;
        let hub = quarter.hub;
        for node in 0..whole.places.len() {
            let own = self.system.structure.nodes[node].place;
            if node == self.hub {
                whole.places[node] = own + (state.places[hub] - rest[hub].place);
                continue;
            }
            // Into the first quadrant: two mirrors.
            let sign = [own.x, own.y].map(|c| if c < 0.0 { -1.0 } else { 1.0 });
            let mirror = Vector3::new(sign[0], sign[1], 1.0);
            let folded = own.component_mul(&mirror);
            let nearest = (0..rest.len()).filter(|n| *n != hub).min_by(|a, b| {
                let far = |n: usize| (rest[n].place - folded).norm_squared();
                far(*a).total_cmp(&far(*b))
            });
            let Some(near) = nearest else { continue };
            let moved = state.places[near] - rest[near].place;
            whole.places[node] = own + moved.component_mul(&mirror);
            // A mirror M takes the turn R to M R M.
            let m = nalgebra::Matrix3::from_diagonal(&mirror);
            whole.turns[node] = m * state.turns[near] * m;
        }
        whole
    }
}
