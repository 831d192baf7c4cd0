//! `flexframe list`: the names that other commands and files take.

use std::process::ExitCode;

use serde_json::{Value, json};

use super::failure::Failure;
use super::names::{What, names};
use super::options::Common;
use super::terminal;

/// List names: presets, bought parts, materials, printers, impact models, effects.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  flexframe list parts\n  flexframe list printers --json")]
pub(super) struct Args {
    /// What to list.
    #[arg(value_enum, value_name = "WHAT")]
    pub what: What,
}

/// Lists names, a line each, with what they are.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let names = names(args.what);
    if common.json {
        let entry = |(name, what): &(String, String)| json!({ "name": name, "what": what });
        let list: Vec<Value> = names.iter().map(entry).collect();
        terminal::print_json(&json!({ "schema_version": 1, "names": list }))?;
        return Ok(ExitCode::SUCCESS);
    }
    let width = names.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
    let line = |(name, what): &(String, String)| format!("{name:<width$}  {what}").trim_end().to_string() + "\n";
    terminal::print(&names.iter().map(line).collect::<String>())?;
    Ok(ExitCode::SUCCESS)
}
