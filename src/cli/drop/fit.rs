//! `flexframe drop --model frame --fit`: the flexible material from drops, and how well one height predicts another.

use std::process::ExitCode;

use super::arguments::Args;
use super::frame::frame;
use crate::cli::failure::{Failure, mechanics_refused};
use crate::cli::given_drops::{file_format, read_drops};
use crate::cli::options::Common;
use crate::cli::progress::Progress;
use crate::cli::{output, session, terminal};
use crate::frame::assembly::mass;
use crate::impact::frame_fit::{Height, MeasuredHeights, ResponseSurface, Subject, fit};
use crate::mechanics::model::frame_model::{Extent, FrameModel};
use crate::mechanics::settings::MechanicsSettings;
use crate::report::data::impact_fit_data;
use crate::report::data::impact_fit_data::Fitted;

/// Fits a frame's own model to drops and writes its folder.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let frame = frame(args)?;
    let stated = MechanicsSettings::load(args.mechanics.as_deref())?;
    let set = read_drops(&args.fit, &args.format, &file_format(&args.format)?)?;
    let measured = MeasuredHeights::of(&set).map_err(|error| Failure::Usage { message: error.to_string() })?;
    let heights = &measured.heights;
    let working = Progress::of("fitting", common);
    let design = session::design(&frame, common)?;
    let masses = mass::table(&design);
    let settings = stated.for_material(&design.frame.flexible.material);
    settings.doubt(&design.frame.flexible).iter().for_each(|doubt| terminal::tell(doubt));
    // What is fitted is of this material, whether its modulus is stated or not.
    let settings = MechanicsSettings { tensile_mpa: design.frame.flexible.material.tensile_modulus_mpa, ..settings };
    let model = FrameModel::new(&design, &masses, &settings, Extent::Quarter).map_err(mechanics_refused)?;
    let subject = Subject { model: &model, settings: &settings };
    let drops: Vec<_> = heights.iter().map(Height::logged).collect();
    let surface = ResponseSurface::new(&subject, &drops).map_err(mechanics_refused)?;
    let found = fit(&subject, surface, heights).map_err(mechanics_refused)?;
    let fitted = Fitted { frame: &design.frame.name, measured: &measured, fit: &found };
    let json = impact_fit_data::json(&fitted);
    let files = [
        ("predictions.csv".into(), impact_fit_data::predictions_csv(&fitted)?.into_bytes()),
        ("fit.json".into(), format!("{json:#}\n").into_bytes()),
        ("mechanics.toml".into(), found.settings.to_toml(&impact_fit_data::remark(&fitted)).into_bytes()),
    ];
    drop(working);
    let place = output::write_folder(&args.output, &format!("drop-fit-{}", design.frame.name), &files)?;
    if common.json {
        terminal::print_json(&json)?;
    } else if !common.quiet {
        let notes: String = set.notes.iter().map(|note| format!("note: {note}\n")).collect();
        terminal::print(&format!("{}{notes}{}: {} files\n", impact_fit_data::table(&fitted), place.display(), files.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}
