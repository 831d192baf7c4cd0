//! A chart of lines over one axis, with level lines and a legend.

use plotters::prelude::*;

use super::plot::{Area, Chart, Drawn, Words, axes, legend, titled};

/// A line.
pub(in crate::report) struct Series {
    /// Its name in the legend, where it is named there.
    pub label: Option<String>,
    /// Whether it only accompanies another.
    pub is_pale: bool,
    /// Its colour.
    pub colour: RGBColor,
    /// Width, pixels.
    pub width: u32,
    /// Whether its points are marked.
    pub marked: bool,
    /// Its points.
    pub points: Vec<(f64, f64)>,
}

/// Lines.
pub(in crate::report) struct Lines {
    /// Over the chart.
    pub title: String,
    /// Under it.
    pub across: &'static str,
    /// Beside it.
    pub up: &'static str,
    /// The lines.
    pub series: Vec<Series>,
    /// Level lines, with what they mean; one without words is not in the legend.
    pub levels: Vec<(String, f64)>,
    /// Where a line leaves the range in which its model is valid: its colour, and the point.
    pub left: Vec<(RGBColor, (f64, f64))>,
    /// Where no line is: the legend goes there.
    pub legend: SeriesLabelPosition,
}

/// Least and largest, with a little room above and below, and never nothing between.
fn range(values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
    let (low, high) = values.filter(|v| v.is_finite()).fold((0.0_f64, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
    let room = 0.04 * (high - low).max(1e-9);
    (if low < 0.0 { low - room } else { 0.0 })..high + room
}

/// How much of the chart a legend takes from its corner, along either axis.
const OF_LEGEND: f64 = 0.35;

/// What lines and level lines reach, across and up.
fn reached(series: &[Series], levels: &[(String, f64)]) -> [std::ops::Range<f64>; 2] {
    let points = || series.iter().flat_map(|series| &series.points);
    [range(points().map(|p| p.0)), range(points().map(|p| p.1).chain(levels.iter().map(|level| level.1)))]
}

/// The corner of a chart in which the fewest points of some lines are.
pub(in crate::report) fn emptiest_corner(series: &[Series], levels: &[(String, f64)]) -> SeriesLabelPosition {
    let points = || series.iter().flat_map(|series| &series.points);
    let [across, up] = reached(series, levels);
    let share = |value: f64, range: &std::ops::Range<f64>| (value - range.start) / (range.end - range.start);
    let within = |right: bool, upper: bool| {
        let near = |share: f64, end: bool| if end { share > 1.0 - OF_LEGEND } else { share < OF_LEGEND };
        points().filter(|(x, y)| near(share(*x, &across), right) && near(share(*y, &up), upper)).count()
    };
    let corners = [
        (SeriesLabelPosition::UpperRight, within(true, true)),
        (SeriesLabelPosition::LowerRight, within(true, false)),
        (SeriesLabelPosition::UpperLeft, within(false, true)),
        (SeriesLabelPosition::LowerLeft, within(false, false)),
    ];
    corners.into_iter().min_by_key(|(_, points)| *points).map_or(SeriesLabelPosition::UpperRight, |(corner, _)| corner)
}

impl Chart for Lines {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        let [across, up] = reached(&self.series, &self.levels);
        let words = Words { across: self.across, up: self.up };
        let area = titled(area, &self.title)?;
        let mut chart = axes(&area, &words, [across.clone(), up])?;
        for (name, level) in &self.levels {
            let line = LineSeries::new([(across.start, *level), (across.end, *level)], BLACK.mix(0.6));
            let drawn = chart.draw_series(line)?;
            if !name.is_empty() {
                drawn.label(name).legend(|(x, y)| PathElement::new([(x, y), (x + 22, y)], BLACK.mix(0.6)));
            }
        }
        for series in &self.series {
            let colour = series.colour;
            let style = ShapeStyle::from(colour.mix(if series.is_pale { 0.45 } else { 1.0 })).stroke_width(series.width);
            let line = chart.draw_series(LineSeries::new(series.points.iter().copied(), style))?;
            match &series.label {
                Some(label) if series.marked => {
                    let mark = move || Circle::new((11, 0), 4, colour.filled());
                    line.label(label).legend(move |at| EmptyElement::at(at) + PathElement::new([(0, 0), (22, 0)], style) + mark());
                }
                Some(label) => {
                    line.label(label).legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], style));
                }
                None => {}
            }
            if series.marked {
                chart.draw_series(series.points.iter().map(|point| Circle::new(*point, 4, colour.filled())))?;
            }
        }
        if !self.left.is_empty() {
            let ring = |at: (f64, f64), tone: RGBColor| EmptyElement::at(at) + Circle::new((0, 0), 9, tone.stroke_width(3));
            let rings = self.left.iter().map(|(colour, at)| ring(*at, *colour));
            let black = ShapeStyle::from(BLACK).stroke_width(2);
            chart
                .draw_series(rings)?
                .label("from here on beyond the model's range")
                .legend(move |at| EmptyElement::at(at) + Circle::new((11, 0), 7, black));
        }
        legend(&mut chart, self.legend.clone())
    }
}
