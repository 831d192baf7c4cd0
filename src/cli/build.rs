//! `flexframe build`: a frame's folder.

use std::process::ExitCode;

use super::arguments::{BuildOptions, Common};
use super::output;
use super::session::{self, Failure};
use crate::assembly::mass;
use crate::assembly::{Design, mass::MassTable};
use crate::export::{bom, glb, manifest, stl};

/// Builds a frame and writes its folder.
pub(super) fn build(options: &BuildOptions, common: &Common) -> Result<ExitCode, Failure> {
    let design = session::design(&options.frame)?;
    let masses = mass::table(&design);
    let files = files(&design, &masses)?;
    let place = output::write_folder(&options.output, &design.frame.name, &files)?;
    if !common.quiet {
        eprintln!("{}: {} files, {:.1} g", place.display(), files.len(), masses.total_g);
    }
    Ok(ExitCode::SUCCESS)
}

/// Every file of the folder, path and bytes; the manifest last.
fn files(design: &Design, masses: &MassTable) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let mut files = Vec::new();
    for part in &design.printed {
        let bytes = stl::binary(&part.mesh).map_err(|error| Failure::Machine { what: format!("cannot make {}.stl", part.name), error })?;
        files.push((format!("parts/{}.stl", part.name), bytes));
    }
    let frame = glb::frame(design, masses)
        .map_err(|error| Failure::Machine { what: "cannot make frame.glb".into(), error: std::io::Error::other(error) })?;
    files.push(("frame.glb".into(), frame));
    files.push(("bom.csv".into(), bom::csv(design, masses).into_bytes()));
    let manifest = manifest::manifest(design, masses, &files);
    let mut text = serde_json::to_string_pretty(&manifest)
        .map_err(|error| Failure::Machine { what: "cannot make manifest.json".into(), error: error.into() })?;
    text.push('\n');
    files.push(("manifest.json".into(), text.into_bytes()));
    Ok(files)
}
