//! Drops with their touch times, height by height, as the fits compare them.

use nalgebra::DVector;

use super::touches::LegTouches;
use crate::impact::fit::{Chosen, Waves};
use crate::impact::measured::{Drop, Spread};

/// The least spike of a touch that is believed, g.
pub const SEEN_G: f64 = 20.0;
/// Fewest drops of a height whose feet were all seen.
pub const FEWEST: usize = 8;

/// One drop of a height.
#[derive(Clone, Debug)]
pub struct ObservedLanding {
    /// Its name.
    pub trial: String,
    /// Its window along the axis, g.
    pub window: Vec<f64>,
    /// Its touches.
    pub touches: LegTouches,
}

/// The drops from one height.
#[derive(Clone, Debug)]
pub struct HeightLandings {
    /// Height, m.
    pub height_m: f64,
    /// Those whose lateral axes could be read.
    pub drops: Vec<ObservedLanding>,
}

/// All drops whose lateral axes could be read.
#[derive(Clone, Debug)]
pub struct ObservedLandings {
    /// Rising height, the same as those of the waves.
    pub heights: Vec<HeightLandings>,
}

impl ObservedLandings {
    /// Reads the touches of the drops that a fit takes; `None` where a height has no lateral axes.
    pub fn of(chosen: &Chosen, waves: &Waves) -> Option<Self> {
        let drop = |trial: &String, height_m: f64| {
            let same = |drop: &&Drop| drop.record.trial == *trial && drop.record.height_m == height_m;
            chosen.drops.iter().find(same)
        };
        let all = waves.groups.iter().flat_map(|group| group.trials.iter().map(|trial| drop(trial, group.height_m)));
        let mut touches = LegTouches::of_all(&all.collect::<Vec<_>>()).into_iter();
        let heights = waves.groups.iter().map(|group| {
            let read = group.trials.iter().zip(&group.windows).zip(touches.by_ref());
            let drops: Vec<ObservedLanding> = read
                .filter_map(|((trial, window), touches)| {
                    Some(ObservedLanding { trial: trial.clone(), window: window.clone(), touches: touches? })
                })
                .collect();
            HeightLandings { height_m: group.height_m, drops }
        });
        let heights: Vec<HeightLandings> = heights.collect();
        heights.iter().all(|height| height.drops.len() >= FEWEST).then_some(Self { heights })
    }

    /// Those heights alone for which the answer is yes.
    #[must_use]
    pub fn only(&self, keep: impl Fn(f64) -> bool) -> Self {
        Self { heights: self.heights.iter().filter(|height| keep(height.height_m)).cloned().collect() }
    }
}

impl HeightLandings {
    /// The drops of which all feet were seen.
    pub fn seen(&self) -> impl Iterator<Item = &ObservedLanding> {
        self.drops.iter().filter(|drop| drop.touches.least_size_g() >= SEEN_G)
    }

    /// Mean window, g.
    pub fn mean_window(&self) -> DVector<f64> {
        let sum =
            self.drops.iter().fold(DVector::zeros(self.drops[0].window.len()), |sum, drop| sum + DVector::from_column_slice(&drop.window));
        sum / self.drops.len() as f64
    }

    /// Quartiles of the time from the first foot to the opposite one, with their standard errors, s.
    ///
    /// The standard error of a quartile is by the distance of its neighbours: those half a standard error of the share away.
    pub fn opposite_quartiles_s(&self) -> Option<[(f64, f64); 3]> {
        let delays: Vec<f64> = self.seen().map(|drop| drop.touches.opposite.delay_s).collect();
        if delays.len() < FEWEST {
            return None;
        }
        let quantile = |share: f64| Spread::middle(delays.iter().copied(), 1.0 - 2.0 * share.min(1.0 - share));
        let at = |share: f64| quantile(share).map(|[low, high]| if share <= 0.5 { low } else { high });
        let count = delays.len() as f64;
        let mut quartiles = [(0.0, 0.0); 3];
        for (quartile, share) in quartiles.iter_mut().zip([0.25, 0.5, 0.75]) {
            let off = (share * (1.0 - share) / count).sqrt();
            let error_s = 0.5 * (at(share + off)? - at(share - off)?);
            *quartile = (at(share)?, error_s.max(LEAST_ERROR_S));
        }
        Some(quartiles)
    }
}

/// Least standard error of a quartile: no time is read better on the whole, s.
const LEAST_ERROR_S: f64 = 0.2e-3;
