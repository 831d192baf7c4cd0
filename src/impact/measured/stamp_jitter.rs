//! Time stamps that jitter, while the samples themselves may be evenly spaced.

use std::fmt;
use std::path::Path;

use super::file_kind::FileKind;
use super::flag::GAP_STEPS;
use super::record::{DropSet, Record};
use super::spread::Spread;

/// Around a stamp that is late, a step, that before and that behind take as long as three even ones; around a lost sample, four.
const AROUND_STEPS: f64 = 3.5;

/// By how much a rounded step is off, in steps.
const ROUNDED: f64 = 0.01;
/// Fewest gaps that show how far apart they are, and the most samples between two that come of rounding: choices.
const FEWEST_GAPS: usize = 4;
const OFTEN: usize = 50;

/// Uneven stamps in most records of tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StampJitter {
    /// Records with a gap.
    pub records: usize,
    /// Of so many.
    pub of: usize,
    /// Median of their largest steps, s.
    pub gap_s: f64,
    /// Median step, s.
    pub step_s: f64,
    /// Samples a second by the length of the records, Hz.
    pub rate_hz: f64,
}

impl StampJitter {
    /// Of all records of tables; `None` where most of them have even stamps, or lack samples.
    pub fn of(set: &DropSet) -> Option<Self> {
        let tables: Vec<&Record> =
            set.records().filter(|record| FileKind::of(Path::new(&record.source)) == Some(FileKind::Table)).collect();
        let uneven: Vec<[f64; 3]> = tables.iter().filter_map(|record| uneven(record)).collect();
        let median = |at: usize| Spread::of(uneven.iter().map(|all| all[at])).map(|spread| spread.median);
        let found = Self { records: uneven.len(), of: tables.len(), gap_s: median(0)?, step_s: median(1)?, rate_hz: median(2)? };
        (2 * found.records > found.of).then_some(found)
    }
}

/// Largest step and median step, s, and rate, Hz, of a record whose steps jitter.
fn uneven(record: &Record) -> Option<[f64; 3]> {
    let step_s = record.step_s()?;
    let gaps = || record.t_s.windows(4).filter(|stamps| stamps[2] - stamps[1] > GAP_STEPS * step_s);
    let around_s = Spread::of(gaps().map(|stamps| stamps[3] - stamps[0]))?.median;
    let largest_s = gaps().map(|stamps| stamps[2] - stamps[1]).fold(0.0, f64::max);
    let rate_hz = (record.len() - 1) as f64 / (record.t_s.last()? - record.t_s.first()?);
    (around_s < AROUND_STEPS * step_s || is_rounded(record, step_s)).then_some([largest_s, step_s, rate_hz])
}

/// Whether every so many samples a step is twice as long: stamps that are rounded to steps longer than the samples' own. Samples are lost less
/// often, or less evenly.
fn is_rounded(record: &Record, step_s: f64) -> bool {
    let steps: Vec<f64> = record.t_s.windows(2).map(|stamps| stamps[1] - stamps[0]).collect();
    let is_one_or_two = |step: &f64| [1.0, 2.0].iter().any(|count| (step / step_s - count).abs() < ROUNDED);
    let gaps: Vec<usize> = (0..steps.len()).filter(|at| steps[*at] > GAP_STEPS * step_s).collect();
    let apart: Vec<usize> = gaps.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let (Some(least), Some(most)) = (apart.iter().min(), apart.iter().max()) else { return false };
    apart.len() >= FEWEST_GAPS && *most <= OFTEN && most - least <= 1 && steps.iter().all(is_one_or_two)
}

impl fmt::Display for StampJitter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { records, of, gap_s, step_s, rate_hz } = self;
        let (gap_ms, step_ms) = (gap_s * 1e3, step_s * 1e3);
        write!(
            f,
            "the time stamps of {records} of {of} drops jitter: steps of up to {gap_ms:.2} ms, {step_ms:.2} ms are usual. If the samples are \
             evenly spaced, give the sampling rate; by the length of the records it is --rate {rate_hz:.0}"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::{FileFormat, read_bytes};
    use super::*;

    /// Five records of 200 samples at 1 kHz; every fifth stamp is late by so much, ms, and one sample may lack.
    fn set(late_ms: f64, lacks: bool) -> DropSet {
        let mut text = "trial,height_m,t_s,accel_g\n".to_string();
        for trial in 0..5 {
            for at in (0..200_u32).filter(|at| !(lacks && *at == 93)) {
                let ms = f64::from(at) + if at % 5 == 0 { late_ms } else { 0.0 };
                text += &format!("{trial},1,{:.6},0\n", ms * 1e-3);
            }
        }
        read_bytes(&[("a.csv".into(), text.into_bytes())], &FileFormat::default()).expect("reads")
    }

    #[test]
    fn planted_jitter_is_told_from_lost_samples() {
        let found = StampJitter::of(&set(0.6, false)).expect("jitters");
        assert_eq!((found.records, found.of), (5, 5));
        assert!((found.rate_hz - 1000.0).abs() < 5.0 && (found.gap_s - 1.6e-3).abs() < 1e-6, "{found:?}");
        assert_eq!(StampJitter::of(&set(0.0, false)), None);
        assert_eq!(StampJitter::of(&set(0.0, true)), None);
    }

    #[test]
    fn planted_stamps_in_whole_milliseconds_are_told_from_lost_samples() {
        let stamped = |rate_hz: f64, lost: fn(u32) -> bool| {
            let mut text = "trial,height_m,t_s,accel_g\n".to_string();
            for trial in 0..5 {
                for at in (0..400_u32).filter(|at| !lost(*at)) {
                    text += &format!("{trial},1,{:.3},0\n", (f64::from(at) * 1e3 / rate_hz).round() * 1e-3);
                }
            }
            StampJitter::of(&read_bytes(&[("a.csv".into(), text.into_bytes())], &FileFormat::default()).expect("reads"))
        };
        for rate_hz in [700.0, 800.0, 900.0, 975.0] {
            let found = stamped(rate_hz, |_| false).expect("is rounded");
            assert!((found.rate_hz / rate_hz - 1.0).abs() < 0.01, "{found:?}");
        }
        assert_eq!(stamped(1000.0, |at| at % 97 == 0), None);
        assert_eq!(stamped(1000.0, |at| [20, 33, 70, 71, 90, 180, 181, 300].contains(&at)), None);
    }
}
