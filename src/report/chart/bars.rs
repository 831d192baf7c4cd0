//! A chart of stacked bars in percent, two to a height: side by side what two conventions say.

use plotters::prelude::*;

use super::plot::{Area, Chart, Drawn, FONT, MARGIN, colour, group_names, number, titled};

/// The bars of a height.
pub(in crate::report) struct Group {
    /// Over them.
    pub label: String,
    /// Shares in %, of the left bar and of the right; by number as in [`Bars::parts`].
    pub shares: [Vec<f64>; 2],
}

/// Stacked bars.
pub(in crate::report) struct Bars {
    /// Over the chart.
    pub title: String,
    /// What the parts are, from below.
    pub parts: Vec<&'static str>,
    /// What the left and the right bar of a group are.
    pub sides: [&'static str; 2],
    /// The groups.
    pub groups: Vec<Group>,
}

/// Where the legend begins, pixels.
const LEGEND: (i32, i32) = (780, 24);

/// Width and height of what is drawn of the groups, pixels, about.
const GROUPS: [f64; 2] = [690.0, 480.0];
/// Room below the lowest bar where one is negative, %.
const BELOW_PERCENT: f64 = 4.0;

/// Width of a bar, of a group's 1.
const WIDTH: f64 = 0.38;

impl Bars {
    /// The top of the highest bar, %: 100, or more where something is negative.
    fn highest(&self) -> f64 {
        let above = |shares: &Vec<f64>| shares.iter().filter(|share| **share > 0.0).sum::<f64>();
        self.groups.iter().flat_map(|group| &group.shares).map(above).fold(100.0, f64::max)
    }

    /// Where the axis begins, %: at 0, or below what is negative.
    fn lowest(&self) -> f64 {
        let below = |shares: &Vec<f64>| shares.iter().filter(|share| **share < 0.0).sum::<f64>();
        let lowest = self.groups.iter().flat_map(|group| &group.shares).map(below).fold(0.0, f64::min);
        if lowest < 0.0 { lowest - BELOW_PERCENT } else { 0.0 }
    }
}

impl Chart for Bars {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        let count = self.groups.len() as f64;
        let area = &titled(area, &self.title)?;
        let names = group_names(area, self.groups.iter().map(|group| &group.label[..]), GROUPS)?;
        let (lowest, highest) = (self.lowest(), self.highest());
        let room = (highest - lowest) * names.height / (1.0 - names.height);
        let mut chart = ChartBuilder::on(area)
            .margin(MARGIN)
            .margin_top(MARGIN / 2)
            .x_label_area_size(44)
            .y_label_area_size(60)
            .margin_right(200)
            .build_cartesian_2d(0.0..count, lowest..highest + room)?;
        let across = format!("drop height, m; left bar: {}, right bar: {}", self.sides[0], self.sides[1]);
        let mesh = &mut chart.configure_mesh();
        mesh.disable_x_mesh().disable_x_axis().x_desc(across).y_desc("share, %").x_labels(0);
        mesh.y_label_formatter(&number).label_style((FONT, 16)).axis_desc_style((FONT, 18)).light_line_style(TRANSPARENT).draw()?;
        for (part, title) in self.parts.iter().enumerate() {
            let style = colour(part).filled();
            let bars = self.groups.iter().enumerate().flat_map(|(at, group)| {
                group.shares.iter().enumerate().map(move |(side, shares)| {
                    let left = at as f64 + 0.5 + (side as f64 - 1.0) * (WIDTH + 0.02) + 0.01;
                    // What is negative hangs below the axis, and nothing stands on it.
                    let below: f64 = shares[..part].iter().filter(|share| (**share < 0.0) == (shares[part] < 0.0)).sum();
                    Rectangle::new([(left, below), (left + WIDTH, below + shares[part])], style)
                })
            });
            chart.draw_series(bars)?;
            let (x, y) = (LEGEND.0, LEGEND.1 + 26 * part as i32);
            area.draw(&Rectangle::new([(x, y), (x + 14, y + 14)], style))?;
            area.draw(&Text::new(*title, (x + 22, y), TextStyle::from((FONT, 16))))?;
        }
        let labels = self.groups.iter().enumerate();
        let label =
            |(at, group): (usize, &Group)| Text::new(group.label.clone(), (at as f64 + 0.5, highest + 0.15 * room), names.style.clone());
        chart.draw_series(labels.map(label))?;
        Ok(())
    }
}
