//! `flexframe list`: the names that other commands and files take.

use std::process::ExitCode;

use serde_json::{Value, json};

use super::failure::Failure;
use super::options::Common;
use super::terminal;
use crate::impact::effects;
use crate::params::impact_file::ImpactFile;
use crate::params::preset;

/// List names: presets, bought parts, materials, printers, impact models, effects.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  flexframe list parts\n  flexframe list printers --json")]
pub(super) struct Args {
    /// What to list.
    #[arg(value_enum, value_name = "WHAT")]
    pub what: What,
}

/// What has names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum What {
    /// Frames that come with the program.
    Presets,
    /// Bought parts: `[bought]` of a frame file.
    Parts,
    /// Materials: `[materials]` of a frame file, and of rods.
    Materials,
    /// Printers: `printer` of a frame file.
    Printers,
    /// Impact models: `--model` of drops and diagnoses.
    Models,
    /// Effects that a diagnosis may name.
    Effects,
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

/// Names, each with what it is.
fn names(what: What) -> Vec<(String, String)> {
    match what {
        What::Presets => preset::names().map(|name| (name.into(), preset::description(name))).collect(),
        What::Parts => preset::bought_parts().into_iter().map(|(name, part)| (name, format!("{}, {} g", part.kind, part.mass_g))).collect(),
        What::Materials => preset::materials()
            .into_iter()
            .map(|(name, material)| (name, format!("{}, {} g/cm3", material.kind, material.density_g_cm3)))
            .collect(),
        What::Printers => preset::printers()
            .into_iter()
            .map(|(name, printer)| {
                (name, format!("{}, {} x {} mm, nozzle {} mm", printer.name, printer.size_mm[0], printer.size_mm[1], printer.nozzle_mm))
            })
            .collect(),
        What::Models => ImpactFile::names().map(|name| (name.into(), String::new())).collect(),
        What::Effects => effects::CATALOGUE.iter().map(|spec| (spec.id.into(), spec.title.into())).collect(),
    }
}
