//! Plots of stiffness: force over displacement with its band and what was measured, and where the energy sits.

use plotters::chart::SeriesLabelPosition;

use super::lines::{Lines, Series};
use super::plot::{self, PlotError};
use crate::report::data::stiffness_data::Stiffness;

/// Every plot, path and bytes.
///
/// # Errors
/// When one cannot be drawn.
pub fn plots(found: &Stiffness) -> Result<Vec<(String, Vec<u8>)>, PlotError> {
    Ok(plot::files("curve", &curve(found))?.into())
}

/// What the feet stand on: beyond the gap flat ground would carry the rest, too.
fn stands(found: &Stiffness) -> String {
    let raised = found.gap_words().and(found.gap_mm);
    raised.map_or("feet on the ground".into(), |gap_mm| format!("feet on the ground, beyond {gap_mm:.1} mm raised"))
}

fn curve(found: &Stiffness) -> Lines {
    let points = |factor: f64| found.curve.points.iter().map(|p| (p.displacement_mm, p.force_n * factor)).collect::<Vec<_>>();
    let [low, high] = found.band();
    let line = |label: Option<&str>, colour, width, marked, points| Series {
        label: label.map(String::from),
        is_pale: label.is_none(),
        colour: plot::colour(colour),
        width,
        marked,
        points,
    };
    let mut series = vec![
        line(None, 0, 1, false, points(low)),
        line(None, 0, 1, false, points(high)),
        line(Some("computed; pale: the band of the modulus"), 0, 2, true, points(1.0)),
    ];
    let k0 = found.curve.initial_n_mm();
    let top = found.curve.points.iter().map(|p| p.force_n).fold(0.0, f64::max);
    series.push(line(Some("stiffness at rest"), 6, 1, false, vec![(0.0, 0.0), (top / k0, top)]));
    if !found.measured.is_empty() {
        let measured = found.measured.iter().map(|[x, f]| (*x, *f)).collect();
        series.push(line(Some("measured"), 1, 1, true, measured));
    }
    Lines {
        title: format!("{}: the centre pressed down, {}", found.frame, stands(found)),
        across: "displacement, mm",
        up: "force, N",
        series,
        levels: Vec::new(),
        left: Vec::new(),
        legend: SeriesLabelPosition::LowerRight,
    }
}
