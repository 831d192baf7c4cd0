//! The plots of measured drops: peaks as boxes, waves of a height trigger-aligned.

use super::bands::Bands;
use super::boxes::{Boxes, Group, Values};
use super::plot::{self, PlotError};
use crate::impact::measured::{Drop, DropGroup, Spread};
use crate::report::data::measure_data::name;

/// Samples before the trigger that are drawn.
const BEFORE: usize = 5;
/// Samples after it.
const AFTER: usize = 30;

/// Every plot, path and bytes.
///
/// # Errors
/// When one cannot be drawn.
pub fn plots(groups: &[(&DropGroup, Vec<Drop>)]) -> Result<Vec<(String, Vec<u8>)>, PlotError> {
    let mut files = Vec::new();
    files.extend(plot::files("peak", &peak(groups))?);
    for (at, (group, drops)) in groups.iter().enumerate() {
        if let Some(chart) = waves(group, drops, at) {
            files.extend(plot::files(&format!("waves-{}", name(group).replace(' ', "-")), &chart)?);
        }
    }
    Ok(files)
}

fn peak(groups: &[(&DropGroup, Vec<Drop>)]) -> Boxes {
    let all_axes = groups.iter().any(|(group, _)| group.records.iter().any(|record| record.axes_g.is_some()));
    let values = |drops: &[Drop], value: fn(&crate::impact::measured::Impact) -> f64| {
        let values: Vec<(f64, bool)> =
            drops.iter().filter_map(|drop| Some((value(drop.impact.as_ref()?), drop.flags.is_empty()))).collect();
        Some(Values { spread: Spread::of(values.iter().map(|value| value.0))?, values })
    };
    let group = |(group, drops): &(&DropGroup, Vec<Drop>)| {
        let mut kinds = vec![values(drops, |impact| impact.peak_axial_g)];
        if all_axes {
            kinds.insert(0, values(drops, |impact| impact.peak_g));
        }
        Group { label: name(group), kinds }
    };
    let mut kinds = vec!["along the axis"];
    if all_axes {
        kinds.insert(0, "magnitude of all axes");
    }
    Boxes {
        title: "Measured peaks: quartiles, ends, every drop (rings: flagged)".into(),
        across: "frame and drop height",
        up: "peak, g",
        kinds,
        groups: groups.iter().map(group).collect(),
    }
}

fn waves(group: &DropGroup, drops: &[Drop], colour: usize) -> Option<Bands> {
    let clean: Vec<(&[f64], usize)> = drops.iter().filter_map(|drop| Some((&drop.record.accel_g[..], drop.clean()?.trigger))).collect();
    (!clean.is_empty()).then(|| Bands {
        title: format!("{}: {} clean drops along the axis, trigger-aligned", name(group), clean.len()),
        across: "time from the trigger, ms",
        up: "acceleration along the axis, g",
        colour,
        lines: Vec::new(),
        quartiles: quartiles(&clean),
        waves: clean.into_iter().map(wave).collect(),
    })
}

/// A record's part around its trigger: ms, g; samples are 1 ms apart, or the record is not clean.
pub(in crate::report) fn wave((series, trigger): (&[f64], usize)) -> Vec<(f64, f64)> {
    let samples = trigger.saturating_sub(BEFORE)..(trigger + AFTER + 1).min(series.len());
    samples.map(|at| (at as f64 - trigger as f64, series[at])).collect()
}

/// Quartiles of records at each sample around their triggers.
pub(in crate::report) fn quartiles(records: &[(&[f64], usize)]) -> Vec<(f64, [f64; 3])> {
    let at = |offset: usize| {
        let values = records.iter().filter_map(|(series, trigger)| series.get((trigger + offset).checked_sub(BEFORE)?).copied());
        Spread::of(values).map(|spread| (offset as f64 - BEFORE as f64, [spread.q1, spread.median, spread.q3]))
    };
    (0..=BEFORE + AFTER).filter_map(at).collect()
}
