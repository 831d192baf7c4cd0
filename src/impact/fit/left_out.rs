//! A drop that is not used, and why.

use std::collections::BTreeMap;

use crate::impact::measured::Record;

/// A drop that is not used.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct LeftOut {
    /// Its name.
    pub trial: String,
    /// From this height, m.
    pub height_m: f64,
    /// The file that it is from.
    pub source: String,
    /// What is wrong with it.
    pub reason: String,
}

impl LeftOut {
    pub(super) fn of(record: &Record, reason: String) -> Self {
        let Record { trial, height_m, source, .. } = record;
        Self { trial: trial.clone(), height_m: *height_m, source: source.clone(), reason }
    }

    /// What is wrong with drops, each reason once without its figures, and how many have it.
    pub fn by_reason<'a>(drops: impl IntoIterator<Item = &'a Self>) -> BTreeMap<&'a str, usize> {
        let mut reasons = BTreeMap::new();
        for drop in drops {
            *reasons.entry(drop.reason.split(':').next().unwrap_or_default()).or_default() += 1;
        }
        reasons
    }
}
