//! What a parameter does: every measure at a little less and a little more of it.

use std::sync::Arc;

use super::measures::{Evaluation, MEASURES};
use crate::mechanics::settings::MechanicsSettings;
use crate::memo::Memo;
use crate::params::parameter::Parameter;
use crate::params::{Frame, FrameFile};

/// The measures at one value of a parameter.
pub struct Response {
    /// The value.
    pub value: f64,
    /// The measures in their order, or why there is no such frame.
    pub measures: Result<Vec<Option<f64>>, String>,
}

/// The measures at a parameter's value and at this share of it less and more, of its bounds where it is 0, no farther than these; all else stays as
/// the file says, and what follows follows. With settings of the mechanics, these are asked, too.
pub fn sensitivity(
    file: &FrameFile,
    frame: &Frame,
    parameter: &Parameter,
    share: f64,
    mechanics: Option<&MechanicsSettings>,
) -> Vec<Response> {
    let Some(value) = frame.value(parameter.table, parameter.key) else { return Vec::new() };
    let step = if value == 0.0 { share * (parameter.max - parameter.min) } else { share * value.abs() };
    let memo = Arc::new(Memo::default());
    [value - step, value, value + step]
        .map(|wanted| wanted.clamp(parameter.min, parameter.max))
        .map(|value| Response { value, measures: at(file, parameter, value, mechanics, &memo) })
        .into()
}

fn at(
    file: &FrameFile,
    parameter: &Parameter,
    value: f64,
    mechanics: Option<&MechanicsSettings>,
    memo: &Arc<Memo>,
) -> Result<Vec<Option<f64>>, String> {
    let mut file = file.clone();
    file.set_number(&format!("{}.{}", parameter.table, parameter.key), value);
    let frame = Frame::resolve(&file).map_err(|refusal| refusal.to_string())?;
    let mut evaluation = Evaluation::quick(frame, memo).map_err(|error| error.to_string())?;
    if let Some(settings) = mechanics {
        evaluation = evaluation.strengthened(settings).map_err(|error| error.to_string())?;
    }
    Ok(MEASURES.iter().map(|measure| measure.of(&evaluation)).collect())
}
