//! The reading with which an impact begins, where others before it are above the trigger, too.
//!
//! A hand jerks the frame as it lets go, and a logger has readings that stand alone. Both have less impulse than the impact, and the fall before the
//! impact lasts as the height says. An impact that a stalled clock cut off has as little, but the fall is before it: what follows is the rebound.
//!
//! *When it is wrong:* where the release is not recorded, or the height is not the stated one; the first reading above the trigger is then taken.

use std::ops::Range;

use super::fall_begin::fall_begin;
use super::fall_length::fall_in_air_s;
use super::impact::{TOUCH_S, TRIGGER_G};
use super::record::Record;

/// Readings above the trigger belong to one hit while there are no longer pauses, s: the feet of a sloped landing touch within it.
const PAUSE_S: f64 = 0.015;
/// How far a fall may be from that of the height, s, and as a share of it: the hand's release, and the height itself.
const NEAR_S: f64 = 0.015;
const NEAR: f64 = 0.05;

/// The first reading of the impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FirstHit {
    /// Its sample.
    pub sample: usize,
    /// The first sample above the trigger that is not of the impact.
    pub passed_over: Option<usize>,
}

impl FirstHit {
    /// `None` when no reading is above the trigger.
    pub fn of(record: &Record) -> Option<Self> {
        let hits = hits(record);
        let first = hits.first()?.start;
        let impulses: Vec<f64> = hits.iter().map(|hit| impulse(record, hit)).collect();
        let hardest = (0..hits.len()).max_by(|a, b| impulses[*a].total_cmp(&impulses[*b]).then(b.cmp(a)))?;
        let is_passed = hardest > 0 && is_behind_the_fall(record, &hits[..hardest], hits[hardest].start);
        let sample = if is_passed { hits[hardest].start } else { first };
        Some(Self { sample, passed_over: is_passed.then_some(first) })
    }
}

/// Samples above the trigger, with what lies between those that follow each other at once.
fn hits(record: &Record) -> Vec<Range<usize>> {
    let mut hits: Vec<Range<usize>> = Vec::new();
    for sample in (0..record.len()).filter(|sample| record.size_g(*sample) > TRIGGER_G) {
        match hits.last_mut().filter(|hit| record.t_s[sample] - record.t_s[hit.end - 1] <= PAUSE_S) {
            Some(hit) => hit.end = sample + 1,
            None => hits.push(sample..sample + 1),
        }
    }
    hits
}

/// Sum of the magnitudes, which at one rate is in proportion to the impulse.
fn impulse(record: &Record, hit: &Range<usize>) -> f64 {
    hit.clone().map(|sample| record.size_g(sample)).sum()
}

/// Whether the fall before a hit lasts as the height says, and better so than the fall before any of those that came earlier.
fn is_behind_the_fall(record: &Record, earlier: &[Range<usize>], hit: usize) -> bool {
    let (begin, is_seen) = fall_begin(record, hit.saturating_sub(record.samples_in(TOUCH_S).max(2)));
    let expected_s = fall_in_air_s(record.height_m);
    let off_s = |sample: usize| (record.t_s[sample] - record.t_s[begin] - expected_s).abs();
    is_seen && off_s(hit) < NEAR_S + NEAR * expected_s && earlier.iter().all(|early| off_s(hit) < off_s(early.start))
}

#[cfg(test)]
mod tests {
    use super::super::impact::Impact;
    use super::super::{FileFormat, read_bytes};
    use super::*;

    /// Held for 150 ms, a fall from half a metre that begins then, a hit of 10 ms behind it and a rebound; some readings, ms and g, are others.
    fn record(others: &[(u32, f64)]) -> Record {
        let hit = |ms: u32, from: u32, peak_g: f64| {
            (from..from + 10).contains(&ms).then(|| peak_g * libm::sin(0.1 * std::f64::consts::PI * (f64::from(ms - from) + 0.5)))
        };
        let reading = |ms: u32| {
            let other = others.iter().find(|(at, _)| *at == ms).map(|(_, reading_g)| *reading_g);
            let held = if ms < 150 { 1.0 } else { 0.05 };
            other.or_else(|| hit(ms, 470, 60.0)).or_else(|| hit(ms, 670, 12.0)).unwrap_or(held)
        };
        let rows: String = (0..900).map(|ms| format!("1,0.5,{},{}\n", f64::from(ms) * 1e-3, reading(ms))).collect();
        let set =
            read_bytes(&[("a.csv".into(), format!("trial,height_m,t_s,accel_g\n{rows}").into())], &FileFormat::default()).expect("reads");
        set.records().next().expect("is one").clone()
    }

    fn first(others: &[(u32, f64)]) -> FirstHit {
        FirstHit::of(&record(others)).expect("there is a hit")
    }

    /// Whether the fall lasts 319 ms, within the few readings from which its begin is taken.
    fn is_whole(impact: &Impact) -> bool {
        impact.fall_s.is_some_and(|fall_s| (fall_s - 0.319).abs() < 0.003)
    }

    #[test]
    fn planted_readings_alone_in_the_fall_are_no_impact() {
        for reading_g in [3.5, -8.0, 30.0, 200.0] {
            for at in [20, 149, 200, 300, 450] {
                assert_eq!(first(&[(at, reading_g)]), FirstHit { sample: 470, passed_over: Some(at as usize) }, "{reading_g} at {at}");
                let impact = Impact::of(&record(&[(at, reading_g)])).expect("there is one");
                assert_eq!(impact.trigger, 469);
                assert!(is_whole(&impact), "{reading_g} at {at}: {:?}", impact.fall_s);
            }
        }
        // A weaker one shortens no fall.
        assert!(is_whole(&Impact::of(&record(&[(300, 2.9)])).expect("there is one")));
        assert_eq!(first(&[]), FirstHit { sample: 470, passed_over: None });
    }

    #[test]
    fn planted_a_jerk_at_the_release_is_no_impact() {
        let jerk: Vec<(u32, f64)> = (140..150).map(|ms| (ms, 12.0)).collect();
        assert_eq!(first(&jerk), FirstHit { sample: 470, passed_over: Some(140) });
    }

    #[test]
    fn planted_an_impact_that_a_stalled_clock_cut_off_is_not_passed_over() {
        // What is left of the hit is one reading, or three; the rebound has the larger impulse.
        for left in [1, 3] {
            let cut: Vec<(u32, f64)> = (470..480).map(|ms| (ms, if ms < 470 + left { 25.0 } else { 0.05 })).collect();
            assert_eq!(first(&cut), FirstHit { sample: 470, passed_over: None }, "{left}");
        }
    }

    #[test]
    fn planted_a_first_touch_of_a_sloped_landing_is_of_the_impact() {
        assert_eq!(first(&[(460, 6.0)]), FirstHit { sample: 460, passed_over: None });
    }

    #[test]
    fn analytic_without_a_release_the_first_reading_above_the_trigger_is_taken() {
        let mut late = record(&[(300, 30.0)]);
        late.t_s.drain(..200);
        late.accel_g.drain(..200);
        assert_eq!(FirstHit::of(&late), Some(FirstHit { sample: 100, passed_over: None }));
    }
}
