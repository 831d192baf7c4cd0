//! `flexframe bom`: the bill of materials.

use std::process::ExitCode;

use super::arguments::{BomFormat, BomOptions, Common};
use super::progress::Progress;
use super::session::{self, Failure};
use super::terminal;
use crate::export::{bill, bill_page, bom};
use crate::frame::assembly::mass;

/// Most that a saw cut may take, mm.
const WIDEST_KERF_MM: f64 = 10.0;

/// Prints the bill; exits 1 when a rod is longer than the stock.
pub(super) fn bom(options: &BomOptions, common: &Common) -> Result<ExitCode, Failure> {
    if let Some(kerf) = options.kerf.filter(|kerf| !(0.0..=WIDEST_KERF_MM).contains(kerf)) {
        return Err(Failure::Usage { message: format!("--kerf {kerf} is out of bounds: give 0 to {WIDEST_KERF_MM} mm") });
    }
    let working = Progress::of("listing", common);
    let design = session::design(&options.frame)?;
    let masses = mass::table(&design);
    let bill = bill::bill(&design, &masses, options.kerf);
    drop(working);
    match options.format {
        _ if common.json => terminal::print_json(&bill)?,
        BomFormat::Json => terminal::print_json(&bill)?,
        BomFormat::Csv => terminal::print(&bom::csv(&bill))?,
        BomFormat::Markdown => terminal::print(&bill_page::markdown(&bill))?,
    }
    if let Some(error) = &bill.cut_error {
        terminal::tell(error);
        return Ok(ExitCode::from(1));
    }
    Ok(ExitCode::SUCCESS)
}
