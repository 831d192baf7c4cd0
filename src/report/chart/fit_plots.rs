//! The plots of a fit: the drops of each height with the fitted model's wave on top.

use super::bands::{BandLine, Bands};
use super::measure_plots::{quartiles, wave};
use super::plot::{self, PlotError};
use crate::report::data::fit_data::Run;

/// A plot a height, path and bytes.
///
/// # Errors
/// When one cannot be drawn.
pub fn plots(run: &Run) -> Result<Vec<(String, Vec<u8>)>, PlotError> {
    let mut files = Vec::new();
    for (colour, (height_m, readings)) in run.fit.waves.iter().enumerate() {
        files.extend(plot::files(&format!("fit-{height_m}-m"), &chart(run, *height_m, readings, colour))?);
    }
    Ok(files)
}

fn chart(run: &Run, height_m: f64, readings: &[f64], colour: usize) -> Bands {
    let drops = run.chosen.drops.iter().filter(|drop| drop.record.height_m == height_m);
    let series: Vec<(Vec<f64>, usize)> = drops.filter_map(|drop| Some((run.series(drop), drop.impact.as_ref()?.trigger))).collect();
    let series: Vec<(&[f64], usize)> = series.iter().map(|(series, trigger)| (&series[..], *trigger)).collect();
    let line = readings.iter().enumerate().map(|(sample, reading)| (sample as f64, *reading)).collect();
    Bands {
        title: format!("{height_m} m: {} drops and the fitted model", series.len()),
        across: "time from the trigger, ms",
        up: "acceleration, g",
        colour,
        lines: vec![BandLine { label: Some(format!("{}, fitted", run.fit.model.name)), width: 3, points: line }],
        quartiles: quartiles(&series),
        waves: series.into_iter().map(wave).collect(),
    }
}
