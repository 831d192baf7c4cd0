//! A chart of many waves laid upon each other: single ones pale, the band between quartiles, the median strong.

use plotters::prelude::*;

use super::plot::{Area, Chart, Drawn, Words, axes, colour, legend, titled};

/// A black line on top of waves.
pub(in crate::report) struct BandLine {
    /// Its name in the legend; none for a line that only accompanies another.
    pub label: Option<String>,
    /// Width, pixels.
    pub width: u32,
    /// Its points.
    pub points: Vec<(f64, f64)>,
}

/// Waves over one axis.
pub(in crate::report) struct Bands {
    /// Over the chart.
    pub title: String,
    /// Under it.
    pub across: &'static str,
    /// Beside it.
    pub up: &'static str,
    /// Number of the colour.
    pub colour: usize,
    /// Single waves.
    pub waves: Vec<Vec<(f64, f64)>>,
    /// Lines on top.
    pub lines: Vec<BandLine>,
    /// At each time the first quartile, median and third quartile.
    pub quartiles: Vec<(f64, [f64; 3])>,
}

impl Chart for Bands {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        let points = || self.waves.iter().flatten().chain(self.lines.iter().flat_map(|line| &line.points));
        let (left, right) = points().fold((0.0_f64, 1e-9_f64), |(left, right), point| (left.min(point.0), right.max(point.0)));
        let (low, high) = points().fold((0.0_f64, 1.0_f64), |(low, high), point| (low.min(point.1), high.max(point.1)));
        let words = Words { across: self.across, up: self.up };
        let area = titled(area, &self.title)?;
        let mut chart = axes(&area, &words, [left..right, 1.05 * low..1.05 * high])?;
        let tone = colour(self.colour);
        for wave in &self.waves {
            chart.draw_series(LineSeries::new(wave.iter().copied(), ShapeStyle::from(BLACK.mix(0.18)).stroke_width(1)))?;
        }
        let lower = self.quartiles.iter().map(|(t, [q1, ..])| (*t, *q1));
        let upper = self.quartiles.iter().rev().map(|(t, [.., q3])| (*t, *q3));
        let band = Polygon::new(lower.chain(upper).collect::<Vec<_>>(), tone.mix(0.35));
        chart
            .draw_series([band])?
            .label("quartiles")
            .legend(move |(x, y)| Rectangle::new([(x, y - 6), (x + 22, y + 6)], tone.mix(0.35).filled()));
        let median = self.quartiles.iter().map(|(t, [_, median, _])| (*t, *median));
        let style = ShapeStyle::from(tone).stroke_width(3);
        chart
            .draw_series(LineSeries::new(median, style))?
            .label("median")
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], style));
        for line in &self.lines {
            let style = ShapeStyle::from(BLACK).stroke_width(line.width);
            let drawn = chart.draw_series(LineSeries::new(line.points.iter().copied(), style))?;
            if let Some(label) = &line.label {
                drawn.label(label).legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], style));
            }
        }
        legend(&mut chart, SeriesLabelPosition::UpperRight)
    }
}
