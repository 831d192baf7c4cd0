//! A diagnosis as a page to read.

use super::landing_figures::figure;
use super::landing_section;
use crate::figures::{PARAMETER_DIGITS, hundredths, p_value, significant};
use crate::frame::assembly::Design;
use crate::impact::diagnose::{CovariateEffect, Diagnosis, Gap, Point, Verdict, joined};
use crate::impact::request::{Compared, SeparatingExperiment};
use crate::report::chart::lines::{Lines, Series, emptiest_corner};
use crate::report::chart::plot::{self, PlotError};
use crate::report::data::diagnosis_data::held_rows;
use crate::report::page::document::Block;

/// Title of the page.
pub fn title(diagnosis: &Diagnosis, compared: &Compared) -> String {
    if let Some(landing) = compared.landing.as_ref().filter(|landing| landing.decides()) {
        return format!("Missing: {}", landing.ids().join(" + "));
    }
    let (own, lacked): (Vec<&str>, Vec<&str>) = diagnosis.chosen.ids().into_iter().partition(|id| compared.own_effects.contains(id));
    // A model that has them all has other numbers than it was given.
    let chosen = if own.is_empty() || lacked.is_empty() {
        joined(&diagnosis.chosen)
    } else {
        format!("{}, beside {} of the model", lacked.join(" + "), own.join(" + "))
    };
    match diagnosis.verdict {
        Verdict::NothingMissing => "Nothing is missing".into(),
        Verdict::Named => format!("Missing: {chosen}"),
        Verdict::Ambiguous => format!("Missing: {chosen}, or another set that these drops cannot distinguish from it"),
        Verdict::NoneSuffices => "No effect of the catalogue suffices".into(),
    }
}

/// Everything, in the order of the work; the frame that fell is drawn as it lands.
///
/// # Errors
/// When a figure cannot be drawn.
pub fn blocks(diagnosis: &Diagnosis, compared: &Compared, design: Option<&Design>) -> Result<Vec<Block>, PlotError> {
    let mut blocks = vec![Block::List(diagnosis.reasons.clone())];
    blocks.extend(drops(diagnosis, compared));
    blocks.extend(gaps(diagnosis, compared));
    blocks.extend(waves(diagnosis)?);
    if let Some(landing) = &compared.landing {
        blocks.extend(landing_section::blocks(landing, diagnosis, design)?);
    }
    blocks.extend(explained(compared));
    blocks.extend(residual_map(diagnosis));
    blocks.extend(ranking(diagnosis));
    blocks.extend(estimates(diagnosis));
    blocks.extend(residual(diagnosis));
    // What landings leave open is told with what varies between drops; to tell two vertical sets apart that both fail is no help there.
    if compared.landings_beside().is_none() {
        blocks.extend(next(diagnosis));
    }
    blocks.extend(left_out(compared));
    Ok(blocks)
}

fn cells<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(String::from).to_vec()
}

fn drops(diagnosis: &Diagnosis, compared: &Compared) -> Vec<Block> {
    let rows = diagnosis
        .observables
        .iter()
        .map(|one| {
            let possible = match (one.impossible, one.too_small) {
                (true, _) => "impossible for a vertical impact",
                (_, true) if diagnosis.clipping.is_some() => "small, as readings are cut off",
                (_, true) => "less than stops a body from there: another height or another scale?",
                _ => "possible",
            };
            vec![
                format!("{}", one.height_m),
                one.drops.to_string(),
                format!("{:.1}", one.median_peak_g),
                format!("{:.2} ± {:.2}", one.impulse_over_v0, one.error),
                format!("{:.2}: {possible}", one.most),
            ]
        })
        .collect();
    let head = cells(["height, m", "drops", "median peak, g", "impulse of the mean wave / v0", "at most"]);
    let mut blocks = vec![Block::Heading("Observations without a model".into()), Block::Table(head, rows)];
    let mut lines = vec![format!("Channel: {} (the model states: {}).", compared.channel, compared.stated_channel)];
    lines.push(compared.channel());
    lines.extend(compared.sampling());
    lines.extend(compared.observed());
    if let Some(clipping) = diagnosis.clipping {
        lines.push(format!("{} readings clip at {:.1} g.", clipping.readings, clipping.level_g));
    }
    lines.push(format!("Trend over trials: p = {}.", p_value(diagnosis.trend_p)));
    lines.extend(compared.early_end());
    lines.extend(compared.free_fall());
    if !compared.left_out.is_empty() {
        lines.push(format!("Drops left out: {}. The last section lists them with the reasons.", compared.left_out.len()));
    }
    blocks.push(Block::List(lines));
    blocks
}

/// Each drop that no fit sees, and why: a long list where a logger's clock stalls, so it stands last.
fn left_out(compared: &Compared) -> Vec<Block> {
    if compared.left_out.is_empty() {
        return Vec::new();
    }
    let rows = compared.left_out.iter().map(|left| vec![left.trial.clone(), format!("{} m", left.height_m), left.reason.clone()]).collect();
    vec![Block::Heading("Drops left out".into()), Block::Table(cells(["drop", "height", "reason"]), rows)]
}

/// What explains how drops of one height vary, and what changes together with the height.
fn explained(compared: &Compared) -> Vec<Block> {
    let or_dash = |value: Option<String>| value.unwrap_or_else(|| "-".into());
    let row = |one: &CovariateEffect| {
        let explained = or_dash(one.explained.map(|share| format!("{:.0} %", 1e2 * share)));
        vec![one.id.clone(), explained, or_dash(one.p.map(p_value)), one.drops.to_string()]
    };
    let mut blocks = vec![
        Block::Heading("What explains the variation between drops".into()),
        Block::Text(
            "Share of the variance between drops of one height, predicted for drops that the regression did not see, with a p-value by \
             permutation. A dash: the quantity is the same for all drops of each height, or \
             has nearly as many names as drops."
                .into(),
        ),
        Block::Table(cells(["quantity", "explained", "p", "drops"]), compared.covariates.iter().map(row).collect()),
    ];
    let mut lines: Vec<String> = compared.confounding.iter().map(|one| one.found.clone()).collect();
    lines.extend(compared.separating.iter().flat_map(SeparatingExperiment::sentences));
    if !lines.is_empty() {
        blocks.push(Block::List(lines));
    }
    blocks
}

fn gaps(diagnosis: &Diagnosis, compared: &Compared) -> Vec<Block> {
    let held = if diagnosis.heights_held_out { "held-out heights" } else { "each height, predicted from the others" };
    let (before, after) = (&diagnosis.before, &diagnosis.after);
    let landings = compared.landings_beside();
    let row = |what: &str, before: Gap, after: Gap, landings_g: Option<f64>| {
        let mut row = vec![
            what.to_string(),
            hundredths(before.net_g),
            hundredths(after.net_g),
            hundredths(after.net_g / before.net_g.max(1e-9)),
            hundredths(before.floor_g),
            format!("{} → {}", hundredths(before.raw_g), hundredths(after.raw_g)),
        ];
        if landings.is_some() {
            row.push(landings_g.map_or("-".into(), hundredths));
        }
        row
    };
    let rows = vec![
        row("fitted heights", before.fitted, after.fitted, landings.map(|landings| landings.gaps.fitted.net_g)),
        row(held, before.held_out, after.held_out, landings.map(|landings| landings.gaps.held_out.net_g)),
        row("every second drop, predicted from the others", before.trials, after.trials, None),
    ];
    let mut head = cells(["mean wave against model", "before, g", "after, g", "ratio", "floor, g", "raw, g"]);
    head.extend(landings.map(|landings| format!("{}, g", landings.ids().join(" + "))));
    let mut blocks = vec![
        Block::Heading("The gap, before and after".into()),
        Block::Text(
            "Root of the mean over samples of (mean wave − model)² − SE², in g; the floor is the standard error of the mean wave itself, and nothing below it can be seen. A dash: not computed, as that to other heights where all drops are from one."
                .into(),
        ),
        Block::Table(head, rows),
    ];
    blocks.extend(compared.before(diagnosis).map(Block::Text));
    blocks
}

fn waves(diagnosis: &Diagnosis) -> Result<Vec<Block>, PlotError> {
    let mut blocks = vec![Block::Heading("Waves and residuals".into())];
    let mut heights: Vec<f64> = diagnosis.base_points.iter().map(|point| point.height_m).collect();
    heights.dedup();
    for height_m in &heights {
        let caption = format!("Mean wave from {height_m} m with the model before and after.");
        blocks.push(figure(
            &format!("wave-{height_m}-m"),
            &wave_chart([&diagnosis.base_points, &diagnosis.chosen_points], *height_m, ""),
            caption,
        )?);
    }
    let [base, chosen] = &diagnosis.held_out_points;
    let mut unseen: Vec<f64> = base.iter().map(|point| point.height_m).collect();
    unseen.dedup();
    for height_m in unseen {
        let caption = format!("Mean wave from {height_m} m, which no fit saw, with the model before and after.");
        blocks.push(figure(&format!("wave-{height_m}-m"), &wave_chart([base, chosen], height_m, ", held out"), caption)?);
    }
    for (when, points) in [("before", &diagnosis.base_points), ("after", &diagnosis.chosen_points)] {
        let caption = format!("Residual {when}, in standard errors of the mean wave.");
        blocks.push(figure(&format!("residual-{when}"), &residual_chart(when, points, &heights), caption)?);
    }
    Ok(blocks)
}

/// Mean wave of a height with the models before and after. All at the times of the base model's first touch: samples are compared by their place
/// behind the trigger, whatever the onset of a model.
fn wave_chart([base, chosen]: [&Vec<Point>; 2], height_m: f64, held_out: &str) -> Lines {
    let of = |points: &[Point], value: &dyn Fn(&Point) -> f64| -> Vec<(f64, f64)> {
        let own = |points: &&Point| points.height_m == height_m;
        let times_ms = base.iter().filter(own).map(|point| point.t_ms);
        times_ms.zip(points.iter().filter(own).map(value)).collect()
    };
    let line = |label: &str, colour: usize, width: u32, marked: bool, points: Vec<(f64, f64)>| Series {
        label: Some(label.into()),
        is_pale: false,
        colour: plot::colour(colour),
        width,
        marked,
        points,
    };
    Lines {
        title: format!("Mean wave from {height_m} m{held_out}"),
        across: "time from first touch in the model before, ms",
        up: "acceleration, g",
        series: vec![
            line("measured", 6, 1, true, of(base, &|point| point.measured_g)),
            line("before", 1, 2, false, of(base, &|point| point.model_g)),
            line("after", 0, 2, false, of(chosen, &|point| point.model_g)),
        ],
        levels: Vec::new(),
        left: Vec::new(),
        legend: plotters::prelude::SeriesLabelPosition::UpperRight,
    }
}

/// What a model leaves of the mean waves, in their standard errors.
fn residual_chart(when: &str, points: &[Point], heights: &[f64]) -> Lines {
    let series = |(at, height_m): (usize, &f64)| Series {
        label: plot::is_named(at, heights.len()).then(|| format!("{height_m} m")),
        is_pale: false,
        colour: plot::colour_among(at, heights.len()),
        width: 2,
        marked: true,
        points: points
            .iter()
            .filter(|point| point.height_m == *height_m)
            .map(|point| (point.t_ms, (point.measured_g - point.model_g) / point.error_g.max(1e-3)))
            .collect(),
    };
    let series: Vec<_> = heights.iter().enumerate().map(series).collect();
    let levels = vec![("± 2 standard errors".into(), 2.0), (String::new(), -2.0)];
    let legend = emptiest_corner(&series, &levels);
    Lines {
        title: format!("Residual {when}"),
        across: "time from first touch, ms",
        up: "measured less model, standard errors",
        series,
        levels,
        left: Vec::new(),
        legend,
    }
}

fn residual_map(diagnosis: &Diagnosis) -> Vec<Block> {
    let rows = diagnosis
        .residual_map
        .cells
        .iter()
        .map(|cell| {
            vec![format!("{}", cell.height_m), cell.phase.words().into(), format!("{:.2}", cell.residual_g), format!("{:.2}", cell.error_g)]
        })
        .collect();
    let (worst, same) = (&diagnosis.residual_map.worst, &diagnosis.residual_map.same_in);
    vec![
        Block::Heading("Residual of the base model".into()),
        Block::Table(cells(["height, m", "phase", "residual, g", "standard error, g"]), rows),
        Block::Text(format!(
            "Largest residual in standard errors: from {} m, {:.1} ms after first touch, at {:.1} mm and {:.2} m/s, {:.1} g measured and {:.1} g in the model. \
             Cosine between the residuals of neighbouring heights: {:.2} by time, {:.2} by displacement, {:.2} by speed.",
            worst.height_m, worst.t_ms, worst.x_mm, worst.v_m_s, worst.measured_g, worst.model_g, same.t, same.x, same.v
        )),
    ]
}

fn ranking(diagnosis: &Diagnosis) -> Vec<Block> {
    let rows = diagnosis
        .ranking
        .iter()
        .map(|one| {
            let score = if one.score.is_finite() { format!("{:.1}", one.score) } else { "-".into() };
            let steady = one.constancy.as_ref().map_or("-".into(), |constancy| format!("{:.2e}", constancy.p));
            vec![
                one.id.clone(),
                score,
                one.left_out_g.map_or("-".into(), |gap| format!("{gap:.2}")),
                steady,
                one.reason_rejected.clone().unwrap_or_else(|| "chosen".into()),
            ]
        })
        .collect();
    vec![
        Block::Heading("Every candidate".into()),
        Block::Text(format!(
            "Score: whitened sum of squares and 5 for each parameter; the base model has {:.1}, of {} numbers compared. Left out: gap of each height, predicted from the others. Constancy: p-value of the parameters' differences between heights.",
            diagnosis.base.fitted.chi2(),
            diagnosis.base_points.len()
        )),
        Block::Table(cells(["effects", "score", "left out, g", "constancy, p", "why not"]), rows),
    ]
}

fn estimates(diagnosis: &Diagnosis) -> Vec<Block> {
    let rows = diagnosis
        .estimates
        .iter()
        .map(|one| {
            let [low, high] = one.ci95;
            let bound = if one.at_bound { " (at its bound)" } else { "" };
            vec![
                format!("{}.{}", one.effect, one.key),
                format!("{}{bound}", significant(one.value, PARAMETER_DIGITS)),
                one.unit.into(),
                format!("{} to {}", significant(low, PARAMETER_DIGITS), significant(high, PARAMETER_DIGITS)),
            ]
        })
        .chain(held_rows(diagnosis).into_iter().map(|[name, value, why]| vec![name, value, String::new(), why]))
        .collect();
    let mut lines = Vec::new();
    for i in 0..diagnosis.correlations.nrows() {
        for j in 0..i {
            let r = diagnosis.correlations[(i, j)];
            if r.abs() > 0.8 {
                lines.push(format!("{} and {} are correlated: {r:.2}.", diagnosis.estimates[i].key, diagnosis.estimates[j].key));
            }
        }
    }
    let mut blocks = vec![Block::Heading("The model after".into()), Block::Table(cells(["parameter", "value", "unit", "95 %"]), rows)];
    if !lines.is_empty() {
        blocks.push(Block::List(lines));
    }
    blocks
}

fn residual(diagnosis: &Diagnosis) -> Vec<Block> {
    let [sum, effect, local] = diagnosis.adequacy.single_p.map(p_value);
    let mut blocks = vec![
        Block::Heading("Is the residual within trial variation?".into()),
        Block::Text(format!(
            "p-value of the residual after, from bootstrap replicates: p = {} (sum of squares {sum}, an effect {effect}, a local deviation {local}). Before: p = {}.",
            p_value(diagnosis.adequacy.p),
            p_value(diagnosis.base_adequacy.p)
        )),
    ];
    if !diagnosis.residual_force.is_empty() {
        let rows = diagnosis
            .residual_force
            .iter()
            .filter(|cell| cell.force_n.abs() > 2.0 * cell.error_n)
            .map(|cell| {
                vec![
                    format!("{:.1}", cell.x_mm),
                    format!("{:.2}", cell.v_m_s),
                    format!("{:.1} ± {:.1}", cell.force_n, cell.error_n),
                    cell.samples.to_string(),
                ]
            })
            .collect();
        blocks.push(Block::Text(
            "The residual as a force over displacement and speed; cells of less than two standard errors are not shown.".into(),
        ));
        blocks.push(Block::Table(cells(["x, mm", "v, m/s", "force, N", "samples"]), rows));
    }
    blocks
}

fn next(diagnosis: &Diagnosis) -> Vec<Block> {
    let Some(first) = diagnosis.experiments.first() else { return Vec::new() };
    let rows = diagnosis.experiments.iter().take(6).map(|one| vec![one.what.clone(), format!("{:.1}", one.discrimination)]).collect();
    vec![
        Block::Heading("The next experiment".into()),
        Block::Text(format!(
            "To distinguish {} from {}: {}. Squared distance as they are fitted, in units of the drops' errors: at most {:.1}; below 10 it would decide nothing.",
            first.between[0], first.between[1], first.what, first.discrimination
        )),
        Block::Table(cells(["experiment", "discrimination"]), rows),
    ]
}
