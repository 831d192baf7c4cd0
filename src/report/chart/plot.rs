//! Plots: a chart drawn twice by the same code, as SVG and as PNG, with a font that is compiled in.

use std::ops::Range;
use std::sync::Once;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};

use crate::report::picture::{image as picture, lettering};

/// Size, pixels.
const SIZE: (u32, u32) = (960, 600);
/// Around a chart, pixels.
pub(in crate::report) const MARGIN: u32 = 14;
/// Height of a title's letters, and of its lines, pixels.
const TITLE: i32 = 24;
const LINE: i32 = 30;
/// Name under which the font is known to the plots.
pub(in crate::report) const FONT: &str = "sans-serif";

/// Where a chart is drawn.
pub(in crate::report) type Area<B> = DrawingArea<B, Shift>;
/// How drawing went.
pub(in crate::report) type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// A chart with a number along each axis.
pub(in crate::report) type NumberChart<'a, B> = ChartContext<'a, B, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The words of a chart beside its axes.
pub(in crate::report) struct Words<'a> {
    /// Under it.
    pub across: &'a str,
    /// Beside it.
    pub up: &'a str,
}

/// Words and axes of a chart with a number along each axis; its ranges are those of x and y.
pub(in crate::report) fn axes<'a, B: DrawingBackend>(
    area: &'a Area<B>,
    words: &Words,
    [x, y]: [Range<f64>; 2],
) -> Result<NumberChart<'a, B>, DrawingAreaErrorKind<B::ErrorType>> {
    let mut chart = ChartBuilder::on(area)
        .margin(MARGIN)
        .margin_top(MARGIN / 2)
        .x_label_area_size(44)
        .y_label_area_size(60)
        .build_cartesian_2d(x, y)?;
    let mesh = &mut chart.configure_mesh();
    mesh.x_desc(words.across).y_desc(words.up).x_label_formatter(&number).y_label_formatter(&number);
    mesh.label_style((FONT, 16)).axis_desc_style((FONT, 18)).light_line_style(TRANSPARENT).draw()?;
    Ok(chart)
}

/// Writes a title over a picture, in as many lines as it takes; what is left below is the chart's.
pub(in crate::report) fn titled<B: DrawingBackend>(area: &Area<B>, title: &str) -> Result<Area<B>, DrawingAreaErrorKind<B::ErrorType>> {
    let style = TextStyle::from((FONT, TITLE)).pos(Pos::new(HPos::Center, VPos::Top));
    let (width, _) = area.dim_in_pixel();
    let mut lines: Vec<String> = Vec::new();
    for word in title.split_whitespace() {
        let longer = lines.last().map(|line| format!("{line} {word}"));
        match longer {
            Some(longer) if area.estimate_text_size(&longer, &style)?.0 + 2 * MARGIN <= width => {
                lines.pop();
                lines.push(longer);
            }
            _ => lines.push(word.into()),
        }
    }
    for (at, line) in lines.iter().enumerate() {
        area.draw_text(line, &style, (width as i32 / 2, MARGIN as i32 + LINE * at as i32))?;
    }
    Ok(area.split_vertically(MARGIN as i32 + LINE * lines.len() as i32).1)
}

/// A number at an axis: no more decimals than it has.
pub(in crate::report) fn number(value: &f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    if rounded == 0.0 { "0".into() } else { rounded.to_string() }
}

/// Draws the legend of what was drawn with a label.
pub(in crate::report) fn legend<'a, B: DrawingBackend + 'a>(chart: &mut NumberChart<'a, B>, position: SeriesLabelPosition) -> Drawn<B> {
    let legend = &mut chart.configure_series_labels();
    legend.position(position).label_font((FONT, 16)).background_style(WHITE.mix(0.85)).border_style(BLACK.mix(0.3)).draw()
}

/// Colours that most people can distinguish (M. Okabe, K. Ito), by number.
pub(in crate::report) fn colour(number: usize) -> RGBColor {
    const COLOURS: [(u8, u8, u8); 7] =
        [(0, 114, 178), (213, 94, 0), (0, 158, 115), (204, 121, 167), (230, 159, 0), (86, 180, 233), (90, 90, 90)];
    let (red, green, blue) = COLOURS[number % COLOURS.len()];
    RGBColor(red, green, blue)
}

/// Curves of one kind that have colours of their own, and that a legend names.
const NAMED: usize = 7;

/// The colour of one of several curves of a kind: one of its own while there are enough, or else from blue over green to red in their order.
pub(in crate::report) fn colour_among(at: usize, count: usize) -> RGBColor {
    if count <= NAMED {
        return colour(at);
    }
    let way = 2.0 * at as f64 / (count - 1) as f64;
    let [from, to] = if way < 1.0 { [colour(0), colour(2)] } else { [colour(2), colour(1)] };
    let share = way - way.min(1.0).floor();
    let mixed = |from: u8, to: u8| (f64::from(from) + share * (f64::from(to) - f64::from(from))).round() as u8;
    RGBColor(mixed(from.0, to.0), mixed(from.1, to.1), mixed(from.2, to.2))
}

/// Whether the legend names one of several curves of a kind: all of a few, or else the first, the last, and some between.
pub(in crate::report) fn is_named(at: usize, count: usize) -> bool {
    count <= NAMED || (0..NAMED).any(|place| (2 * place * (count - 1) + NAMED - 1) / (2 * (NAMED - 1)) == at)
}

/// How the names of groups side by side are written.
pub(in crate::report) struct GroupNames {
    /// The style; its anchor is the middle of what stands above the groups.
    pub style: TextStyle<'static>,
    /// How much room they take upward, of the chart's range.
    pub height: f64,
}

/// Names of groups that share a width and lie over a chart of some height, pixels: in a line, or upright where they would cover each other.
pub(in crate::report) fn group_names<'a, B: DrawingBackend>(
    area: &Area<B>,
    names: impl Iterator<Item = &'a str>,
    [width, height]: [f64; 2],
) -> Result<GroupNames, DrawingAreaErrorKind<B::ErrorType>> {
    let plain = TextStyle::from((FONT, 17));
    let (mut widest, mut tallest, mut count) = (0, 0, 0);
    for name in names {
        let (across, up) = area.estimate_text_size(name, &plain)?;
        (widest, tallest, count) = (widest.max(across), tallest.max(up), count + 1);
    }
    let crowded = f64::from(widest) > width / f64::from(count.max(1));
    let style = match crowded {
        true => plain.transform(FontTransform::Rotate270).pos(Pos::new(HPos::Left, VPos::Center)),
        false => plain.pos(Pos::new(HPos::Center, VPos::Bottom)),
    };
    Ok(GroupNames { style, height: 1.4 * f64::from(if crowded { widest } else { tallest }) / height })
}

/// Something that can be drawn.
pub(in crate::report) trait Chart {
    /// Draws it.
    fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B>;
}

/// A plot could not be drawn.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw {name}: {message}")]
pub struct PlotError {
    /// Which.
    pub name: String,
    /// What the drawing says.
    pub message: String,
}

/// A chart as `NAME.svg` and `NAME.png`.
pub(in crate::report) fn files(name: &str, chart: &impl Chart) -> Result<[(String, Vec<u8>); 2], PlotError> {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // Without it the text alone is missing; drawing then says so.
        let _ = register_font(FONT, FontStyle::Normal, lettering::TYPEFACE);
    });
    let failed = |message: String| PlotError { name: name.into(), message };
    let mut svg = String::new();
    finish(chart, &SVGBackend::with_string(&mut svg, SIZE).into_drawing_area()).map_err(|error| failed(error.to_string()))?;
    let mut pixels = vec![255; (SIZE.0 * SIZE.1 * 3) as usize];
    finish(chart, &BitMapBackend::with_buffer(&mut pixels, SIZE).into_drawing_area()).map_err(|error| failed(error.to_string()))?;
    Ok([(format!("{name}.svg"), svg.into_bytes()), (format!("{name}.png"), picture::encoded(&pixels, SIZE.0, SIZE.1))])
}

fn finish<B: DrawingBackend>(chart: &impl Chart, area: &Area<B>) -> Drawn<B> {
    area.fill(&WHITE)?;
    chart.draw(area)?;
    area.present()
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Titled(&'static str);

    impl Chart for Titled {
        fn draw<B: DrawingBackend>(&self, area: &Area<B>) -> Drawn<B> {
            let below = titled(area, self.0)?;
            below.fill(&BLACK)
        }
    }

    #[test]
    fn analytic_a_long_title_breaks_into_lines_within_the_picture() {
        let words = "a title that goes on and on about the frame, its rods, its corners, its hinges and what becomes of them in a fall \
                     from two metres onto concrete";
        let [svg, _] = files("t", &Titled(words)).expect("is drawn");
        let svg = String::from_utf8(svg.1).expect("text");
        let lines: Vec<&str> = svg.match_indices("<text").map(|(at, _)| &svg[at..]).collect();
        assert!(lines.len() > 1, "{svg}");
        let [short, _] = files("t", &Titled("short")).expect("is drawn");
        assert_eq!(String::from_utf8(short.1).expect("text").matches("<text").count(), 1);
    }

    #[test]
    fn analytic_curves_of_a_kind_have_colours_of_their_own_and_a_legend_that_is_short() {
        for count in 1..60 {
            let colours: Vec<RGBColor> = (0..count).map(|at| colour_among(at, count)).collect();
            assert!((1..count).all(|at| !colours[..at].contains(&colours[at])), "{count}: {colours:?}");
            let named: Vec<usize> = (0..count).filter(|at| is_named(*at, count)).collect();
            assert_eq!((named.len(), named[0], named[named.len() - 1]), (count.min(7), 0, count - 1));
        }
    }

    #[test]
    fn analytic_numbers_at_axes_have_no_needless_decimals() {
        assert_eq!(
            [0.0, -0.0, 100.0, 0.25, -1.5, 0.1 + 0.2, 1e-9].map(|value| number(&value)),
            ["0", "0", "100", "0.25", "-1.5", "0.3", "0"]
        );
    }
}
