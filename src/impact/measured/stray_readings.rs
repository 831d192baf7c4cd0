//! Readings above the trigger that are of no hit: a jerk as the frame is let go, and readings of a logger that stand alone.
//!
//! They have less impulse than the impact, and the fall before the impact lasts as the height says. An impact that a stalled clock cut off has as
//! little, but the fall is before it: what follows is the rebound. Behind the impact a reading is stray that stands alone and is larger than the impact's
//! largest. The line between the readings beside them takes their place, before anything else is made of the record.
//!
//! *When it is wrong:* where the release is not recorded, or the height is not the stated one, readings before the impact stay as they are. Below
//! 1 kHz none is known to stand alone, as the touch of a foot may last one reading.

use std::fmt;
use std::ops::Range;

use super::fall_begin::{HELD_G, fall_begin};
use super::fall_length::fall_in_air_s;
use super::impact::{TOUCH_S, TRIGGER_G};
use super::record::Record;
use super::spread::Spread;

/// Readings above the trigger belong to one hit while there are no longer pauses, s: the feet of a sloped landing touch within it.
const PAUSE_S: f64 = 0.015;
/// Beside a reading that stands alone none is above this, g, so long on both sides, s, and for so many readings: the touch of a foot rings. None of the
/// 274 reference records of the paper's logger begins its hit so.
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

/// Samples above the trigger.
struct Loud {
    /// Hits, with what lies between readings that follow each other at once.
    hits: Vec<Range<usize>>,
    /// Readings that stand alone, outside of all hits.
    alone: Vec<usize>,
}

/// Takes the stray readings out of a record; what the largest one was, `None` where there are none.
pub(super) fn without_stray(record: &mut Record) -> Option<StrayReading> {
    let Loud { hits, alone } = Loud::of(record);
    let sums = hits.iter().map(|hit| hit.clone().map(|sample| record.size_g(sample)).sum::<f64>());
    // At one rate the sum of magnitudes is in proportion to the impulse.
    let (main, _) = sums.enumerate().max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))?;
    if main == 0 && alone.is_empty() {
        return None;
    }
    let impact = hits[main].clone();
    let singles =
        |is_early: bool| alone.iter().filter(move |sample| (**sample < impact.start) == is_early).map(|sample| *sample..*sample + 1);
    let early: Vec<Range<usize>> = hits[..main].iter().cloned().chain(singles(true)).collect();
    let fall = Fall::before(&bridged(record, &early), impact.start);
    let mut stray: Vec<Range<usize>> = Vec::new();
    if early.iter().all(|hit| lasts_s(record, hit) <= JERK_S) && fall.is_that_of(record, &hits[..main], &alone) {
        stray.extend(early);
    }
    // Of a record that begins in the fall, the impact is the hardest hit, too.
    if fall.is_begun || fall.is_of_height() {
        let largest_g = impact.clone().map(|sample| record.size_g(sample)).fold(0.0, f64::max);
        stray.extend(singles(false).filter(|sample| record.size_g(sample.start) > largest_g));
    }
    let largest = stray.iter().flat_map(Clone::clone).max_by(|a, b| record.size_g(*a).total_cmp(&record.size_g(*b)))?;
    let before_s = record.t_s[impact.start] - record.t_s[largest];
    let found = StrayReading { trial: record.trial.clone(), reading_g: record.size_g(largest), before_s };
    *record = bridged(record, &stray);
    Some(found)
}

impl Loud {
    fn of(record: &Record) -> Self {
        let is_fine = record.step_s().is_some_and(|step_s| step_s < COARSE_S);
        let around = is_fine.then(|| record.samples_in(STILL_S).max(STILL));
        let (mut hits, mut alone): (Vec<Range<usize>>, Vec<usize>) = Default::default();
        for sample in (0..record.len()).filter(|sample| record.size_g(*sample) > TRIGGER_G) {
            if around.is_some_and(|around| stands_alone(record, sample, around)) {
                alone.push(sample);
                continue;
            }
            match hits.last_mut().filter(|hit| record.t_s[sample] - record.t_s[hit.end - 1] <= PAUSE_S) {
                Some(hit) => hit.end = sample + 1,
                None => hits.push(sample..sample + 1),
            }
        }
        // One between two touches of a landing is within the hit.
        let is_within = |sample: usize| {
            let next = hits.partition_point(|hit| hit.end <= sample);
            hits.get(next).is_some_and(|hit| hit.contains(&sample))
        };
        alone.retain(|sample| !is_within(*sample));
        Self { hits, alone }
    }
}

/// Whether so many readings on both sides of one are those of a fall, or of a frame that is held.
fn stands_alone(record: &Record, sample: usize, around: usize) -> bool {
    let mut beside = sample.saturating_sub(around)..(sample + around + 1).min(record.len());
    beside.all(|other| other == sample || record.size_g(other) < STILL_G)
}

fn lasts_s(record: &Record, hit: &Range<usize>) -> f64 {
    record.t_s[hit.end - 1] - record.t_s[hit.start]
}

/// The fall before a hit.
struct Fall {
    hit: usize,
    begin_s: f64,
    hit_s: f64,
    expected_s: f64,
    /// Whether its begin is recorded.
    is_seen: bool,
    /// Whether the record begins in it.
    is_begun: bool,
}

impl Fall {
    fn before(record: &Record, hit: usize) -> Self {
        let end = hit.saturating_sub(record.samples_in(TOUCH_S).max(2));
        let (begin, is_seen) = fall_begin(record, end);
        let (begin_s, hit_s) = (record.t_s[begin], record.t_s[hit]);
        let all = Spread::of((0..end).map(|sample| record.size_g(sample)));
        let is_begun = !is_seen && all.is_some_and(|all| all.q3 < HELD_G);
        Self { hit, begin_s, hit_s, expected_s: fall_in_air_s(record.height_m), is_seen, is_begun }
    }

    /// How far a fall until a time is from that of the height, s.
    fn off_s(&self, until_s: f64) -> f64 {
        (until_s - self.begin_s - self.expected_s).abs()
    }

    /// Whether it lasts as the height says.
    fn is_of_height(&self) -> bool {
        self.is_seen && self.off_s(self.hit_s) < NEAR_S + NEAR * self.expected_s
    }

    /// The same, and better than the fall until any hit before, or any reading that stands alone before, but for those so shortly before the hit
    /// that the fall of either is that of the height.
    fn is_that_of(&self, record: &Record, earlier: &[Range<usize>], alone: &[usize]) -> bool {
        let is_farther = |sample: usize| self.off_s(self.hit_s) < self.off_s(record.t_s[sample]);
        let singles = alone.iter().filter(|sample| **sample < self.hit && self.hit_s - record.t_s[**sample] > PAUSE_S);
        self.is_of_height() && earlier.iter().map(|hit| hit.start).chain(singles.copied()).all(is_farther)
    }
}

/// The record with the line between the readings beside some samples in place of these.
fn bridged(record: &Record, stray: &[Range<usize>]) -> Record {
    let mut record = record.clone();
    record.at_full_scale.retain(|sample| !stray.iter().any(|samples| samples.contains(sample)));
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
            "in {} of {records} drops readings above {TRIGGER_G} g are of no hit ({}{more}), but of a jerk as the frame was let go, or of the logger. The \
             line between the readings beside them takes their place",
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
        is_found_with(record, 0.003)
    }

    /// The same with a fall that differs by less than this, s.
    fn is_found_with(record: &Record, least_s: f64) -> bool {
        let impact = Impact::of(record).expect("there is one");
        let is_whole = impact.fall_s.is_some_and(|fall_s| (fall_s - 0.319).abs() < least_s);
        impact.trigger == 469 && impact.second_hit == Some(671) && impact.peak_g < 60.0 && is_whole
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
        // The fall begins somewhere in the jerk.
        assert!(is_found_with(&read(&jerk, 0).0, 0.011));
    }

    #[test]
    fn planted_an_impact_that_a_stalled_clock_cut_off_stays() {
        // What is left of the hit is one reading, or three; the rebound has the larger impulse.
        for left in [1, 3] {
            let cut = (470..480).map(|ms| (ms, if ms < 470 + left { 25.0 } else { 0.05 }));
            let jerk = (140..150).map(|ms| (ms, 12.0));
            for others in [cut.clone().collect::<Vec<_>>(), cut.chain(jerk).collect()] {
                let (record, notes) = read(&others, 0);
                assert!(record.accel_g[470] == 25.0 && notes.is_empty(), "{left}: {notes:?}");
            }
        }
    }

    #[test]
    fn planted_a_first_touch_of_a_sloped_landing_stays() {
        // It rings, and so does not stand alone; what stands alone between it and the next one is of the landing.
        let touch = [(460, 6.0), (461, 2.0), (465, 5.0)];
        for touch in [&touch[..2], &touch] {
            let (record, notes) = read(touch, 0);
            assert!(record.accel_g[460] == 6.0 && notes.is_empty(), "{notes:?}");
        }
        assert_eq!(read(&touch, 0).0.accel_g[465], 5.0);
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
        let (record, _) = read(&[(300, 30.0), (570, 200.0)], 200);
        assert_eq!(record.accel_g[100], 30.0);
        assert!(record.accel_g[370] < 1.0, "behind it the larger one is taken out all the same");
    }

    #[test]
    fn planted_a_stray_reading_at_the_end_of_the_sensor_is_no_saturation() {
        let (record, notes) = read(&[(300, 233.66)], 0);
        assert!(is_found(&record) && record.at_full_scale.is_empty(), "{notes:?}");
        assert_eq!(read(&[(474, 233.66)], 0).0.at_full_scale, [474]);
    }
}
