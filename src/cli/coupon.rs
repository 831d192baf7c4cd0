//! `flexframe coupon`: a small print that tells a printer's clearances, and what was found on it.

use std::path::PathBuf;
use std::process::ExitCode;

use super::failure::Failure;
use super::frame_text::{self, Line};
use super::options::{Common, FrameOption};
use super::output;
use super::session;
use super::terminal;
use crate::export::stl;
use crate::params::Frame;
use crate::params::frame_file::Value;
use crate::printing::coupon::{Coupon, Found};
use crate::printing::plates::PrintSettings;
use crate::report::page::coupon_page;

/// Write a small print that tells a printer's clearances; read what was found on it into a frame file.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe coupon\n  flexframe coupon my-frame.toml --read held=2.8,slides=3.1,window=0.1,plug=0.2 --into my-frame.toml\n\nThe folder's coupon.md says what to look for. A frame file with another one as its base has the clearances of that one."
)]
pub(super) struct Args {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// What was found: held, slides, window, plug, hinge, each with the number on the coupon in mm.
    #[arg(long, value_delimiter = ',', value_name = "WHAT=MM", requires = "into")]
    pub read: Vec<String>,
    /// Write the clearances that follow into a frame file: one that is there is amended, a new one has FRAME as its base.
    #[arg(long, value_name = "TOML", requires = "read")]
    pub into: Option<PathBuf>,
    /// Folder that takes the folder `FRAME-coupon`.
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
        let settings = PrintSettings::of_part(false, material, &frame.printer).ini() + &PrintSettings::of_filament(material).ini();
        files.push((format!("{}.ini", piece.name), settings.into_bytes()));
    }
    files.push(("coupon.png".into(), coupon_page::picture(&coupon)));
    files.push(("coupon.md".into(), coupon_page::markdown(frame, &coupon).into_bytes()));
    let place = output::write_folder(&args.output, &format!("{}-coupon", frame.name), &files)?;
    if common.json {
        let names: Vec<String> = files.iter().map(|(name, _)| place.join(name).display().to_string()).collect();
        terminal::print_json(&serde_json::json!({ "folder": place.display().to_string(), "files": names }))?;
    } else if !common.quiet {
        terminal::print(&format!("{}: three pieces to print; coupon.md says what to look for\n", place.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn read(frame: &Frame, args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let unfit = |error: crate::printing::coupon::FindingError| Failure::Usage { message: format!("--read: {error}") };
    let found: Vec<Found> = args.read.iter().map(|words| Found::parse(words)).collect::<Result<_, _>>().map_err(unfit)?;
    let set = Found::parameters(frame, &found).map_err(unfit)?;
    let why = format!("found on the coupon: {}", args.read.join(", "));
    let lines: Vec<Line> =
        set.iter().map(|(key, value)| Line { key: (*key).into(), value: Value::Number(*value), why: why.clone() }).collect();
    if let Some(place) = &args.into {
        frame_text::amend(place, &args.frame.frame, "Clearances of a printer", &lines)?;
        if common.json {
            let set: serde_json::Map<String, serde_json::Value> = set.iter().map(|(key, value)| ((*key).into(), (*value).into())).collect();
            terminal::print_json(&serde_json::json!({ "file": place.display().to_string(), "set": set }))?;
        } else if !common.quiet {
            let formatted: String = set.iter().map(|(key, value)| format!("{key:<40} {value}\n")).collect();
            terminal::print(&format!("{formatted}{}\n", place.display()))?;
        }
    }
    Ok(ExitCode::SUCCESS)
}
