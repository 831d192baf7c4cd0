//! The plots of a drop: acceleration and displacement over time, energies, peaks over height.

use plotters::chart::SeriesLabelPosition;
use plotters::style::RGBColor;

use super::bars::{Bars, Group};
use super::lines::{Lines, Series};
use super::plot::{self, PlotError};
use crate::impact::effects::Model;
use crate::impact::sim::{Balance, PaperShares, Peaks, Trace, ValidityWarning};

/// Every plot, path and bytes.
///
/// # Errors
/// When one cannot be drawn.
pub fn plots(model: &Model, traces: &[Trace]) -> Result<Vec<(String, Vec<u8>)>, PlotError> {
    let mut files = Vec::new();
    files.extend(plot::files("acceleration", &acceleration(model, traces))?);
    files.extend(plot::files("displacement", &displacement(model, traces))?);
    files.extend(plot::files("energy", &energy(model, traces))?);
    files.extend(plot::files("peak", &peak(model, traces))?);
    Ok(files)
}

/// The curve of one drop of several; without a name for a pale one.
fn series(trace: &Trace, values: &[f64], scale: f64, [at, count]: [usize; 2], name: Option<String>) -> Series {
    let points = trace.t_s.iter().zip(values).map(|(t_s, value)| (t_s * 1e3, value * scale)).collect();
    let (is_pale, label) = (name.is_none(), name.filter(|_| plot::is_named(at, count)));
    Series { colour: plot::colour_among(at, count), is_pale, width: if is_pale { 1 } else { 2 }, marked: false, points, label }
}

/// Where each trace first leaves its model's range, on a curve of it.
fn left(traces: &[Trace], values: fn(&Trace) -> &Vec<f64>, scale: f64) -> Vec<(RGBColor, (f64, f64))> {
    let point = |(at, trace): (usize, &Trace)| {
        let t_ms = trace.warnings.iter().filter_map(ValidityWarning::t_ms).min_by(f64::total_cmp)?;
        let value = values(trace).get((1e-3 * t_ms / Trace::STEP_S).round() as usize)?;
        Some((plot::colour_among(at, traces.len()), (t_ms, scale * value)))
    };
    traces.iter().enumerate().filter_map(point).collect()
}

fn acceleration(model: &Model, traces: &[Trace]) -> Lines {
    let mut all = Vec::new();
    for (at, trace) in traces.iter().enumerate() {
        all.push(series(trace, &trace.proper_g, 1.0, [at, traces.len()], None));
        all.push(series(trace, &trace.sensor_g, 1.0, [at, traces.len()], Some(format!("{} m, sensor", trace.height_m))));
    }
    let title = format!("{}: proper acceleration, pale as it is, strong through the sensor", model.name);
    Lines {
        left: left(traces, |trace| &trace.sensor_g, 1.0),
        title,
        across: "time from first touch, ms",
        up: "acceleration, g",
        series: all,
        levels: Vec::new(),
        legend: SeriesLabelPosition::UpperRight,
    }
}

fn displacement(model: &Model, traces: &[Trace]) -> Lines {
    let line = |(at, trace): (usize, &Trace)| series(trace, &trace.x_m, 1e3, [at, traces.len()], Some(format!("{} m", trace.height_m)));
    let gap_mm = model.body.gap_m * 1e3;
    Lines {
        left: left(traces, |trace| &trace.x_m, 1e3),
        title: format!("{}: compression of the frame", model.name),
        across: "time from first touch, ms",
        up: "compression, mm",
        series: traces.iter().enumerate().map(line).collect(),
        levels: vec![(format!("gap, {gap_mm:.1} mm"), gap_mm)],
        legend: SeriesLabelPosition::UpperRight,
    }
}

/// Lost, stored, left for or in motion, air: of the input.
fn balance_shares(balance: &Balance) -> Vec<f64> {
    let motion_j = balance.kinetic_j + balance.collision_j;
    [balance.dissipated_j, balance.stored_j, motion_j, balance.air_j].iter().map(|part| 100.0 * part / balance.input_j).collect()
}

fn energy(model: &Model, traces: &[Trace]) -> Bars {
    let group = |trace: &Trace| {
        let paper =
            |PaperShares { damper_percent, spring_percent, rigid_percent }| vec![damper_percent, spring_percent, rigid_percent, 0.0];
        Some(Group { label: format!("{} m", trace.height_m), shares: [balance_shares(trace.compression.as_ref()?), paper(trace.paper?)] })
    };
    Bars {
        title: format!("{}: where the energy is when the gap is used up, or else at the turning point", model.name),
        parts: vec!["lost in dampers", "stored in springs", "rigid collision", "air"],
        sides: ["full balance, of m g (h + x)", "the paper's, of m g h"],
        groups: traces.iter().filter_map(group).collect(),
    }
}

fn peak(model: &Model, traces: &[Trace]) -> Lines {
    let line = |colour, label: &str, value: fn(&Peaks) -> f64| {
        let mut points: Vec<(f64, f64)> = traces.iter().filter_map(|trace| Some((trace.height_m, value(trace.peaks.as_ref()?)))).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Series { label: Some(label.into()), is_pale: false, colour: plot::colour(colour), width: 2, marked: true, points }
    };
    Lines {
        title: format!("{}: peak over drop height", model.name),
        across: "drop height, m",
        up: "peak, g",
        series: vec![
            line(0, "coordinate, |x''|", |peaks| peaks.coordinate_g),
            line(1, "proper", |peaks| peaks.proper_g),
            line(2, "through the sensor", |peaks| peaks.sensor_g),
        ],
        levels: Vec::new(),
        left: Vec::new(),
        legend: SeriesLabelPosition::UpperLeft,
    }
}
