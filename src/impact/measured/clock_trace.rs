//! What a record shows of its clock, before it is compared with others.

use super::clock_sign::ClockSign;
use super::impact::{Impact, WINDOW_S};
use super::impact_speed_m_s;
use super::record::Record;
use crate::units::GRAVITY_M_S2;

/// Least reading that cannot fall to free flight within one sample, g.
const JUMP_G: f64 = 8.0;
/// Free flight behind a jump: no reading above this, g, for this long, s.
const FLIGHT_G: f64 = 2.5;
const FLIGHT_S: f64 = 0.012;
/// A jump is looked for so long after the trigger, s.
const LOOKED_S: f64 = 0.040;
/// Vibration is looked at in steps of this length, s.
const STEP_S: f64 = 1e-3;
/// Vibration in and behind the impact: from and to, s after the trigger.
const VIBRATION_S: [[f64; 2]; 2] = [[0.001, 0.060], [0.025, 0.090]];
/// What lies behind an impact begins when the frame has flown for so long, s, but not later than this: a frame that lands on one foot first is pushed
/// for longer than one that lands level, and its last push is smoother than any vibration.
const FLOWN_S: f64 = 0.003;
const LATEST_S: f64 = 0.045;
/// Noise before the impact, s, and the fewest samples of it.
const NOISE_S: f64 = 0.060;
const NOISE_SAMPLES: usize = 20;
/// A gap of the stamps in usual steps, and samples that count as fast ones behind it.
const GAP_STEPS: f64 = 3.0;
const FAST: f64 = 0.75;
const FEWEST_FAST: usize = 3;

/// What a record shows of its clock.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClockTrace {
    pub fall_s: Option<f64>,
    /// Impulse along the axis over that of the speed before, within 25 ms, and of a frame that is still pushed then, until it flies.
    pub over_v0: f64,
    pub to_peak_s: f64,
    /// Sample of the trigger.
    pub trigger: usize,
    pub step_s: f64,
    /// Reading before a jump into free flight, g, and its time after the trigger, s.
    pub jump: Option<[f64; 2]>,
    /// Logarithm of the squared second over the squared first differences in the two windows of [`VIBRATION_S`], the second one once it flies.
    pub vibration: [Option<f64>; 2],
    /// Lag-1 autocorrelation of the noise before the impact, all axes.
    pub noise: Option<f64>,
    pub stamps: Option<ClockSign>,
}

impl ClockTrace {
    pub fn of(record: &Record, impact: &Impact) -> Self {
        let samples = |time_s: f64| record.samples_in(time_s);
        let window = |[from_s, to_s]: [f64; 2]| smoothness(record, impact.trigger + samples(from_s), impact.trigger + samples(to_s));
        let [in_impact, [behind_s, to_s]] = VIBRATION_S;
        let flown_s = flown(record, impact.trigger, behind_s);
        let end = impact.falling.end;
        Self {
            fall_s: impact.fall_s,
            over_v0: impulse_over_v0(record, impact, flown_s),
            to_peak_s: impact.to_peak_s,
            trigger: impact.trigger,
            step_s: record.step_s().unwrap_or(STEP_S),
            jump: jump(record, impact.trigger),
            vibration: [window(in_impact), window([flown_s, to_s])],
            noise: autocorrelation(record, impact.falling.start.max(end.saturating_sub(samples(NOISE_S))), end),
            stamps: stamps(record, impact),
        }
    }
}

/// Impulse along the axis until the frame flies over that of the speed before. Within 25 ms alone that of a steep landing is not all there, and looks
/// like one that a stall cut.
fn impulse_over_v0(record: &Record, impact: &Impact, flown_s: f64) -> f64 {
    let end = record.t_s.partition_point(|t_s| *t_s < record.t_s[impact.trigger] + flown_s - 1e-6);
    let later = (impact.window_end..end.min(record.len() - 1))
        .map(|at| 0.5 * (record.accel_g[at] + record.accel_g[at + 1]) * (record.t_s[at + 1] - record.t_s[at]));
    impact.impulse_over_v0(record.height_m) + later.sum::<f64>() * GRAVITY_M_S2 / impact_speed_m_s(record.height_m)
}

/// When a frame has left the ground, s after the trigger, and not before a time.
fn flown(record: &Record, trigger: usize, from_s: f64) -> f64 {
    let quiet = record.samples_in(FLOWN_S);
    let first = trigger + record.samples_in(from_s);
    let last = (trigger + record.samples_in(LATEST_S)).min(record.len().saturating_sub(quiet));
    let flies = |at: &usize| (*at..at + quiet).all(|sample| record.size_g(sample) < FLIGHT_G);
    (first..last).find(flies).map_or(LATEST_S, |at| record.t_s[at] - record.t_s[trigger])
}

/// A reading far from zero with free flight behind it.
fn jump(record: &Record, trigger: usize) -> Option<[f64; 2]> {
    let quiet = record.samples_in(FLIGHT_S);
    let last = (trigger + record.samples_in(LOOKED_S)).min(record.len().saturating_sub(quiet + 1));
    let flies = |at: usize| (at + 1..=at + quiet).all(|sample| record.size_g(sample) < FLIGHT_G);
    let at = (trigger + 1..last).find(|at| record.size_g(*at) >= FLIGHT_G && flies(*at))?;
    let from_g = record.size_g(at);
    (from_g > JUMP_G).then(|| [from_g, record.t_s[at] - record.t_s[trigger]])
}

/// Logarithm of the mean squared second over the mean squared first difference of all axes, in steps of about 1 ms: low where
/// vibration is slow.
fn smoothness(record: &Record, from: usize, to: usize) -> Option<f64> {
    let stride = record.samples_in(STEP_S);
    let to = to.min(record.len());
    if to < from + 20 * stride {
        return None;
    }
    let (mut first, mut second) = (0.0, 0.0);
    for axis in record.axes() {
        let means: Vec<f64> = axis[from..to].chunks_exact(stride).map(|part| part.iter().sum::<f64>() / stride as f64).collect();
        first += means.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum::<f64>();
        second += means.windows(3).map(|three| (three[2] - 2.0 * three[1] + three[0]).powi(2)).sum::<f64>();
    }
    (first > 0.0 && second > 0.0).then(|| libm::log(second / first))
}

/// Lag-1 autocorrelation of all axes.
fn autocorrelation(record: &Record, from: usize, to: usize) -> Option<f64> {
    if to < from + NOISE_SAMPLES {
        return None;
    }
    let (mut product, mut square) = (0.0, 0.0);
    for axis in record.axes() {
        let part = &axis[from..to];
        let mean = part.iter().sum::<f64>() / part.len() as f64;
        product += part.windows(2).map(|pair| (pair[0] - mean) * (pair[1] - mean)).sum::<f64>();
        square += part.iter().map(|reading| (reading - mean).powi(2)).sum::<f64>();
    }
    (square > 0.0).then(|| product / square)
}

/// A gap of the stamps near the impact with faster samples behind it.
fn stamps(record: &Record, impact: &Impact) -> Option<ClockSign> {
    let step_s = record.step_s()?;
    let steps: Vec<f64> = record.t_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let near = impact.trigger.saturating_sub(record.samples_in(0.1))..impact.window_end.min(steps.len());
    let gap = near.clone().find(|at| steps[*at] > GAP_STEPS * step_s)?;
    let fast = steps[gap + 1..].iter().take_while(|step| **step < FAST * step_s).count();
    let reaches = gap + fast + 1 >= impact.trigger || record.t_s[impact.trigger] - record.t_s[gap] < WINDOW_S;
    (fast >= FEWEST_FAST && reaches).then_some(ClockSign::Stamps { gap_ms: steps[gap] * 1e3, fast })
}
