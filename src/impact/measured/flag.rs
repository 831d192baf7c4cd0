//! What is wrong with a record that reads.

use std::ops::{Range, RangeInclusive};

use super::clock_sign::ClockSign;
use super::impact::{Impact, TRIGGER_G, WINDOW_S};
use super::impact_speed_m_s;
use super::record::Record;
use crate::units::GRAVITY_M_S2;

/// Samples a second with which an impact can be compared with a model.
pub(super) const RATES_HZ: RangeInclusive<f64> = 399.0..=201_000.0;
/// A gap is longer than so many steps.
pub(super) const GAP_STEPS: f64 = 1.5;
/// Fewest samples before the trigger, which is itself below its level.
const FEWEST_BEFORE: usize = 2;
/// Shortest duration of a record after the trigger, s.
const LEAST_AFTER_S: f64 = 0.02;
/// Equal samples in a row, at the top of the impact, that count as clipping: at least so many, and so long, s.
const FLAT: usize = 3;
const FLAT_S: f64 = 0.0015;
/// Whether what passes the trigger first is weak and ends at once.
fn is_jolt(record: &Record, impact: &Impact) -> bool {
    let first = impact.trigger + 1;
    let end = (first..record.len()).find(|sample| record.size_g(*sample) <= TRIGGER_G);
    let is_weak = |end: usize| (first..end).all(|sample| record.size_g(sample) < JOLT_G);
    end.is_some_and(|end| record.t_s[end] - record.t_s[first] <= JOLT_S && is_weak(end))
}

/// Impulse over v0 that a vertical drop has at least: 1, with room for variation.
pub const LEAST_OVER_V0: f64 = 0.8;
/// What it has at the most without its weight: 2 with full restitution.
const MOST_OVER_V0: f64 = 2.0;
/// A peak that is so much later than the trigger is that of another drop, ms: a rebound from some metres has ended.
const OTHER_DROP_MS: f64 = 2e3;
/// Readings beyond the trigger that end within this, s, and stay below this, g, are no hit: choices. Hits of frames last longer, or are harder.
const JOLT_S: f64 = 0.003;
const JOLT_G: f64 = 10.0;
const JOLT: &str = ". Before the fall a reading is above 3 g, as where the frame is taken up or let go: cut the begin of the recording off";
const OTHER_DROP: &str = ". It is of another drop: a trial is one drop, so cut the recording into its drops";
/// Readings that differ by less are the same, but for the rounding of their conversion, g.
const LEAST_STEP_G: f64 = 1e-6;
/// A rounded top is as long as a parabola through what is beside it, give or take so many samples.
const ROUNDED: f64 = 1.0;

/// A reason not to trust a record.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Flag {
    /// Nothing hit.
    #[error("no impact: nothing above {TRIGGER_G} g")]
    NoImpact,
    /// The logger's clock stalled: the impact is lost, cut off or stretched in time.
    #[error("clock stall: {}", .signs.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    ClockStall {
        /// What says so.
        signs: Vec<ClockSign>,
    },
    /// The largest acceleration is not that of the first hit.
    #[error(
        "double hit: the peak comes {to_peak_ms:.0} ms after the trigger, later than 25 ms{}",
        match () {
            () if *.is_jolt => JOLT,
            () if *.to_peak_ms > OTHER_DROP_MS => OTHER_DROP,
            () => "",
        }
    )]
    DoubleHit {
        /// When.
        to_peak_ms: f64,
        /// Whether what passes the trigger first is no hit, as where the frame is taken up or let go.
        is_jolt: bool,
    },
    /// The converter was at its end, or the top is clipped.
    #[error("saturation: {samples} sample{} at {level_g:.1} g", if *samples == 1 { "" } else { "s" })]
    Saturated {
        /// How many.
        samples: usize,
        /// Where.
        level_g: f64,
    },
    /// More, or less, than a fall from the stated height can give.
    #[error("impossible impulse: {over_v0:.2} v0, a vertical drop gives {LEAST_OVER_V0} to {most:.2}")]
    Impulse {
        /// Over v0.
        over_v0: f64,
        /// Most that it can be.
        most: f64,
    },
    /// It begins or ends in the impact.
    #[error(
        "too short: {before} sample{} before the trigger and {after_ms:.0} ms after it, {FEWEST_BEFORE} and {:.0} ms are needed",
        if *.before == 1 { "" } else { "s" },
        1e3 * LEAST_AFTER_S
    )]
    TooShort {
        /// Before.
        before: usize,
        /// After.
        after_ms: f64,
    },
    /// Too few samples in an impact, or more than any logger takes.
    #[error("wrong sample rate: {rate_hz:.1} Hz, 400 Hz to 200 kHz can be compared; see --units and --rate")]
    Rate {
        /// Samples a second.
        rate_hz: f64,
    },
    /// Samples are missing.
    #[error("wrong sample rate: a gap of {gap_ms:.1} ms at {t_s} s")]
    Gap {
        /// Length.
        gap_ms: f64,
        /// Before it.
        t_s: f64,
    },
}

impl Flag {
    /// Its name in results.
    pub fn name(&self) -> &'static str {
        match self {
            Self::NoImpact => "no_impact",
            Self::ClockStall { .. } => "clock_stall",
            Self::DoubleHit { .. } => "double_hit",
            Self::Saturated { .. } => "saturation",
            Self::Impulse { .. } => "impossible_impulse",
            Self::TooShort { .. } => "too_short",
            Self::Rate { .. } | Self::Gap { .. } => "wrong_sample_rate",
        }
    }
}

/// Everything that is wrong with a record; `signs` are those of a stalled clock. What a stall explains is not flagged a second time.
pub fn flags(record: &Record, impact: Option<&Impact>, signs: Vec<ClockSign>) -> Vec<Flag> {
    let mut flags = Vec::new();
    let stalled = !signs.is_empty();
    flags.extend(clock(record).filter(|flag| !stalled || matches!(flag, Flag::Rate { .. })));
    let Some(impact) = impact else {
        flags.push(Flag::NoImpact);
        return flags;
    };
    let after_s = record.t_s.last().map_or(0.0, |last_s| last_s - record.t_s[impact.trigger]);
    if impact.trigger < FEWEST_BEFORE || after_s < LEAST_AFTER_S {
        flags.push(Flag::TooShort { before: impact.trigger, after_ms: after_s * 1e3 });
    }
    if !stalled && impact.to_peak_s > WINDOW_S + 1e-6 {
        flags.push(Flag::DoubleHit { to_peak_ms: impact.to_peak_s * 1e3, is_jolt: is_jolt(record, impact) });
    }
    flags.extend(saturation(record, impact));
    let over_v0 = impact.impulse_over_v0(record.height_m);
    let possible = impulse_over_v0(record.height_m);
    if !stalled && !possible.contains(&over_v0) {
        flags.push(Flag::Impulse { over_v0, most: *possible.end() });
    }
    if stalled {
        flags.push(Flag::ClockStall { signs });
    }
    flags
}

/// Impulse over v0 that a vertical drop from a height can have within the window: that of the impact, and of the weight meanwhile.
pub(super) fn impulse_over_v0(height_m: f64) -> RangeInclusive<f64> {
    LEAST_OVER_V0..=MOST_OVER_V0 + GRAVITY_M_S2 * WINDOW_S / impact_speed_m_s(height_m)
}

fn clock(record: &Record) -> Option<Flag> {
    let step_s = record.step_s()?;
    if !RATES_HZ.contains(&(1.0 / step_s)) {
        return Some(Flag::Rate { rate_hz: 1.0 / step_s });
    }
    let gap = record.t_s.windows(2).find(|pair| pair[1] - pair[0] > GAP_STEPS * step_s)?;
    Some(Flag::Gap { gap_ms: (gap[1] - gap[0]) * 1e3, t_s: gap[0] })
}

/// The converter's end, or one value several times in a row at the top.
fn saturation(record: &Record, impact: &Impact) -> Option<Flag> {
    let window = &record.accel_g[impact.trigger..impact.window_end];
    if !record.at_full_scale.is_empty() {
        let largest = |readings: &[f64]| readings.iter().fold(0.0_f64, |largest, reading| largest.max(reading.abs()));
        let all = record.axes_g.iter().flatten().map(|axis| largest(axis)).fold(largest(&record.accel_g), f64::max);
        return Some(Flag::Saturated { samples: record.at_full_scale.len(), level_g: all });
    }
    let level_g = window.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let (mut run, mut longest, mut end) = (0, 0, 0);
    for (at, accel_g) in window.iter().enumerate() {
        run = if *accel_g == level_g { run + 1 } else { 0 };
        if run > longest {
            (longest, end) = (run, at + 1);
        }
    }
    let is_flat = longest >= FLAT.max(record.samples_in(FLAT_S)) && level_g > TRIGGER_G;
    (is_flat && !is_rounded(window, end - longest..end)).then_some(Flag::Saturated { samples: longest, level_g })
}

/// Whether equal samples at the top are a round top in steps of the converter: a parabola through the samples beside them is as long within
/// one step of its vertex.
fn is_rounded(window: &[f64], flat: Range<usize>) -> bool {
    let beside = [flat.start.checked_sub(1), Some(flat.end)].map(|at| at.and_then(|at| window.get(at)));
    let [Some(before_g), Some(behind_g)] = beside else { return false };
    let fall_g = window[flat.start] - 0.5 * (before_g + behind_g);
    let length = (flat.len() + 1) as f64 * (step_g(window) / fall_g).sqrt();
    flat.len() as f64 <= length + ROUNDED
}

/// The converter's step, g: the least difference between two readings.
fn step_g(window: &[f64]) -> f64 {
    let mut readings = window.to_vec();
    readings.sort_by(f64::total_cmp);
    readings.windows(2).map(|pair| pair[1] - pair[0]).filter(|step_g| *step_g > LEAST_STEP_G).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::super::{FileFormat, read_bytes};
    use super::*;

    /// What is wrong with one drop from half a metre at 1 kHz, with so many samples at rest before those of a hit, and a second hit.
    fn said(before: u32, second_ms: u32, samples: u32) -> Vec<String> {
        let hit = |at: u32, from: u32| {
            (from..from + 10).contains(&at).then(|| 48.0 * libm::sin(0.1 * std::f64::consts::PI * (f64::from(at - from) + 0.5)))
        };
        let reading = |at: u32| hit(at, before).or_else(|| hit(at, before + second_ms).map(|reading| 1.2 * reading)).unwrap_or(0.0);
        let rows: String = (0..samples).map(|at| format!("1,0.5,{},{}\n", f64::from(at) * 1e-3, reading(at))).collect();
        let set =
            read_bytes(&[("a.csv".into(), format!("trial,height_m,t_s,accel_g\n{rows}").into())], &FileFormat::default()).expect("reads");
        let record = set.records().next().expect("there is one");
        flags(record, Impact::of(record).as_ref(), Vec::new()).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn analytic_as_many_samples_are_needed_as_the_message_says() {
        // The trigger is the last sample before the hit.
        assert_eq!(said(2, 1000, 60), ["too short: 1 sample before the trigger and 58 ms after it, 2 and 20 ms are needed"]);
        assert_eq!(said(3, 1000, 60), Vec::<String>::new());
    }

    #[test]
    fn planted_a_recording_of_two_drops_is_to_be_cut() {
        let [rebound, other] = [300, 3000].map(|second_ms| said(20, second_ms, 3100).join("; "));
        assert!(rebound.starts_with("double hit: the peak comes 30") && !rebound.contains("cut the recording"), "{rebound}");
        assert!(other.starts_with("double hit: the peak comes 300") && other.contains("cut the recording into its drops"), "{other}");
    }

    #[test]
    fn planted_a_jolt_before_a_fall_from_another_height_is_to_be_cut_off() {
        let reading = |at: u32| match at {
            5 => 3.5,
            300..310 => 48.0 * libm::sin(0.1 * std::f64::consts::PI * (f64::from(at - 300) + 0.5)),
            0..40 => 1.0,
            _ => 0.0,
        };
        let rows: String = (0..420).map(|at| format!("1,0.5,{},{}\n", f64::from(at) * 1e-3, reading(at))).collect();
        let set =
            read_bytes(&[("a.csv".into(), format!("trial,height_m,t_s,accel_g\n{rows}").into())], &FileFormat::default()).expect("reads");
        let record = set.records().next().expect("there is one");
        let said = flags(record, Impact::of(record).as_ref(), Vec::new()).iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
        assert!(said.starts_with("double hit: the peak comes 30") && said.contains("cut the begin of the recording off"), "{said}");
    }
}
