//! Drops with their touch times, height by height, as the fits compare them.

use nalgebra::DVector;
use rayon::prelude::*;

use super::legged_body::Slopes;
use super::population::Population;
use super::read_drops::ReadDrops;
use super::table::LandingTable;
use super::touch_errors::TouchErrors;
use super::touch_pattern::TouchPattern;
use super::touches::LegTouches;
use crate::impact::fit::{Chosen, Decimation, Waves};
use crate::impact::measured::{Drop, Spread, is_same_m};

/// The shares of quartiles.
const QUARTILES: [f64; 3] = [0.25, 0.5, 0.75];
/// Standard deviation of a touch time that was read, as long as no landing was simulated, s: the clock's step, and feet that slide.
const READ_S: f64 = 0.9e-3;
/// Least of it, s: touches are searched for in steps of a twentieth, and the model is not the frame.
const LEAST_READ_S: f64 = 0.3e-3;
/// Fewest drops of a height whose feet were all seen.
pub const FEWEST: usize = 8;

/// What is kept of a record before and behind the begin of its impact, s: a window that is aligned a little sooner or later lies within.
const AROUND_S: [f64; 2] = [5e-3, 36e-3];

/// One drop of a height.
#[derive(Clone, Debug)]
pub struct ObservedLanding {
    /// Its name.
    pub trial: String,
    /// Its window along the axis, g.
    pub window: Vec<f64>,
    /// Readings along the sensor's x, y and axis around the impact, as they were recorded, g.
    pub axes: [Vec<f64>; 3],
    /// Its touches.
    pub touches: LegTouches,
    /// What its lateral axes show beside them.
    pub pattern: TouchPattern,
}

/// The drops from one height.
#[derive(Clone, Debug)]
pub struct HeightLandings {
    /// Height, m.
    pub height_m: f64,
    /// How readings become those of a window.
    pub decimation: Decimation,
    /// Those whose lateral axes could be read.
    pub drops: Vec<ObservedLanding>,
    /// How their touch times are read; `None` before landings were simulated.
    pub errors: Option<TouchErrors>,
    /// Least standard deviation of a touch time, s.
    pub least_read_s: f64,
}

/// All drops whose lateral axes could be read.
#[derive(Clone, Debug)]
pub struct ObservedLandings {
    /// Rising height, the same as those of the waves.
    pub heights: Vec<HeightLandings>,
}

impl ObservedLandings {
    /// Reads the touches of the drops that a fit takes; `None` where a height has no lateral axes. What touches look like is learned from the heights
    /// that are not held out.
    pub fn of(chosen: &Chosen, waves: &Waves, held_out_heights_m: &[f64]) -> Option<Self> {
        let all: Vec<Option<&Drop>> = chosen.behind(waves).into_iter().flatten().collect();
        let held = |height_m: f64| held_out_heights_m.iter().any(|out_m| is_same_m(*out_m, height_m));
        let mut touches = all.iter().zip(ReadDrops::of(&all, |drop| !held(drop.record.height_m)).each);
        let heights = waves.groups.iter().map(|group| {
            let read = group.trials.iter().zip(&group.windows).zip(touches.by_ref());
            let drops: Vec<ObservedLanding> = read
                .filter_map(|((trial, window), (drop, read))| {
                    let ((touches, pattern), drop) = (read?, (*drop)?);
                    let (t_s, axes) = drop.aligned_axes()?;
                    let around = around_impact(&t_s);
                    let axes = axes.map(|readings| readings[around.clone()].to_vec());
                    Some(ObservedLanding { trial: trial.clone(), window: window.clone(), axes, touches, pattern })
                })
                .collect();
            HeightLandings { height_m: group.height_m, decimation: group.decimation, drops, errors: None, least_read_s: LEAST_READ_S }
        });
        let heights: Vec<HeightLandings> = heights.collect();
        heights.iter().all(|height| height.drops.len() >= FEWEST).then_some(Self { heights })
    }

    /// The same with how touch times are read, by the landings that were simulated at each height, and how frequent they are.
    #[must_use]
    pub fn with_errors(&self, tables: &[LandingTable], slopes: &Slopes) -> Self {
        let with = |(height, table): (&HeightLandings, &LandingTable)| {
            let weights = Population::of(table, slopes).weights().clone();
            let patterns: Vec<&TouchPattern> = height.drops.iter().map(|drop| &drop.pattern).collect();
            HeightLandings { errors: TouchErrors::of(&patterns, table, &weights), ..height.clone() }
        };
        Self { heights: self.heights.par_iter().zip(tables).map(with).collect() }
    }

    /// The same with touch times that are not read better than within so much, s.
    #[must_use]
    pub fn read_no_better(&self, least_read_s: f64) -> Self {
        Self { heights: self.heights.iter().map(|height| HeightLandings { least_read_s, ..height.clone() }).collect() }
    }

    /// Least standard deviation of a touch time, the largest of the heights', s.
    pub fn least_read_s(&self) -> f64 {
        self.heights.iter().map(|height| height.least_read_s).fold(0.0, f64::max)
    }

    /// Standard deviation of a touch time that was read, the largest of the heights', s.
    pub fn read_s(&self) -> f64 {
        self.heights.iter().map(HeightLandings::read_s).fold(0.0, f64::max)
    }

    /// Those of the heights of some waves alone.
    #[must_use]
    pub fn of_heights(&self, waves: &Waves) -> Self {
        let kept = |height: &&HeightLandings| waves.groups.iter().any(|group| group.height_m == height.height_m);
        Self { heights: self.heights.iter().filter(kept).cloned().collect() }
    }
}

impl HeightLandings {
    /// The drops of which all feet were seen.
    pub fn seen(&self) -> impl Iterator<Item = &ObservedLanding> {
        self.drops.iter().filter(|drop| drop.touches.all_seen())
    }

    /// Mean window, g.
    pub fn mean_window(&self) -> DVector<f64> {
        let sum =
            self.drops.iter().fold(DVector::zeros(self.drops[0].window.len()), |sum, drop| sum + DVector::from_column_slice(&drop.window));
        sum / self.drops.len() as f64
    }

    /// Standard deviation of a touch time that was read, s.
    pub fn read_s(&self) -> f64 {
        self.errors.as_ref().map_or(READ_S, |errors| errors.deviation_s.max(self.least_read_s))
    }

    /// Quartiles of the time from the first foot to the opposite one, with their standard errors, s.
    pub fn opposite_quartiles_s(&self) -> Option<[(f64, f64); 3]> {
        quartiles_with_errors_s(self.seen())
    }
}

/// Places of a record around its impact, by times from its begin on, s.
fn around_impact(t_s: &[f64]) -> std::ops::Range<usize> {
    t_s.partition_point(|t_s| *t_s < -AROUND_S[0])..t_s.partition_point(|t_s| *t_s < AROUND_S[1])
}

/// Quartiles of the time from the first foot to the opposite one of some drops, with their standard errors, s; `None` of too few.
///
/// The standard error of a quartile is by the distance of its neighbours: those half a standard error of the share away.
fn quartiles_with_errors_s<'a>(drops: impl Iterator<Item = &'a ObservedLanding>) -> Option<[(f64, f64); 3]> {
    let delays: Vec<f64> = drops.map(|drop| drop.touches.opposite.delay_s).collect();
    if delays.len() < FEWEST {
        return None;
    }
    let quantile = |share: f64| Spread::middle(delays.iter().copied(), 1.0 - 2.0 * share.min(1.0 - share));
    let at = |share: f64| quantile(share).map(|[low, high]| if share <= 0.5 { low } else { high });
    let count = delays.len() as f64;
    let mut quartiles = [(0.0, 0.0); 3];
    for (quartile, share) in quartiles.iter_mut().zip(QUARTILES) {
        let off = (share * (1.0 - share) / count).sqrt();
        let error_s = 0.5 * (at(share + off)? - at(share - off)?);
        *quartile = (at(share)?, error_s.max(LEAST_ERROR_S));
    }
    Some(quartiles)
}

/// Least standard error of a quartile: no time is read better on the whole, s.
const LEAST_ERROR_S: f64 = 0.2e-3;
