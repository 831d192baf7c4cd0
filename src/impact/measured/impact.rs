//! The parts of a record: free fall, impact, what comes after.

use std::ops::Range;

use super::fall_begin::fall_begin;
use super::impact_speed_m_s;
use super::record::Record;
use crate::units::GRAVITY_M_S2;

/// A reading beyond this is the impact, g.
pub const TRIGGER_G: f64 = 3.0;
/// Length of the impact, s: the paper's drops have their peak within it, or hit twice.
pub(super) const WINDOW_S: f64 = 0.025;
/// No fall is as short, s: from 2 mm. What is before the trigger is then no free fall, or its zero is off.
const LEAST_FALL_S: f64 = 0.02;
/// The last of the fall, from which the noise is estimated, s: the first may hold the release.
const NOISE_S: f64 = 0.2;
/// Fewest samples of a fall that say where zero is.
const FALLING: usize = 20;
/// Before the trigger the ground may touch already, s.
pub(super) const TOUCH_S: f64 = 0.002;
/// Before the fall begins a hand lets go, s.
const RELEASE_S: f64 = 0.1;
/// Held before that for so long at least, s.
const HELD_S: f64 = 0.1;
/// The frame has left the ground when no reading is above [`TRIGGER_G`] for this long, s.
const QUIET_S: f64 = 0.005;

/// The impact in a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Impact {
    /// Sample before the first above 3 g; contact begins here or up to one step later.
    pub trigger: usize,
    /// Largest magnitude in the whole record.
    pub peak: usize,
    /// Largest magnitude, g.
    pub peak_g: f64,
    /// Largest acceleration along the axis, g.
    pub peak_axial_g: f64,
    /// Time from trigger to peak, s.
    pub to_peak_s: f64,
    /// Samples of the 25 ms after the trigger, as far as the record goes: from the trigger to this one, which is left out.
    pub window_end: usize,
    /// Impulse along the axis within the window over the mass, m/s.
    pub impulse_m_s: f64,
    /// The same of the magnitude.
    pub impulse_magnitude_m_s: f64,
    /// First sample beyond the trigger after a pause behind the window: the frame has come down a second time.
    pub second_hit: Option<usize>,
    /// From release to second hit, s: how long the frame flew.
    pub flight_s: Option<f64>,
    /// Samples of the free fall, without the last 2 ms.
    pub falling: Range<usize>,
    /// Length of the free fall, s; `None` when the record begins in it, or readings before the impact are none of a fall.
    pub fall_s: Option<f64>,
    /// Standard deviation along the axis in free fall, g; `None` with fewer than five samples of it.
    pub noise_g: Option<f64>,
}

impl Impact {
    /// Samples of the fall without its first fifth, which may hold the release; `None` for a fall that is too short.
    pub(super) fn behind_release(&self) -> Option<Range<usize>> {
        let falling = self.falling.start + self.falling.len() / 5..self.falling.end;
        (falling.len() >= FALLING).then_some(falling)
    }

    /// Samples of the frame while it is held, before a hand lets go; `None` where the release is not recorded, or too little before it.
    pub(super) fn held(&self, record: &Record) -> Option<Range<usize>> {
        self.fall_s?;
        let held = 0..self.falling.start.checked_sub(record.samples_in(RELEASE_S))?;
        (held.len() >= record.samples_in(HELD_S)).then_some(held)
    }

    /// Finds the impact; `None` when no reading is above 3 g.
    pub fn of(record: &Record) -> Option<Self> {
        let size = |sample: usize| record.size_g(sample);
        let count = record.len();
        let first = (0..count).find(|sample| size(*sample) > TRIGGER_G)?;
        let trigger = first.saturating_sub(1);
        let peak = (trigger..count).max_by(|a, b| size(*a).total_cmp(&size(*b)).then(b.cmp(a)))?;
        let after = |s: f64| record.t_s.partition_point(|t_s| *t_s < record.t_s[trigger] + s - 1e-6);
        let window_end = after(WINDOW_S);
        let impulse = |g: &dyn Fn(usize) -> f64| {
            let steps = (trigger..window_end.min(count - 1)).map(|at| 0.5 * (g(at) + g(at + 1)) * (record.t_s[at + 1] - record.t_s[at]));
            steps.sum::<f64>() * GRAVITY_M_S2
        };
        let (release, second_hit) = second_hit(record, trigger, window_end);
        let (begin, seen) = fall_begin(record, last_of_fall(record, trigger));
        let falling = begin..last_of_fall(record, trigger).max(begin);
        let last = falling.start.max(falling.end.saturating_sub(record.samples_in(NOISE_S)))..falling.end;
        Some(Self {
            trigger,
            peak,
            peak_g: size(peak),
            peak_axial_g: record.accel_g[trigger..].iter().copied().fold(f64::NEG_INFINITY, f64::max),
            to_peak_s: record.t_s[peak] - record.t_s[trigger],
            window_end,
            impulse_m_s: impulse(&|at| record.accel_g[at]),
            impulse_magnitude_m_s: impulse(&|at| record.size_g(at)),
            second_hit,
            flight_s: second_hit.zip(release).map(|(hit, release)| record.t_s[hit] - record.t_s[release]),
            fall_s: seen.then(|| record.t_s[trigger] - record.t_s[begin]).filter(|fall_s| *fall_s > LEAST_FALL_S),
            noise_g: deviation(&record.accel_g[last]),
            falling,
        })
    }

    /// Impulse along the axis over that of the speed before.
    pub fn impulse_over_v0(&self, height_m: f64) -> f64 {
        self.impulse_m_s / impact_speed_m_s(height_m)
    }

    /// Speed after over speed before, by the impulse. Gravity's part, at most g times the 25 ms, is left in.
    pub fn restitution(&self, height_m: f64) -> f64 {
        self.impulse_over_v0(height_m) - 1.0
    }

    /// Speed after over speed before, by the time until the second hit.
    pub fn restitution_by_flight(&self, height_m: f64) -> Option<f64> {
        self.flight_s.map(|flight_s| 0.5 * GRAVITY_M_S2 * flight_s / impact_speed_m_s(height_m))
    }
}

/// The release, behind which no reading is beyond the trigger for a while, and the first one that is beyond it again.
fn second_hit(record: &Record, trigger: usize, window_end: usize) -> (Option<usize>, Option<usize>) {
    let count = record.len();
    let beyond_trigger = |sample: &usize| record.size_g(*sample) > TRIGGER_G;
    let mut last = (trigger..window_end.min(count)).rev().find(beyond_trigger).unwrap_or(trigger);
    for sample in window_end..count {
        if beyond_trigger(&sample) {
            if record.t_s[sample] - record.t_s[last] > QUIET_S {
                return (Some(last), Some(sample));
            }
            last = sample;
        }
    }
    (Some(last), None)
}

/// The sample with which the fall ends before the ground may touch.
fn last_of_fall(record: &Record, trigger: usize) -> usize {
    trigger.saturating_sub(record.samples_in(TOUCH_S).max(2))
}

/// Standard deviation of at least five values.
fn deviation(values: &[f64]) -> Option<f64> {
    let count = values.len() as f64;
    if values.len() < 5 {
        return None;
    }
    let mean = values.iter().sum::<f64>() / count;
    Some((values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (count - 1.0)).sqrt())
}
