//! A drop in full: motion, events, peaks, energies.

use super::balance::{Balance, Moment, PaperShares};
use super::events::Events;
use super::integrate::{Run, SolverOptions, Stop};
use super::system::{ALL, Push, System};
use super::validity_warning::ValidityWarning;
use crate::impact::effects::Reach;
use crate::units::GRAVITY_M_S2;

/// Duration of a run in which the frame does not leave the ground, s.
const PATIENCE_S: f64 = 0.5;

/// Largest values of a drop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peaks {
    /// Largest |x''|, g.
    pub coordinate_g: f64,
    /// Largest proper acceleration, g.
    pub proper_g: f64,
    /// Largest reading, g.
    pub sensor_g: f64,
}

/// A drop from one height.
#[derive(Clone, Debug)]
pub struct Trace {
    /// Stated drop height, m.
    pub height_m: f64,
    /// Speed at first touch, m/s.
    pub impact_speed_m_s: f64,
    /// Length of the fall, s.
    pub fall_s: f64,
    /// Time from first touch, s, in steps of [`Trace::STEP_S`]; shorter than asked when the run stopped.
    pub t_s: Vec<f64>,
    /// Compression, m.
    pub x_m: Vec<f64>,
    /// Its rate, m/s.
    pub v_m_s: Vec<f64>,
    /// Proper acceleration of the frame, g.
    pub proper_g: Vec<f64>,
    /// Force of the ground upwards on the frame, N; below 0 where the model's ground pulls.
    pub ground_n: Vec<f64>,
    /// The sensor's output before sampling, g.
    pub sensor_g: Vec<f64>,
    /// Largest accelerations; `None` where the run diverges, as they are then those of the last steps.
    pub peaks: Option<Peaks>,
    /// From first touch until the ground ceases to push, s; `None` when it does not within half a second.
    pub contact_s: Option<f64>,
    /// Largest compression, m; `None` when the run ended before.
    pub max_displacement_m: Option<f64>,
    /// Energies when the gap is used up or else at the largest compression.
    pub compression: Option<Balance>,
    /// Energies at the release.
    pub release: Option<Balance>,
    /// Shares by the paper's convention.
    pub paper: Option<PaperShares>,
    /// Why the run ended.
    pub stop: Stop,
    /// Where it leaves the range in which the model is valid.
    pub warnings: Vec<ValidityWarning>,
}

impl Trace {
    /// Step of the series, s.
    pub const STEP_S: f64 = 5e-5;

    fn empty(system: &System, height_m: f64) -> Self {
        let fall = system.arrangement.fall;
        Self {
            height_m,
            impact_speed_m_s: fall.impact_speed_m_s(height_m),
            fall_s: fall.duration_s(height_m),
            t_s: Vec::new(),
            x_m: Vec::new(),
            v_m_s: Vec::new(),
            proper_g: Vec::new(),
            ground_n: Vec::new(),
            sensor_g: Vec::new(),
            peaks: None,
            contact_s: None,
            max_displacement_m: None,
            compression: None,
            release: None,
            paper: None,
            stop: Stop::End,
            warnings: Vec::new(),
        }
    }

    fn push(&mut self, system: &System, t_s: f64, y: &[f64; ALL], push: &Push) {
        let [frame_m_s2, _] = system.proper_m_s2(push, y);
        self.t_s.push(t_s);
        self.x_m.push(y[0]);
        self.v_m_s.push(y[1]);
        self.proper_g.push(frame_m_s2 / GRAVITY_M_S2);
        self.ground_n.push(push.total_n);
        self.sensor_g.push(system.arrangement.sensor.reading_g(y[system.sensed()]));
    }
}

/// Drops a system from a height.
pub fn simulate(system: &System, height_m: f64, settings: &SolverOptions) -> Trace {
    let mut trace = Trace::empty(system, height_m);
    let mut events = Events::new(system);
    let points = (settings.duration_s / Trace::STEP_S).round() as usize + 1;
    let patient = SolverOptions { duration_s: settings.duration_s.max(PATIENCE_S), ..*settings };
    let mut run = Run::<ALL>::from_touch(system, height_m, patient, true);
    trace.stop = loop {
        let (dense, phase) = match run.step() {
            Ok(step) => step,
            Err(stop) => break stop,
        };
        events.look(&dense, phase);
        while trace.t_s.len() < points && trace.t_s.len() as f64 * Trace::STEP_S <= dense.time_s(1.0) {
            let t_s = trace.t_s.len() as f64 * Trace::STEP_S;
            let y = dense.at((t_s - dense.start_s) / dense.h_s);
            trace.push(system, t_s, &y, &system.push(phase, &y));
        }
        if trace.t_s.len() == points && events.release.is_some() {
            break Stop::End;
        }
    };
    conclude(system, &mut trace, &events);
    trace
}

/// Fills in what the events say.
fn conclude(system: &System, trace: &mut Trace, events: &Events) {
    let height_m = trace.height_m;
    trace.peaks = (!matches!(trace.stop, Stop::Diverges { .. })).then(|| Peaks {
        coordinate_g: events.coordinate_m_s2 / GRAVITY_M_S2,
        proper_g: events.proper_m_s2 / GRAVITY_M_S2,
        sensor_g: events.reading_g,
    });
    trace.contact_s = events.release.map(|(t_s, ..)| t_s);
    trace.max_displacement_m = events.deepest.map(|(_, y, _)| y[0]);
    let balance = |moment, (t_s, y, phase): super::events::Moment| Balance::of(system, moment, height_m, (t_s, &y, phase));
    trace.compression = match (events.gap, events.deepest) {
        (Some(gap), _) => Some(balance(Moment::GapReached, gap)),
        (None, deepest) => deepest.map(|deepest| balance(Moment::TurningPoint, deepest)),
    };
    trace.release = events.release.map(|release| balance(Moment::Release, release));
    trace.paper = trace.compression.as_ref().map(|compression| PaperShares::of(system, height_m, compression));
    trace.warnings = warnings(system, trace, events);
}

fn warnings(system: &System, trace: &Trace, events: &Events) -> Vec<ValidityWarning> {
    let mut warnings = Vec::new();
    if system.arrangement.fall.height_m(trace.height_m) == 0.0 {
        warnings.push(ValidityWarning::NoFall);
    }
    match trace.stop {
        Stop::End => {}
        Stop::Diverges { t_s } => warnings.push(ValidityWarning::Diverges { t_ms: t_s * 1e3 }),
        Stop::StepsExhausted { t_s } => warnings.push(ValidityWarning::Chatters { t_ms: t_s * 1e3 }),
    }
    if let Some((t_s, y, _)) = events.gap {
        warnings.push(ValidityWarning::PastGap { gap_mm: system.body.gap_m * 1e3, t_ms: t_s * 1e3, speed_m_s: y[1] });
    }
    let x_m = trace.max_displacement_m.unwrap_or_else(|| deepest_m(trace));
    if let Some(travel_m) = system.body.travel_m.filter(|travel_m| x_m > *travel_m) {
        warnings.push(ValidityWarning::PastTravel { x_mm: x_m * 1e3, travel_mm: travel_m * 1e3 });
    }
    match trace.contact_s {
        Some(t_s) if system.arrangement.tension_factor > 0.0 => warnings.push(ValidityWarning::Pulls { t_ms: t_s * 1e3 }),
        None if trace.stop == Stop::End => warnings.push(ValidityWarning::NoRelease { t_ms: PATIENCE_S * 1e3 }),
        _ => {}
    }
    let limit_g = system.arrangement.sensor.limit_g;
    if trace.peaks.is_some_and(|peaks| peaks.sensor_g >= limit_g) {
        warnings.push(ValidityWarning::SensorLimit { limit_g });
    }
    warnings.extend(effects_outside(system, trace, events));
    warnings
}

/// The largest compression that was followed, m.
fn deepest_m(trace: &Trace) -> f64 {
    trace.x_m.iter().copied().fold(0.0, f64::max)
}

/// Effects that do not hold where the drop went.
fn effects_outside(system: &System, trace: &Trace, events: &Events) -> Vec<ValidityWarning> {
    let reach = Reach {
        impact_speed_m_s: trace.impact_speed_m_s,
        // Where it never turns back, as far as it was followed.
        deepest_m: trace.max_displacement_m.unwrap_or_else(|| deepest_m(trace)),
        above_ground: trace.x_m.iter().any(|x_m| *x_m < 0.0),
        contact_s: trace.contact_s,
        released_at_m: events.release.map(|(_, y, _)| y[0]),
        stiffness_n_m: system.spring.stiffness_n_m,
    };
    system.outside(&reach).into_iter().map(|(effect, reason)| ValidityWarning::Effect { effect, reason }).collect()
}
