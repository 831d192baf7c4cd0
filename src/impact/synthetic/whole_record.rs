//! A logger whose clock stalls, and the whole record that it writes of a drop: held, falling, impact, rebound.
//!
//! The logger wants a sample every step. At the end of a sector of its memory it stops for a while. Behind that it takes samples as
//! fast as it can until it has caught up. It stamps all of them as if nothing had happened.

use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};

use super::fine_wave::{AFTER_S, at};
use super::stalls::ROOM_S;
use super::synthetic_record::SyntheticRecord;
use super::{Plan, ReferenceTrajectory, Stalls};
use crate::units::GRAVITY_M_S2;

/// Bandwidth of the sensor's noise, Hz: what is sampled faster is correlated.
const NOISE_HZ: f64 = 500.0;
/// Its correlation time, s.
const NOISE_S: f64 = 0.5 / (std::f64::consts::PI * NOISE_HZ);
/// Relative variation of the lost time.
const LOST_VARIES: f64 = 0.1;
/// A hand lets go within, s.
const RELEASE_S: [f64; 2] = [0.002, 0.010];
/// Tremor of the hand: standard deviation, g, and correlation time, s.
const TREMOR: [f64; 2] = [0.08, 0.01];
/// What a reading has at least while the ground acts, g.
const ACTING_G: f64 = 3.0;
/// A clock error that stretches or cuts off an impact, s.
const OFF_S: f64 = 0.001;
/// Share of the impulse in which it does: what comes behind changes little.
const IMPULSE: f64 = 0.95;

/// When things happen, s of true time.
struct Course {
    release_s: f64,
    letting_go_s: f64,
    touch_s: f64,
    /// Later touches, each with the size of its wave.
    rebounds: Vec<(f64, f64)>,
    /// When most of the impulse has come, s after the touch.
    acted_s: f64,
}

impl Course {
    fn of(fine: &[f64], fine_s: f64, [fall_s, speed_m_s]: [f64; 2], record_s: f64, rng: &mut impl Rng) -> Self {
        let letting_go_s = RELEASE_S[0] + (RELEASE_S[1] - RELEASE_S[0]) * rng.random::<f64>();
        let earliest = fall_s + ROOM_S[0];
        let touch_s = earliest + (record_s - ROOM_S[1] - earliest).max(0.0) * rng.random::<f64>();
        let pushed_m_s = GRAVITY_M_S2 * fine_s * fine.iter().sum::<f64>();
        let acting_s = fine.iter().rposition(|reading| reading.abs() > ACTING_G).map_or(0.0, |last| last as f64 * fine_s);
        let back = (pushed_m_s / speed_m_s - 1.0).clamp(0.0, 0.9);
        let (mut rebounds, mut size, mut time_s) = (Vec::new(), back, touch_s + acting_s);
        while size > 0.05 {
            time_s += 2.0 * size * speed_m_s / GRAVITY_M_S2;
            rebounds.push((time_s, size));
            time_s += acting_s;
            size *= back;
        }
        let mut come_m_s = 0.0;
        let acted = fine.iter().position(|reading| {
            come_m_s += GRAVITY_M_S2 * fine_s * reading;
            come_m_s > IMPULSE * pushed_m_s
        });
        let acted_s = acted.map_or(0.0, |at| at as f64 * fine_s);
        Self { release_s: touch_s - fall_s, letting_go_s, touch_s, rebounds, acted_s }
    }

    /// Proper acceleration at a time, g, and whether the hand holds.
    fn true_g(&self, fine: &[f64], t_s: f64) -> (f64, bool) {
        if t_s < self.release_s + self.letting_go_s {
            return ((1.0 - (t_s - self.release_s).max(0.0) / self.letting_go_s).min(1.0), t_s < self.release_s);
        }
        let wave = |since_s: f64| if (0.0..AFTER_S).contains(&since_s) { at(fine, since_s) } else { 0.0 };
        let hits = self.rebounds.iter().map(|(touch_s, size)| size * wave(t_s - touch_s)).sum::<f64>();
        (wave(t_s - self.touch_s) + hits, false)
    }

    /// Proper acceleration along a lateral axis, g: where feet touch, at later touches in proportion.
    fn lateral_g(&self, fine: &[f64], t_s: f64) -> f64 {
        let wave = |since_s: f64| if (0.0..AFTER_S).contains(&since_s) { at(fine, since_s) } else { 0.0 };
        wave(t_s - self.touch_s) + self.rebounds.iter().map(|(touch_s, size)| size * wave(t_s - touch_s)).sum::<f64>()
    }
}

impl Stalls {
    /// True times of the samples, s.
    fn times_s(&self, step_s: f64, rng: &mut impl Rng) -> Vec<f64> {
        let count = (self.record_s / step_s).floor() as usize;
        let mut times: Vec<f64> = Vec::with_capacity(count);
        for i in 0..count {
            let due_s = i as f64 * step_s;
            let Some(last_s) = times.last().copied() else {
                times.push(due_s);
                continue;
            };
            let sector = |i: usize| (i as f64 / self.sector).floor();
            let ends = self.lost_s > 0.0 && sector(i) > sector(i - 1);
            let normal: f64 = StandardNormal.sample(rng);
            let lost_s = if ends { self.lost_s * (1.0 + LOST_VARIES * normal).max(0.2) } else { 0.0 };
            times.push(f64::max(due_s, last_s + step_s / self.catch_up + lost_s));
        }
        times
    }

    /// The whole record of a drop.
    pub(super) fn record(
        &self,
        plan: &Plan,
        (trajectory, fine, fine_s): (&ReferenceTrajectory, &[f64], f64),
        lateral: Option<[&[f64]; 2]>,
        (height_m, trial): (f64, String),
        rng: &mut impl Rng,
    ) -> SyntheticRecord {
        let step_s = 1.0 / plan.rate_hz;
        let fall = plan.model.arrangement().fall;
        let fallen = [fall.duration_s(height_m), fall.impact_speed_m_s(height_m)];
        let course = Course::of(fine, fine_s, fallen, self.record_s, rng);
        let times = self.times_s(step_s, rng);
        let lean: f64 = StandardNormal.sample(rng);
        let tilt = libm::cos(plan.scatter.tilt_deg.to_radians() * lean);
        let scatter = plan.scatter.share * plan.scatter.law.factor(plan.seed, height_m, rng);
        let sizes_g = plan.scatter.law.sizes_g(fine);
        let mut accel_g = Vec::with_capacity(times.len());
        let [mut factor, mut noise, mut tremor] = [0; 3].map(|_| -> f64 { StandardNormal.sample(rng) });
        let mut before_s = f64::NEG_INFINITY;
        for t_s in &times {
            // Three Markov processes in true time.
            let kept = |time_s: f64| libm::exp((before_s - t_s) / time_s);
            for (value, time_s) in [(&mut factor, plan.scatter.correlation_s), (&mut noise, NOISE_S), (&mut tremor, TREMOR[1])] {
                let (kept, fresh): (f64, f64) = (kept(time_s), StandardNormal.sample(rng));
                *value = kept * *value + (1.0 - kept * kept).sqrt() * fresh;
            }
            before_s = *t_s;
            let (true_g, held) = course.true_g(fine, *t_s);
            let varied = if held {
                true_g + TREMOR[0] * tremor
            } else {
                match &sizes_g {
                    None => true_g * (1.0 + scatter * factor) * tilt,
                    Some(sizes_g) => (true_g + scatter * factor * course.true_g(sizes_g, *t_s).0) * tilt,
                }
            };
            let reading = varied.clamp(-trajectory.limit_g(), trajectory.limit_g()) + plan.noise_g * noise;
            accel_g.push((reading * plan.counts_per_g).round() / plan.counts_per_g);
        }
        let stalled = stalled(&times, step_s, &course);
        let mut sideways = |fine: &[f64]| -> Vec<f64> {
            let (mut noise, mut before_s) = (0.0, f64::NEG_INFINITY);
            let mut reading = |t_s: &f64| {
                let kept = libm::exp((before_s - t_s) / NOISE_S);
                let fresh: f64 = StandardNormal.sample(rng);
                noise = kept * noise + (1.0 - kept * kept).sqrt() * fresh;
                before_s = *t_s;
                let limited = course.lateral_g(fine, *t_s).clamp(-trajectory.limit_g(), trajectory.limit_g());
                ((limited + plan.noise_g * noise) * plan.counts_per_g).round() / plan.counts_per_g
            };
            times.iter().map(&mut reading).collect()
        };
        let lateral_g = lateral.map(|axes| axes.map(&mut sideways));
        let t_s = (0..times.len()).map(|i| i as f64 * step_s).collect();
        SyntheticRecord { trial, height_m, t_s, accel_g, lateral_g, stalled }
    }
}

/// Whether the impact's samples are not evenly spaced in true time.
fn stalled(times: &[f64], step_s: f64, course: &Course) -> bool {
    let from = times.partition_point(|t_s| *t_s < course.touch_s).saturating_sub(1);
    let to = times.partition_point(|t_s| *t_s < course.touch_s + course.acted_s);
    // The sample behind the impact is one of them: a stall that begins in the impact ends behind it.
    (from..=to.min(times.len() - 1)).any(|i| (times[i] - times[from] - (i - from) as f64 * step_s).abs() > OFF_S)
}
