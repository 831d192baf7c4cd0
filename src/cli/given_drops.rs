//! Measured drops as the command line gives them: their paths, the frame among them, and how the logger counts.

use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::options::{Common, DropsOption, FormatOptions, FrameOption};
use super::session;
use crate::frame::assembly::mass;
use crate::impact::body::DropBody;
use crate::impact::effects::Model;
use crate::impact::measured::{self, Calibration, DropSet, FileFormat, TableFormat};
use crate::params::preset;
use crate::units::Angle;

/// The model that is the frame's own.
pub(super) const FRAME_MODEL: &str = "frame";

/// The frame among the drops, if there is one, and the paths of the drops. A frame is a preset's name that is no path, or a TOML
/// file.
pub(super) fn frame_and_paths(given: &DropsOption) -> Result<(Option<String>, Vec<PathBuf>), Failure> {
    let is_frame = |path: &Path| {
        let name = path.to_string_lossy();
        name.ends_with(".toml") || (preset::names().any(|preset| preset == name) && !path.exists())
    };
    let (frames, paths): (Vec<PathBuf>, Vec<PathBuf>) = given.drops.iter().cloned().partition(|path| is_frame(path));
    if paths.is_empty() {
        return Err(Failure::Usage { message: "name the drops: .csv or .tsv tables, .bin files or folders".into() });
    }
    match &frames[..] {
        [] => Ok((None, paths)),
        [frame] => Ok((Some(frame.to_string_lossy().into_owned()), paths)),
        _ => Err(Failure::Usage { message: "name one frame, or none".into() }),
    }
}

/// The model that is compared with drops, by its name. A frame's own beam model is none of them: it has no file whose numbers a fit could move.
pub(super) fn compared_model(name: &str) -> Result<Model, Failure> {
    if name == FRAME_MODEL && !Path::new(name).exists() {
        let message = "--model frame is the model of `drop`; its material is fitted by `drop --model frame --fit DROPS`. In `diagnose` \
                       --frame FRAME adds the frame's static curve to the candidates";
        return Err(Failure::Usage { message: message.into() });
    }
    Ok(Model::load(name)?)
}

/// The model with mass and gap of the frame; as it is without one.
pub(super) fn with_body_of(frame: Option<String>, mut model: Model, common: &Common) -> Result<Model, Failure> {
    if let Some(frame) = frame {
        let design = session::design(&FrameOption { frame, rigid: None }, common)?;
        model.body = DropBody::of(&design, &mass::table(&design));
    }
    Ok(model)
}

/// How files of drops are written: the paper's logger and this program's tables, with the command line's changes.
pub(super) fn file_format(args: &FormatOptions) -> Result<FileFormat, Failure> {
    let table = TableFormat::new(&args.columns, &args.units, args.rate).and_then(|table| table.zeroed(&args.zero));
    let table = table.map_err(|error| Failure::Usage { message: error.to_string() })?;
    Ok(FileFormat { calibration: calibration(args)?, table, turn: Angle::deg(args.turn) })
}

/// Reads drops whose files are written so.
///
/// # Errors
/// Also when an option says how files are written of which none is there: it would say nothing.
pub(super) fn read_drops(paths: &[PathBuf], args: &FormatOptions, format: &FileFormat) -> Result<DropSet, Failure> {
    let set = measured::read(paths, format)?;
    if args.turn != 0.0 && set.records().all(|record| record.axes_g.is_none()) {
        return Err(Failure::Usage { message: "--turn is about the axes x and y, and no drop has them".into() });
    }
    let tables = set.records().filter(|record| record.is_of_table()).count();
    let logged = set.records().count() - tables;
    let idle =
        |options: &[(bool, &'static str)], files: usize| options.iter().find(|(given, _)| *given && files == 0).map(|(_, name)| *name);
    match (idle(&args.of_tables(), tables), idle(&args.of_logger(), logged)) {
        (Some(option), _) => Err(Failure::Usage { message: format!("{option} is about tables, and none of the drops is in one") }),
        (_, Some(option)) => {
            let instead = FormatOptions::of_tables_instead_of(option);
            let message = format!("{option} is about the logger's .bin files, and none of the drops is in one; for a table give {instead}");
            Err(Failure::Usage { message })
        }
        _ => Ok(set),
    }
}

fn calibration(args: &FormatOptions) -> Result<Calibration, Failure> {
    let three = |values: &[f64], what: &str, good: fn(f64) -> bool| {
        let three: Option<[f64; 3]> = values.try_into().ok().filter(|values: &[f64; 3]| values.iter().all(|value| good(*value)));
        three.ok_or_else(|| Failure::Usage { message: format!("--{what} takes three numbers, for x, y and z: as in 2019.94,2020,2020.77") })
    };
    let mut calibration = Calibration::default();
    if let Some(offsets) = &args.offset_counts {
        calibration.offset_counts = three(offsets, "offset-counts", f64::is_finite)?;
    }
    if let Some(scales) = &args.counts_per_g {
        calibration.counts_per_g = three(scales, "counts-per-g", |scale| scale.is_finite() && scale.abs() > 1e-6)?;
    }
    Ok(calibration)
}
