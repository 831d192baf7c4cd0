//! Parallel coordinates: an axis for each figure side by side, a line for each frame.

use plotters::prelude::*;

use super::plot::{Area, Chart, Drawn, FONT, MARGIN, colour, titled};
use crate::figures::decimals;

/// Most lines that are drawn: more make one surface.
const MOST: usize = 1500;

/// What a line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::report) enum Kind {
    /// A frame that violates a limit.
    Violating,
    /// A frame that keeps every limit.
    Keeping,
    /// A frame that none beats.
    OfTheFront,
}

impl Kind {
    const ALL: [Self; 3] = [Self::Violating, Self::Keeping, Self::OfTheFront];

    fn word(self) -> &'static str {
        match self {
            Self::Violating => "violates a limit",
            Self::Keeping => "keeps every limit",
            Self::OfTheFront => "none beats it",
        }
    }

    fn colour(self) -> RGBColor {
        colour(match self {
            Self::Violating => 6,
            Self::Keeping => 0,
            Self::OfTheFront => 1,
        })
    }

    /// Of which there are many, those let others shine through.
    fn style(self) -> ShapeStyle {
        match self {
            Self::Violating => self.colour().mix(0.12).stroke_width(1),
            Self::Keeping => self.colour().mix(0.25).stroke_width(1),
            Self::OfTheFront => self.colour().stroke_width(2),
        }
    }
}

/// Frames over several figures.
pub(in crate::report) struct Parallel<'a> {
    /// Over the chart.
    pub title: String,
    /// The names of the figures, each with its unit.
    pub names: Vec<String>,
    /// The frames: what each is, and its figures.
    pub frames: &'a [(Kind, Vec<f64>)],
}

impl Parallel<'_> {
    /// Least and largest value of a figure.
    fn range(&self, figure: usize) -> [f64; 2] {
        let values = || self.frames.iter().map(|(_, figures)| figures[figure]);
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        if high > low { [low, high] } else { [low - 0.5, low + 0.5] }
    }

    /// What stands at the lower and the upper end of a figure's axis: as many decimals as tell the two apart; of a figure that is the same in all
    /// frames that value, once.
    fn end_words(&self, figure: usize) -> [String; 2] {
        let first = self.frames.first().map_or(0.0, |(_, figures)| figures[figure]);
        if self.frames.iter().all(|(_, figures)| figures[figure] == first) {
            return [String::new(), format!("all {}", decimals(first, 2))];
        }
        let words = |places: usize| self.range(figure).map(|value| decimals(value, places));
        (2..MOST_PLACES).map(words).find(|[low, high]| low != high).unwrap_or_else(|| words(MOST_PLACES))
    }
}

/// Most decimals at the ends of an axis.
const MOST_PLACES: usize = 9;
/// The figures' axes reach from here to here, of the chart's height 0 to 1.
const REACH: [f64; 2] = [0.06, 0.9];

impl Chart for Parallel<'_> {
    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
        let count = self.names.len().max(2);
        let area = &titled(area, &self.title)?;
        let mut chart = ChartBuilder::on(area).margin(MARGIN).build_cartesian_2d(-0.4..count as f64 - 0.6, -0.04..1.12_f64)?;
        let ranges: Vec<[f64; 2]> = (0..self.names.len()).map(|figure| self.range(figure)).collect();
        let height = |figure: usize, value: f64| {
            let [low, high] = ranges[figure];
            REACH[0] + (REACH[1] - REACH[0]) * (value - low) / (high - low)
        };
        let every = self.frames.len().div_ceil(MOST).max(1);
        for kind in Kind::ALL {
            // Those that none beats are few, and every one is drawn.
            let every = if kind == Kind::OfTheFront { 1 } else { every };
            let of_kind = self.frames.iter().filter(|(of, _)| *of == kind).step_by(every);
            for (_, figures) in of_kind {
                let line = figures.iter().enumerate().map(|(at, value)| (at as f64, height(at, *value)));
                chart.draw_series(LineSeries::new(line, kind.style()))?;
            }
        }
        for (at, name) in self.names.iter().enumerate() {
            let x = at as f64;
            chart.draw_series([PathElement::new([(x, REACH[0]), (x, REACH[1])], BLACK.stroke_width(1))])?;
            let [low, high] = self.end_words(at);
            // Names of neighbours stand at two heights, so that they do not cover each other.
            let lift = if at % 2 == 0 { 0.055 } else { 0.1 };
            let words = [(name.as_str(), REACH[1] + lift, 15), (high.as_str(), REACH[1] + 0.015, 13), (low.as_str(), REACH[0] - 0.02, 13)];
            for (text, y, size) in words {
                let style = TextStyle::from((FONT, size)).pos(plotters::style::text_anchor::Pos::new(
                    plotters::style::text_anchor::HPos::Center,
                    plotters::style::text_anchor::VPos::Center,
                ));
                chart.draw_series([Text::new(text.to_string(), (x, y), style)])?;
            }
        }
        for (at, kind) in Kind::ALL.into_iter().enumerate() {
            let (x, y) = (30 + 220 * at as i32, area.dim_in_pixel().1 as i32 - 24);
            area.draw(&PathElement::new([(x, y), (x + 24, y)], kind.colour().stroke_width(3)))?;
            area.draw(&Text::new(kind.word(), (x + 32, y - 8), TextStyle::from((FONT, 15))))?;
        }
        Ok(())
    }
}
