//! What a record shows of its clock, before it is compared with others.

use super::clock_sign::ClockSign;
use super::impact::{Impact, WINDOW_S};
use super::record::Record;

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
/// A frame that is still pushed behind the impact's window has left the ground when it has flown for so long, s, this long after the trigger at the latest.
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
    pub over_v0: f64,
    pub to_peak_s: f64,
    /// Sample of the trigger.
    pub trigger: usize,
    pub step_s: f64,
    /// Reading before a jump into free flight, g, and its time after the trigger, s.
    pub jump: Option<[f64; 2]>,
    /// Logarithm of the squared second over the squared first differences in the two windows of [`VIBRATION_S`].
    pub vibration: [Option<f64>; 2],
    /// Of a frame that is still pushed behind the impact's window.
    pub late: Option<LateFlight>,
    /// Lag-1 autocorrelation of the noise before the impact, all axes.
    pub noise: Option<f64>,
    pub stamps: Option<ClockSign>,
}

/// A frame that flies later than most.
#[derive(Clone, Copy, Debug)]
pub(super) struct LateFlight {
    /// As in [`ClockTrace::vibration`], from the moment on at which it flies.
    pub vibration: Option<f64>,
}

impl ClockTrace {
    pub fn of(record: &Record, impact: &Impact) -> Self {
        let samples = |time_s: f64| record.samples_in(time_s);
        let window = |[from_s, to_s]: [f64; 2]| smoothness(record, impact.trigger + samples(from_s), impact.trigger + samples(to_s));
        let end = impact.falling.end;
        Self {
            fall_s: impact.fall_s,
            over_v0: impact.impulse_over_v0(record.height_m),
            to_peak_s: impact.to_peak_s,
            trigger: impact.trigger,
            step_s: record.step_s().unwrap_or(STEP_S),
            jump: jump(record, impact.trigger),
            vibration: VIBRATION_S.map(window),
            late: flown(record, impact).map(|flown_s| LateFlight { vibration: window([flown_s, VIBRATION_S[1][1]]) }),
            noise: autocorrelation(record, impact.falling.start.max(end.saturating_sub(samples(NOISE_S))), end),
            stamps: stamps(record, impact),
        }
    }
}

/// When a frame that is still pushed behind the impact's window has left the ground, s after the trigger; `None` for one that flies there already.
fn flown(record: &Record, impact: &Impact) -> Option<f64> {
    let quiet = record.samples_in(FLOWN_S);
    let last = (impact.trigger + record.samples_in(LATEST_S)).min(record.len().saturating_sub(quiet));
    let flies = |at: &usize| (*at..at + quiet).all(|sample| record.size_g(sample) < FLIGHT_G);
    let at = (impact.window_end..last).find(flies).unwrap_or(last);
    (at > impact.window_end).then(|| record.t_s[at] - record.t_s[impact.trigger])
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
