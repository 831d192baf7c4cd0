//! From a frame's name to its design, and what can go wrong on the way.

use super::choice;
use super::failure::Failure;
use super::options::{FrameOption, MechanicsOption};
use crate::frame::assembly::{Design, DesignError};
use crate::mechanics::settings::MechanicsSettings;
use crate::params::frame_file::Value;
use crate::params::parameter::Parameter;
use crate::params::refusal::{Reason, Refusal, nearest};
use crate::params::{Frame, FrameFile, LoadError, parameters, preset};

/// Numbers of the mechanics, where they are to be asked.
pub(super) fn mechanics(option: &MechanicsOption) -> Result<Option<MechanicsSettings>, Failure> {
    Ok(option.strength.then(|| MechanicsSettings::load(option.mechanics.as_deref())).transpose()?)
}

/// Refuses a frame that is no file where one is needed, and says what it is.
pub(super) fn needs_file(frame: &str, why: &str) -> Result<(), Failure> {
    if frame.ends_with(".toml") {
        return Ok(());
    }
    let what = match preset::text(frame) {
        Some(_) => format!("{frame} is a preset; a file with base = \"{frame}\" is the same frame"),
        None => format!("{frame} is neither a file nor a preset: the name of a frame's file ends in .toml"),
    };
    Err(Failure::Usage { message: format!("{why}: {what}") })
}

/// Loads, resolves and designs a frame; every refusal points into the file.
pub(super) fn design(option: &FrameOption) -> Result<Design, Failure> {
    let (frame, file) = load(option)?;
    designed(frame, &file)
}

/// Designs a frame that was read from a file.
pub(super) fn designed(frame: Frame, file: &FrameFile) -> Result<Design, Failure> {
    Design::new(frame).map_err(|error| refused(file, &error))
}

/// A design error as a refusal of the file that caused it.
pub(super) fn refused(file: &FrameFile, error: &DesignError) -> Failure {
    LoadError::Refused(refusal(file, error)).into()
}

/// A parameter by its key, with or without its table; the ending `_length_mm` or `_mm` may be left out, and a beginning is
/// enough where only one key has it.
pub(super) fn parameter(key: &str) -> Result<&'static Parameter, Failure> {
    let whole = |p: &&Parameter| key == p.key || key == format!("{}.{}", p.table, p.key);
    let bare = key.rsplit('.').next().unwrap_or(key);
    let table = key.rsplit_once('.').map(|(table, _)| table);
    let within = |p: &&Parameter| table.is_none_or(|table| table == p.table);
    let short = |p: &&Parameter| within(p) && ["_length_mm", "_mm", "_deg", "_g"].iter().any(|unit| p.key == format!("{bare}{unit}"));
    for fits in [&whole as &dyn Fn(&&Parameter) -> bool, &short] {
        if let Some(found) = parameters().find(|p| fits(p)) {
            return Ok(found);
        }
    }
    let begun: Vec<&'static Parameter> = parameters().filter(|p| within(p) && !bare.is_empty() && p.key.starts_with(bare)).collect();
    match begun[..] {
        [only] => Ok(only),
        [] if choice::is_one(key) => {
            Err(Failure::Usage { message: format!("`{key}` is a name, not a number; `flexframe explain {key}` lists the names") })
        }
        [] => {
            let near = nearest(bare, parameters().map(|p| p.key));
            let meant = near.first().map_or(String::new(), |near| format!(", did you mean `{near}`?"));
            Err(Failure::Usage { message: format!("there is no parameter `{key}`{meant}; `flexframe params` lists them") })
        }
        _ => {
            let names: Vec<String> = begun.iter().take(6).map(|p| format!("`{}`", p.key)).collect();
            Err(Failure::Usage { message: format!("`{key}` may be any of {}", names.join(", ")) })
        }
    }
}

/// Loads and resolves a frame with the command line's changes on top.
pub(super) fn load(option: &FrameOption) -> Result<(Frame, FrameFile), Failure> {
    let mut file = FrameFile::load(&option.frame)?;
    if let Some(rigid) = &option.rigid {
        file.ask("materials.rigid", Value::Text(rigid.clone()), format!("--rigid {rigid}"));
    }
    resolved(file)
}

/// Resolves a frame that was read.
pub(super) fn resolved(file: FrameFile) -> Result<(Frame, FrameFile), Failure> {
    let frame = Frame::resolve(&file).map_err(LoadError::Refused)?;
    Ok((frame, file))
}

/// A design error as a refusal of the file that caused it.
fn refusal(file: &FrameFile, error: &DesignError) -> Refusal {
    let message = error.to_string();
    match error {
        DesignError::Closure(closure) => {
            // The lengths close together or not at all: what the nearest file states is what was changed.
            let keys = [closure.key(), "rods.arm_rod_length_mm", "rods.cage_rod_length_mm", "rods.strut_rod_length_mm"];
            let depth = |key: &&str| file.entries.get(*key).map_or(usize::MAX, |entry| entry.depth);
            let nearest = keys.into_iter().min_by_key(depth).unwrap_or(keys[0]);
            file.refuse(nearest, Reason::Impossible { message, remedy: closure.remedy() })
        }
        DesignError::Target { .. } => {
            let remedy = "choose another width, height or strut_tilt_deg".into();
            file.refuse("target.width_mm", Reason::Impossible { message, remedy })
        }
        DesignError::Part { part, .. } => {
            let mut drivers: Vec<(usize, String)> = parameters()
                .filter(|p| p.drives.contains(part))
                .filter_map(|p| {
                    let key = format!("{}.{}", p.table, p.key);
                    file.entries.get(&key).map(|entry| (entry.depth, key))
                })
                .collect();
            drivers.sort();
            let nearest = drivers.first().map_or(String::new(), |(_, key)| key.clone());
            let own: Vec<&str> = drivers.iter().filter(|(depth, _)| *depth == 0).map(|(_, key)| key.as_str()).collect();
            let remedy = match own[..] {
                [] => format!("its parameters contradict each other; `flexframe params` lists those that drive {part}"),
                _ => format!("change one of those that this file sets for it: {}", own.join(", ")),
            };
            file.refuse(&nearest, Reason::Impossible { message, remedy })
        }
    }
}
