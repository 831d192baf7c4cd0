//! The charts of a study: its front, its rows as parallel coordinates, and what its axes explain.

use super::front_plot;
use super::index_bars::IndexBars;
use super::parallel::{Kind, Parallel};
use super::plot::{self, PlotError};
use crate::study::{Axis, Column, Indices, Input, Outcomes, Study};

/// Every plot, path and bytes: `front` are the rows that none beats with the figures of these goals, `indices` those of some of the
/// columns.
///
/// # Errors
/// When one cannot be drawn.
pub fn plots(
    study: &Study,
    outcomes: &Outcomes,
    goals: &[String],
    front: &[(usize, Vec<f64>)],
    indices: &[(usize, Indices)],
) -> Result<Vec<(String, Vec<u8>)>, PlotError> {
    let mut files = Vec::new();
    // The rows that are best in one goal alone are no front to draw.
    if !front.is_empty() && goals.len() > 1 {
        let columns: Vec<Column> = goals.iter().filter_map(|name| column(study, name)).map(|at| study.columns[at]).collect();
        let points: Vec<&[f64]> = front.iter().map(|(_, figures)| &figures[..]).collect();
        files.extend(front_plot::plots(&columns, &points, &study.name)?);
    }
    let frames = frames(study, outcomes, goals, front);
    if !frames.is_empty() {
        let names = names(study, goals);
        let title = format!("{}: {} frames", study.name, frames.len());
        files.extend(plot::files("parallel", &Parallel { title, names, frames: &frames })?);
    }
    let axes: Vec<String> = study.axes.iter().map(bare_key).collect();
    for (column, indices) in indices {
        let name = study.columns[*column].name();
        let title = format!("{}: what explains {name}", study.name);
        files.extend(plot::files(&format!("indices-{name}"), &IndexBars { title, axes: &axes, indices })?);
    }
    Ok(files)
}

/// The axes of numbers, then the goals.
fn names(study: &Study, goals: &[String]) -> Vec<String> {
    let with_unit = |name: String, unit: &str| if unit.is_empty() { name } else { format!("{name}, {unit}") };
    let is_number = |axis: &&Axis| !matches!(axis, Axis::Name { .. });
    let axes = study.axes.iter().filter(is_number).map(|axis| with_unit(without_unit(&bare_key(axis)), axis.unit()));
    let goals = goals.iter().filter_map(|name| column(study, name)).map(|at| study.columns[at].with_unit());
    axes.chain(goals).collect()
}

/// The place of a column of this name.
fn column(study: &Study, name: &str) -> Option<usize> {
    study.columns.iter().position(|column| column.name() == name)
}

/// The key of an axis without its table.
fn bare_key(axis: &Axis) -> String {
    axis.key().rsplit('.').next().unwrap_or_default().to_string()
}

fn without_unit(key: &str) -> String {
    ["_length_mm", "_mm", "_deg", "_g"].iter().find_map(|ending| key.strip_suffix(ending)).unwrap_or(key).to_string()
}

fn frames(study: &Study, outcomes: &Outcomes, goals: &[String], front: &[(usize, Vec<f64>)]) -> Vec<(Kind, Vec<f64>)> {
    let columns: Vec<usize> = goals.iter().filter_map(|name| column(study, name)).collect();
    let counted = study.columns.iter().position(|column| matches!(column, Column::Violations));
    let frame = |row: usize| {
        let numbers = study.inputs(row).into_iter().filter_map(|input| match input {
            Input::Number(value) => Some(Some(value)),
            Input::Name(_) | Input::None => None,
        });
        let figures = columns.iter().map(|column| outcomes.figure(row, *column));
        let all = numbers.chain(figures).collect::<Option<Vec<f64>>>()?;
        let kind = match counted.and_then(|at| outcomes.figure(row, at)) {
            _ if front.iter().any(|(of, _)| *of == row) => Kind::OfTheFront,
            Some(count) if count > 0.0 => Kind::Violating,
            _ => Kind::Keeping,
        };
        Some((kind, all))
    };
    (0..study.rows()).filter(|row| outcomes.of(*row).is_some()).filter_map(frame).collect()
}
