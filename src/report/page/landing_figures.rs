//! The figures of landings that are not level.

use plotters::prelude::SeriesLabelPosition;

use super::document::Block;
use crate::impact::diagnose::Diagnosis;
use crate::impact::fit::BEFORE;
use crate::impact::landing::{HeightSpread, LandingAssessment, ShownDrop};
use crate::report::chart::bands::{BandLine, Bands};
use crate::report::chart::lines::{Lines, Series};
use crate::report::chart::plot::{self, Chart, PlotError, files};

const ACROSS: &str = "time from the sample before the trigger, ms";
const UP: &str = "acceleration, g";

/// Mean waves before and after, quantiles, touch times, one drop.
pub(super) fn figures(assessment: &LandingAssessment, diagnosis: &Diagnosis) -> Result<Vec<Block>, PlotError> {
    let step_ms = 1e3 * assessment.step_s;
    let mut blocks = Vec::new();
    let fitted = assessment.windows.iter().map(|window| (window, ""));
    let held_out = assessment.held_out_windows.iter().map(|window| (window, ", held out"));
    for ((height_m, measured, predicted), held_out) in fitted.chain(held_out) {
        let points = diagnosis.base_points.iter().chain(&diagnosis.held_out_points[0]);
        let level: Vec<f64> = points.filter(|point| point.height_m == *height_m).map(|point| point.model_g).collect();
        let chart = Lines {
            title: format!("Mean wave from {height_m} m{held_out}: level, and with random slopes"),
            across: ACROSS,
            up: UP,
            series: vec![
                line("measured", 6, true, &timed(measured, step_ms)),
                line("before: level", 1, false, &timed(&level, step_ms)),
                line("after: random slopes", 0, false, &timed(predicted, step_ms)),
            ],
            levels: Vec::new(),
            left: Vec::new(),
            legend: SeriesLabelPosition::UpperRight,
        };
        let unseen = if held_out.is_empty() { "" } else { " No fit saw this height." };
        let caption = format!("Mean wave from {height_m} m, the base model's, and the mean of landings with random slopes.{unseen}");
        blocks.push(figure(&format!("landing-{height_m}-m"), &chart, caption)?);
    }
    for (at, spread) in assessment.spreads.iter().enumerate() {
        let caption = format!(
            "Every drop from {} m, their quartiles, and the quartiles of landings that differ by their slope alone. What else varies between \
             drops is in the band and not in the lines.",
            spread.height_m
        );
        blocks.push(figure(&format!("landing-quartiles-{}-m", spread.height_m), &bands(spread, at, step_ms), caption)?);
    }
    let caption = "Each drop whose feet were all seen: the foot opposite to the first touches after nearly the sum of the times of the two \
                   between. Times that had nothing to do with each other would fill the square.";
    blocks.push(figure("leg-touches", &touches(assessment), caption.into())?);
    let caption = "Share of the drops whose opposite foot has touched, over the time from the first touch: as read, and of random slopes. A \
                   slope that does not grow with the fall would shift the curves of greater heights to the left.";
    blocks.push(figure("leg-times", &times(&assessment.spreads), caption.into())?);
    if let Some(shown) = &assessment.shown {
        let caption = format!(
            "Drop {} from {} m: its record, what its touches let expect, and the mean of its height. Upright lines are the touches, as read \
             from the lateral axes.",
            shown.trial, shown.height_m
        );
        blocks.push(figure("landing-drop", &drop(shown, step_ms), caption)?);
    }
    Ok(blocks)
}

fn timed(window: &[f64], step_ms: f64) -> Vec<(f64, f64)> {
    window.iter().enumerate().map(|(at, reading)| (step_ms * at as f64, *reading)).collect()
}

fn line(label: &str, colour: usize, marked: bool, points: &[(f64, f64)]) -> Series {
    let (label, colour) = (Some(label.into()), plot::colour(colour));
    Series { label, is_pale: false, colour, width: if marked { 1 } else { 2 }, marked, points: points.to_vec() }
}

fn bands(spread: &HeightSpread, colour: usize, step_ms: f64) -> Bands {
    let of_slopes = |at: usize| timed(&spread.slopes_g.iter().map(|three| three[at]).collect::<Vec<_>>(), step_ms);
    Bands {
        title: format!("Drops from {} m, and random slopes", spread.height_m),
        across: ACROSS,
        up: UP,
        colour,
        waves: spread.windows.iter().map(|window| timed(window, step_ms)).collect(),
        lines: vec![
            BandLine { label: Some("median of random slopes".into()), width: 3, points: of_slopes(1) },
            BandLine { label: Some("quartiles of random slopes".into()), width: 1, points: of_slopes(0) },
            BandLine { label: None, width: 1, points: of_slopes(2) },
        ],
        quartiles: spread.measured_g.iter().enumerate().map(|(at, three)| (step_ms * at as f64, *three)).collect(),
    }
}

/// Time to the opposite foot over the sum of the times to those beside.
fn touches(assessment: &LandingAssessment) -> Lines {
    let count = assessment.touches.len();
    let points = |(at, (height_m, times)): (usize, &(f64, Vec<[f64; 3]>))| Series {
        label: plot::is_named(at, count).then(|| format!("{height_m} m")),
        is_pale: false,
        colour: plot::colour_among(at, count),
        width: 0,
        marked: true,
        points: times.iter().map(|[opposite, near, far]| (1e3 * (near + far), 1e3 * opposite)).collect(),
    };
    let mut series: Vec<Series> = assessment.touches.iter().enumerate().map(points).collect();
    let most = series.iter().flat_map(|series| &series.points).map(|point| point.0).fold(0.0, f64::max);
    let ratio = assessment.evidence.ratio;
    series.push(line(&format!("feet in one plane, {ratio:.2} of the sum"), 6, false, &[(0.0, 0.0), (most, ratio * most)]));
    Lines {
        title: "Touch times of the feet".into(),
        across: "first to both feet beside, sum, ms",
        up: "first to opposite foot, ms",
        series,
        levels: Vec::new(),
        left: Vec::new(),
        legend: SeriesLabelPosition::UpperLeft,
    }
}

/// Share of the drops over the time to the opposite foot.
fn times(spreads: &[HeightSpread]) -> Lines {
    let heights = spreads.len();
    let both = |(height, spread): (usize, &HeightSpread)| {
        let count = spread.opposite_s.len() as f64;
        let read = spread.opposite_s.iter().enumerate().map(|(at, delay_s)| (1e3 * delay_s, (at as f64 + 0.5) / count)).collect();
        let label = |what: &str| plot::is_named(height, heights).then(|| format!("{} m, {what}", spread.height_m));
        let colour = plot::colour_among(height, heights);
        let of_slopes = spread.opposite_of_slopes.iter().map(|(delay_s, share)| (1e3 * delay_s, *share)).collect();
        [
            Series { label: label("as read"), is_pale: false, colour, width: 0, marked: true, points: read },
            Series { label: label("random slopes"), is_pale: false, colour, width: 2, marked: false, points: of_slopes },
        ]
    };
    Lines {
        title: "Time to the opposite foot".into(),
        across: "first to opposite foot, ms",
        up: "share of the drops",
        series: spreads.iter().enumerate().flat_map(both).collect(),
        levels: Vec::new(),
        left: Vec::new(),
        legend: SeriesLabelPosition::LowerRight,
    }
}

fn drop(shown: &ShownDrop, step_ms: f64) -> Lines {
    let most = shown.window_g.iter().chain(&shown.predicted_g).copied().fold(0.0, f64::max);
    let mut series = vec![
        line("record", 6, true, &timed(&shown.window_g, step_ms)),
        line("expected by its touches", 0, false, &timed(&shown.predicted_g, step_ms)),
        line("mean of its height", 4, false, &timed(&shown.mean_g, step_ms)),
    ];
    let [opposite, near, far] = shown.touches.delays_s();
    for (name, colour, delay_s) in
        [("first foot", 1, 0.0), ("a foot beside", 2, near), ("the other", 5, far), ("opposite foot", 3, opposite)]
    {
        // First touch lies within the step before the trigger.
        let at_ms = step_ms * (BEFORE as f64 - 0.5) + 1e3 * delay_s;
        series.push(line(name, colour, false, &[(at_ms, 0.0), (at_ms, 0.35 * most)]));
    }
    Lines {
        title: format!("Drop {} from {} m with its landing", shown.trial, shown.height_m),
        across: ACROSS,
        up: UP,
        series,
        levels: Vec::new(),
        left: Vec::new(),
        legend: SeriesLabelPosition::UpperRight,
    }
}

/// A chart as a figure of a page.
///
/// # Errors
/// When it cannot be drawn.
pub(super) fn figure(name: &str, chart: &impl Chart, caption: String) -> Result<Block, PlotError> {
    let [(_, svg), _] = files(name, chart)?;
    Ok(Block::Figure { name: name.into(), svg: String::from_utf8_lossy(&svg).into_owned(), caption })
}
