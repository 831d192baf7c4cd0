//! The assembly as binary glTF 2.0: metres, Y up, Z front, one node a body.

use std::collections::BTreeMap;

use gltf::binary::{Glb, Header};
use gltf::json::accessor::{Accessor, ComponentType, GenericComponentType, Type};
use gltf::json::buffer::{Buffer, Target, View};
use gltf::json::material::{AlphaMode, Material, PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::scene::{Node, Scene, UnitQuaternion};
use gltf::json::validation::{Checked, USize64};
use gltf::json::{Asset, Index, Mesh as GltfMesh, Root};
use serde_json::{json, value::RawValue};

use super::format::{ExportError, Exported, File, Format};
use crate::figures::to_thousandth;
use crate::frame::assembly::mass::{LineKind, MassTable};
use crate::frame::assembly::wire::Wire;
use crate::frame::assembly::wires::wires;
use crate::frame::assembly::{Body, BodyKind, Design, Shape};
use crate::solid::Mesh;

/// The file could not be put together.
#[derive(Debug, thiserror::Error)]
pub enum GlbError {
    /// The JSON part.
    #[error("the glTF header could not be written: {0}")]
    Json(#[from] serde_json::Error),
    /// The container.
    #[error("the glTF container could not be written: {0}")]
    Container(#[from] gltf::Error),
}

/// The assembled frame.
pub const FORMAT: Format = Format {
    extension: "glb",
    sentence: "The assembled frame for any viewer: binary glTF 2.0, metres, Y up, Z front.",
    always: true,
    files,
};

fn files(of: &Exported) -> Result<Vec<File>, ExportError> {
    let bytes = frame(of.design, of.masses).map_err(ExportError::of("frame.glb"))?;
    Ok(vec![File::new("frame.glb", bytes)])
}

/// Millimetres in a metre.
pub(super) const MM_PER_M: f64 = 1000.0;

/// The assembled frame.
///
/// # Errors
/// When the header cannot be written as JSON.
pub fn frame(design: &Design, masses: &MassTable) -> Result<Vec<u8>, GlbError> {
    let mut file = GlbFile::new();
    file.describe(&json!({
        "frame": design.frame.name,
        "description": design.frame.description,
        "units": "metre; the frame's own axes, X right, Y front, Z up, hang below the node `frame`",
        "total_mass_g": to_thousandth(masses.total_g),
    }))?;
    for shape in &design.shapes {
        file.add_shape(shape);
    }
    let mut children = design.bodies.iter().map(|body| file.add_body(design, body, masses)).collect::<Result<Vec<_>, _>>()?;
    for wire in wires(design) {
        children.push(file.add_wire(&wire)?);
    }
    file.add_frame_node(&design.frame.name, children);
    file.into_bytes()
}

/// A header and its binary chunk while they grow together.
pub(super) struct GlbFile {
    pub(super) root: Root,
    pub(super) binary: Vec<u8>,
    /// What was last written as rows of numbers.
    pub(super) last_numbers: Option<(Index<Accessor>, Vec<Vec<f32>>)>,
}

impl GlbFile {
    pub(super) fn new() -> Self {
        let asset = Asset { generator: Some(format!("flexframe {}", env!("CARGO_PKG_VERSION"))), ..Asset::default() };
        Self { root: Root { asset, ..Root::default() }, binary: Vec::new(), last_numbers: None }
    }

    /// What a viewer can tell of the file.
    pub(super) fn describe(&mut self, facts: &serde_json::Value) -> Result<(), GlbError> {
        self.root.asset.extras = Some(raw(facts)?);
        Ok(())
    }

    /// Adds a shape's material and mesh; both have the shape's index.
    pub(super) fn add_shape(&mut self, shape: &Shape) {
        self.add_mesh(shape, &shape.mesh);
    }

    /// The same with another mesh.
    pub(super) fn add_mesh(&mut self, shape: &Shape, mesh: &Mesh) -> Index<GltfMesh> {
        self.add_coloured(&shape.name, material(shape), mesh)
    }

    /// A wire, in the frame's axes.
    pub(super) fn add_wire(&mut self, wire: &Wire) -> Result<Index<Node>, GlbError> {
        let silicone = Material {
            name: Some(wire.role.into()),
            pbr_metallic_roughness: PbrMetallicRoughness {
                base_color_factor: PbrBaseColorFactor(wire.colour),
                metallic_factor: StrengthFactor(0.0),
                roughness_factor: StrengthFactor(0.8),
                ..PbrMetallicRoughness::default()
            },
            ..Material::default()
        };
        let mesh = self.add_coloured(&wire.name, silicone, &wire.mesh());
        let facts = raw(&json!({ "kind": "wire", "role": wire.role, "length_mm": to_thousandth(wire.length_mm()) }))?;
        Ok(self.root.push(Node { mesh: Some(mesh), name: Some(wire.name.clone()), extras: Some(facts), ..Node::default() }))
    }

    fn add_coloured(&mut self, name: &str, material: Material, mesh: &Mesh) -> Index<GltfMesh> {
        let material = self.root.push(material);
        let positions = self.positions(mesh);
        let indices = self.indices(mesh);
        let primitive = Primitive {
            attributes: BTreeMap::from([(Checked::Valid(Semantic::Positions), positions)]),
            extensions: None,
            extras: None,
            indices: Some(indices),
            material: Some(material),
            mode: Checked::Valid(Mode::Triangles),
            targets: None,
        };
        let name = Some(name.into());
        self.root.push(GltfMesh { extensions: None, extras: None, name, primitives: vec![primitive], weights: None })
    }

    fn positions(&mut self, mesh: &Mesh) -> Index<Accessor> {
        let metres = |v: f32| (f64::from(v) / MM_PER_M) as f32;
        let offset = self.binary.len();
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for vertex in &mesh.vertices {
            for axis in 0..3 {
                let value = metres(vertex[axis]);
                low[axis] = low[axis].min(value);
                high[axis] = high[axis].max(value);
                self.binary.extend_from_slice(&value.to_le_bytes());
            }
        }
        let view = self.view(offset, Some(Target::ArrayBuffer));
        let count = mesh.vertices.len();
        let mut accessor = accessor(view, count, ComponentType::F32, Type::Vec3);
        accessor.min = Some(json!(low));
        accessor.max = Some(json!(high));
        self.root.push(accessor)
    }

    fn indices(&mut self, mesh: &Mesh) -> Index<Accessor> {
        let offset = self.binary.len();
        for index in mesh.triangles.iter().flatten() {
            self.binary.extend_from_slice(&index.to_le_bytes());
        }
        let view = self.view(offset, Some(Target::ElementArrayBuffer));
        self.root.push(accessor(view, 3 * mesh.triangles.len(), ComponentType::U32, Type::Scalar))
    }

    pub(super) fn view(&mut self, offset: usize, target: Option<Target>) -> Index<View> {
        self.root.push(View {
            buffer: Index::new(0),
            byte_length: USize64::from(self.binary.len() - offset),
            byte_offset: Some(USize64::from(offset)),
            byte_stride: None,
            name: None,
            target: target.map(Checked::Valid),
            extensions: None,
            extras: None,
        })
    }

    fn add_body(&mut self, design: &Design, body: &Body, masses: &MassTable) -> Result<Index<Node>, GlbError> {
        let turn = body.pose.rotation.coords;
        let at = body.pose.translation.vector;
        let extras = raw(&body_facts(design, body, masses))?;
        Ok(self.root.push(Node {
            mesh: Some(Index::new(body.shape as u32)),
            name: Some(body.name.clone()),
            rotation: Some(UnitQuaternion([turn.x as f32, turn.y as f32, turn.z as f32, turn.w as f32])),
            translation: Some([(at.x / MM_PER_M) as f32, (at.y / MM_PER_M) as f32, (at.z / MM_PER_M) as f32]),
            extras: Some(extras),
            ..Node::default()
        }))
    }

    /// The node that turns the frame's Z up and Y front to glTF's Y up and Z front (glTF 2.0, 3.4): (x, y, z) becomes (-x, z, y).
    pub(super) fn add_frame_node(&mut self, name: &str, children: Vec<Index<Node>>) {
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let node = Node {
            children: Some(children),
            name: Some("frame".into()),
            rotation: Some(UnitQuaternion([0.0, half, half, 0.0])),
            ..Node::default()
        };
        let node = self.root.push(node);
        let scene = Scene { extensions: None, extras: None, name: Some(name.into()), nodes: vec![node] };
        self.root.scene = Some(self.root.push(scene));
    }

    /// Nodes beside the node `frame`.
    pub(super) fn add_to_scene(&mut self, nodes: Vec<Index<Node>>) {
        for scene in &mut self.root.scenes {
            scene.nodes.extend(nodes.iter().copied());
        }
    }

    pub(super) fn into_bytes(mut self) -> Result<Vec<u8>, GlbError> {
        let byte_length = USize64::from(self.binary.len());
        self.root.push(Buffer { byte_length, name: None, uri: None, extensions: None, extras: None });
        let mut json = self.root.to_vec()?;
        json.resize(json.len().next_multiple_of(4), b' ');
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let header = Header { magic: *b"glTF", version: 2, length: 0 };
        Ok(Glb { header, json: json.into(), bin: Some(self.binary.into()) }.to_vec()?)
    }
}

pub(super) fn accessor(view: Index<View>, count: usize, component: ComponentType, type_: Type) -> Accessor {
    Accessor {
        buffer_view: Some(view),
        byte_offset: None,
        count: USize64::from(count),
        component_type: Checked::Valid(GenericComponentType(component)),
        extensions: None,
        extras: None,
        type_: Checked::Valid(type_),
        min: None,
        max: None,
        name: None,
        normalized: false,
        sparse: None,
    }
}

fn material(shape: &Shape) -> Material {
    let flexible = shape.kind.is_flexible();
    let metal = matches!(shape.kind, BodyKind::Motor) || shape.name.starts_with("magnet") || shape.name.ends_with("_screw");
    Material {
        name: Some(format!("{} ({})", shape.name, shape.material)),
        alpha_mode: Checked::Valid(if shape.colour[3] < 1.0 { AlphaMode::Blend } else { AlphaMode::Opaque }),
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: PbrBaseColorFactor(shape.colour),
            metallic_factor: StrengthFactor(if metal { 0.6 } else { 0.0 }),
            roughness_factor: StrengthFactor(if flexible { 0.8 } else { 0.55 }),
            ..PbrMetallicRoughness::default()
        },
        ..Material::default()
    }
}

/// What a viewer can tell of a body.
fn body_facts(design: &Design, body: &Body, masses: &MassTable) -> serde_json::Value {
    let shape = design.shape(body);
    let count = bodies_of(design, body.shape);
    let of = |kind: LineKind| masses.line(kind, &shape.name);
    let (kind, quantity, mass) = match shape.kind {
        BodyKind::Printed(_) => ("printed", count, of(LineKind::Printed)),
        BodyKind::Rod(_) => ("rod", count, of(LineKind::Rod)),
        BodyKind::Motor | BodyKind::Propeller | BodyKind::Bought(_) => {
            let line = masses.bought(&shape.kind.bill_line());
            // Some shapes are several pieces, as the screws of a motor are.
            ("bought", line.map_or(count, |line| line.quantity as usize), line)
        }
    };
    json!({
        "part": shape.name,
        "kind": kind,
        "material": shape.material,
        "quantity": quantity,
        "mass_each_g": mass.map(|line| to_thousandth(line.each_g)),
        "module": body.module.map(|module| crate::frame::skeleton::MODULE_NAMES[module]),
    })
}

fn bodies_of(design: &Design, shape: usize) -> usize {
    design.bodies.iter().filter(|body| body.shape == shape).count()
}

fn raw(value: &serde_json::Value) -> Result<Box<RawValue>, serde_json::Error> {
    RawValue::from_string(value.to_string())
}
