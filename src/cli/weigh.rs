//! `flexframe weigh`: printed masses by volume, by a slicer, by a scale.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::candidates;
use super::failure::Failure;
use super::frame_text::{self, AmendedFile, Line};
use super::options::{Common, FrameOption};
use super::progress::Progress;
use super::session;
use super::slicer::Slicer;
use super::terminal;
use crate::frame::assembly::{Design, mass};
use crate::impact::measured::{ScaleReading, read_scale};
use crate::params::PartName;
use crate::params::frame_file::Value;
use crate::printing::weighing::{Fitted, Reading, Sliced, Weighing};
use crate::report::page::weighing_page;

/// Compare the masses of parts by volume, by a slicer and on a scale, and fit the print factors to the scale.
#[derive(Debug, clap::Args)]
#[command(
    override_usage = "flexframe weigh [OPTIONS] [FRAME] [READINGS.csv]",
    after_help = "Examples:\n  flexframe weigh --slicer\n  flexframe weigh measured.csv\n  flexframe weigh my-frame.toml measured.csv --slicer --into my-frame.toml\n\nReadings are a CSV table with the columns part,mass_g and, if several parts were weighed together, quantity. --slicer runs\nPrusaSlicer, which has to be installed. Exit code 1 when the frame, with the fitted factors, is heavier than its limit."
)]
pub(super) struct Args {
    /// A preset's name or a TOML file, and a CSV table of readings of a scale. Either may be left out.
    #[arg(num_args = 0..=2, value_names = ["FRAME", "READINGS.csv"], add = candidates::frames())]
    pub given: Vec<String>,
    /// Material of the rigid parts instead of the frame file's: a name of params/materials.toml.
    #[arg(long, value_name = "MATERIAL", add = candidates::materials())]
    pub rigid: Option<String>,
    /// Slice every part with prusa-slicer; --slicer=PROGRAM names another program.
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "prusa-slicer", value_name = "PROGRAM")]
    pub slicer: Option<String>,
    /// Write the fitted factors into a frame file. An existing file is amended; a new one has FRAME as its base.
    #[arg(long, value_name = "TOML")]
    pub into: Option<PathBuf>,
}

/// Prints the table; exits 1 when the frame is too heavy with the fitted factors.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let (frame, readings_file) = given(&args.given)?;
    if args.into.is_some() && readings_file.is_none() {
        return Err(Failure::Usage { message: "--into writes what readings of a scale ask for: give their CSV table, too".into() });
    }
    let scale: Vec<ScaleReading> = readings_file.map(|file| read_scale(Path::new(file))).transpose()?.unwrap_or_default();
    let slicer = args.slicer.as_deref().map(Slicer::found).transpose()?;
    let working = Progress::of("weighing", common);
    let design = session::design(&FrameOption { frame: frame.into(), rigid: args.rigid.clone() }, common)?;
    let sliced = slicer.as_ref().map(|slicer| slicer.all(&design)).transpose()?.unwrap_or_default();
    drop(working);
    let weighing = table(&design, &scale, &sliced, readings_file.unwrap_or_default())?;
    if let Some(place) = &args.into {
        let lines = lines(&weighing, readings_file.unwrap_or_default());
        let amended = AmendedFile::new(place, frame, "Print factors as weighed", &lines)?;
        // What cannot be designed is refused before it is written.
        amended.designed(common)?;
        amended.write()?;
    }
    if common.json {
        terminal::print_json(&weighing_page::json(&design.frame.name, &weighing))?;
    } else if !common.quiet {
        terminal::print(&weighing_page::table(&weighing))?;
    }
    let too_heavy = weighing.is_weighed() && weighing.after_g().0 > weighing.limit_g;
    Ok(ExitCode::from(u8::from(too_heavy)))
}

/// The frame and the readings among the arguments.
fn given(given: &[String]) -> Result<(&str, Option<&str>), Failure> {
    let is_table = |name: &&String| Path::new(name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"));
    let (tables, frames): (Vec<&String>, Vec<&String>) = given.iter().partition(is_table);
    match (&frames[..], &tables[..]) {
        ([], []) => Ok(("cognifly", None)),
        ([], [table]) => Ok(("cognifly", Some(table))),
        ([frame], []) => Ok((frame, None)),
        ([frame], [table]) => Ok((frame, Some(table))),
        _ => Err(Failure::Usage { message: "give one frame and one table of readings, whose name ends in .csv".into() }),
    }
}

fn table(design: &Design, scale: &[ScaleReading], sliced: &BTreeMap<PartName, Sliced>, file: &str) -> Result<Weighing, Failure> {
    let reading =
        |one: &ScaleReading| Reading { part: one.part.clone(), quantity: one.quantity, mass_g: one.mass_g, resolution_g: one.resolution_g };
    let readings: Vec<Reading> = scale.iter().map(reading).collect();
    Weighing::new(design, &mass::table(design), &readings, sliced).map_err(|(at, misread)| {
        let line = scale.get(at).map_or(0, |one| one.line);
        Failure::Usage { message: format!("{file}, line {line}: {misread}") }
    })
}

/// The fitted factors, as lines of a frame file.
fn lines(weighing: &Weighing, file: &str) -> Vec<Line> {
    let line = |fitted: &Fitted| {
        let after = fitted.after?;
        let interval = after.interval.map_or("no interval".into(), |[low, high]| format!("95 % {low:.3} to {high:.3}"));
        Some(Line {
            key: frame_text::key(&["override", "materials", &fitted.material, "print_factor"]),
            value: Value::Number((1e4 * after.value).round() / 1e4),
            why: format!("weighed, {file}: {interval}"),
        })
    };
    weighing.fitted.iter().filter_map(line).collect()
}
