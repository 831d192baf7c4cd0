//! What a format of a frame's folder is: its record stands beside the code that writes it, [`CATALOGUE`](super::CATALOGUE) is the
//! only list of them.

use std::io;

use serde::Serialize;

use super::bill::Bill;
use crate::frame::assembly::Design;
use crate::frame::assembly::compensated::Compensated;
use crate::frame::assembly::mass::MassTable;
use crate::params::PartName;
use crate::printing::plates::Plate;

/// A format.
pub struct Format {
    /// Ending of its files, without the point.
    pub extension: &'static str,
    /// What its files hold, one sentence.
    pub sentence: &'static str,
    /// Whether it is written without being asked for; where not, `build` has an option of the extension's name.
    pub always: bool,
    /// Makes its files.
    pub files: fn(&Exported) -> Result<Vec<File>, ExportError>,
}

/// What the formats are made of.
pub struct Exported<'a> {
    /// The frame's bodies.
    pub design: &'a Design,
    /// Their masses.
    pub masses: &'a MassTable,
    /// Their bill of materials.
    pub bill: &'a Bill,
    /// The meshes for the frame's printer.
    pub meshes: &'a Compensated<'a>,
    /// Plates of that printer, each with its picture as PNG.
    pub plates: &'a [(Plate, Vec<u8>)],
}

/// A file of the folder.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct File {
    /// Path in the folder, with `/`.
    pub path: String,
    /// What stands in it.
    pub bytes: Vec<u8>,
    /// The printed part whose file it is; the manifest lists it there.
    pub part: Option<PartName>,
    /// The solids in it, where the format has solids; the manifest lists them.
    pub solids: Vec<SolidEntry>,
}

impl File {
    /// A file of the frame as a whole.
    pub fn new(path: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self { path: path.into(), bytes, ..Self::default() }
    }

    /// A file of one printed part, below `parts/`.
    pub fn of_part(part: PartName, extension: &str, bytes: Vec<u8>) -> Self {
        Self { part: Some(part), ..Self::new(format!("parts/{part}.{extension}"), bytes) }
    }
}

/// How the faces of a solid were made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Made {
    /// On the surfaces of the features, edges where they meet.
    Exact,
    /// On the surfaces of the features where that goes, facets of the mesh elsewhere.
    Mixed,
    /// From the mesh, coplanar facets merged.
    Faceted,
}

/// A part or shape of a STEP file, as the manifest lists it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SolidEntry {
    /// Its file; several solids share that of the assembly.
    pub file: String,
    /// Name of the part or shape.
    pub name: String,
    /// How its faces were made.
    pub made: Made,
    /// Why it is not exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub because: Option<String>,
    /// How many faces it has.
    pub faces: usize,
    /// How many of them are facets of the mesh.
    pub facets: usize,
    /// How many solids it is in the file; the four screws of a motor are one shape, and four solids.
    pub pieces: usize,
    /// Volume within its faces, mm³.
    pub volume_mm3: f64,
    /// Volume of the mesh, mm³.
    pub mesh_volume_mm3: f64,
}

/// A file could not be made.
#[derive(Debug, thiserror::Error)]
#[error("cannot make {what}: {error}")]
pub struct ExportError {
    /// The file.
    pub what: String,
    /// Why.
    pub error: io::Error,
}

impl ExportError {
    /// From what an encoder says.
    pub fn of<E: Into<Box<dyn std::error::Error + Send + Sync>>>(what: impl Into<String>) -> impl FnOnce(E) -> Self {
        let what = what.into();
        move |error| Self { what, error: io::Error::other(error) }
    }
}
