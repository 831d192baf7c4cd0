//! `flexframe schema`: the JSON Schema of a kind of file.

use std::process::ExitCode;

use super::failure::Failure;
use super::options::Common;
use super::terminal;
use crate::schema::{FileKind, schema};

/// Print the JSON Schema of a kind of file, for editors.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example:\n  flexframe schema frame > frame.schema.json\n\nA frame file that begins with the line\n  #:schema ./frame.schema.json\nis then completed and checked by editors with Taplo, such as VS Code with Even Better TOML."
)]
pub(super) struct Args {
    /// Of which kind of file.
    #[arg(value_enum, default_value = "frame")]
    pub kind: SchemaKind,
}

/// Kinds of files that have a schema.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum SchemaKind {
    /// A frame file.
    Frame,
    /// An impact model.
    Model,
    /// A plan of planted drops.
    Plan,
    /// The form of params/bought.toml.
    Bought,
    /// The form of params/materials.toml.
    Materials,
    /// A printer.
    Printer,
    /// A list of accepted findings.
    Baseline,
}

/// Prints a schema.
pub(super) fn run(args: &Args, _: &Common) -> Result<ExitCode, Failure> {
    let kind = match args.kind {
        SchemaKind::Frame => FileKind::Frame,
        SchemaKind::Model => FileKind::Model,
        SchemaKind::Plan => FileKind::Plan,
        SchemaKind::Bought => FileKind::Bought,
        SchemaKind::Materials => FileKind::Materials,
        SchemaKind::Printer => FileKind::Printer,
        SchemaKind::Baseline => FileKind::Baseline,
    };
    terminal::print_json(&schema(kind))?;
    Ok(ExitCode::SUCCESS)
}
