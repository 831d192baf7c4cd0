//! A layer is lower than the nozzle is wide: one as high is not pressed onto the one below it, and does not hold.

use super::frame::{Frame, NamedMaterial};
use super::frame_file::FrameFile;
use super::refusal::{Reason, Refusal};
use crate::figures::told_apart;

/// Highest layer, in nozzles: slicers and makers of nozzles advise 0.75 to 0.8.
const MOST_NOZZLES: f64 = 0.8;

/// Refuses a material whose layers are too high for the printer's nozzle.
pub(super) fn hold(file: &FrameFile, frame: &Frame) -> Result<(), Refusal> {
    [&frame.flexible, &frame.rigid].into_iter().try_for_each(|material| of(file, frame, material))
}

fn of(file: &FrameFile, frame: &Frame, NamedMaterial { name, material }: &NamedMaterial) -> Result<(), Refusal> {
    let (nozzle_mm, layer_mm) = (frame.printer.nozzle_mm, frame.printer.layer_mm(material));
    let most_mm = MOST_NOZZLES * nozzle_mm;
    if layer_mm <= most_mm + 1e-9 {
        return Ok(());
    }
    let [layer, most] = told_apart(layer_mm, most_mm, 2);
    let message = format!("layers of {layer} mm of {name} are too high for a nozzle of {nozzle_mm} mm: {most} mm at most");
    // A hundredth below the limit, as settings of slicers are typed.
    let remedy = format!(
        "state layer_mm = {} in [override.materials.{name}], or choose a printer with a nozzle of {:.2} mm or more",
        (most_mm * 100.0 + 1e-6).floor() / 100.0,
        layer_mm / MOST_NOZZLES
    );
    let stated = |key: &String| file.entries.contains_key(key);
    let layer_key = format!("override.materials.{name}.layer_mm");
    let nozzle_key = file.entries.keys().find(|key| key.starts_with("override.printers.") && key.ends_with(".nozzle_mm")).cloned();
    let key = Some(layer_key).filter(stated).or(nozzle_key).unwrap_or_else(|| "printer".into());
    Err(file.refuse(&key, Reason::Impossible { message, remedy }))
}
