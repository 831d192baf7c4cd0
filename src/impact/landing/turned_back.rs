//! Drops as a sensor without a lean would have read them.
//!
//! Each drop is aligned anew, as a lateral reading that was picked up moves the trigger. Its touches stay as they were read.

use super::observed::{HeightLandings, ObservedLanding, ObservedLandings};
use super::sensor_attitude::SensorAttitude;
use crate::impact::fit::{WaveGroup, Waves, aligned_windows};

/// Landings turned back.
pub fn landings(observed: &ObservedLandings, attitude: &SensorAttitude) -> ObservedLandings {
    let drop = |height: &HeightLandings, drop: &ObservedLanding| {
        let axes = attitude.turned_back(drop.axes.each_ref().map(Vec::as_slice));
        let windows = aligned_windows(&height.decimation, drop.window.len(), axes.each_ref().map(Vec::as_slice));
        let window = windows.map_or_else(|| drop.window.clone(), |[_, _, axis]| axis);
        ObservedLanding { window, axes, ..drop.clone() }
    };
    let height =
        |height: &HeightLandings| HeightLandings { drops: height.drops.iter().map(|one| drop(height, one)).collect(), ..height.clone() };
    ObservedLandings { heights: observed.heights.iter().map(height).collect() }
}

/// Waves whose drops were turned back; a drop whose lateral axes could not be read stays.
pub fn waves(waves: &Waves, turned: &ObservedLandings) -> Waves {
    let group = |group: &WaveGroup| {
        let height = turned.heights.iter().find(|height| height.height_m == group.height_m);
        let known = |trial: &String| height?.drops.iter().find(|drop| drop.trial == *trial).map(|drop| drop.window.clone());
        let windows = group.trials.iter().zip(&group.windows).map(|(trial, window)| known(trial).unwrap_or_else(|| window.clone()));
        group.with_windows(windows.collect())
    };
    Waves { groups: waves.groups.iter().map(group).collect(), ..*waves }
}
