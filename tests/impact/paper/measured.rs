//! The measured figures: peaks and impulses.

use std::fmt::Write;

use flexframe::impact::measured;
use flexframe::impact::measured::{FileFormat, Summary};

use super::figures::{Height, MEASURED};
use super::{folder, ratio};

/// What `measure` says of a height's folder.
pub fn summary(height: &Height) -> Summary {
    let set = measured::read(&[folder().join(height.folder)], &FileFormat::default()).expect("reads");
    let groups = measured::JudgedDrops::of(&set).groups;
    Summary::of(groups[0].0, &groups[0].1)
}

/// The share of a height's drops that the notebook calls clean: peak within 25 ms, impulse along the axis 0.8 to 1.8 v0.
pub fn clean_share(height: &Height) -> f64 {
    let set = measured::read(&[folder().join(height.folder)], &FileFormat::default()).expect("reads");
    let groups = measured::JudgedDrops::of(&set).groups;
    let is_clean = |drop: &&measured::Drop| {
        drop.impact
            .as_ref()
            .is_some_and(|impact| impact.to_peak_s < 0.0255 && (0.8..=1.8).contains(&impact.impulse_over_v0(groups[0].0.height_m)))
    };
    groups[0].1.iter().filter(is_clean).count() as f64 / groups[0].1.len() as f64
}

fn title(height: &Height) -> String {
    height
        .folder
        .replace('_', " ")
        .replace("030cm", "30 cm")
        .replace("050cm", "50 cm")
        .replace("100cm", "100 cm")
        .replace("150cm", "150 cm")
}

pub fn peaks(page: &mut String) {
    page.push_str(
        "## Measured peaks\n\n\
         `flexframe measure`: the largest |a| of each record, and the largest along the axis, g. Each cell: ours, published, ratio.\n\n\
         | | drops | median | first quartile | third quartile | median along the axis |\n|---|---|---|---|---|---|\n",
    );
    let cell = |ours: f64, theirs: f64| format!("{ours:.1}, {theirs:.1}, {}", ratio(ours, theirs));
    for height in &MEASURED {
        let sum = summary(height);
        let (peak, axial) = (sum.peak_g.expect("there are drops"), sum.peak_axial_g.expect("there are drops"));
        let [q1, median, q3] = height.quartiles_g;
        let _ = writeln!(
            page,
            "| {} | {} of {} | {} | {} | {} | {} |",
            title(height),
            sum.drops,
            height.drops,
            cell(peak.median, median),
            cell(peak.q1, q1),
            cell(peak.q3, q3),
            cell(axial.median, height.axial_g)
        );
    }
    let median = |at: usize| summary(&MEASURED[at]).peak_g.expect("there are drops").median;
    let (ours, theirs) = (median(3) / median(0), MEASURED[3].quartiles_g[1] / MEASURED[0].quartiles_g[1]);
    let _ = writeln!(
        page,
        "\n**Five times the energy.** 150 cm is five times the height of 30 cm. The soft frame's median peak from 150 cm is {ours:.3} of the rigid\n\
         centre's from 30 cm (published {theirs:.3}, ratio {}). It is still lower.\n",
        ratio(ours, theirs)
    );
}

pub fn impulses(page: &mut String) {
    page.push_str(
        "## Impulses\n\n\
         Medians of the clean drops (a clock that did not stall, peak within 25 ms, impulse along the axis 0.8 to 1.8 v0), integrated over\n\
         25 ms. The published figures are of drops that are clean but for their clocks. Each cell: ours, published, ratio.\n\n\
         | | clean | magnitude, of v0 | along the axis, of v0 | restitution |\n|---|---|---|---|---|\n",
    );
    for height in &MEASURED {
        let sum = summary(height);
        let Some([magnitude, axial]) = height.impulses else { continue };
        let median = |spread: Option<measured::Spread>| spread.expect("there are drops").median;
        let cell = |ours: f64, theirs: f64| format!("{ours:.2}, {theirs:.2}, {}", ratio(ours, theirs));
        let _ = writeln!(
            page,
            "| {} | {} of {} | {} | {} | {:.2} |",
            title(height),
            sum.clean,
            sum.drops,
            cell(median(sum.impulse_magnitude_over_v0), magnitude),
            cell(median(sum.impulse_over_v0), axial),
            median(sum.restitution)
        );
    }
    page.push_str(
        "\nA vertical drop that rebounds without loss has an impulse of 2 v0. The magnitude, which the paper fits, has more at 50 and 100 cm. It\n\
         contains sideways motion, which no one-dimensional model can explain. The impulse along the axis is physically possible.\n\n",
    );
}
