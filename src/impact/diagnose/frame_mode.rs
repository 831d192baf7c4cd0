//! A frame's own mode beside the payload mode of a diagnosis.

use serde::Serialize;

use super::diagnosis::Diagnosis;
use crate::impact::effects::PAYLOAD_MODE;

/// The mode, and what the diagnosis found in its place.
#[derive(Clone, Debug, Serialize)]
pub struct FrameMode {
    /// Share of the mass that rides, by the frame's symmetric modes.
    pub mu: f64,
    /// Its frequency on a frame that is held, Hz.
    pub f_hz: f64,
    /// Share and frequency of the payload mode that was chosen; none where none was.
    pub fitted: Option<[f64; 2]>,
    /// Whether both lie within the fitted ones' 95 % intervals.
    pub agrees: bool,
}

impl FrameMode {
    /// Compares.
    pub fn of([mu, f_hz]: [f64; 2], diagnosis: &Diagnosis) -> Self {
        let of = |key: &str| diagnosis.estimates.iter().find(|one| one.effect == PAYLOAD_MODE.id && one.key == key);
        let fitted = of("mu").zip(of("f_hz"));
        let within = |value: f64, [low, high]: [f64; 2]| (low..=high).contains(&value);
        let agrees = fitted.is_some_and(|(share, frequency)| within(mu, share.ci95) && within(f_hz, frequency.ci95));
        Self { mu, f_hz, fitted: fitted.map(|(share, frequency)| [share.value, frequency.value]), agrees }
    }
}
