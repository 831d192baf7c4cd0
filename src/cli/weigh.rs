//! `flexframe weigh`: printed masses by volume, by a slicer, by a scale.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::ExitCode;

use super::arguments::{Common, FrameOption, WeighOptions};
use super::frame_text::{self, Line};
use super::progress::Progress;
use super::session::{self, Failure};
use super::slicer::Slicer;
use super::terminal;
use crate::frame::assembly::{Design, mass};
use crate::impact::measured::{ScaleReading, read_scale};
use crate::params::PartName;
use crate::params::frame_file::Value;
use crate::printing::weighing::{Fitted, Reading, Sliced, Weighing};
use crate::report::page::weighing_page;

/// Prints the table; exits 1 when the frame is too heavy with the factors that the scale asks for.
pub(super) fn weigh(options: &WeighOptions, common: &Common) -> Result<ExitCode, Failure> {
    let (frame, readings_file) = given(&options.given)?;
    if options.into.is_some() && readings_file.is_none() {
        return Err(Failure::Usage { message: "--into writes what readings of a scale ask for: give their CSV table, too".into() });
    }
    let scale: Vec<ScaleReading> = readings_file.map(|file| read_scale(Path::new(file))).transpose()?.unwrap_or_default();
    let slicer = options.slicer.as_deref().map(Slicer::found).transpose()?;
    let working = Progress::of("weighing", common);
    let design = session::design(&FrameOption { frame: frame.into(), rigid: options.rigid.clone() })?;
    let sliced = slicer.as_ref().map(|slicer| slicer.all(&design)).transpose()?.unwrap_or_default();
    drop(working);
    let weighing = table(&design, &scale, &sliced, readings_file.unwrap_or_default())?;
    if let Some(place) = &options.into {
        let lines = lines(&weighing, readings_file.unwrap_or_default());
        frame_text::amend(place, frame, "Print factors as weighed", &lines)?;
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

/// What the scale asks for, as lines of a frame file.
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
