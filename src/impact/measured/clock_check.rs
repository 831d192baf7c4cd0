//! Whether a logger's clock stalled in a record, judged against the other records.
//!
//! A logger that writes to flash memory stops while a sector is erased, and catches up afterwards, but stamps every sample as if no
//! time had been lost. The impact is then lost, cut off or stretched. A fall that is too short by itself, or a jump into free flight
//! with an impulse unlike the others', says so. Weaker signs count together. *When it is wrong:* where most records are stalled,
//! and for stalls that change neither the fall nor the impulse.

use super::clock_period::ClockPeriod;
use super::clock_sign::ClockSign;
use super::clock_trace::ClockTrace;
use super::fall_length::{FallLength, UsualFall};
use super::flag::impulse_over_v0;
use super::impact::WINDOW_S;
use super::shorth::Shorth;

// The limits were set on synthetic stalls and on the CogniFly drops; docs/physics.md says how often they are right.

/// Deviations by which an impulse is unlike the others'.
const UNLIKE: f64 = 4.0;
/// Least relative deviation of impulses.
const LEAST_IMPULSE: f64 = 0.03;
/// An impact is cut off when its impulse is lower by so many deviations, and no more than this part of the usual one.
const CUT: f64 = 3.0;
const CUT_SHARE: f64 = 0.85;
/// The impact is lost, and what hits is the rebound, when the fall is so many times too long and the impulse lower by so many deviations.
const LONGER: f64 = 1.4;
const SECOND: f64 = 1.5;
/// Deviations by which vibration is smoother than the others', and the same of noise.
const SMOOTH: f64 = 2.5;
const SMOOTH_NOISE: f64 = 3.5;
/// Least deviation of both.
const LEAST_VIBRATION: f64 = 0.05;
const LEAST_NOISE: f64 = 0.05;
/// Largest share of a height's records that lie where the clock stalls.
const MOST_INSIDE: f64 = 0.7;
/// From the trigger on, an impact acts so long, s.
const ACTS_S: f64 = 0.015;

/// What is usual at a height.
struct Usual {
    fall: UsualFall,
    impulse: Option<Shorth>,
    vibration: [Option<Shorth>; 2],
    noise: Option<Shorth>,
}

impl Usual {
    fn of(traces: &[&ClockTrace]) -> Self {
        let of = |value: &dyn Fn(&ClockTrace) -> Option<f64>| Shorth::of(traces.iter().filter_map(|trace| value(trace)));
        Self {
            fall: UsualFall::of(&traces.iter().filter_map(|trace| trace.fall_s).collect::<Vec<_>>()),
            impulse: of(&|trace| Some(trace.over_v0)),
            vibration: [0, 1].map(|at| of(&|trace| trace.vibration[at])),
            noise: of(&|trace| trace.noise),
        }
    }
}

/// The signs of a stalled clock in each of the traces of one height; none where the clock is good. `None` is a record without impact.
pub(super) fn stalls(height_m: f64, traces: &[Option<ClockTrace>], period: Option<&ClockPeriod>) -> Vec<Vec<ClockSign>> {
    let known: Vec<&ClockTrace> = traces.iter().flatten().collect();
    let usual = Usual::of(&known);
    let period = period.filter(|period| tells_apart(period, &known));
    let one = |trace: &Option<ClockTrace>| trace.as_ref().map_or_else(Vec::new, |trace| signs(height_m, trace, &usual, period));
    traces.iter().map(one).collect()
}

/// Whether a period tells some records of a height from others. Where the impact lies at the same sample of nearly all of them, it says the same
/// of each, and a period that shows by chance would be held against a whole height.
fn tells_apart(period: &ClockPeriod, traces: &[&ClockTrace]) -> bool {
    let inside = traces.iter().filter(|trace| position(trace, period, false).is_some()).count();
    (inside as f64) <= MOST_INSIDE * traces.len() as f64
}

fn signs(height_m: f64, trace: &ClockTrace, usual: &Usual, period: Option<&ClockPeriod>) -> Vec<ClockSign> {
    let fall = FallLength::of(height_m, trace.fall_s, usual.fall);
    let impulse = usual.impulse.map_or(0.0, |shorth| shorth.above(trace.over_v0, LEAST_IMPULSE * shorth.middle.abs()));
    let smoothest =
        usual.vibration.iter().zip(trace.vibration).filter_map(|(usual, own)| Some(usual.as_ref()?.above(own?, LEAST_VIBRATION)));
    let smoothest = smoothest.fold(0.0, f64::min);
    // A frame that lands on one foot first is pushed for longer, and has less impulse in the window: its last push is smoother than any vibration.
    let behind = match trace.late {
        Some(flight) if impulse < 0.0 => {
            flight.vibration.zip(usual.vibration[1].as_ref()).map_or(0.0, |(own, usual)| usual.above(own, LEAST_VIBRATION))
        }
        _ => smoothest,
    };
    let noise = usual.noise.zip(trace.noise).filter(|(usual, own)| usual.above(*own, LEAST_NOISE) > SMOOTH_NOISE);
    let impossible = usual.impulse.is_none() && !impulse_over_v0(height_m).contains(&trace.over_v0);
    let (unlike, late, smooth) = (impulse.abs() > UNLIKE || impossible, trace.to_peak_s > WINDOW_S + 1e-6, smoothest < -SMOOTH);
    let jump = trace.jump.is_some();
    let cut = impulse < -CUT && usual.impulse.is_some_and(|usual| trace.over_v0 < CUT_SHARE * usual.middle);
    let odd = unlike || late;
    let position = period.and_then(|period| position(trace, period, odd));
    let weak = smooth || noise.is_some() || fall.is_rather_short;
    let stalled = trace.stamps.is_some()
        || fall.is_short
        || (jump && cut)
        || (odd && (behind < -SMOOTH || noise.is_some() || fall.is_rather_short || fall.is_long || position.is_some()))
        || (fall.own_s > LONGER * fall.usual_s && impulse < -SECOND)
        || (position.is_some() && (jump || weak));
    if !stalled {
        return Vec::new();
    }
    let mut signs: Vec<ClockSign> = trace.stamps.into_iter().chain(fall.sign()).collect();
    signs.extend(trace.jump.map(|[from_g, after_s]| ClockSign::Jump { from_g, after_ms: after_s * 1e3 }));
    if let Some(usual) = usual.impulse.filter(|_| unlike || (jump && cut)) {
        signs.push(ClockSign::Impulse { over_v0: trace.over_v0, usual: usual.middle });
    }
    signs.extend(smooth.then_some(ClockSign::SmoothVibration { deviations: -smoothest }));
    signs.extend(noise.map(|(usual, correlation)| ClockSign::SmoothNoise { correlation, usual: usual.middle }));
    signs.extend(late.then_some(ClockSign::LatePeak { to_peak_ms: trace.to_peak_s * 1e3 }));
    signs.extend(position);
    signs
}

/// Where the impact lies in a period, if the clock stalls in others while an impact would act there; an odd one a little longer.
fn position(trace: &ClockTrace, period: &ClockPeriod, odd: bool) -> Option<ClockSign> {
    let at = period.from_begin(trace.trigger);
    let acts = if odd { WINDOW_S } else { ACTS_S } / trace.step_s;
    (-acts..period.stretch).contains(&at).then_some(ClockSign::Position { at, period: period.samples })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trace(fall_s: f64, over_v0: f64) -> Option<ClockTrace> {
        let (vibration, noise) = ([None; 2], None);
        Some(ClockTrace {
            fall_s: Some(fall_s),
            over_v0,
            to_peak_s: 0.008,
            trigger: 900,
            step_s: 1e-3,
            jump: None,
            vibration,
            late: None,
            noise,
            stamps: None,
        })
    }

    #[test]
    fn planted_a_period_in_which_all_impacts_lie_alike_is_held_against_none() {
        let period = ClockPeriod { samples: 200.0, begin: 95.0, stretch: 40.0, rise: 9.0 };
        let jumping = |trigger: usize, jumps: bool| {
            let mut one = trace(0.451, 1.33)?;
            (one.trigger, one.jump) = (trigger, jumps.then_some([11.0, 0.001]));
            Some(one)
        };
        let alike: Vec<_> = (0..30).map(|at| jumping(900, at % 4 == 0)).collect();
        assert!(stalls(1.0, &alike, Some(&period)).iter().all(Vec::is_empty));
        let spread: Vec<_> = (0..30).map(|at| jumping(900 + 37 * at, at % 4 == 0)).collect();
        let found = stalls(1.0, &spread, Some(&period));
        let inside = |at: usize| position(spread[at].as_ref().expect("a trace"), &period, false).is_some();
        assert!((0..30).all(|at| found[at].is_empty() != (at % 4 == 0 && inside(at))));
        assert!((0..30).any(|at| !found[at].is_empty()));
    }

    #[test]
    fn analytic_short_falls_are_stalls_and_odd_impulses_alone_are_not() {
        let even = |at: u32| 0.450 + 1e-4 * f64::from(at % 30);
        let mut traces: Vec<_> = (0..30).map(|at| trace(even(at), 1.3 + 0.005 * f64::from(at % 20))).collect();
        traces.extend([trace(0.400, 1.33), trace(0.451, 3.5), trace(0.510, 1.33), None]);
        let found = stalls(1.0, &traces, None);
        let stalled: Vec<usize> = (0..found.len()).filter(|at| !found[*at].is_empty()).collect();
        assert_eq!(stalled, [30], "{found:?}");
        assert!(matches!(found[30][..], [ClockSign::Fall { .. }]));
        // A few drops are compared with one another, and fewer with the height and what a vertical drop can give.
        let alike = [0.316, 0.319, 0.315, 0.317, 0.250].map(|fall_s| trace(fall_s, 1.3));
        let short: Vec<bool> = stalls(1.0, &alike, None).iter().map(|signs| !signs.is_empty()).collect();
        assert_eq!(short, [false, false, false, false, true], "those of another height are no stalls");
        let few = stalls(1.0, &[trace(0.400, 3.0), trace(0.400, 1.3), trace(0.450, 3.0)], None);
        assert_eq!([few[0].len(), few[1].len(), few[2].len()], [1, 0, 0]);
    }
}
