//! What a key of a study is to the frame that the study is based on.

use super::plan_keys::impossible;
use crate::params::frame_file::Value;
use crate::params::parameter::Parameter;
use crate::params::refusal::{Reason, Refusal};
use crate::params::{Frame, FrameFile, ImpactFile, target};

/// Whether a number may vary: refuses a rod's length that follows from the frame's target size; `key` is its place in the plan.
pub(super) fn can_vary(file: &ImpactFile, key: &str, parameter: &Parameter, frame: &Frame) -> Result<(), Refusal> {
    let own = format!("{}.{}", parameter.table, parameter.key);
    if !target::gives(frame, &own) {
        return Ok(());
    }
    let remedy =
        "base the study on a frame that states the three rod lengths instead, `flexframe params FRAME --filter rod_length` shows them";
    Err(file.refuse(key, impossible(format!("`{own}` cannot vary: it follows from [target] of the frame"), remedy.into())))
}

/// What the frame's reader says of a text for a key, where it is about the key or the name; whether they make a frame is not looked at.
pub(super) fn refused_name(base: &FrameFile, key: &str, value: Value, why: String) -> Option<Reason> {
    let mut with = base.clone();
    with.ask(key, value, why);
    let Err(refusal) = Frame::resolve(&with) else { return None };
    let is_about_it = matches!(
        *refusal.reason,
        Reason::UnknownKey { .. } | Reason::UnknownName { .. } | Reason::WrongKind { .. } | Reason::WrongType { .. }
    );
    is_about_it.then_some(*refusal.reason)
}
