//! `flexframe build`: a frame's folder.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde::Serialize;

use super::bounded::count;
use super::candidates;
use super::failure::Failure;
use super::options::{Common, FrameOption};
use super::output;
use super::progress::Progress;
use super::session;
use super::terminal;
use crate::checks::{self, Verdict, is_too_cold};
use crate::export::File;
use crate::frame::assembly::mass;
use crate::frame::assembly::mass::{LineKind, MassTable};
use crate::frame::assembly::{Design, Printed};
use crate::params::PartName;
use crate::params::refusal::nearest;
use crate::printing::plates;
use crate::printing::plates::Wanted;
use crate::report::frame_folder;
use crate::report::frame_folder::FolderChoice;

/// Write STL, GLB, bill of materials, manifest, report and pictures of a frame.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  flexframe build\n  flexframe build my-frame.toml -o frames --rigid pla")]
pub(super) struct Args {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Folder in which the frame's folder is written.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
    /// Leave out the pictures.
    #[arg(long)]
    pub no_pictures: bool,
    /// Write STEP files, too: one for each part, and `frame.step` for the assembly.
    #[arg(long, conflicts_with = "part")]
    pub step: bool,
    /// Write plates of one printed part only, as a spare, into the folder `FRAME-PART`.
    #[arg(long, value_name = "PART", add = candidates::printed())]
    pub part: Option<String>,
    /// With --part: number of copies, 1 by default.
    #[arg(long, value_name = "N", requires = "part", value_parser = count([1, MOST_COPIES]))]
    pub quantity: Option<usize>,
}

/// Most copies of one part.
const MOST_COPIES: u32 = 100;

/// Builds a frame and writes its folder; a violated limit is a warning here, `check` gates.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let working = Progress::of("building", common);
    let design = session::design(&args.frame, common)?;
    if let Some(part) = &args.part {
        return one_part(&design, part, args, common);
    }
    let masses = mass::table(&design);
    let findings = checks::check(&design, &masses);
    let choice = FolderChoice { pictures: !args.no_pictures, step: args.step };
    let files = written(frame_folder::files(&design, &masses, &findings, choice)?);
    drop(working);
    let place = output::write_folder(&args.output, &design.frame.name, &files)?;
    for finding in findings.iter().filter(|finding| finding.verdict == Verdict::Violated || is_too_cold(finding)) {
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

/// Path and bytes of each.
fn written(files: Vec<File>) -> Vec<(String, Vec<u8>)> {
    files.into_iter().map(|file| (file.path, file.bytes)).collect()
}

/// What was written of a part that has to be printed again.
#[derive(Serialize)]
struct SpareParts<'a> {
    schema_version: u32,
    part: &'a str,
    quantity: usize,
    plates: usize,
    folder: String,
    /// Paths in the folder.
    files: Vec<&'a str>,
}

/// Plates of a part that has to be printed again.
fn one_part(design: &Design, part: &str, args: &Args, common: &Common) -> Result<ExitCode, Failure> {
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
    let quantity = args.quantity.unwrap_or(1);
    let wanted: [Wanted; 1] = [(name, quantity)];
    let plates = plates::arrange(design, &wanted).map_err(|error| usage(format!("{error}: choose another printer in the frame file")))?;
    let count = plates.len();
    let files = frame_folder::plate_files(design, plates)?;
    let files = written(files);
    let place = output::write_folder(&args.output, &format!("{}-{part}", design.frame.name), &files)?;
    if common.json {
        let paths = files.iter().map(|(path, _)| path.as_str()).collect();
        terminal::print_json(&SpareParts {
            schema_version: 1,
            part,
            quantity,
            plates: count,
            folder: place.display().to_string(),
            files: paths,
        })?;
    } else if !common.quiet {
        terminal::print(&format!("{}: {quantity} {part} on {} plate{}\n", place.display(), count, if count == 1 { "" } else { "s" }))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// What was built, part by part.
fn table(design: &Design, masses: &MassTable, place: &Path) -> String {
    let mut text = format!("{:<24} {:>3}  {:<9} {:>9} {:>8}  size mm\n", "part", "pcs", "material", "mm3", "g each");
    for part in &design.printed {
        text += &row(part, masses);
    }
    for line in masses.lines.iter().filter(|line| line.kind == LineKind::Rod) {
        let name = line.name.trim_end_matches("_rod");
        let rod = design.skeleton.rods.iter().find(|rod| rod.role.slug() == name);
        let sawn = rod.map_or(0.0, |rod| design.skeleton.sawn_mm(rod.role));
        text += &format!("{:<24} {:>3}  {:<9} {:>9} {:>8.2}  saw to {sawn:.1}\n", line.name, line.quantity, line.material, "", line.each_g);
    }
    text + &format!("{}: {:.1} g in all, of which {:.1} g are estimates\n", place.display(), masses.total_g, masses.estimated_g)
}

fn row(part: &Printed, masses: &MassTable) -> String {
    let [x, y, z] = part.mesh.size_mm();
    let line = masses.printed(part.name);
    let (material, each) = line.map_or(("", 0.0), |line| (line.material.as_str(), line.each_g));
    let (name, quantity, volume) = (part.name.slug(), part.part.quantity(), part.volume_mm3);
    format!("{name:<24} {quantity:>3}  {material:<9} {volume:>9.0} {each:>8.2}  {x:.1} x {y:.1} x {z:.1}\n")
}
