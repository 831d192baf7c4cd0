//! `flexframe coupon`: the test coupon for a printer's clearances and the strain limit of hinges, and its readings.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::candidates;
use super::failure::Failure;
use super::frame_text::{AmendedFile, Line};
use super::options::{Common, FrameOption};
use super::output;
use super::session;
use super::terminal;
use crate::checks::{self, Finding, Verdict};
use crate::export::stl;
use crate::frame::assembly::{Design, mass};
use crate::frame::fold;
use crate::impact::measured::{FoldReading, read_folds};
use crate::params::Frame;
use crate::params::frame_file::Value;
use crate::printing::coupon::{Coupon, CouponPlates, FOLDS, FoldedHinge, Found, HINGE_KEY, HingeLimit, Hinges};
use crate::printing::plates::PrintSettings;
use crate::report::page::coupon_page::{self, FOLD_TABLE};

/// Write a test coupon for a printer's clearances and the strain limit of hinges; turn its readings into parameters of a frame file.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe coupon\n  flexframe coupon my-frame.toml --read held=2.8,slides=3.1,window=0.1,plug=0.2 --into my-frame.toml\n  flexframe coupon --read out/cognifly-coupon/hinges.csv --into my-printer.toml\n\ncoupon.md in the folder describes the readings. A frame file inherits clearances and limit from its base."
)]
pub(super) struct Args {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Readings: held, slides, window, plug, hinge, each with the number on the coupon in mm; or the table of folded hinges.
    #[arg(long, value_delimiter = ',', value_name = "WHAT=MM|CSV", requires = "into", add = candidates::found_on_a_coupon())]
    pub read: Vec<String>,
    /// Write the resulting clearances and limit into a frame file. An existing file is amended; a new one has FRAME as its base.
    #[arg(long, value_name = "TOML", requires = "read")]
    pub into: Option<PathBuf>,
    /// Folder in which to write the folder `FRAME-coupon`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Writes the coupon's folder, or what was found on it.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let (frame, _) = session::load(&args.frame)?;
    if args.into.is_some() { read(&frame, args, common) } else { write(&frame, args, common) }
}

fn write(frame: &Frame, args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let coupon = Coupon::new(frame).map_err(|error| Failure::Usage { message: error.to_string() })?;
    let mut files = Vec::new();
    for piece in &coupon.pieces {
        let bytes =
            stl::binary(&piece.mesh).map_err(|error| Failure::Machine { what: format!("cannot make {}.stl", piece.name), error })?;
        files.push((format!("{}.stl", piece.name), bytes));
        let material = &piece.material.material;
        let settings =
            PrintSettings::of_part(false, material, &frame.printer).ini() + &PrintSettings::of_filament(material, &frame.printer).ini();
        files.push((format!("{}.ini", piece.name), settings.into_bytes()));
    }
    let CouponPlates { plates, no_room } = coupon.plates(&frame.printer);
    for (plate, name) in plates.iter().zip(coupon_page::plate_files(&plates)) {
        let bytes = coupon_page::plate(frame, plate);
        files.push((name.clone(), bytes.map_err(|error| Failure::Machine { what: format!("cannot make {name}"), error })?));
    }
    files.push((FOLD_TABLE.into(), coupon_page::fold_table(&coupon.hinges).into_bytes()));
    files.push(("coupon.png".into(), coupon_page::picture(&coupon)));
    let folder = format!("{}-coupon", frame.name);
    files.push(("coupon.md".into(), coupon_page::markdown(frame, &coupon, &no_room, &args.frame.frame).into_bytes()));
    let place = output::write_folder(&args.output, &folder, &files)?;
    if common.json {
        let names: Vec<String> = files.iter().map(|(name, _)| place.join(name).display().to_string()).collect();
        terminal::print_json(&serde_json::json!({
            "schema_version": 1,
            "folder": place.display().to_string(),
            "files": names,
            "no_room": no_room.iter().map(|piece| &piece.name).collect::<Vec<_>>(),
        }))?;
    } else if !common.quiet {
        terminal::print(&format!("{}: {} pieces to print; coupon.md says what to look for\n", place.display(), coupon.pieces.len()))?;
    }
    if !no_room.is_empty() {
        terminal::tell(&coupon_page::without_room(&no_room, &frame.printer));
    }
    Ok(ExitCode::SUCCESS)
}

/// Values that follow from what was found, each with the reason that stands behind it in the file.
type Set = Vec<(&'static str, f64, String)>;

fn read(frame: &Frame, args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let (tables, words): (Vec<&String>, Vec<&String>) = args.read.iter().partition(|said| is_table(said));
    let limit = match tables[..] {
        [] => None,
        [table] => Some((table, hinge_limit(frame, table)?)),
        _ => return Err(Failure::Usage { message: "--read: give one table of folded hinges".into() }),
    };
    let mut set = clearances(frame, &words)?;
    if let Some((table, limit)) = &limit {
        set.push((HINGE_KEY, limit.factor, format!("hinges folded {FOLDS} times, {table}: {}", bracket(limit))));
    }
    let line = |(key, value, why): &(&str, f64, String)| Line { key: (*key).into(), value: Value::Number(*value), why: why.clone() };
    let Some(place) = &args.into else { return Ok(ExitCode::SUCCESS) };
    let lines: Vec<Line> = set.iter().map(line).collect();
    let amended = AmendedFile::new(place, &args.frame.frame, "What a printer's prints were found to do", &lines)?;
    // What cannot be designed is refused before it is written.
    let design = amended.designed(common)?;
    amended.write()?;
    if common.json {
        let values: serde_json::Map<String, serde_json::Value> =
            set.iter().map(|(key, value, _)| ((*key).into(), (*value).into())).collect();
        let hinges = limit.as_ref().map(|(_, limit)| {
            serde_json::json!({
                "held_percent": limit.held.strain_percent,
                "cracked_percent": limit.cracked.map(|one| one.strain_percent),
                "elongation_percent": limit.elongation_percent,
            })
        });
        terminal::print_json(
            &serde_json::json!({ "schema_version": 1, "file": place.display().to_string(), "set": values, "hinges": hinges }),
        )?;
    } else if !common.quiet {
        let formatted: String = set.iter().map(|(key, value, _)| format!("{key:<40} {value}\n")).collect();
        let hinges = limit.as_ref().map(|(_, limit)| hinge_lines(limit)).unwrap_or_default();
        terminal::print(&format!("{hinges}{formatted}{}\n", place.display()))?;
    }
    tell_changes(frame, &design, place);
    Ok(ExitCode::SUCCESS)
}

/// Says what the frame with the new values does that the former did not: which limits it violates, as parts grow around wider bores, and by how
/// much more a thinner web is strained.
fn tell_changes(before: &Frame, design: &Design, place: &Path) {
    tell_strain(before, &design.frame);
    let found = checks::check(design, &mass::table(design));
    let violated: Vec<&Finding> = found.iter().filter(|finding| finding.verdict == Verdict::Violated).collect();
    for finding in &violated {
        terminal::tell(&format!("VIOLATED {}: {}", finding.rule, finding.message));
    }
    if !violated.is_empty() {
        terminal::tell(&format!("`flexframe check {} --remedies` looks for what helps", place.display()));
    }
}

/// Says that a thinner web is strained more, which a tongue that folds flat does not show.
fn tell_strain(before: &Frame, after: &Frame) {
    let [was_mm, is_mm] = [before, after].map(|frame| frame.corner.corner_hinge_thickness_mm);
    let strain = |frame: &Frame| fold::largest_web_strain_percent(frame).ok();
    if let (true, Some(was), Some(is)) = (is_mm < was_mm, strain(before), strain(after)) {
        terminal::tell(&format!(
            "corner.corner_hinge_thickness_mm {was_mm} -> {is_mm}: the corners' webs are strained by {is:.0} % instead of {was:.0} % when the frame \
             is folded, as a thinner web is stretched over a shorter length; {FOLD_TABLE} of the coupon finds what strain they bear"
        ));
    }
}

fn is_table(said: &str) -> bool {
    !said.contains('=') && Path::new(said).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"))
}

fn clearances(frame: &Frame, words: &[&String]) -> Result<Set, Failure> {
    let usage_error = |error: crate::printing::coupon::FindingError| Failure::Usage { message: format!("--read: {error}") };
    let found: Vec<Found> = words.iter().map(|words| Found::parse(words)).collect::<Result<_, _>>().map_err(usage_error)?;
    let set = Found::parameters(frame, &found).map_err(usage_error)?;
    let said: Vec<&str> = words.iter().map(|words| words.as_str()).collect();
    let why = format!("found on the coupon: {}", said.join(", "));
    Ok(set.into_iter().map(|(key, value)| (key, value, why.clone())).collect())
}

/// The limit that a table of folded hinges asks for; what contradicts itself is refused with its line.
fn hinge_limit(frame: &Frame, table: &str) -> Result<HingeLimit, Failure> {
    let readings = read_folds(Path::new(table), FOLDS)?;
    let usage = |message: String| Failure::Usage { message };
    let hinges = Hinges::of(frame).map_err(|error| usage(format!("{error}; {}", error.remedy())))?;
    let folded =
        |one: &FoldReading| FoldedHinge { thickness_mm: one.thickness_mm, fold_deg: one.fold_deg, cracked_after: one.cracked_after };
    HingeLimit::of(frame, &hinges, &readings.iter().map(folded).collect::<Vec<_>>()).map_err(|(at, error)| {
        let line = at.and_then(|at| readings.get(at)).map_or(String::new(), |one| format!(", line {}", one.line));
        usage(format!("{table}{line}: {error}"))
    })
}

/// Between which strains the material's limit lies.
fn bracket(limit: &HingeLimit) -> String {
    let held = format!("{:.0} % held", limit.held.strain_percent);
    match limit.cracked {
        Some(one) => {
            format!("{held}, {:.0} % cracked after {}", one.strain_percent, one.folded.cracked_after.unwrap_or_default())
        }
        None => format!("{held}, none cracked"),
    }
}

fn hinge_lines(limit: &HingeLimit) -> String {
    let line = |one: &crate::printing::coupon::StrainedHinge| {
        let became = one.folded.cracked_after.map_or(format!("held {FOLDS} folds"), |count| format!("cracked after {count} folds"));
        format!("{:.1} mm folded by {:.0} deg: {:.0} %, {became}\n", one.folded.thickness_mm, one.folded.fold_deg, one.strain_percent)
    };
    let all: String = limit.hinges.iter().map(line).collect();
    format!(
        "{all}{:.0} % of strain held; {:.0} % is the elongation at break: one sample of each, one direction of layers\n",
        limit.held.strain_percent, limit.elongation_percent
    )
}
