//! `flexframe coupon`: a small print that tells a printer's clearances, and what was found on it.

use std::process::ExitCode;

use super::arguments::{Common, CouponOptions};
use super::frame_text::{self, Line};
use super::output;
use super::session::{self, Failure};
use super::terminal;
use crate::export::stl;
use crate::params::Frame;
use crate::params::frame_file::Value;
use crate::printing::coupon::{Coupon, Found};
use crate::printing::plates::PrintSettings;
use crate::report::page::coupon_page;

/// Writes the coupon's folder, or what was found on it.
pub(super) fn coupon(options: &CouponOptions, common: &Common) -> Result<ExitCode, Failure> {
    let (frame, _) = session::load(&options.frame)?;
    if options.into.is_some() { read(&frame, options, common) } else { write(&frame, options, common) }
}

fn write(frame: &Frame, options: &CouponOptions, common: &Common) -> Result<ExitCode, Failure> {
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
    let place = output::write_folder(&options.output, &format!("{}-coupon", frame.name), &files)?;
    if common.json {
        let names: Vec<String> = files.iter().map(|(name, _)| place.join(name).display().to_string()).collect();
        terminal::print_json(&serde_json::json!({ "folder": place.display().to_string(), "files": names }))?;
    } else if !common.quiet {
        terminal::print(&format!("{}: three pieces to print; coupon.md says what to look for\n", place.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn read(frame: &Frame, options: &CouponOptions, common: &Common) -> Result<ExitCode, Failure> {
    let unfit = |error: crate::printing::coupon::Unfit| Failure::Usage { message: format!("--read: {error}") };
    let found: Vec<Found> = options.read.iter().map(|words| Found::parse(words)).collect::<Result<_, _>>().map_err(unfit)?;
    let set = Found::parameters(frame, &found).map_err(unfit)?;
    let why = format!("found on the coupon: {}", options.read.join(", "));
    let lines: Vec<Line> =
        set.iter().map(|(key, value)| Line { key: (*key).into(), value: Value::Number(*value), why: why.clone() }).collect();
    if let Some(place) = &options.into {
        frame_text::amend(place, &options.frame.frame, "Clearances of a printer", &lines)?;
        if common.json {
            let set: serde_json::Map<String, serde_json::Value> = set.iter().map(|(key, value)| ((*key).into(), (*value).into())).collect();
            terminal::print_json(&serde_json::json!({ "file": place.display().to_string(), "set": set }))?;
        } else if !common.quiet {
            let told: String = set.iter().map(|(key, value)| format!("{key:<40} {value}\n")).collect();
            terminal::print(&format!("{told}{}\n", place.display()))?;
        }
    }
    Ok(ExitCode::SUCCESS)
}
