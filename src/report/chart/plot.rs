//! Plots: a chart drawn twice by the same code, as SVG and as PNG, with a font that is compiled in.

use std::ops::Range;
use std::sync::Once;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};

use crate::report::picture::{image as picture, lettering};

/// Size, pixels.
const SIZE: (u32, u32) = (960, 600);
/// Name under which the font is known to the plots.
pub(in crate::report) const FONT: &str = "sans-serif";

/// Where a chart is drawn.
pub(in crate::report) type Area<B> = DrawingArea<B, Shift>;
/// How drawing went.
pub(in crate::report) type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// A chart with a number along each axis.
pub(in crate::report) type NumberChart<'a, B> = ChartContext<'a, B, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The words of a chart.
pub(in crate::report) struct Words<'a> {
    /// Over it.
    pub title: &'a str,
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
        .caption(words.title, (FONT, 24))
        .margin(14)
        .x_label_area_size(44)
        .y_label_area_size(60)
        .build_cartesian_2d(x, y)?;
    let mesh = &mut chart.configure_mesh();
    mesh.x_desc(words.across).y_desc(words.up).label_style((FONT, 16)).axis_desc_style((FONT, 18)).light_line_style(TRANSPARENT).draw()?;
    Ok(chart)
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
