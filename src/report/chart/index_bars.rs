//! Sobol' indices of a figure: two bars for each axis of a study, with their 95 % intervals.

use plotters::prelude::*;

use super::plot::{Area, Chart, Drawn, FONT, MARGIN, colour, number, titled};
use crate::study::Indices;

/// Width of a bar, of an axis' 1.
const WIDTH: f64 = 0.36;
/// Height of a line of names, of the chart's.
const LINE: f64 = 0.045;
/// The two kinds of indices.
const KINDS: [&str; 2] = ["first order: by itself", "total: with its interactions"];

/// The indices of one figure.
pub(in crate::report) struct IndexBars<'a> {
    /// Over the chart.
    pub title: String,
    /// The axes of the study.
    pub axes: &'a [String],
    /// Their indices.
    pub indices: &'a Indices,
}

impl Chart for IndexBars<'_> {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        let all = || self.indices.first.iter().chain(&self.indices.total);
        let most = all().map(|index| index.share + index.half_interval).fold(1.0, f64::max);
        let least = all().map(|index| index.share - index.half_interval).fold(0.0, f64::min);
        let line = LINE * (most - least);
        let count = self.axes.len() as f64;
        let area = &titled(area, &self.title)?;
        let mut chart = ChartBuilder::on(area)
            .margin(MARGIN)
            .margin_top(MARGIN / 2)
            .x_label_area_size(44)
            .y_label_area_size(60)
            .build_cartesian_2d(0.0..count, least - 2.6 * line..most + 2.6 * line)?;
        let mesh = &mut chart.configure_mesh();
        mesh.disable_x_mesh().disable_x_axis().y_desc("share of the variance, of 1").x_labels(0);
        mesh.y_label_formatter(&number).label_style((FONT, 16)).axis_desc_style((FONT, 18)).light_line_style(TRANSPARENT).draw()?;
        for (kind, indices) in [&self.indices.first, &self.indices.total].into_iter().enumerate() {
            let style = colour(kind).filled();
            for (axis, index) in indices.iter().enumerate() {
                let left = axis as f64 + 0.5 + (kind as f64 - 1.0) * (WIDTH + 0.02) + 0.01;
                let middle = left + 0.5 * WIDTH;
                chart.draw_series([Rectangle::new([(left, 0.0), (left + WIDTH, index.share)], style)])?;
                let ends = [-1.0, 1.0].map(|way| (middle, index.share + way * index.half_interval));
                chart.draw_series([PathElement::new(ends, BLACK.stroke_width(2))])?;
            }
            let (x, y) = (90 + 300 * kind as i32, 18);
            area.draw(&Rectangle::new([(x, y), (x + 14, y + 14)], style))?;
            area.draw(&Text::new(KINDS[kind], (x + 22, y), TextStyle::from((FONT, 16))))?;
        }
        for (axis, name) in self.axes.iter().enumerate() {
            let centred = TextStyle::from((FONT, 15)).pos(plotters::style::text_anchor::Pos::new(
                plotters::style::text_anchor::HPos::Center,
                plotters::style::text_anchor::VPos::Top,
            ));
            // Names of neighbours stand at two heights, so that they do not cover each other.
            let below = if axis % 2 == 0 { 0.4 * line } else { 1.5 * line };
            let name = name.rsplit('.').next().unwrap_or(name).trim_end_matches("_mm");
            chart.draw_series([Text::new(name.to_string(), (axis as f64 + 0.5, least - below), centred)])?;
        }
        Ok(())
    }
}
