//! Landings that are not level, as a section of the diagnosis' page.

use plotters::prelude::SeriesLabelPosition;

use super::document::Block;
use crate::impact::landing::LandingAssessment;
use crate::report::chart::lines::{Lines, Series};
use crate::report::chart::plot::{PlotError, files};
use crate::report::data::landing_data;

/// Tests, numbers, waves and touch times.
///
/// # Errors
/// When a figure cannot be drawn.
pub(super) fn blocks(assessment: &LandingAssessment) -> Result<Vec<Block>, PlotError> {
    let cells = |cells: &[&str]| cells.iter().map(|cell| (*cell).to_string()).collect::<Vec<_>>();
    let gates = assessment.gates.iter().map(|gate| cells(&[gate.id, if gate.passed { "passed" } else { "failed" }, &gate.found])).collect();
    let numbers = assessment.estimates.iter().map(|estimate| {
        let [low, high] = estimate.ci95;
        cells(&[estimate.key, &format!("{:.4}", estimate.value), &format!("{low:.4} to {high:.4}"), estimate.unit])
    });
    let covariates = assessment
        .covariates
        .iter()
        .map(|covariate| cells(&[&covariate.id, &format!("{:.0} %", 1e2 * covariate.explained), &format!("{:.3}", covariate.p)]));
    let mut blocks = vec![
        Block::Heading("Landings that are not level".into()),
        Block::Text(
            "Each foot's touch is read from the lateral axes. A rigid body on four legs lands with random slopes: the mean of such landings is \
             compared with the mean waves, and single drops with the landing that their own touches show."
                .into(),
        ),
        Block::Text(format!("{}.", landing_data::spread(assessment))),
        Block::Table(cells(&["test", "", "what was found"]), gates),
        Block::Table(cells(&["parameter", "value", "95 %", "unit"]), numbers.collect()),
        Block::Table(cells(&["between drops of one height", "explained", "p"]), covariates.collect()),
    ];
    for (height_m, measured, predicted) in &assessment.windows {
        let line = |label: &str, colour: usize, marked: bool, window: &[f64]| Series {
            label: Some(label.into()),
            colour,
            width: if marked { 1 } else { 2 },
            marked,
            points: window.iter().enumerate().map(|(at, reading)| (1e3 * assessment.step_s * at as f64, *reading)).collect(),
        };
        let chart = Lines {
            title: format!("Mean wave from {height_m} m, random slopes"),
            across: "time from the sample before the trigger, ms",
            up: "acceleration, g",
            series: vec![line("measured", 6, true, measured), line("random slopes", 0, false, predicted)],
            levels: Vec::new(),
            legend: SeriesLabelPosition::UpperRight,
        };
        let name = format!("landing-{:03.0}cm", height_m * 100.0);
        blocks.push(figure(&name, &chart, format!("Mean wave from {height_m} m and the mean of landings with random slopes."))?);
    }
    let caption = "Each drop whose feet were all seen: the foot opposite to the first touches after nearly the sum of the times of the two \
                   between. Times that had nothing to do with each other would fill the square.";
    blocks.push(figure("leg-touches", &touches(assessment), caption.into())?);
    Ok(blocks)
}

/// Time to the opposite foot over the sum of the times to those beside.
fn touches(assessment: &LandingAssessment) -> Lines {
    let points = |(colour, (height_m, times)): (usize, &(f64, Vec<[f64; 3]>))| Series {
        label: Some(format!("{height_m} m")),
        colour,
        width: 0,
        marked: true,
        points: times.iter().map(|[opposite, near, far]| (1e3 * (near + far), 1e3 * opposite)).collect(),
    };
    let mut series: Vec<Series> = assessment.touches.iter().enumerate().map(points).collect();
    let most = series.iter().flat_map(|series| &series.points).map(|point| point.0).fold(0.0, f64::max);
    let ratio = assessment.evidence.ratio;
    let label = Some(format!("feet in one plane, {ratio:.2} of the sum"));
    series.push(Series { label, colour: 6, width: 2, marked: false, points: vec![(0.0, 0.0), (most, ratio * most)] });
    Lines {
        title: "Touch times of the feet".into(),
        across: "first to both feet beside, sum, ms",
        up: "first to opposite foot, ms",
        series,
        levels: Vec::new(),
        legend: SeriesLabelPosition::UpperLeft,
    }
}

fn figure(name: &str, chart: &Lines, caption: String) -> Result<Block, PlotError> {
    let [(_, svg), _] = files(name, chart)?;
    Ok(Block::Figure { name: name.into(), svg: String::from_utf8_lossy(&svg).into_owned(), caption })
}
