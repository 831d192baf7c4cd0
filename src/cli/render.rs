//! `flexframe render`: the pictures alone.

use std::path::PathBuf;
use std::process::ExitCode;

use super::failure::Failure;
use super::options::{Common, FrameOption};
use super::output;
use super::progress::Progress;
use super::session;
use super::terminal;
use crate::frame::assembly::{Design, Printed};
use crate::printing::plates;
use crate::report::picture::{printing_picture, scene};

/// Write PNG pictures: assembled from four sides, flat on the bed, each part.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  flexframe render cognifly-mini -o pictures")]
pub(super) struct Args {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Instead, draw the parts as they are printed, from above and from below, and mark overhangs, thin walls and poor footing; a part
    /// without any of these has no picture.
    #[arg(long)]
    pub findings: bool,
    /// Folder in which to write the folder `FRAME-pictures`, or `FRAME-findings`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Writes `FRAME-pictures` with every picture, or `FRAME-findings`.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let working = Progress::of("drawing", common);
    let design = session::design(&args.frame, common)?;
    let files: Vec<(String, Vec<u8>)> = if args.findings {
        printing_picture::pictures(&design)
    } else {
        // What lies on no bed is a finding of `check`.
        let plates = plates::arrange_what_fits(&design, &plates::all(&design));
        scene::pictures(&design, &plates)
            .into_iter()
            .map(|(path, bytes)| (path.trim_start_matches("pictures/").to_string(), bytes))
            .collect()
    };
    drop(working);
    let place = output::write_folder(
        &args.output,
        &format!("{}-{}", design.frame.name, if args.findings { "findings" } else { "pictures" }),
        &files,
    )?;
    if common.json {
        let paths: Vec<String> = files.iter().map(|(path, _)| place.join(path).display().to_string()).collect();
        terminal::print_json(&serde_json::json!({ "schema_version": 1, "folder": place.display().to_string(), "pictures": paths }))?;
    } else if !common.quiet {
        let unmarked = if args.findings { unmarked(&design, &files) } else { String::new() };
        terminal::tell(&format!("{}: {} pictures{unmarked}", place.display(), files.len()));
    }
    Ok(ExitCode::SUCCESS)
}

/// The parts without a picture of findings, as a clause; empty where each has one.
fn unmarked(design: &Design, files: &[(String, Vec<u8>)]) -> String {
    let is_drawn = |part: &&Printed| files.iter().any(|(path, _)| *path == printing_picture::file_of(part.name));
    let parts: Vec<&str> = design.printed.iter().filter(|part| !is_drawn(part)).map(|part| part.name.slug()).collect();
    if parts.is_empty() { String::new() } else { format!("; nothing to mark on {}", parts.join(", ")) }
}
