//! The names that commands and files take.

use crate::impact::effects;
use crate::params::impact_file::ImpactFile;
use crate::params::preset;

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
    /// Impact models: `--model` of drops and diagnoses; `frame`, the own geometry of a frame, is one more for drops.
    Models,
    /// Effects: tables of a model file. A diagnosis adds them to a model, and those of landings, which docs/diagnosis.md lists.
    Effects,
}

/// Names, each with what it is.
pub(super) fn names(what: What) -> Vec<(String, String)> {
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
