//! The record of what a diagnosis compared.

use super::separating_experiment::SeparatingExperiment;
use crate::impact::diagnose::{Confounding, CovariateEffect, FrameMode, FreeFallReading, StaticComparison};
use crate::impact::fit::{Decimation, EarlyEnd, LeftOut};
use crate::impact::landing::LandingAssessment;
use crate::impact::measured::Fall;

/// What was compared, for the record.
#[derive(Clone, Debug)]
pub struct Compared {
    /// Channel that was used.
    pub channel: &'static str,
    /// Channel that the model states.
    pub stated_channel: &'static str,
    /// Why it was used.
    pub channel_reason: String,
    /// What the lateral axes are used for, or why they are not, where the drops have some.
    pub lateral_axes: Option<String>,
    /// The model's own effects.
    pub own_effects: Vec<&'static str>,
    /// Drops used, by height, m.
    pub drops: Vec<(f64, usize)>,
    /// How the readings of each height, m, were averaged and thinned out.
    pub sampling: Vec<(f64, Decimation)>,
    /// Where the comparison ends, if a few records end before the others.
    pub early_end: Option<EarlyEnd>,
    /// Drops left out, with the reason.
    pub left_out: Vec<LeftOut>,
    /// What they read along the axis in free fall, for each height.
    pub free_fall: Vec<FreeFallReading>,
    /// Held-out heights, m.
    pub held_out_heights_m: Vec<f64>,
    /// Seed.
    pub seed: u64,
    /// Duration of the fall, for each height.
    pub falls: Vec<Fall>,
    /// A static test beside the models.
    pub static_test: Option<StaticComparison>,
    /// A frame's own mode beside the one found.
    pub frame_mode: Option<FrameMode>,
    /// Landings that are not level, where the drops have lateral axes.
    pub landing: Option<LandingAssessment>,
    /// What explains how drops of one height vary.
    pub covariates: Vec<CovariateEffect>,
    /// What changes together with the height.
    pub confounding: Vec<Confounding>,
    /// What would separate the two.
    pub separating: Option<SeparatingExperiment>,
}
