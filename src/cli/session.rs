//! From a frame's name to its design, and what can go wrong on the way.

use std::sync::Arc;

use super::cache;
use super::choice;
use super::failure::Failure;
use super::options::{Common, FrameOption, MechanicsOption};
use super::terminal;
use crate::frame::assembly::{Design, DesignError};
use crate::mechanics::settings::MechanicsSettings;
use crate::memo::Memo;
use crate::params::frame_file::Value;
use crate::params::lookup::{LookupError, lookup};
use crate::params::parameter::Parameter;
use crate::params::unused::unused;
use crate::params::{Frame, FrameFile, LoadError, preset};

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
pub(super) fn design(option: &FrameOption, common: &Common) -> Result<Design, Failure> {
    let (frame, file) = load(option)?;
    designed(frame, &file, &cache::memo(common))
}

/// Designs a frame that was read from a file.
pub(super) fn designed(frame: Frame, file: &FrameFile, memo: &Arc<Memo>) -> Result<Design, Failure> {
    Design::with(frame, memo).map_err(|error| refused(file, &error))
}

/// A frame with the rod lengths that follow from its target size, where it has one.
pub(super) fn with_lengths(frame: Frame, file: &FrameFile, common: &Common) -> Result<Frame, Failure> {
    if frame.target.is_none() {
        return Ok(frame);
    }
    designed(frame, file, &cache::memo(common)).map(|design| design.frame)
}

/// A design error as a refusal of the file that caused it.
pub(super) fn refused(file: &FrameFile, error: &DesignError) -> Failure {
    LoadError::Refused(error.refusal(file)).into()
}

/// A parameter by what was typed for it.
pub(super) fn parameter(key: &str) -> Result<&'static Parameter, Failure> {
    lookup(key).map_err(|error| {
        let message = match error {
            LookupError::Unknown { .. } if choice::is_one(key) => {
                format!("`{key}` is a name, not a number; `flexframe explain {key}` lists the names")
            }
            error => error.to_string(),
        };
        Failure::Usage { message }
    })
}

/// Loads and resolves a frame with the command line's changes on top.
pub(super) fn load(option: &FrameOption) -> Result<(Frame, FrameFile), Failure> {
    let mut file = FrameFile::load(&option.frame)?;
    if let Some(rigid) = &option.rigid {
        file.ask("materials.rigid", Value::Text(rigid.clone()), format!("--rigid {rigid}"));
    }
    let (frame, file) = resolved(file)?;
    unused(&file, &frame).iter().for_each(|told| terminal::tell(&format!("note: {told}")));
    Ok((frame, file))
}

/// Resolves a frame that was read.
pub(super) fn resolved(file: FrameFile) -> Result<(Frame, FrameFile), Failure> {
    let frame = Frame::resolve(&file).map_err(LoadError::Refused)?;
    Ok((frame, file))
}
