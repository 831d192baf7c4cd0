//! `flexframe schema`: the JSON Schema of a kind of file.

use std::process::ExitCode;

use clap::builder::{PossibleValue, PossibleValuesParser};

use super::failure::Failure;
use super::options::Common;
use super::terminal;
use crate::schema::CATALOGUE;

/// Print the JSON Schema of a kind of file, for editors.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example:\n  flexframe schema frame > frame.schema.json\n\nA frame file that begins with the line\n  #:schema ./frame.schema.json\nis then completed and checked by editors with Taplo, such as VS Code with Even Better TOML."
)]
pub(super) struct Args {
    /// Kind of file.
    #[arg(default_value = "frame", value_parser = kinds())]
    pub kind: String,
}

fn kinds() -> PossibleValuesParser {
    PossibleValuesParser::new(CATALOGUE.iter().map(|kind| PossibleValue::new(kind.name).help(kind.sentence)))
}

/// Prints a schema.
pub(super) fn run(args: &Args, _: &Common) -> Result<ExitCode, Failure> {
    // The parser takes no other names than the catalogue's.
    for kind in CATALOGUE.iter().filter(|kind| kind.name == args.kind) {
        terminal::print_json(&kind.schema())?;
    }
    Ok(ExitCode::SUCCESS)
}
