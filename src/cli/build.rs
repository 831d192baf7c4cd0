//! `flexframe build`: a frame's folder.

use std::path::Path;
use std::process::ExitCode;

use rayon::prelude::*;

use super::arguments::{BuildOptions, Common};
use super::output;
use super::progress::Progress;
use super::session::{self, Failure};
use super::terminal;
use crate::checks::{self, Finding, Verdict};
use crate::export::{bill, bom, glb, manifest, step, stl, three_mf};
use crate::frame::assembly::compensated::Compensated;
use crate::frame::assembly::mass;
use crate::frame::assembly::mass::MassTable;
use crate::frame::assembly::{Design, Printed};
use crate::params::PartName;
use crate::params::refusal::nearest;
use crate::printing::plates;
use crate::printing::plates::{Plate, Wanted};
use crate::report::page::{print_settings, summary};
use crate::report::picture::{plate_picture, scene};

/// Most copies of one part.
const MOST_COPIES: usize = 100;

/// Builds a frame and writes its folder; a violated limit is a warning here, `check` gates.
pub(super) fn build(options: &BuildOptions, common: &Common) -> Result<ExitCode, Failure> {
    let working = Progress::of("building", common);
    let design = session::design(&options.frame)?;
    if let Some(part) = &options.part {
        return one_part(&design, part, options, common);
    }
    let masses = mass::table(&design);
    let findings = checks::check(&design, &masses);
    let files = files(&design, &masses, &findings, options)?;
    drop(working);
    let place = output::write_folder(&options.output, &design.frame.name, &files)?;
    for finding in findings.iter().filter(|finding| finding.verdict == Verdict::Violated) {
        terminal::tell(&format!("warning: {}", finding.message));
    }
    if common.json {
        let (_, manifest) = files.last().map_or(("", &[][..]), |(path, bytes)| (path.as_str(), bytes.as_slice()));
        terminal::print(&String::from_utf8_lossy(manifest))?;
    } else if !common.quiet {
        terminal::print(&table(&design, &masses, &place))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Every file of the folder, path and bytes; the manifest last.
fn files(design: &Design, masses: &MassTable, findings: &[Finding], options: &BuildOptions) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let failed = |what: String| move |error| Failure::Machine { what, error };
    let pictures = !options.no_pictures;
    let mut files = Vec::new();
    let meshes = compensated(design)?;
    for part in &design.printed {
        let mesh = meshes.mesh(part.name).unwrap_or(&part.mesh);
        let bytes = stl::binary(mesh).map_err(failed(format!("cannot make {}.stl", part.name)))?;
        files.push((format!("parts/{}.stl", part.name), bytes));
    }
    let frame = glb::frame(design, masses).map_err(std::io::Error::other).map_err(failed("cannot make frame.glb".into()))?;
    files.push(("frame.glb".into(), frame));
    files.push(("bom.csv".into(), bom::csv(&bill::bill(design, masses, None)).into_bytes()));
    // What lies on no bed is a finding of `check`; the parts are written all the same.
    if let Ok(plates) = plates::arrange(design, &plates::all(design)) {
        files.extend(plate_files(design, &meshes, &plates)?);
        files.push(("print-settings.md".into(), print_settings::markdown(design, &plates).into_bytes()));
    }
    let mut solids = Vec::new();
    if options.step {
        let (step, entries) = step::files(design).map_err(std::io::Error::other).map_err(failed("cannot make STEP files".into()))?;
        files.extend(step);
        solids = entries;
    }
    if pictures {
        files.extend(scene::pictures(design));
    }
    files.push(("report.md".into(), summary::markdown(design, masses, findings, pictures).into_bytes()));
    let manifest = manifest::manifest(design, &meshes, masses, solids, &files);
    let mut text =
        serde_json::to_string_pretty(&manifest).map_err(std::io::Error::from).map_err(failed("cannot make manifest.json".into()))?;
    text.push('\n');
    files.push(("manifest.json".into(), text.into_bytes()));
    Ok(files)
}

/// Pixels of a plate's picture.
const PLATE_SIZE: [u32; 2] = [480, 360];

/// The meshes for the frame's printer.
fn compensated(design: &Design) -> Result<Compensated<'_>, Failure> {
    Compensated::of(design).map_err(|error| Failure::Usage {
        message: format!(
            "{error} with hole_undersize_mm and elephant_foot_mm of the printer {}: make them smaller",
            design.frame.printer.name
        ),
    })
}

fn plate_files(design: &Design, meshes: &Compensated, plates: &[Plate]) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let files = |plate: &Plate| {
        let failed = |error| Failure::Machine { what: format!("cannot make {}.3mf", plate.name()), error };
        let picture = plate_picture::png(design, plate, PLATE_SIZE);
        let bytes = three_mf::plate(design, meshes, plate, &picture).map_err(failed)?;
        Ok([(format!("plates/{}.3mf", plate.name()), bytes), (format!("plates/{}.png", plate.name()), picture)])
    };
    let all = plates.par_iter().map(files).collect::<Result<Vec<_>, Failure>>()?;
    Ok(all.into_iter().flatten().collect())
}

/// Plates of a part that has to be printed again.
fn one_part(design: &Design, part: &str, options: &BuildOptions, common: &Common) -> Result<ExitCode, Failure> {
    let usage = |message: String| Failure::Usage { message };
    let known = || design.printed.iter().map(|printed| printed.name.slug());
    let Some(name) = PartName::ALL.into_iter().find(|name| name.slug() == part && design.part(*name).is_some()) else {
        let near = nearest(part, known());
        let near = if near.is_empty() { ".".into() } else { format!(", did you mean {}?", near.join(" or ")) };
        return Err(usage(format!(
            "--part {part}: the frame has no such printed part{near} It has {}",
            known().collect::<Vec<_>>().join(", ")
        )));
    };
    let quantity = options.quantity.unwrap_or(1);
    if !(1..=MOST_COPIES).contains(&quantity) {
        return Err(usage(format!("--quantity {quantity} is out of bounds: give 1 to {MOST_COPIES}")));
    }
    let wanted: [Wanted; 1] = [(name, quantity)];
    let plates = plates::arrange(design, &wanted).map_err(|error| usage(format!("{error}: choose another printer in the frame file")))?;
    let mut files = plate_files(design, &compensated(design)?, &plates)?;
    files.push(("print-settings.md".into(), print_settings::markdown(design, &plates).into_bytes()));
    let place = output::write_folder(&options.output, &format!("{}-{part}", design.frame.name), &files)?;
    if !common.quiet {
        terminal::print(&format!(
            "{}: {quantity} {part} on {} plate{}\n",
            place.display(),
            plates.len(),
            if plates.len() == 1 { "" } else { "s" }
        ))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// What was built, part by part.
fn table(design: &Design, masses: &MassTable, place: &Path) -> String {
    let mut text = format!("{:<24} {:>3}  {:<9} {:>9} {:>8}  size mm\n", "part", "pcs", "material", "mm3", "g each");
    for part in &design.printed {
        text += &row(part, masses);
    }
    for line in masses.lines.iter().filter(|line| line.kind == "rod") {
        let name = line.name.trim_end_matches("_rod");
        let rod = design.skeleton.rods.iter().find(|rod| rod.role.slug() == name);
        let sawn = rod.map_or(0.0, |rod| design.skeleton.sawn_mm(rod.role));
        text += &format!("{:<24} {:>3}  {:<9} {:>9} {:>8.2}  saw to {sawn:.1}\n", line.name, line.quantity, line.material, "", line.each_g);
    }
    text + &format!("{}: {:.1} g in all, of which {:.1} g are estimates\n", place.display(), masses.total_g, masses.estimated_g)
}

fn row(part: &Printed, masses: &MassTable) -> String {
    let [x, y, z] = part.mesh.size_mm();
    let line = masses.lines.iter().find(|line| line.name == part.name.slug());
    let (material, each) = line.map_or(("", 0.0), |line| (line.material.as_str(), line.each_g));
    let (name, quantity, volume) = (part.name.slug(), part.name.quantity(), part.volume_mm3);
    format!("{name:<24} {quantity:>3}  {material:<9} {volume:>9.0} {each:>8.2}  {x:.1} x {y:.1} x {z:.1}\n")
}
