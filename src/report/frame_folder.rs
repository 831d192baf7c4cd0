//! The folder of a frame: every file that `build` writes, path and bytes.

use std::ops::ControlFlow;

use rayon::prelude::*;

use super::page::{print_settings, summary};
use super::picture::{plate_picture, scene};
use crate::checks::Finding;
use crate::export::bill::bill;
use crate::export::{self, ExportError, Exported, File, Format, manifest, step, three_mf};
use crate::frame::assembly::compensated::Compensated;
use crate::frame::assembly::mass::MassTable;
use crate::frame::assembly::{Design, DesignError, mass};
use crate::params::PartName;
use crate::printing::plates;
use crate::printing::plates::{Plate, Wanted};
use crate::solid::gate::GateError;

/// Which of the files that may be left out are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FolderChoice {
    /// Pictures of the frame.
    pub pictures: bool,
    /// STEP files.
    pub step: bool,
}

impl FolderChoice {
    /// Whether a format is asked for.
    fn asks_for(self, format: &Format) -> bool {
        format.always || self.step && format.extension == step::FORMAT.extension
    }
}

/// Why a folder cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// The printer's compensation leaves no sound mesh.
    #[error("{error} with hole_undersize_mm and elephant_foot_mm of the printer {printer}: make them smaller")]
    Compensation {
        /// What is wrong with which part.
        error: DesignError,
        /// The printer.
        printer: String,
    },
    /// The facets that are drawn for the printer's compensation do not close, though the figures leave a part.
    #[error(
        "no sound mesh of {part} was found for hole_undersize_mm and elephant_foot_mm of the printer {printer}, though the figures may be right: change one of them by 0.01 mm"
    )]
    Unsound {
        /// The part.
        part: PartName,
        /// The printer.
        printer: String,
    },
    /// A file cannot be made.
    #[error(transparent)]
    File(#[from] ExportError),
}

/// Every file of the folder, the manifest last.
///
/// # Errors
/// [`FolderError`] when a file cannot be made.
pub fn files(design: &Design, masses: &MassTable, findings: &[Finding], choice: FolderChoice) -> Result<Vec<File>, FolderError> {
    Ok(followed(design, masses, findings, choice, &|_, _| ControlFlow::Continue(()))?.unwrap_or_default())
}

/// The same, asking before each format and picture whether it goes on; none when it was ended.
///
/// # Errors
/// [`FolderError`] when a file cannot be made.
pub fn followed(
    design: &Design,
    masses: &MassTable,
    findings: &[Finding],
    choice: FolderChoice,
    begins: &scene::Begins,
) -> Result<Option<Vec<File>>, FolderError> {
    let meshes = compensated(design)?;
    // What lies on no bed is a finding of `check`; the parts are written all the same.
    let plates = with_pictures(design, plates::arrange_what_fits(design, &plates::all(design)));
    let bill = bill(design, masses, None);
    let of = Exported { design, masses, bill: &bill, meshes: &meshes, plates: &plates };
    let mut files = Vec::new();
    let formats: Vec<_> = export::CATALOGUE.iter().filter(|format| choice.asks_for(format)).collect();
    for format in &formats {
        if begins(format.extension, formats.len()).is_break() {
            return Ok(None);
        }
        files.extend((format.files)(&of)?);
    }
    if !plates.is_empty() {
        files.push(settings_page(design, &plates, &plates::all(design)));
    }
    if choice.pictures {
        let bare: Vec<Plate> = plates.iter().map(|(plate, _)| plate.clone()).collect();
        let Some(pictures) = scene::pictures_followed(design, &bare, begins) else { return Ok(None) };
        files.extend(pictures.into_iter().map(|(path, bytes)| File::new(path, bytes)));
    }
    files.push(File::new("report.md", summary::markdown(design, masses, &bill, findings, &plates, choice.pictures).into_bytes()));
    let manifest = manifest::manifest(design, &meshes, masses, &files);
    let text = manifest::signed_text(&manifest).map_err(ExportError::of("manifest.json"))?;
    files.push(File::new("manifest.json", text.into_bytes()));
    Ok(Some(files))
}

/// The files of one format alone, with the same bytes as in the folder.
///
/// # Errors
/// [`FolderError`] when one cannot be made.
pub fn format_files(design: &Design, masses: &MassTable, format: &Format) -> Result<Vec<File>, FolderError> {
    let needs_plates = format.extension == three_mf::FORMAT.extension;
    let plates = if needs_plates { plates::arrange_what_fits(design, &plates::all(design)) } else { Vec::new() };
    let plates = with_pictures(design, plates);
    let (bill, meshes) = (bill(design, masses, None), compensated(design)?);
    Ok((format.files)(&Exported { design, masses, bill: &bill, meshes: &meshes, plates: &plates })?)
}

/// The files of these plates, and how to print them.
///
/// # Errors
/// [`FolderError`] when one cannot be made.
pub fn plate_files(design: &Design, plates: Vec<Plate>) -> Result<Vec<File>, FolderError> {
    let (masses, plates) = (mass::table(design), with_pictures(design, plates));
    let lies_on_one = |name| plates.iter().any(|(plate, _)| plate.items.iter().any(|item| item.part == name));
    let meshes = Compensated::some(design, lies_on_one).map_err(|error| refusal(design, error))?;
    let bill = bill(design, &masses, None);
    let of = Exported { design, masses: &masses, bill: &bill, meshes: &meshes, plates: &plates };
    let mut files = (three_mf::FORMAT.files)(&of)?;
    files.push(settings_page(design, &plates, &[]));
    Ok(files)
}

/// How to print the plates, as a page that names what of the wanted parts lies on none.
fn settings_page(design: &Design, plates: &[(Plate, Vec<u8>)], wanted: &[Wanted]) -> File {
    let plates: Vec<Plate> = plates.iter().map(|(plate, _)| plate.clone()).collect();
    let no_room = plates::without_room(&plates, wanted);
    File::new("print-settings.md", print_settings::markdown(design, &plates, &no_room).into_bytes())
}

/// Pixels of a plate's picture.
const PLATE_SIZE: [u32; 2] = [480, 360];

/// The meshes for the frame's printer.
fn compensated(design: &Design) -> Result<Compensated<'_>, FolderError> {
    Compensated::of(design).map_err(|error| refusal(design, error))
}

/// Why the meshes for the frame's printer cannot be made: only figures that take a part away are too large.
fn refusal(design: &Design, error: DesignError) -> FolderError {
    let printer = design.frame.printer.name.clone();
    match error {
        DesignError::Part { part, error: GateError::OpenEdges { .. } | GateError::ZeroArea { .. } | GateError::SelfIntersecting } => {
            FolderError::Unsound { part, printer }
        }
        error => FolderError::Compensation { error, printer },
    }
}

/// Plates, each with its picture.
fn with_pictures(design: &Design, plates: Vec<Plate>) -> Vec<(Plate, Vec<u8>)> {
    plates.into_par_iter().map(|plate| (plate_picture::png(design, &plate, PLATE_SIZE), plate)).map(|(png, plate)| (plate, png)).collect()
}
