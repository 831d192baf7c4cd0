//! Confounding: covariates that change together with the drop height, so that the drops cannot separate their effects.
//!
//! A quantity explains the height as far as its values do in a linear regression (names: as the means of their groups do), less what
//! as many random values would explain. Where no session is stated, the sensor's zero speaks: when it moved from height to height, so
//! did mounting, day or both.

use std::collections::BTreeMap;

use super::moved_zero::{HeightZeros, moved_zero_p};
use super::search::RARE;
use crate::impact::fit::Chosen;
use crate::impact::measured::{Drop, Record, Session, decimal, mean_in_fall};

/// A quantity that explains more of the height than this is confounded with it.
const MOST: f64 = 0.5;
/// Numbers with fewer different values than a drop in so many are names.
const PER_NAME: usize = 4;
/// Which axis points along the fall.
const AXIAL: usize = 2;
/// Axes that are asked.
const AXES: f64 = 3.0;
/// What a falling sensor reads of drag at the most, over the last four fifths of its fall, g a metre of height: its mean is 0.827 β h, and β is
/// 0.2 1/m at the most for a body of this size and mass.
const MOST_DRAG_G_M: f64 = 0.827 * 0.2;

/// A quantity that changes together with the height.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Confounding {
    /// `session`, `mount`, or a column's name.
    pub with: String,
    /// Part of the variation of the height that it explains.
    pub share_of_height: f64,
    /// What was found, in a sentence.
    pub found: String,
}

/// Everything that is confounded with the height; `columns` are asked in addition to session and mount.
pub fn confounded(chosen: &Chosen, columns: &[String]) -> Vec<Confounding> {
    let records: Vec<&Record> = chosen.drops.iter().map(|drop| drop.record).collect();
    let mut all = Vec::new();
    if records.iter().all(|record| record.session.is_some()) {
        all.extend(of_column("session", &records, |record| record.session.clone()));
    } else {
        all.extend(of_zeros(chosen));
    }
    all.extend(columns.iter().filter_map(|name| of_column(name, &records, |record| record.column(name).map(String::from))));
    all
}

fn of_column(name: &str, records: &[&Record], text: impl Fn(&Record) -> Option<String>) -> Option<Confounding> {
    let known: Vec<(String, f64)> = records.iter().filter_map(|record| Some((text(record)?, record.height_m))).collect();
    let mut groups: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    known.iter().for_each(|(text, height_m)| groups.entry(text).or_default().push(*height_m));
    let numbers: Option<Vec<f64>> = known.iter().map(|(text, _)| decimal(text)).collect();
    let share_of_height = match numbers.filter(|_| PER_NAME * groups.len() > known.len()) {
        Some(numbers) => share_of_numbers(&numbers, &known)?,
        None => share_of_groups(&groups, known.len())?,
    };
    if share_of_height <= MOST {
        return None;
    }
    let apart = groups.values().all(|heights| heights.iter().all(|height_m| *height_m == heights[0]));
    let found = if apart && PER_NAME * groups.len() <= known.len() {
        format!("no {name} has drops from two heights: what differs between heights and between {name}s cannot be told apart")
    } else {
        format!(
            "{name} explains {:.0} % of the drop height: what it does and what the height does can hardly be told apart",
            1e2 * share_of_height
        )
    };
    Some(Confounding { with: name.into(), share_of_height, found })
}

/// One minus the variance about a line, or the means of groups, over that about the mean, each by its degrees of freedom.
fn share(left: f64, whole: f64, count: usize, parameters: usize) -> Option<f64> {
    let free = count.checked_sub(parameters + 1).filter(|free| *free > 0)?;
    (whole > 0.0).then(|| 1.0 - left / free as f64 / (whole / (count as f64 - 1.0)))
}

fn sum_of_squares(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    values.iter().map(|value| (value - mean).powi(2)).sum()
}

fn share_of_numbers(numbers: &[f64], known: &[(String, f64)]) -> Option<f64> {
    let heights: Vec<f64> = known.iter().map(|(_, height_m)| *height_m).collect();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (a, b) = (mean(numbers), mean(&heights));
    let product: f64 = numbers.iter().zip(&heights).map(|(number, height)| (number - a) * (height - b)).sum();
    let (own, whole) = (sum_of_squares(numbers), sum_of_squares(&heights));
    if own <= 0.0 {
        return None;
    }
    share(whole - product * product / own, whole, known.len(), 1)
}

fn share_of_groups(groups: &BTreeMap<&str, Vec<f64>>, count: usize) -> Option<f64> {
    let all: Vec<f64> = groups.values().flatten().copied().collect();
    let left = groups.values().map(|heights| sum_of_squares(heights)).sum();
    share(left, sum_of_squares(&all), count, groups.len().checked_sub(1)?)
}

/// The sensor's zero from height to height, where no session is stated. Along the axis a falling sensor also reads the drag of the air, which goes as
/// the height does: what such a line explains is no change of zero.
fn of_zeros(chosen: &Chosen) -> Option<Confounding> {
    let mut by_height: BTreeMap<u64, Vec<&Drop>> = BTreeMap::new();
    chosen.drops.iter().for_each(|drop| by_height.entry(drop.record.height_m.to_bits()).or_default().push(drop));
    let of_height = |axis: usize, drops: &[&Drop]| HeightZeros {
        height_m: drops[0].record.height_m,
        zeros_g: drops.iter().filter_map(|drop| mean_in_fall(drop.record, drop.impact.as_ref()?, axis)).collect(),
    };
    let zeros = |axis: usize| -> Vec<HeightZeros> { by_height.values().map(|drops| of_height(axis, drops)).collect() };
    let moved = |axis: usize| moved_zero_p(&zeros(axis), if axis == AXIAL { MOST_DRAG_G_M } else { 0.0 }).map(|p| (axis, AXES * p));
    let (axis, p) = (0..3).filter_map(moved).min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, p)| *p < RARE)?;
    let told = |drops: &Vec<&Drop>| Some(format!("{:.2} g in {}", of_height(axis, drops).median_g()?, Session::name_of(drops[0].record)));
    let each: Vec<String> = by_height.values().filter_map(told).collect();
    let found = format!(
        "no session is stated, and the zero of {} moved from height to height ({}; p = {p:.3}): each height is a session, a day or a mounting of \
         its own, and what these do cannot be told from what the height does",
        ["x", "y", "z"][axis],
        each.join(", "),
    );
    Some(Confounding { with: "mount".into(), share_of_height: 1.0, found })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn records(of: &[(f64, &str)]) -> Vec<Record> {
        let record = |(at, (height_m, session)): (usize, &(f64, &str))| Record {
            trial: at.to_string(),
            height_m: *height_m,
            frame: None,
            session: Some((*session).into()),
            source: String::new(),
            t_s: vec![0.0],
            accel_g: vec![0.0],
            axes_g: None,
            columns: BTreeMap::new(),
            at_full_scale: Vec::new(),
        };
        of.iter().enumerate().map(record).collect()
    }

    fn found(of: &[(f64, &str)]) -> Option<Confounding> {
        let all = records(of);
        of_column("session", &all.iter().collect::<Vec<_>>(), |record| record.session.clone())
    }

    #[test]
    fn analytic_a_session_for_each_height_is_confounded_and_a_mixed_one_is_not() {
        let apart: Vec<(f64, &str)> = (0..24).map(|i| if i < 12 { (0.5, "mon") } else { (1.5, "tue") }).collect();
        let one = found(&apart).expect("it is");
        assert!((one.share_of_height - 1.0).abs() < 1e-12 && one.found.starts_with("no session has drops from two"), "{one:?}");
        let mixed: Vec<(f64, &str)> = (0..24).map(|i| (if i % 2 == 0 { 0.5 } else { 1.5 }, if i < 12 { "mon" } else { "tue" })).collect();
        assert_eq!(found(&mixed), None);
        // A name for each drop explains the height no better than random ones.
        let names: Vec<String> = (0..24).map(|i| format!("d{i}")).collect();
        let each: Vec<(f64, &str)> = names.iter().enumerate().map(|(i, name)| (if i < 12 { 0.5 } else { 1.5 }, name.as_str())).collect();
        assert_eq!(found(&each), None);
    }

    #[test]
    fn analytic_numbers_that_rise_with_the_height_are_confounded() {
        let warm: Vec<String> = (0..24).map(|i| format!("{}", 20.0 + 0.1 * f64::from(i))).collect();
        let rising: Vec<(f64, &str)> = warm.iter().enumerate().map(|(i, text)| (0.5 + 0.5 * (i / 8) as f64, text.as_str())).collect();
        assert!(found(&rising).is_some_and(|one| one.share_of_height > 0.8));
        let turned: Vec<(f64, &str)> = warm.iter().enumerate().map(|(i, text)| (0.5 + 0.5 * (i % 3) as f64, text.as_str())).collect();
        assert_eq!(found(&turned), None);
    }
}
