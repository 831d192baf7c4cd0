//! Landings that are not level, as a section of the diagnosis' page.

use super::document::Block;
use super::landing_figures;
use crate::figures::{PARAMETER_DIGITS, significant};
use crate::frame::assembly::Design;
use crate::impact::diagnose::Diagnosis;
use crate::impact::landing::{Gate, LandingAssessment};
use crate::report::chart::plot::PlotError;
use crate::report::data::landing_data;
use crate::report::picture::landing_picture;

/// Tests, numbers, figures, and the frame as it lands where its design is known.
///
/// # Errors
/// When a figure cannot be drawn.
pub(super) fn blocks(assessment: &LandingAssessment, diagnosis: &Diagnosis, design: Option<&Design>) -> Result<Vec<Block>, PlotError> {
    let cells = |cells: &[&str]| cells.iter().map(|cell| (*cell).to_string()).collect::<Vec<_>>();
    let table = |gates: &[Gate]| gates.iter().map(|gate| cells(&[gate.id, gate.word(), &gate.found])).collect();
    let attitude = &assessment.attitude;
    let numbers = assessment.estimates.iter().chain(&attitude.estimates).map(|estimate| {
        let [value, low, high] = [estimate.value, estimate.ci95[0], estimate.ci95[1]].map(|value| significant(value, PARAMETER_DIGITS));
        cells(&[estimate.key, &value, &format!("{low} to {high}"), estimate.unit])
    });
    let mut blocks = vec![
        Block::Heading("Landings that are not level".into()),
        Block::Text(
            "Each foot's touch is read from the lateral axes. A rigid body on four legs lands with random slopes: the mean of such landings is \
             compared with the mean waves, and single drops with the landing that their own touches show."
                .into(),
        ),
        Block::Text(format!("In words: {}.", landing_data::spread(assessment))),
        Block::Table(cells(&["test", "", "what was found"]), table(&assessment.gates)),
        Block::Table(cells(&["parameter", "value", "95 %", "unit"]), numbers.collect()),
        Block::Text(format!("Mounting: {}. {}.", landing_data::lean(attitude), attitude.reason())),
        Block::Table(cells(&["test of attitude_sensor", "", "what was found"]), table(&attitude.gates)),
    ];
    blocks.extend(landing_figures::figures(assessment, diagnosis)?);
    if let Some((shown, design)) = assessment.shown.as_ref().zip(design) {
        let [own, across] = shown.slopes_rad.map(f64::to_degrees);
        let caption = format!(
            "{} as drop {} from {} m landed by its touches, at first touch: {own:.1} degrees down along the first foot's diagonal, {across:.1} \
             along the other one. Which foot of the frame is the first is not known: it is drawn at the front right.",
            design.frame.name, shown.trial, shown.height_m
        );
        let png = landing_picture::png(design, shown.slopes_rad);
        blocks.push(Block::Picture { name: "landing-frame".into(), png, caption });
    }
    Ok(blocks)
}
