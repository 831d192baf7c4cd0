//! Plots of the frame's own impact: acceleration, way and ground force over time.

use plotters::chart::SeriesLabelPosition;
use plotters::style::RGBColor;

use super::lines::{Lines, Series};
use super::plot::{self, PlotError};
use crate::mechanics::result::impact::{Impact, Moment};
use crate::paper_logger::BANDWIDTH_HZ;
use crate::report::data::impact_data::Impacts;

/// Every plot, path and bytes.
///
/// # Errors
/// When one cannot be drawn.
pub fn plots(found: &Impacts) -> Result<Vec<(String, Vec<u8>)>, PlotError> {
    let mut files = Vec::new();
    files.extend(plot::files("acceleration", &acceleration(found))?);
    // A way begins and ends low, and its largest value lies between.
    let way =
        Lines { legend: SeriesLabelPosition::LowerMiddle, ..of(found, "travel of the payload", "travel, mm", |m| m.down_mm, gap(found)) };
    files.extend(plot::files("displacement", &way)?);
    files.extend(plot::files("ground", &of(found, "force of the ground", "force, N", |m| m.ground_n, Vec::new()))?);
    Ok(files)
}

/// The way of the payload at which its lowest body reaches the ground; of a turned frame there is no such way.
fn gap(found: &Impacts) -> Vec<(String, f64)> {
    let level = found.underside.iter().filter(|_| found.tilt_deg == [0.0; 2]);
    level.map(|underside| (format!("gap, {:.1} mm", underside.gap_mm), underside.gap_mm)).collect()
}

/// The curve of one drop of several; without a name for a pale one.
fn series(impact: &Impact, values: impl Iterator<Item = f64>, [at, count]: [usize; 2], name: Option<String>) -> Series {
    let points = impact.moments.iter().map(|m| m.t_ms).zip(values).collect();
    let (is_pale, label) = (name.is_none(), name.filter(|_| plot::is_named(at, count)));
    Series { colour: plot::colour_among(at, count), is_pale, width: if is_pale { 1 } else { 2 }, marked: false, points, label }
}

/// Where the lowest body reaches the ground: its impact there is not in the model.
fn left(found: &Impacts, values: impl Fn(&Impact) -> Vec<f64>) -> Vec<(RGBColor, (f64, f64))> {
    let Some(underside) = &found.underside else { return Vec::new() };
    let point = |(at, impact): (usize, &Impact)| {
        let reached = underside.reached(impact)?;
        let moment = impact.moments.iter().position(|moment| moment.t_ms > reached.at_ms)?;
        Some((plot::colour_among(at, found.impacts.len()), (impact.moments[moment].t_ms, *values(impact).get(moment)?)))
    };
    found.impacts.iter().enumerate().filter_map(point).collect()
}

fn acceleration(found: &Impacts) -> Lines {
    let mut all = Vec::new();
    for (at, impact) in found.impacts.iter().enumerate() {
        all.push(series(impact, impact.moments.iter().map(|m| m.proper_g), [at, found.impacts.len()], None));
        all.push(series(
            impact,
            impact.through(BANDWIDTH_HZ).into_iter(),
            [at, found.impacts.len()],
            Some(format!("{} m, sensor", impact.height_m)),
        ));
    }
    Lines {
        left: left(found, |impact| impact.through(BANDWIDTH_HZ)),
        title: format!("{}: payload, pale as it is, strong through the sensor", found.frame),
        across: "time from first touch, ms",
        up: "acceleration, g",
        series: all,
        levels: Vec::new(),
        legend: SeriesLabelPosition::UpperRight,
    }
}

fn of(found: &Impacts, what: &str, up: &'static str, value: fn(&Moment) -> f64, levels: Vec<(String, f64)>) -> Lines {
    let line = |(at, impact): (usize, &Impact)| {
        series(impact, impact.moments.iter().map(value), [at, found.impacts.len()], Some(format!("{} m", impact.height_m)))
    };
    Lines {
        left: left(found, |impact| impact.moments.iter().map(value).collect()),
        title: format!("{}: {what}", found.frame),
        across: "time from first touch, ms",
        up,
        series: found.impacts.iter().enumerate().map(line).collect(),
        levels,
        legend: SeriesLabelPosition::UpperRight,
    }
}
