//! A Pareto front as a chart: the first two goals along the axes, a third by colour and in figures.

use std::ops::Range;

use plotters::prelude::*;

use super::plot::{self, Area, Chart, Drawn, FONT, PlotError, Words, axes, colour, titled};
use crate::study::Column;

/// Every plot, path and bytes: of points in two or three goals. The name is that of the frame, or of the study.
///
/// # Errors
/// When one cannot be drawn.
pub fn plots(goals: &[Column], points: &[&[f64]], name: &str) -> Result<Vec<(String, Vec<u8>)>, PlotError> {
    Ok(plot::files("pareto", &FrontChart { goals, points, name })?.into())
}

struct FrontChart<'a> {
    goals: &'a [Column],
    points: &'a [&'a [f64]],
    name: &'a str,
}

impl FrontChart<'_> {
    /// Least and largest of a goal, with room on both sides.
    fn range(&self, goal: usize) -> Range<f64> {
        let values = || self.points.iter().map(|point| point[goal]);
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        let room = (0.08 * (high - low)).max(1e-3 * high.abs()).max(1e-6);
        low - room..high + room
    }

    /// The colour of a point: its third goal, from the least to the largest.
    fn tone(&self, point: &[f64]) -> RGBColor {
        let Some(value) = point.get(2) else { return colour(0) };
        let range = self.range(2);
        let share = ((value - range.start) / (range.end - range.start)).clamp(0.0, 1.0);
        let (RGBColor(r0, g0, b0), RGBColor(r1, g1, b1)) = (colour(0), colour(4));
        let mixed = |from: u8, to: u8| (f64::from(from) + share * (f64::from(to) - f64::from(from))).round() as u8;
        RGBColor(mixed(r0, r1), mixed(g0, g1), mixed(b0, b1))
    }
}

impl Chart for FrontChart<'_> {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        let goal = |at: usize| self.goals[at].with_unit();
        let third = if self.goals.len() > 2 { format!(", with {}", goal(2)) } else { String::new() };
        let title = format!("{}: frames that none beats{third}", self.name);
        let (across, up) = (goal(0), goal(1));
        let area = titled(area, &title)?;
        let mut chart = axes(&area, &Words { across: &across, up: &up }, [self.range(0), self.range(1)])?;
        if self.goals.len() == 2 {
            let line = self.points.iter().map(|point| (point[0], point[1]));
            chart.draw_series(LineSeries::new(line, BLACK.mix(0.25)))?;
        }
        for point in self.points {
            let at = (point[0], point[1]);
            chart.draw_series([Circle::new(at, 6, self.tone(point).filled())])?;
            if let Some(value) = point.get(2) {
                let figure = self.goals[2].reported(*value);
                chart.draw_series([EmptyElement::at(at) + Text::new(figure, (8, -8), (FONT, 15))])?;
            }
        }
        Ok(())
    }
}
