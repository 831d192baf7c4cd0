//! `manifest.json`: every file with its hash, every printed part with its numbers.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::format::{File, SolidEntry};
use crate::figures::to_thousandth;
use crate::frame::assembly::compensated::Compensated;
use crate::frame::assembly::mass::{LineKind, MassTable};
use crate::frame::assembly::{Design, Shape};

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
    pub step: Vec<SolidEntry>,
    /// Every other file of the folder.
    pub files: Vec<FileEntry>,
    /// SHA-256 of the manifest's own text with this value left empty; whoever changes the text by hand makes it wrong.
    pub own_sha256: String,
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
    /// Volume as it is designed, mm³: another one where the printer's figures change what is written.
    pub design_volume_mm3: f64,
    /// Mass of one as it is designed, g: that volume times density and print factor.
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
    /// How the mass is known: `datasheet`, `estimate`, `measured`, `stated` by the frame file, or the extra that it is in.
    pub mass_basis: String,
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
#[derive(Debug, Serialize, Deserialize)]
pub struct FileEntry {
    /// Path in the folder, with `/`.
    pub path: String,
    /// Its SHA-256 in hexadecimal.
    pub sha256: String,
}

/// The manifest of a design and the files written for it; `meshes` are what is printed.
pub fn manifest(design: &Design, meshes: &Compensated, masses: &MassTable, files: &[File]) -> Manifest {
    let frame = &design.frame;
    Manifest {
        schema_version: SCHEMA_VERSION,
        generator: format!("flexframe {}", env!("CARGO_PKG_VERSION")),
        frame: frame.name.clone(),
        description: frame.description.clone(),
        total_mass_g: to_thousandth(masses.total_g),
        parts: part_entries(design, meshes, masses, files),
        rods: rod_entries(design, masses),
        bought: frame
            .bought
            .iter()
            .filter_map(|(role, item)| Some((role, item, masses.bought(role)?)))
            .map(|(role, item, weighed)| BoughtEntry {
                role: role.clone(),
                name: item.name.clone(),
                quantity: item.quantity,
                mass_g: weighed.each_g,
                mass_basis: weighed.basis.clone(),
                source: weighed.source(&item.part.source),
            })
            .collect(),
        exact: exact_entries(design),
        step: files.iter().flat_map(|file| file.solids.clone()).collect(),
        files: files.iter().map(|file| FileEntry { path: file.path.clone(), sha256: hash(&file.bytes) }).collect(),
        own_sha256: String::new(),
    }
}

/// The text of a list of files with its own hash in it. `list` has an `own_sha256`, which is empty.
///
/// # Errors
/// When it cannot be written as JSON.
pub fn signed_text(list: &impl Serialize) -> serde_json::Result<String> {
    let text = serde_json::to_string_pretty(list)? + "\n";
    let own = hash(text.as_bytes());
    Ok(text.replacen(EMPTY_HASH, &EMPTY_HASH.replace("\"\"", &format!("\"{own}\"")), 1))
}

/// What a list of files needs; a manifest has more.
#[derive(Serialize, Deserialize)]
struct FileList {
    schema_version: u32,
    files: Vec<FileEntry>,
    /// Manifests of former versions have none.
    #[serde(default)]
    own_sha256: Option<String>,
}

/// The list of files of a folder that has no manifest, by path and hash. A path stands there twice while its file is being replaced.
///
/// # Errors
/// When it cannot be written as JSON.
pub fn list_text(files: impl IntoIterator<Item = (String, String)>) -> serde_json::Result<String> {
    let files = files.into_iter().map(|(path, sha256)| FileEntry { path, sha256 }).collect();
    signed_text(&FileList { schema_version: SCHEMA_VERSION, files, own_sha256: Some(String::new()) })
}

/// Paths with their hashes as a manifest or another list states them, and whether the list itself is as it was written; `None` when the text is
/// no list.
pub fn listed(text: &str) -> Option<(Vec<(String, String)>, bool)> {
    let list: FileList = serde_json::from_str(text).ok()?;
    let whole = list.own_sha256.is_none_or(|own| is_signed(text, &own));
    Some((list.files.into_iter().map(|file| (file.path, file.sha256)).collect(), whole))
}

/// Whether a text is as [`signed_text`] wrote it, when it holds this hash of its own.
fn is_signed(text: &str, own_sha256: &str) -> bool {
    let empty = text.replacen(&EMPTY_HASH.replace("\"\"", &format!("\"{own_sha256}\"")), EMPTY_HASH, 1);
    hash(empty.as_bytes()) == own_sha256
}

/// A hash of its own that is still empty.
const EMPTY_HASH: &str = "\n  \"own_sha256\": \"\"";

fn part_entries(design: &Design, meshes: &Compensated, masses: &MassTable, files: &[File]) -> Vec<PartEntry> {
    design
        .printed
        .iter()
        .map(|part| (part, meshes.mesh(part.name).unwrap_or(&part.mesh)))
        .map(|(part, mesh)| PartEntry {
            name: part.name.to_string(),
            quantity: part.part.quantity(),
            material: design.material_of(part.name).name.clone(),
            volume_mm3: to_thousandth(mesh.volume_mm3()),
            design_volume_mm3: to_thousandth(part.volume_mm3),
            mass_g: to_thousandth(mass_of(masses, LineKind::Printed, part.name.slug())),
            bbox_mm: mesh.size_mm().map(to_thousandth),
            triangles: mesh.triangles.len(),
            files: files.iter().filter(|file| file.part == Some(part.name)).map(|file| file.path.clone()).collect(),
        })
        .collect()
}

fn rod_entries(design: &Design, masses: &MassTable) -> Vec<RodEntry> {
    design
        .skeleton
        .roles()
        .iter()
        .map(|role| RodEntry {
            name: role.slug().into(),
            quantity: design.skeleton.rods_of(*role).count() as u32,
            material: design.frame.rod_material.name.clone(),
            length_mm: to_thousandth(design.skeleton.length_mm(*role)),
            sawn_mm: to_thousandth(design.skeleton.sawn_mm(*role)),
            diameter_mm: design.frame.rods.rod_diameter_mm,
            mass_g: to_thousandth(mass_of(masses, LineKind::Rod, &format!("{}_rod", role.slug()))),
        })
        .collect()
}

fn exact_entries(design: &Design) -> Vec<ExactEntry> {
    let entry = |shape: &Shape| {
        let exact_volume_mm3 = to_thousandth(shape.exact_mm3?);
        Some(ExactEntry { name: shape.name.clone(), mesh_volume_mm3: to_thousandth(shape.solid.volume_mm3()), exact_volume_mm3 })
    };
    design.shapes.iter().filter_map(entry).collect()
}

fn mass_of(masses: &MassTable, kind: LineKind, name: &str) -> f64 {
    masses.line(kind, name).map_or(0.0, |line| line.each_g)
}

/// SHA-256 in hexadecimal.
pub fn hash(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}
