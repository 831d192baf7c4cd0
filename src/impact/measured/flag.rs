//! What is wrong with a record that reads.

use std::ops::RangeInclusive;

use super::clock_sign::ClockSign;
use super::impact::{Impact, TRIGGER_G, WINDOW_S};
use super::record::Record;

/// Samples a second with which an impact can be compared with a model.
const RATES_HZ: RangeInclusive<f64> = 399.0..=201_000.0;
/// A gap is longer than so many steps.
pub(super) const GAP_STEPS: f64 = 1.5;
/// Fewest samples before the trigger.
const FEWEST_BEFORE: usize = 3;
/// Shortest duration of a record after the trigger, s.
const LEAST_AFTER_S: f64 = 0.02;
/// Equal samples in a row, at the top of the impact, that count as clipping: at least so many, and so long, s.
const FLAT: usize = 3;
const FLAT_S: f64 = 0.0015;
/// Impulse over v0 that a vertical drop can have: 1 without, 2 with full restitution, and room for variation.
pub(super) const IMPULSE_OVER_V0: RangeInclusive<f64> = 0.8..=1.8;

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
    #[error("double hit: the peak comes {to_peak_ms:.0} ms after the trigger, later than 25 ms")]
    DoubleHit {
        /// When.
        to_peak_ms: f64,
    },
    /// The converter was at its end, or the top is clipped.
    #[error("saturation: {samples} samples at {level_g:.1} g")]
    Saturated {
        /// How many.
        samples: usize,
        /// Where.
        level_g: f64,
    },
    /// More, or less, than a fall from the stated height can give.
    #[error("impossible impulse: {over_v0:.2} v0, a vertical drop gives {} to {}", IMPULSE_OVER_V0.start(), IMPULSE_OVER_V0.end())]
    Impulse {
        /// Over v0.
        over_v0: f64,
    },
    /// It begins or ends in the impact.
    #[error("too short: {before} samples before the trigger and {after_ms:.0} ms after it, 3 and 20 ms are needed")]
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
    if impact.trigger + 1 < FEWEST_BEFORE || after_s < LEAST_AFTER_S {
        flags.push(Flag::TooShort { before: impact.trigger, after_ms: after_s * 1e3 });
    }
    if !stalled && impact.to_peak_s > WINDOW_S + 1e-6 {
        flags.push(Flag::DoubleHit { to_peak_ms: impact.to_peak_s * 1e3 });
    }
    flags.extend(saturation(record, impact));
    let over_v0 = impact.impulse_over_v0(record.height_m);
    if !stalled && !IMPULSE_OVER_V0.contains(&over_v0) {
        flags.push(Flag::Impulse { over_v0 });
    }
    if stalled {
        flags.push(Flag::ClockStall { signs });
    }
    flags
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
    if record.at_full_scale > 0 {
        return Some(Flag::Saturated { samples: record.at_full_scale, level_g: impact.peak_axial_g });
    }
    let level_g = window.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let (mut run, mut longest) = (0, 0);
    for accel_g in window {
        run = if *accel_g == level_g { run + 1 } else { 0 };
        longest = longest.max(run);
    }
    (longest >= FLAT.max(record.samples_in(FLAT_S)) && level_g > TRIGGER_G).then_some(Flag::Saturated { samples: longest, level_g })
}
