//! A target size: three numbers of a frame file from which the three rod lengths follow.

use super::frame::{Frame, TargetSize};
use super::frame_file::{FrameFile, Value};
use super::refusal::{Reason, Refusal};

/// A key of a target size.
#[derive(Debug)]
pub struct TargetKey {
    /// The key with its table.
    pub key: &'static str,
    /// Least value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
    /// Unit.
    pub unit: &'static str,
    /// What it is.
    pub doc: &'static str,
}

impl TargetKey {
    /// Its number in a target size.
    pub fn of(&self, size: &TargetSize) -> f64 {
        match self.key {
            "target.width_mm" => size.width_mm,
            "target.height_mm" => size.height_mm,
            _ => size.strut_tilt_deg,
        }
    }
}

/// All three.
pub const KEYS: [TargetKey; 3] = [
    TargetKey { key: "target.width_mm", min: 80.0, max: 600.0, unit: "mm", doc: "Width and depth, without propellers." },
    TargetKey { key: "target.height_mm", min: 40.0, max: 400.0, unit: "mm", doc: "Height, without propellers." },
    TargetKey { key: "target.strut_tilt_deg", min: 10.0, max: 35.0, unit: "°", doc: "Tilt of the struts against the vertical." },
];

/// The rod lengths that follow from a target size.
pub const LENGTHS: [&str; 3] = ["rods.cage_rod_length_mm", "rods.arm_rod_length_mm", "rods.strut_rod_length_mm"];

/// The key of a target size by its name.
pub fn key(name: &str) -> Option<&'static TargetKey> {
    KEYS.iter().find(|target| target.key == name)
}

/// Whether a number of a frame follows from its target size.
pub fn gives(frame: &Frame, key: &str) -> bool {
    frame.target.is_some() && LENGTHS.contains(&key)
}

/// The target size that a file states; none where it states no key of one.
pub(super) fn read(file: &FrameFile) -> Result<Option<TargetSize>, Refusal> {
    if !file.entries.keys().any(|key| key.starts_with("target.")) {
        return Ok(None);
    }
    let mut values = [0.0; 3];
    for (value, target) in values.iter_mut().zip(&KEYS) {
        *value = number(file, target)?;
    }
    lengths_are_free(file)?;
    Ok(Some(TargetSize { width_mm: values[0], height_mm: values[1], strut_tilt_deg: values[2] }))
}

/// A key's number within its bounds.
fn number(file: &FrameFile, target: &TargetKey) -> Result<f64, Refusal> {
    let TargetKey { key, min, max, unit, .. } = *target;
    match file.entries.get(key).map(|entry| &entry.value) {
        Some(Value::Number(number)) if (min..=max).contains(number) => Ok(*number),
        Some(Value::Number(number)) => {
            Err(file.refuse(key, Reason::OutOfBounds { key: key.into(), value: *number, min, max, unit: unit.into() }))
        }
        Some(other) => {
            let reason = Reason::WrongType { key: key.into(), found: other.kind().into(), expected: format!("a number in {unit}") };
            Err(file.refuse(key, reason))
        }
        None => Err(file.refuse("target.width_mm", Reason::Missing { key: key.into() })),
    }
}

/// No rod length is stated in the file of the target size, or in one nearer to the frame.
fn lengths_are_free(file: &FrameFile) -> Result<(), Refusal> {
    let depth = file.entries.get("target.width_mm").map_or(0, |entry| entry.depth);
    let stated = LENGTHS.into_iter().find(|length| file.entries.get(*length).is_some_and(|entry| entry.depth <= depth));
    let Some(length) = stated else { return Ok(()) };
    let reason = Reason::Impossible {
        message: format!("`{length}` and a target size are both given"),
        remedy: "give the three rod lengths, or [target], not both".into(),
    };
    Err(file.refuse(length, reason))
}
