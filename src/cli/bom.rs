//! `flexframe bom`: the bill of materials.

use std::process::ExitCode;

use super::bounded::number;
use super::failure::Failure;
use super::options::{Common, FrameOption};
use super::progress::Progress;
use super::session;
use super::terminal;
use crate::export::{bill, bill_page, bom};
use crate::frame::assembly::mass;

/// List the parts to print and to buy, and the rods to cut.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  flexframe bom light.toml\n  flexframe bom light.toml --format csv --kerf 1.5 > bom.csv")]
pub(super) struct Args {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Format of the list, a page by default; --json is the same as --format json.
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub format: Option<BomFormat>,
    /// Width of a saw cut, mm, instead of 1 mm.
    #[arg(long, value_name = "MM", value_parser = number([0.0, WIDEST_KERF_MM], "mm"))]
    pub kerf: Option<f64>,
}

impl Args {
    /// Whether JSON is asked for by the format.
    pub fn wants_json(&self) -> bool {
        self.format == Some(BomFormat::Json)
    }
}

/// Forms of a bill of materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum BomFormat {
    /// A page.
    Markdown,
    /// A table, as in `bom.csv`.
    Csv,
    /// Everything.
    Json,
}

/// Most that a saw cut may take, mm.
const WIDEST_KERF_MM: f64 = 10.0;

/// Prints the bill; exits 1 when a rod is longer than the stock.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let format = match (args.format, common.json) {
        (None, false) => BomFormat::Markdown,
        (None | Some(BomFormat::Json), true) => BomFormat::Json,
        (Some(_), true) => return Err(Failure::Usage { message: "--json contradicts --format: leave one of them out".into() }),
        (Some(format), false) => format,
    };
    let working = Progress::of("listing", common);
    let design = session::design(&args.frame, common)?;
    let masses = mass::table(&design);
    let bill = bill::bill(&design, &masses, args.kerf);
    drop(working);
    match format {
        BomFormat::Json => terminal::print_json(&bill)?,
        BomFormat::Csv => terminal::print(&bom::csv(&bill)?)?,
        BomFormat::Markdown => terminal::print(&bill_page::markdown(&bill))?,
    }
    if let Some(error) = &bill.cut_error {
        terminal::tell(error);
        return Ok(ExitCode::from(1));
    }
    Ok(ExitCode::SUCCESS)
}
