//! `flexframe schema`: the JSON Schema of a kind of file.

use std::process::ExitCode;

use super::arguments::{SchemaKind, SchemaOptions};
use super::session::Failure;
use super::terminal;
use crate::schema::{FileKind, schema};

/// Prints a schema.
pub(super) fn print(options: &SchemaOptions) -> Result<ExitCode, Failure> {
    let kind = match options.kind {
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
