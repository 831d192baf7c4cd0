//! Readings above the trigger that are of no hit: a jerk as the frame is let go, and readings of a logger that stand alone.
//!
//! They have less impulse than the impact, and the fall before the impact lasts as the height says. An impact that a stalled clock cut off has as
//! little, but the fall is before it: what follows is the rebound. Behind the impact a reading is stray that stands alone and is larger than the impact's
//! largest. The line between the readings beside them takes their place, before anything else is made of the record.
//!
//! *When it is wrong:* where the release is not recorded, or the height is not the stated one, readings before the impact stay as they are. Below
//! 1 kHz one that stands alone within 15 ms of the impact is taken for the touch of a foot, as a touch may last one reading.

use std::fmt;
use std::ops::Range;

use super::fall_begin::fall_begin;
use super::fall_length::fall_in_air_s;
use super::impact::{TOUCH_S, TRIGGER_G};
use super::record::Record;

/// Readings above the trigger belong to one hit while there are no longer pauses, s: the feet of a sloped landing touch within it.
const PAUSE_S: f64 = 0.015;
/// Beside a reading that stands alone none is above this, g, so long on both sides, s, and for so many readings: the touch of a foot rings. Among the
/// 250 drops of the paper's logger whose clock is good no first touch does so.
const STILL_G: f64 = 1.5;
const STILL_S: f64 = 0.002;
const STILL: usize = 2;
/// Readings farther apart do not tell a touch from one that stands alone, s.
const COARSE_S: f64 = 1.1e-3;
/// A jerk is no longer, s: what lasts is another unit or another zero of the readings.
const JERK_S: f64 = 0.03;
/// How far a fall may be from that of the height, s, and as a share of it: the hand's release, and the height itself.
const NEAR_S: f64 = 0.015;
const NEAR: f64 = 0.05;
/// Drops that are named one by one, at the most.
const NAMED: usize = 3;

/// The largest stray reading of a record.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StrayReading {
    trial: String,
    /// Magnitude, g.
    reading_g: f64,
    /// How long before the first reading of the impact, s; negative behind it.
    before_s: f64,
}

/// Takes the stray readings out of a record; what the largest one was, `None` where there are none.
pub(super) fn without_stray(record: &mut Record) -> Option<StrayReading> {
    let hits = hits(record);
    let main = main_hit(record, &hits)?;
    let early = &hits[..main];
    let impact = hits[main].clone();
    let bridged = Some(early).filter(|early| !early.is_empty()).map(|early| bridged(record, early));
    if let Some(bridged) = &bridged
        && !(early.iter().all(|hit| lasts_s(record, hit) <= JERK_S) && is_behind_the_fall(bridged, early, impact.start))
    {
        return None;
    }
    let largest_g = largest_g(record, &impact);
    let is_late = |hit: &&Range<usize>| hit.len() == 1 && record.size_g(hit.start) > largest_g;
    let stray: Vec<Range<usize>> = early.iter().chain(hits[main + 1..].iter().filter(is_late)).cloned().collect();
    let sample = stray.iter().flat_map(Clone::clone).max_by(|a, b| record.size_g(*a).total_cmp(&record.size_g(*b)))?;
    let before_s = record.t_s[impact.start] - record.t_s[sample];
    let found = StrayReading { trial: record.trial.clone(), reading_g: record.size_g(sample), before_s };
    *record = self::bridged(record, &stray);
    Some(found)
}

/// Samples above the trigger, with what lies between those that follow each other at once. One that stands alone is a hit of its own.
fn hits(record: &Record) -> Vec<Range<usize>> {
    let mut hits: Vec<Range<usize>> = Vec::new();
    let mut is_open = false;
    let is_fine = record.step_s().is_some_and(|step_s| step_s < COARSE_S);
    let around = is_fine.then(|| record.samples_in(STILL_S).max(STILL));
    for sample in (0..record.len()).filter(|sample| record.size_g(*sample) > TRIGGER_G) {
        let is_alone = around.is_some_and(|around| stands_alone(record, sample, around));
        match hits.last_mut().filter(|hit| is_open && !is_alone && record.t_s[sample] - record.t_s[hit.end - 1] <= PAUSE_S) {
            Some(hit) => hit.end = sample + 1,
            None => hits.push(sample..sample + 1),
        }
        is_open = !is_alone;
    }
    hits
}

/// Whether so many readings on both sides of one are those of a fall, or of a frame that is held.
fn stands_alone(record: &Record, sample: usize, around: usize) -> bool {
    let mut beside = sample.saturating_sub(around)..(sample + around + 1).min(record.len());
    beside.all(|other| other == sample || record.size_g(other) < STILL_G)
}

/// The hit with the largest sum of magnitudes, which at one rate is in proportion to the impulse, among those of more than one reading if there are any.
fn main_hit(record: &Record, hits: &[Range<usize>]) -> Option<usize> {
    let is_alone = |at: &usize| hits[*at].len() == 1;
    let all_alone = (0..hits.len()).all(|at| is_alone(&at));
    let sum = |at: usize| hits[at].clone().map(|sample| record.size_g(sample)).sum::<f64>();
    let candidates = (0..hits.len()).filter(|at| all_alone || !is_alone(at));
    candidates.max_by(|a, b| sum(*a).total_cmp(&sum(*b)).then(b.cmp(a)))
}

fn lasts_s(record: &Record, hit: &Range<usize>) -> f64 {
    record.t_s[hit.end - 1] - record.t_s[hit.start]
}

fn largest_g(record: &Record, hit: &Range<usize>) -> f64 {
    hit.clone().map(|sample| record.size_g(sample)).fold(0.0, f64::max)
}

/// Whether the fall before a hit lasts as the height says, and better so than the fall before any of those that came earlier, but for one that stands
/// alone so shortly before it that the fall of either is that of the height.
fn is_behind_the_fall(record: &Record, earlier: &[Range<usize>], hit: usize) -> bool {
    let (begin, is_seen) = fall_begin(record, hit.saturating_sub(record.samples_in(TOUCH_S).max(2)));
    let expected_s = fall_in_air_s(record.height_m);
    let off_s = |sample: usize| (record.t_s[sample] - record.t_s[begin] - expected_s).abs();
    let is_farther = |early: &Range<usize>| off_s(hit) < off_s(early.start) || record.t_s[hit] - record.t_s[early.start] <= PAUSE_S;
    is_seen && off_s(hit) < NEAR_S + NEAR * expected_s && earlier.iter().all(is_farther)
}

/// The record with the line between the readings beside some samples in place of these.
fn bridged(record: &Record, stray: &[Range<usize>]) -> Record {
    let mut record = record.clone();
    let axes = record.axes_g.iter_mut().flatten();
    for series in axes.chain([&mut record.accel_g]) {
        stray.iter().for_each(|samples| bridge(series, samples.clone()));
    }
    record
}

fn bridge(series: &mut [f64], samples: Range<usize>) {
    let beside = [samples.start.checked_sub(1), Some(samples.end)].map(|at| at.and_then(|at| series.get(at)).copied());
    let [before, behind] = [beside[0].or(beside[1]), beside[1].or(beside[0])].map(Option::unwrap_or_default);
    let steps = (samples.len() + 1) as f64;
    for (at, reading) in series[samples].iter_mut().enumerate() {
        *reading = before + (behind - before) * (at + 1) as f64 / steps;
    }
}

/// The stray readings of all records, in a sentence; `None` where there are none.
pub(super) fn told(stray: &[StrayReading], records: usize) -> Option<String> {
    let named: Vec<String> = stray.iter().take(NAMED).map(ToString::to_string).collect();
    let more = if stray.len() > NAMED { ", and others" } else { "" };
    (!stray.is_empty()).then(|| {
        format!(
            "in {} of {records} drops readings above {TRIGGER_G} g are of no hit ({}{more}): they are a jerk before the fall, or stand alone. The line \
             between the readings beside them takes their place",
            stray.len(),
            named.join("; ")
        )
    })
}

impl fmt::Display for StrayReading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { trial, reading_g, before_s } = self;
        let side = if *before_s < 0.0 { "behind" } else { "before" };
        write!(f, "{trial}: {reading_g:.1} g, {:.0} ms {side} the first touch", 1e3 * before_s.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::super::impact::Impact;
    use super::super::{FileFormat, read_bytes};
    use super::*;

    /// Held for 150 ms, a fall from half a metre that begins then, a hit of 10 ms behind it and a rebound; some readings, ms and g, are others.
    /// As it is read, with what is noted of it.
    fn read(others: &[(u32, f64)], begin_ms: u32) -> (Record, Vec<String>) {
        let hit = |ms: u32, from: u32, peak_g: f64| {
            (from..from + 10).contains(&ms).then(|| peak_g * libm::sin(0.1 * std::f64::consts::PI * (f64::from(ms - from) + 0.5)))
        };
        let reading = |ms: u32| {
            let other = others.iter().find(|(at, _)| *at == ms).map(|(_, reading_g)| *reading_g);
            let held = if ms < 150 { 1.0 } else { 0.05 };
            other.or_else(|| hit(ms, 470, 60.0)).or_else(|| hit(ms, 670, 12.0)).unwrap_or(held)
        };
        let rows: String = (begin_ms..900).map(|ms| format!("1,0.5,{},{}\n", f64::from(ms) * 1e-3, reading(ms))).collect();
        let set =
            read_bytes(&[("a.csv".into(), format!("trial,height_m,t_s,accel_g\n{rows}").into())], &FileFormat::default()).expect("reads");
        (set.records().next().expect("is one").clone(), set.notes.clone())
    }

    /// Whether the impact is found where it is, with its fall, as in the record without other readings.
    fn is_found(record: &Record) -> bool {
        let impact = Impact::of(record).expect("there is one");
        let is_whole = impact.fall_s.is_some_and(|fall_s| (fall_s - 0.319).abs() < 0.003);
        impact.trigger == 469 && impact.second_hit == Some(670) && impact.peak_g < 60.0 && is_whole
    }

    #[test]
    fn planted_readings_alone_before_the_impact_are_taken_out_and_told() {
        let (plain, notes) = read(&[], 0);
        assert!(is_found(&plain) && notes.is_empty(), "{notes:?}");
        for reading_g in [3.5, -8.0, 30.0, 200.0] {
            for at in [20, 149, 200, 300, 450] {
                let (record, notes) = read(&[(at, reading_g)], 0);
                assert!(is_found(&record), "{reading_g} at {at}");
                assert!(record.accel_g.iter().zip(&plain.accel_g).all(|(a, b)| (a - b).abs() < 0.5), "{reading_g} at {at}");
                let told = format!("in 1 of 1 drops readings above 3 g are of no hit (1: {:.1} g, {} ms before", reading_g.abs(), 470 - at);
                assert!(notes.iter().any(|note| note.starts_with(&told)), "{notes:?}");
            }
        }
        // A weaker one is none, and shortens no fall.
        let (record, notes) = read(&[(300, 2.9)], 0);
        assert!(is_found(&record) && record.accel_g[300] == 2.9 && notes.is_empty(), "{notes:?}");
    }

    #[test]
    fn planted_some_readings_in_a_row_in_the_fall_are_taken_out() {
        let row: Vec<(u32, f64)> = (300..305).map(|ms| (ms, 20.0)).collect();
        assert!(is_found(&read(&row, 0).0));
    }

    #[test]
    fn planted_a_larger_reading_alone_behind_the_impact_is_taken_out() {
        let (record, notes) = read(&[(570, 200.0)], 0);
        assert!(is_found(&record) && notes.iter().any(|note| note.contains("1: 200.0 g, 100 ms behind")), "{notes:?}");
        // A smaller one may be a bounce.
        let (record, notes) = read(&[(570, 20.0)], 0);
        assert!(record.accel_g[570] == 20.0 && notes.is_empty(), "{notes:?}");
    }

    #[test]
    fn planted_a_jerk_at_the_release_is_taken_out() {
        let jerk: Vec<(u32, f64)> = (140..150).map(|ms| (ms, 12.0)).collect();
        assert!(is_found(&read(&jerk, 0).0));
    }

    #[test]
    fn planted_an_impact_that_a_stalled_clock_cut_off_stays() {
        // What is left of the hit is one reading, or three; the rebound has the larger impulse.
        for left in [1, 3] {
            let cut: Vec<(u32, f64)> = (470..480).map(|ms| (ms, if ms < 470 + left { 25.0 } else { 0.05 })).collect();
            let (record, notes) = read(&cut, 0);
            assert!(record.accel_g[470] == 25.0 && notes.is_empty(), "{left}: {notes:?}");
        }
    }

    #[test]
    fn planted_a_first_touch_of_a_sloped_landing_stays() {
        // It rings, and so does not stand alone.
        let touch = [(460, 6.0), (461, 2.0)];
        assert_eq!(read(&touch, 0).0.accel_g[460], 6.0);
    }

    #[test]
    fn planted_a_reading_alone_shortly_before_the_impact_is_taken_out() {
        for at in [458, 462, 466] {
            let (record, notes) = read(&[(at, 10.0)], 0);
            assert!(is_found(&record) && notes.iter().any(|note| note.contains("of no hit")), "{at}: {notes:?}");
        }
    }

    #[test]
    fn analytic_without_a_release_readings_before_the_impact_stay() {
        assert_eq!(read(&[(300, 30.0)], 200).0.accel_g[100], 30.0);
    }
}
