//! `manifest.json`: every file with its hash, every printed part with its numbers.

use serde::Serialize;
use sha2::{Digest, Sha256};

use super::step::StepEntry;
use crate::frame::assembly::compensated::Compensated;
use crate::frame::assembly::mass::MassTable;
use crate::frame::assembly::{Design, Shape};
use crate::frame::skeleton::RodRole;
use crate::params::catalogue::MassBasis;

/// Version of the manifest's form; raised when a key changes its meaning or goes.
pub const SCHEMA_VERSION: u32 = 1;

/// The manifest.
#[derive(Debug, Serialize)]
pub struct Manifest {
    /// See [`SCHEMA_VERSION`].
    pub schema_version: u32,
    /// Program and version that wrote it.
    pub generator: String,
    /// Name of the frame.
    pub frame: String,
    /// One line about it.
    pub description: String,
    /// Total mass, g.
    pub total_mass_g: f64,
    /// Printed parts.
    pub parts: Vec<PartEntry>,
    /// Rods by role.
    pub rods: Vec<RodEntry>,
    /// Bought parts by role.
    pub bought: Vec<BoughtEntry>,
    /// Shapes that the B-rep kernel builds, too.
    pub exact: Vec<ExactEntry>,
    /// Solids of the STEP files, when they were asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub step: Vec<StepEntry>,
    /// Every other file of the folder.
    pub files: Vec<FileEntry>,
}

/// A printed part.
#[derive(Debug, Serialize)]
pub struct PartEntry {
    /// Name.
    pub name: String,
    /// How many to print.
    pub quantity: u32,
    /// Name of the material.
    pub material: String,
    /// Volume of the mesh as it is written for the printer, mm³.
    pub volume_mm3: f64,
    /// Mass of one as it is designed, g.
    pub mass_g: f64,
    /// Edge lengths of the bounding box as printed, mm.
    pub bbox_mm: [f64; 3],
    /// Facets of the mesh.
    pub triangles: usize,
    /// Its files.
    pub files: Vec<String>,
}

/// Rods of a role.
#[derive(Debug, Serialize)]
pub struct RodEntry {
    /// Role.
    pub name: String,
    /// How many.
    pub quantity: u32,
    /// Material.
    pub material: String,
    /// Length between the bottoms of its bores, mm.
    pub length_mm: f64,
    /// What it is sawn to, mm: the next half millimetre below.
    pub sawn_mm: f64,
    /// Diameter, mm.
    pub diameter_mm: f64,
    /// Mass of one, g.
    pub mass_g: f64,
}

/// Something bought.
#[derive(Debug, Serialize)]
pub struct BoughtEntry {
    /// What for.
    pub role: String,
    /// Name in the catalogue.
    pub name: String,
    /// How many.
    pub quantity: u32,
    /// Mass of one, g.
    pub mass_g: f64,
    /// How the mass is known.
    pub mass_basis: MassBasis,
    /// Where size and mass come from.
    pub source: String,
}

/// A shape that both kernels have made.
#[derive(Debug, Serialize)]
pub struct ExactEntry {
    /// Name of the shape.
    pub name: String,
    /// Volume of the mesh, mm³.
    pub mesh_volume_mm3: f64,
    /// Volume of the B-rep, mm³.
    pub exact_volume_mm3: f64,
}

/// A file and its hash.
#[derive(Debug, Serialize)]
pub struct FileEntry {
    /// Path in the folder, with `/`.
    pub path: String,
    /// Its SHA-256 in hexadecimal.
    pub sha256: String,
}

/// The manifest of a design and the files written for it; `meshes` are what is printed, `step` the solids of the STEP files.
pub fn manifest(design: &Design, meshes: &Compensated, masses: &MassTable, step: Vec<StepEntry>, files: &[(String, Vec<u8>)]) -> Manifest {
    let frame = &design.frame;
    Manifest {
        schema_version: SCHEMA_VERSION,
        generator: format!("flexframe {}", env!("CARGO_PKG_VERSION")),
        frame: frame.name.clone(),
        description: frame.description.clone(),
        total_mass_g: rounded(masses.total_g),
        parts: part_entries(design, meshes, masses, &step),
        rods: rod_entries(design, masses),
        bought: frame
            .bought
            .iter()
            .filter(|(role, _)| *role != "rod")
            .map(|(role, item)| BoughtEntry {
                role: role.clone(),
                name: item.name.clone(),
                quantity: item.quantity,
                mass_g: if role == "battery" { frame.battery.battery_mass_g } else { item.part.mass_g },
                mass_basis: item.part.mass_basis,
                source: item.part.source.clone(),
            })
            .collect(),
        exact: exact_entries(design),
        step,
        files: files.iter().map(|(path, bytes)| FileEntry { path: path.clone(), sha256: hex(&Sha256::digest(bytes)) }).collect(),
    }
}

fn part_entries(design: &Design, meshes: &Compensated, masses: &MassTable, step: &[StepEntry]) -> Vec<PartEntry> {
    design
        .printed
        .iter()
        .map(|part| (part, meshes.mesh(part.name).unwrap_or(&part.mesh)))
        .map(|(part, mesh)| PartEntry {
            name: part.name.to_string(),
            quantity: part.name.quantity(),
            material: design.material_of(part.name).name.clone(),
            volume_mm3: rounded(mesh.volume_mm3()),
            mass_g: rounded(mass_of(masses, part.name.slug())),
            bbox_mm: mesh.size_mm().map(rounded),
            triangles: mesh.triangles.len(),
            files: [Some("stl"), (!step.is_empty()).then_some("step")]
                .iter()
                .flatten()
                .map(|kind| format!("parts/{}.{kind}", part.name))
                .collect(),
        })
        .collect()
}

fn rod_entries(design: &Design, masses: &MassTable) -> Vec<RodEntry> {
    RodRole::ALL
        .iter()
        .map(|role| RodEntry {
            name: role.slug().into(),
            quantity: design.skeleton.rods_of(*role).count() as u32,
            material: design.frame.rod_material.name.clone(),
            length_mm: rounded(design.skeleton.length_mm(*role)),
            sawn_mm: rounded(design.skeleton.sawn_mm(*role)),
            diameter_mm: design.frame.rods.rod_diameter_mm,
            mass_g: rounded(mass_of(masses, &format!("{}_rod", role.slug()))),
        })
        .collect()
}

fn exact_entries(design: &Design) -> Vec<ExactEntry> {
    let entry = |shape: &Shape| {
        let exact_volume_mm3 = rounded(shape.exact_mm3?);
        Some(ExactEntry { name: shape.name.clone(), mesh_volume_mm3: rounded(shape.solid.volume_mm3()), exact_volume_mm3 })
    };
    design.shapes.iter().filter_map(entry).collect()
}

fn mass_of(masses: &MassTable, name: &str) -> f64 {
    masses.lines.iter().find(|line| line.name == name).map_or(0.0, |line| line.each_g)
}

/// To a thousandth.
fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
