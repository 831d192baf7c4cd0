//! `flexframe render`: the pictures alone.

use std::process::ExitCode;

use super::arguments::{Common, RenderOptions};
use super::output;
use super::progress::Progress;
use super::session::{self, Failure};
use super::terminal;
use crate::report::picture::{printing_picture, scene};

/// Writes `FRAME-pictures` with every picture, or `FRAME-findings`.
pub(super) fn render(options: &RenderOptions, common: &Common) -> Result<ExitCode, Failure> {
    let working = Progress::of("drawing", common);
    let design = session::design(&options.frame)?;
    let files: Vec<(String, Vec<u8>)> = if options.findings {
        printing_picture::pictures(&design)
    } else {
        scene::pictures(&design).into_iter().map(|(path, bytes)| (path.trim_start_matches("pictures/").to_string(), bytes)).collect()
    };
    drop(working);
    let place = output::write_folder(
        &options.output,
        &format!("{}-{}", design.frame.name, if options.findings { "findings" } else { "pictures" }),
        &files,
    )?;
    if common.json {
        let paths: Vec<String> = files.iter().map(|(path, _)| place.join(path).display().to_string()).collect();
        terminal::print_json(&serde_json::json!({ "folder": place.display().to_string(), "pictures": paths }))?;
    } else if !common.quiet {
        terminal::tell(&format!("{}: {} pictures", place.display(), files.len()));
    }
    Ok(ExitCode::SUCCESS)
}
