//! Whether a logger's clock stalled in a record, judged against the other records.
//!
//! A logger that writes to flash memory stops while a sector is erased, and catches up afterwards, but stamps every sample as if no
//! time had been lost. The impact is then lost, cut off or stretched. A fall that is too short by itself, or a jump into free flight
//! with an impulse unlike the others', says so. Weaker signs count together. *When it is wrong:* where most records are stalled,
//! and for stalls that change neither the fall nor the impulse.

use super::clock_period::ClockPeriod;
use super::clock_sign::ClockSign;
use super::clock_trace::ClockTrace;
use super::impact::WINDOW_S;
use super::shorth::Shorth;
use crate::units::GRAVITY_M_S2;

/// How much shorter than others a fall must be: deviations, and s.
const SHORT: f64 = 5.0;
const SHORT_S: f64 = 0.008;
/// A weaker sign: deviations, and s.
const RATHER_SHORT: f64 = 2.5;
const RATHER_SHORT_S: f64 = 0.004;
/// How much shorter than the height says, s, where there are too few others.
const SHORT_OF_HEIGHT_S: f64 = 0.025;
/// Falls that vary by more than this are not compared, s.
const MOST_VARIED_S: f64 = 0.012;
/// Least deviation of falls, s.
const LEAST_FALL_S: f64 = 0.001;
/// Drag of a small frame in its fall, 1/m.
const DRAG_1_M: f64 = 0.038;
/// Deviations by which an impulse is unlike the others', and the least relative deviation of impulses.
const UNLIKE: f64 = 4.0;
const LEAST_IMPULSE: f64 = 0.03;
/// The same for a jump into free flight.
const CUT: f64 = 3.0;
/// Deviations by which vibration or noise is smoother than the others'.
const SMOOTH: f64 = 2.5;
const SMOOTH_NOISE: f64 = 3.5;
/// Least deviations of both.
const LEAST_VIBRATION: f64 = 0.05;
const LEAST_NOISE: f64 = 0.05;
/// From the trigger on, an impact acts so long, s.
const ACTS_S: f64 = 0.015;

/// What is usual at a height.
struct Usual {
    fall: Option<Shorth>,
    impulse: Option<Shorth>,
    vibration: [Option<Shorth>; 2],
    noise: Option<Shorth>,
}

impl Usual {
    fn of(traces: &[&ClockTrace]) -> Self {
        let of = |value: &dyn Fn(&ClockTrace) -> Option<f64>| Shorth::of(traces.iter().filter_map(|trace| value(trace)));
        Self {
            fall: of(&|trace| trace.fall_s),
            impulse: of(&|trace| Some(trace.over_v0)),
            vibration: [0, 1].map(|at| of(&|trace| trace.vibration[at])),
            noise: of(&|trace| trace.noise),
        }
    }
}

/// The signs of a stalled clock in each of the traces of one height; none where the clock is good. `None` is a record without impact.
pub(super) fn stalls(height_m: f64, traces: &[Option<ClockTrace>], period: Option<&ClockPeriod>) -> Vec<Vec<ClockSign>> {
    let usual = Usual::of(&traces.iter().flatten().collect::<Vec<_>>());
    let one = |trace: &Option<ClockTrace>| trace.as_ref().map_or_else(Vec::new, |trace| signs(height_m, trace, &usual, period));
    traces.iter().map(one).collect()
}

/// How long a fall lasts in air, s: v = √(g/β) tanh(√(g β) t), integrated.
fn fall_s(height_m: f64) -> f64 {
    libm::acosh(libm::exp(DRAG_1_M * height_m)) / (GRAVITY_M_S2 * DRAG_1_M).sqrt()
}

fn signs(height_m: f64, trace: &ClockTrace, usual: &Usual, period: Option<&ClockPeriod>) -> Vec<ClockSign> {
    let (short, rather_short) = short_fall(height_m, trace, usual);
    let impulse = usual.impulse.map_or(0.0, |shorth| shorth.above(trace.over_v0, LEAST_IMPULSE * shorth.middle.abs()));
    let smoothest = usual.vibration.iter().zip(trace.vibration).filter_map(|(usual, own)| Some(usual.as_ref()?.above(own?, LEAST_VIBRATION)));
    let smoothest = smoothest.fold(0.0, f64::min);
    let position = period.and_then(|period| position(trace, period));
    let noise = usual.noise.zip(trace.noise).filter(|(usual, own)| usual.above(*own, LEAST_NOISE) > SMOOTH_NOISE);
    let (unlike, late, smooth) = (impulse.abs() > UNLIKE, trace.to_peak_s > WINDOW_S + 1e-6, smoothest < -SMOOTH);
    let jump = trace.jump.is_some();
    let clock = rather_short.is_some() || smooth || noise.is_some() || position.is_some();
    let stalled = trace.stamps.is_some()
        || short
        || (jump && impulse < -CUT)
        || ((unlike || late) && clock)
        || (position.is_some() && (jump || smooth || rather_short.is_some() || noise.is_some()));
    if !stalled {
        return Vec::new();
    }
    let mut signs: Vec<ClockSign> = trace.stamps.into_iter().chain(rather_short).collect();
    signs.extend(trace.jump.map(|[from_g, after_s]| ClockSign::Jump { from_g, after_ms: after_s * 1e3 }));
    if let Some(usual) = usual.impulse.filter(|_| unlike || (jump && impulse < -CUT)) {
        signs.push(ClockSign::Impulse { over_v0: trace.over_v0, usual: usual.middle });
    }
    signs.extend(smooth.then_some(ClockSign::SmoothVibration { deviations: -smoothest }));
    signs.extend(noise.map(|(usual, correlation)| ClockSign::SmoothNoise { correlation, usual: usual.middle }));
    signs.extend(late.then_some(ClockSign::LatePeak { to_peak_ms: trace.to_peak_s * 1e3 }));
    signs.extend(position);
    signs
}

/// Whether the fall is short beyond doubt, and the sign where it is rather short at least.
fn short_fall(height_m: f64, trace: &ClockTrace, usual: &Usual) -> (bool, Option<ClockSign>) {
    let Some(own_s) = trace.fall_s else { return (false, None) };
    let sign = |usual_s: f64| ClockSign::ShortFall { fall_ms: own_s * 1e3, usual_ms: usual_s * 1e3 };
    match usual.fall {
        Some(shorth) if shorth.deviation > MOST_VARIED_S => (false, None),
        Some(shorth) => {
            let (deviations, s) = (-shorth.above(own_s, LEAST_FALL_S), shorth.middle - own_s);
            let short = deviations > SHORT && s > SHORT_S;
            let rather = deviations > RATHER_SHORT && s > RATHER_SHORT_S;
            (short, rather.then(|| sign(shorth.middle)))
        }
        None => {
            let expected_s = fall_s(height_m);
            let short = expected_s - own_s > SHORT_OF_HEIGHT_S;
            (short, short.then(|| sign(expected_s)))
        }
    }
}

/// Where the impact lies in a period, if the clock stalls in others while an impact would act there.
fn position(trace: &ClockTrace, period: &ClockPeriod) -> Option<ClockSign> {
    let at = period.from_begin(trace.trigger);
    let acts = ACTS_S / trace.step_s;
    (-acts..period.stretch).contains(&at).then_some(ClockSign::Position { at, period: period.samples })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trace(fall_s: f64, over_v0: f64) -> Option<ClockTrace> {
        let (vibration, noise) = ([None; 2], None);
        Some(ClockTrace { fall_s: Some(fall_s), over_v0, to_peak_s: 0.008, trigger: 900, step_s: 1e-3, jump: None, vibration, noise, stamps: None })
    }

    #[test]
    fn analytic_a_fall_in_air_lasts_a_little_longer() {
        let vacuum_s = libm::sqrt(2.0 * 1.5 / GRAVITY_M_S2);
        // To first order by β h / 6.
        assert!((fall_s(1.5) / vacuum_s - (1.0 + DRAG_1_M * 1.5 / 6.0)).abs() < 1e-4);
    }

    #[test]
    fn analytic_short_falls_are_stalls_and_odd_impulses_alone_are_not() {
        let even = |at: u32| 0.450 + 1e-4 * f64::from(at % 30);
        let mut traces: Vec<_> = (0..30).map(|at| trace(even(at), 1.3 + 0.005 * f64::from(at % 20))).collect();
        traces.extend([trace(0.400, 1.33), trace(0.451, 3.5), trace(0.510, 1.33), None]);
        let found = stalls(1.0, &traces, None);
        let stalled: Vec<usize> = (0..found.len()).filter(|at| !found[*at].is_empty()).collect();
        assert_eq!(stalled, [30], "{found:?}");
        assert!(matches!(found[30][..], [ClockSign::ShortFall { .. }]));
        // A few drops are compared with the height: 50 ms are missed, 20 ms are not.
        let few = stalls(1.0, &[trace(0.400, 1.3), trace(0.432, 1.3)], None);
        assert_eq!([few[0].len(), few[1].len()], [1, 0]);
    }
}
