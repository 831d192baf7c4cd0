//! A frame that bends, as animated binary glTF: one mesh a body, its bent shapes as morph targets.

use gltf::json::Index;
use gltf::json::accessor::{Accessor, ComponentType, Type};
use gltf::json::animation::{Animation, Channel, Interpolation, Property, Sampler, Target as Track};
use gltf::json::buffer::Target;
use gltf::json::mesh::MorphTarget;
use gltf::json::scene::Node;
use gltf::json::validation::Checked;
use serde_json::json;

use super::glb::{GlbError, GlbFile, MM_PER_M, accessor};
use crate::frame::assembly::Design;
use crate::mechanics::result::deformed::DeformedBody;

/// A moment of the animation: when, s, and how much of each bent shape.
pub type Key = (f64, Vec<f64>);

/// The frame at rest, its bent shapes, and how it goes from one to the other.
///
/// # Errors
/// When the header cannot be written as JSON.
pub fn deformed(
    design: &Design,
    title: &str,
    rest: &[DeformedBody],
    shapes: &[Vec<DeformedBody>],
    keys: &[Key],
) -> Result<Vec<u8>, GlbError> {
    let mut file = GlbFile::new();
    file.describe(&json!({
        "frame": design.frame.name,
        "shows": title,
        "units": "metre; the frame's own axes, X right, Y front, Z up, hang below the node `frame`",
    }))?;
    let mut nodes = Vec::new();
    for (at, body) in rest.iter().enumerate() {
        let own = &design.bodies[body.body];
        let mesh = file.add_mesh(design.shape(own), &body.mesh);
        let targets: Vec<MorphTarget> = shapes.iter().map(|bodies| file.target(body, &bodies[at])).collect();
        file.root.meshes[mesh.value()].weights = Some(vec![0.0; targets.len()]);
        file.root.meshes[mesh.value()].primitives[0].targets = Some(targets);
        nodes.push(file.root.push(Node { mesh: Some(mesh), name: Some(own.name.clone()), ..Node::default() }));
    }
    file.animate_weights(title, &nodes, keys);
    file.add_frame_node(&design.frame.name, nodes);
    file.into_bytes()
}

impl GlbFile {
    /// How far each corner has gone.
    fn target(&mut self, rest: &DeformedBody, bent: &DeformedBody) -> MorphTarget {
        let rows: Vec<[f32; 3]> = rest
            .mesh
            .vertices
            .iter()
            .zip(&bent.mesh.vertices)
            .map(|(a, b)| [0, 1, 2].map(|i| ((f64::from(b[i]) - f64::from(a[i])) / MM_PER_M) as f32))
            .collect();
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for row in &rows {
            for i in 0..3 {
                (low[i], high[i]) = (low[i].min(row[i]), high[i].max(row[i]));
            }
        }
        let values: Vec<f32> = rows.iter().flatten().copied().collect();
        let index = self.floats(&values, rows.len(), Type::Vec3, Some(Target::ArrayBuffer));
        let own = &mut self.root.accessors[index.value()];
        (own.min, own.max) = (Some(json!(low)), Some(json!(high)));
        MorphTarget { positions: Some(index), normals: None, tangents: None }
    }

    fn floats(&mut self, values: &[f32], count: usize, kind: Type, target: Option<Target>) -> Index<Accessor> {
        let offset = self.binary.len();
        self.binary.extend(values.iter().flat_map(|x| x.to_le_bytes()));
        let view = self.view(offset, target);
        self.root.push(accessor(view, count, ComponentType::F32, kind))
    }

    fn animate_weights(&mut self, name: &str, nodes: &[Index<Node>], keys: &[Key]) {
        let times: Vec<f32> = keys.iter().map(|(at_s, _)| *at_s as f32).collect();
        let input = self.floats(&times, times.len(), Type::Scalar, None);
        let ends = [times.first(), times.last()].map(|t| t.copied().unwrap_or_default());
        let own = &mut self.root.accessors[input.value()];
        (own.min, own.max) = (Some(json!([ends[0]])), Some(json!([ends[1]])));
        let weights: Vec<f32> = keys.iter().flat_map(|(_, weights)| weights.iter().map(|w| *w as f32)).collect();
        let output = self.floats(&weights, weights.len(), Type::Scalar, None);
        let interpolation = Checked::Valid(Interpolation::Linear);
        let sampler = Sampler { extensions: None, extras: None, input, interpolation, output };
        let channel = |node: &Index<Node>| Channel {
            sampler: Index::new(0),
            target: Track { extensions: None, extras: None, node: *node, path: Checked::Valid(Property::MorphTargetWeights) },
            extensions: None,
            extras: None,
        };
        let channels = nodes.iter().map(channel).collect();
        self.root.push(Animation { extensions: None, extras: None, channels, name: Some(name.into()), samplers: vec![sampler] });
    }
}
