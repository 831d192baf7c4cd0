//! Drops of one height that were sampled at different rates: their waves have no common mean.

use std::fmt;

use super::record::{DropGroup, DropSet, Record};
use super::spread::Spread;

/// Steps between samples that differ by less are of one rate.
const ONE_RATE: f64 = 1e-2;

/// The time between the samples of most drops of a height, s; of two rates that are equally common, the faster one.
pub fn usual_step_s<'a>(records: impl IntoIterator<Item = &'a Record>) -> Option<f64> {
    let mut steps: Vec<f64> = records.into_iter().filter_map(Record::step_s).collect();
    steps.sort_by(f64::total_cmp);
    let alike = |from: usize| from..steps.partition_point(|step_s| *step_s <= (1.0 + ONE_RATE) * steps[from]);
    // The last of equal ones is the largest for `max_by_key`, so that the fastest comes last.
    let most = (0..steps.len()).rev().map(alike).max_by_key(ExactSizeIterator::len)?;
    Spread::of(steps[most].iter().copied()).map(|spread| spread.median)
}

/// Whether a record's samples are as far apart as those of most drops of its height, s.
pub fn is_sampled_every(record: &Record, usual_s: f64) -> bool {
    record.step_s().is_none_or(|own_s| (own_s / usual_s - 1.0).abs() <= ONE_RATE)
}

/// Drops of a height beside those of its usual rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MixedRates {
    height_m: f64,
    /// Drops at another rate, and the rate of the first one, Hz.
    others: usize,
    other_hz: f64,
    /// All drops, and the rate of most, Hz.
    drops: usize,
    usual_hz: f64,
}

impl MixedRates {
    /// Of each height from which drops have several rates.
    pub fn all(set: &DropSet) -> Vec<Self> {
        set.groups.iter().filter_map(Self::of).collect()
    }

    fn of(group: &DropGroup) -> Option<Self> {
        let usual_s = usual_step_s(&group.records)?;
        let others = || group.records.iter().filter(|record| !is_sampled_every(record, usual_s));
        let other_hz = 1.0 / others().next()?.step_s()?;
        Some(Self { height_m: group.height_m, others: others().count(), other_hz, drops: group.records.len(), usual_hz: 1.0 / usual_s })
    }
}

impl fmt::Display for MixedRates {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { height_m, others, other_hz, drops, usual_hz } = self;
        let are = if *others == 1 { "is" } else { "are" };
        write!(
            f,
            "{others} of {drops} drops from {height_m} m {are} sampled at another rate, {other_hz:.0} Hz instead of {usual_hz:.0} Hz: fits leave \
             them out. Give drops of one rate, or --rate HZ where the stamps are wrong"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::{FileFormat, read_bytes};
    use super::*;

    /// Drops from half a metre, each sampled at so many Hz.
    fn set(rates_hz: &[f64]) -> DropSet {
        let row = |trial: usize, at: u32, rate_hz: f64| format!("{trial},0.5,{},{trial}e-6\n", f64::from(at) / rate_hz);
        let rows: String = rates_hz.iter().enumerate().flat_map(|(trial, hz)| (0..50).map(move |at| row(trial, at, *hz))).collect();
        read_bytes(&[("a.csv".into(), format!("trial,height_m,t_s,accel_g\n{rows}").into())], &FileFormat::default()).expect("reads")
    }

    #[test]
    fn planted_drops_at_another_rate_are_told() {
        let said = |rates_hz: &[f64]| set(rates_hz).notes.join("\n");
        assert_eq!(said(&[1000.0, 1001.0, 999.0]), "");
        let minority = said(&[1000.0, 1000.0, 500.0, 1000.0]);
        assert!(minority.starts_with("1 of 4 drops from 0.5 m is sampled at another rate, 500 Hz instead of 1000 Hz"), "{minority}");
        let half = said(&[800.0, 800.0, 1600.0, 1600.0]);
        assert!(half.contains("2 of 4 drops from 0.5 m are sampled at another rate, 800 Hz instead of 1600 Hz"), "{half}");
    }

    #[test]
    fn analytic_the_usual_step_is_that_of_most_drops() {
        let step_ms = |rates_hz: &[f64]| usual_step_s(set(rates_hz).records()).map(|step_s| (1e6 * step_s).round() * 1e-3);
        assert_eq!(step_ms(&[1000.0, 500.0, 500.0]), Some(2.0));
        assert_eq!(step_ms(&[500.0, 1000.0]), Some(1.0));
        assert_eq!(usual_step_s(&[]), None);
    }
}
