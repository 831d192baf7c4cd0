//! What the drops from one height say together.

use super::response_surface::LoggedDrop;
use crate::impact::effects::Channel;
use crate::impact::fit::{Chosen, FitError, Keep, LeftOut};
use crate::impact::measured::{Drop, DropGroup, DropSet, Spread, Summary, usual_step_s};

/// A median and its standard error.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct MedianEstimate {
    /// The median.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
}

/// Least standard error over the median: what scale and height of a drop are known to.
const LEAST_ERROR: f64 = 0.01;

impl MedianEstimate {
    /// Of values that lie around their median about normally.
    fn of(spread: &Spread) -> Self {
        Self { value: spread.median, error: spread.median_error().max(LEAST_ERROR * spread.median.abs()) }
    }
}

/// A height.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Height {
    /// From where, m.
    pub height_m: f64,
    /// Time between the readings of most drops, s. The slower a logger, the lower are its peaks.
    pub step_s: f64,
    /// Peaks along the axis of the drops that hit once by a clock that did not stall, g, behind the logger's 500 Hz.
    pub peak_axial_g: MedianEstimate,
    /// Impulse along the axis within 25 ms over the speed before, of the drops without a flag; restitution is that less one.
    pub impulse_over_v0: MedianEstimate,
}

impl Height {
    /// Of a summary and the time between its readings, s; `None` when no drop has an impact, or none is without a flag.
    fn of(summary: &Summary, step_s: f64) -> Option<Self> {
        let (peak, impulse) = (summary.peak_axial_g.as_ref()?, summary.impulse_over_v0.as_ref()?);
        Some(Self {
            height_m: summary.height_m,
            step_s,
            peak_axial_g: MedianEstimate::of(peak),
            impulse_over_v0: MedianEstimate::of(impulse),
        })
    }

    /// What the model is asked.
    pub fn logged(&self) -> LoggedDrop {
        LoggedDrop { height_m: self.height_m, step_s: self.step_s }
    }
}

/// Why drops give no figures of their heights.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeasuredHeightsError {
    /// No drop can be used.
    #[error(transparent)]
    Drops(#[from] FitError),
    /// A height without a drop that nothing is wrong with.
    #[error("no drop from {height_m} m has an impact without a flag; `flexframe measure` says why")]
    NoneClean {
        /// The height, m.
        height_m: f64,
    },
}

/// What the drops of one frame say, height by height.
#[derive(Clone, Debug)]
pub struct MeasuredHeights {
    /// Rising height.
    pub heights: Vec<Height>,
    /// Drops that no figure contains: a stalled clock, two hits, an end too soon.
    pub left_out: Vec<LeftOut>,
}

impl MeasuredHeights {
    /// Of the same drops that a diagnosis takes.
    ///
    /// # Errors
    /// [`MeasuredHeightsError`] when the drops are of several frames, or a height has none that can be used.
    pub fn of(set: &DropSet) -> Result<Self, MeasuredHeightsError> {
        let chosen = Chosen::of(set, Channel::Axial, Keep::Evidence)?;
        let height = |group: &DropGroup| {
            let height_m = group.height_m;
            let kept: Vec<Drop> = chosen.drops.iter().filter(|drop| drop.record.height_m == height_m).cloned().collect();
            let step_s = usual_step_s(kept.iter().map(|drop| drop.record));
            step_s.and_then(|step_s| Height::of(&Summary::of(group, &kept), step_s)).ok_or(MeasuredHeightsError::NoneClean { height_m })
        };
        Ok(Self { heights: set.groups.iter().map(height).collect::<Result<_, _>>()?, left_out: chosen.left_out })
    }
}
