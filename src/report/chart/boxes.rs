//! A chart of boxes: quartiles, whiskers, and every value beside them.

use plotters::prelude::*;

use super::plot::{Area, Chart, Drawn, FONT, MARGIN, colour, group_names, number, titled};
use crate::impact::measured::Spread;

/// Values of a kind and a group.
pub(in crate::report) struct Values {
    /// How they spread.
    pub spread: Spread,
    /// All of them, and whether each is trusted.
    pub values: Vec<(f64, bool)>,
}

/// A group of boxes, one a kind; `None` where a kind was not measured.
pub(in crate::report) struct Group {
    /// Over it.
    pub label: String,
    /// By kind.
    pub kinds: Vec<Option<Values>>,
}

/// Boxes.
pub(in crate::report) struct Boxes {
    /// Over the chart.
    pub title: String,
    /// Under it.
    pub across: &'static str,
    /// Beside it.
    pub up: &'static str,
    /// What the kinds are.
    pub kinds: Vec<&'static str>,
    /// The groups.
    pub groups: Vec<Group>,
}

/// Where the legend begins, pixels.
const LEGEND: (i32, i32) = (766, 24);

/// Width and height of what is drawn of the groups, pixels, about.
const GROUPS: [f64; 2] = [680.0, 460.0];
/// Width of a box, of a group's 1, when there is one kind.
const WIDTH: f64 = 0.56;
/// Room above the highest value, as a multiple of the height of names, and how much of the chart it may be.
const CLEAR: f64 = 1.5;
const MOST_NAMES: f64 = 0.6;
/// Steps of this share of a width scatter values evenly without a random number.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

impl Chart for Boxes {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        let all =
            self.groups.iter().flat_map(|group| group.kinds.iter().flatten()).flat_map(|kind| kind.values.iter().map(|value| value.0));
        let (low, high) = all.fold((0.0_f64, 1.0_f64), |(low, high), value| (low.min(value), high.max(value)));
        let count = self.groups.len().max(1) as f64;
        let area = &titled(area, &self.title)?;
        let names = group_names(area, self.groups.iter().map(|group| &group.label[..]), GROUPS)?;
        // Names stand clear of the highest whisker.
        let share = (CLEAR * names.height).min(MOST_NAMES);
        let room = (high - low) * share / (1.0 - share);
        let mut chart = ChartBuilder::on(area)
            .margin(MARGIN)
            .margin_top(MARGIN / 2)
            .x_label_area_size(64)
            .y_label_area_size(60)
            .margin_right(210)
            .build_cartesian_2d(0.0..count, 1.04 * low..high + room)?;
        let mesh = &mut chart.configure_mesh();
        mesh.disable_x_mesh().disable_x_axis().x_desc(self.across).y_desc(self.up).x_labels(0);
        mesh.y_label_formatter(&number).label_style((FONT, 16)).axis_desc_style((FONT, 18)).light_line_style(TRANSPARENT).draw()?;
        let share = WIDTH / self.kinds.len().max(1) as f64;
        for (number, kind) in self.kinds.iter().enumerate() {
            let tone = colour(number);
            let mut shapes = Vec::new();
            let mut dots = Vec::new();
            for (at, values) in self.groups.iter().enumerate().filter_map(|(at, group)| group.kinds[number].as_ref().map(|kind| (at, kind)))
            {
                let left = at as f64 + 0.5 + (number as f64 - 0.5 * self.kinds.len() as f64) * share;
                shapes.extend(outline(&values.spread, left + 0.06 * share, left + 0.94 * share, tone));
                dots.extend(values.values.iter().enumerate().map(|(order, (value, trusted))| {
                    let place = left + share * (0.2 + 0.6 * (GOLDEN * order as f64).fract());
                    let style = if *trusted { tone.mix(0.55).filled() } else { tone.stroke_width(1) };
                    Circle::new((place, *value), 3, style)
                }));
            }
            chart.draw_series(dots)?;
            chart.draw_series(shapes)?;
            let (x, y) = (LEGEND.0, LEGEND.1 + 26 * number as i32);
            area.draw(&Rectangle::new([(x, y), (x + 14, y + 14)], tone.mix(0.6).filled()))?;
            area.draw(&Text::new(*kind, (x + 22, y), TextStyle::from((FONT, 16))))?;
        }
        let labels = self.groups.iter().enumerate();
        let label = |(at, group): (usize, &Group)| {
            Text::new(group.label.clone(), (at as f64 + 0.5, high + (1.0 - 1.0 / CLEAR + 0.05) * room), names.style.clone())
        };
        chart.draw_series(labels.map(label))?;
        Ok(())
    }
}

/// Box from quartile to quartile, median, whiskers to the ends.
fn outline(spread: &Spread, left: f64, right: f64, tone: RGBColor) -> Vec<PathElement<(f64, f64)>> {
    let Spread { min, q1, median, q3, max, .. } = *spread;
    let middle = 0.5 * (left + right);
    let quarter = 0.25 * (right - left);
    let thin = ShapeStyle::from(BLACK.mix(0.8)).stroke_width(1);
    vec![
        PathElement::new(vec![(left, q1), (right, q1), (right, q3), (left, q3), (left, q1)], thin),
        PathElement::new(vec![(left, median), (right, median)], ShapeStyle::from(tone).stroke_width(3)),
        PathElement::new(vec![(middle, q3), (middle, max)], thin),
        PathElement::new(vec![(middle, min), (middle, q1)], thin),
        PathElement::new(vec![(middle - quarter, max), (middle + quarter, max)], thin),
        PathElement::new(vec![(middle - quarter, min), (middle + quarter, min)], thin),
    ]
}
