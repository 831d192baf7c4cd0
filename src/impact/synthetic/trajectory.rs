//! The drop with a known truth: one right-hand side, written as plainly as possible, and fixed steps.

use super::Hidden;
use super::bezier::Bezier;
use crate::impact::effects::{CATALOGUE, Conditions, Generator, GeneratorState, MOST_STAGES, Model, Rider, states};
use crate::units::GRAVITY_M_S2;

/// Step of the method, s.
const STEP_S: f64 = 2e-6;
/// Most masses on the frame.
const RIDERS: usize = 2;
/// Room for the forces that are states.
const BRANCHES: usize = states(&CATALOGUE) + 4;
/// States: x, v, the filter's stages, the masses' lag and rate, the forces that are states.
const STATES: usize = BRANCH + BRANCHES;
const FILTER: usize = 2;
const RIDER: usize = FILTER + MOST_STAGES;
const BRANCH: usize = RIDER + 2 * RIDERS;
type State = [f64; STATES];

/// What a drop remembers.
#[derive(Clone, Copy, Debug)]
struct Past {
    /// Feet that have touched.
    touched: usize,
    /// Largest compression so far, m.
    deepest_m: f64,
}

/// A force as the generator writes it, with the effect's values in the units of model files.
#[derive(Clone, Debug)]
struct Term {
    formula: fn(GeneratorState, &[f64]) -> f64,
    values: Vec<f64>,
}

impl Term {
    fn at(&self, moment: GeneratorState) -> f64 {
        (self.formula)(moment, &self.values)
    }
}

/// What a landing in space takes of a plan's model: spring, damper, the other forces that depend on motion alone, fall and sensor.
#[derive(Clone, Copy, Debug)]
pub(super) struct VerticalConditions<'a> {
    forces: &'a [Term],
    pub mass_kg: f64,
    pub stiffness_n_m: f64,
    pub damping_n_s_m: f64,
    pub speed_m_s: f64,
    pub fall_s: f64,
    /// Rate of each stage of the sensor's filter, 1/s.
    pub filter_1_s: f64,
    pub stages: usize,
    pub gain: f64,
}

impl VerticalConditions<'_> {
    /// Force of a foot that carries a quarter of the frame, N, pressed by x, m, at v, m/s; it never pulls.
    pub(super) fn foot_n(&self, x: f64, v: f64) -> f64 {
        let others: f64 = self.forces.iter().map(|term| term.at(GeneratorState { x, v, q: 0.0 })).sum();
        (0.25 * (self.stiffness_n_m * x + self.damping_n_s_m * v + others)).max(0.0)
    }
}

/// A drop with a known truth: the numbers of a model, ready to run.
#[derive(Clone, Debug)]
pub struct ReferenceTrajectory {
    mass_kg: f64,
    conditions: Conditions,
    forces: Vec<Term>,
    branches: Vec<Term>,
    stops: Vec<Term>,
    curve: Option<Bezier>,
    /// Stages of the sensor's filter.
    order: usize,
    hidden: Option<Hidden>,
}

impl ReferenceTrajectory {
    /// A model's numbers with spring and damper scaled.
    pub fn of(model: &Model, hidden: Option<Hidden>, stiffness_factor: f64, damping_factor: f64) -> Self {
        let mut conditions = Conditions {
            stiffness_n_m: 0.0,
            damping_n_s_m: 0.0,
            tension_factor: 1.0,
            stagger_m: 0.0,
            curve_share: 0.0,
            riders: Vec::new(),
            on_rider: false,
            extra_m: 0.0,
            drag_1_m: 0.0,
            cutoff_hz: model.sensor.cutoff_hz,
            gain: 1.0,
            limit_g: model.sensor.limit_g,
        };
        let (mut forces, mut branches, mut stops) = (Vec::new(), Vec::new(), Vec::new());
        for listed in &model.effects {
            let term = |formula| Term { formula, values: listed.values.clone() };
            match listed.spec.generator {
                Generator::Force(formula) => forces.push(term(formula)),
                Generator::Branch(rate) => branches.push(term(rate)),
                Generator::Stop(formula) => stops.push(term(formula)),
                Generator::Conditions(change) => change(&mut conditions, &listed.values, listed.word),
            }
        }
        conditions.stiffness_n_m *= stiffness_factor;
        conditions.damping_n_s_m *= damping_factor;
        if let Some(Hidden::TwoModes { shares, f_hz, zeta }) = hidden {
            conditions.riders = [0, 1].map(|i| Rider { share: shares[i], f_hz: f_hz[i], zeta }).to_vec();
        }
        let points = |curve: &crate::impact::effects::FrameCurve| curve.points_mm().map(|point| point.map(|mm| mm * 1e-3)).collect();
        let curve = model.frame_curve.as_ref().map(|curve| Bezier::new(points(curve)));
        Self { mass_kg: model.body.mass_kg, conditions, forces, branches, stops, curve, order: model.sensor.order, hidden }
    }

    /// The sensor's largest reading, g.
    pub fn limit_g(&self) -> f64 {
        self.conditions.limit_g
    }

    /// What a landing in space takes of it. The fall's duration is that without drag.
    pub(super) fn vertical(&self, stated_m: f64) -> VerticalConditions<'_> {
        VerticalConditions {
            forces: &self.forces,
            mass_kg: self.mass_kg,
            stiffness_n_m: self.conditions.stiffness_n_m,
            damping_n_s_m: self.conditions.damping_n_s_m,
            speed_m_s: self.impact_speed_m_s(stated_m),
            fall_s: (2.0 * stated_m / GRAVITY_M_S2).sqrt(),
            filter_1_s: circular(self.conditions.cutoff_hz),
            stages: self.order,
            gain: self.conditions.gain,
        }
    }

    /// Speed at first touch, m/s.
    fn impact_speed_m_s(&self, stated_m: f64) -> f64 {
        let (height_m, drag) = ((stated_m + self.conditions.extra_m).max(0.0), self.conditions.drag_1_m);
        let squared =
            if drag > 0.0 { GRAVITY_M_S2 / drag * (1.0 - libm::exp(-2.0 * drag * height_m)) } else { 2.0 * GRAVITY_M_S2 * height_m };
        squared.sqrt()
    }

    /// Compression of the spring with the frame's curve in it, m.
    fn curved(&self, x: f64) -> f64 {
        let share = self.conditions.curve_share;
        match &self.curve {
            Some(curve) if x > 0.0 && share != 0.0 => (1.0 - share) * x + share * curve.at(x),
            _ => x,
        }
    }

    /// Force of the frame on the body, N.
    fn force_n(&self, y: &State, past: Past) -> f64 {
        let (x, v) = (y[0], y[1]);
        let Conditions { stiffness_n_m: k, damping_n_s_m: c, stagger_m, .. } = self.conditions;
        let moment = GeneratorState { x, v, q: 0.0 };
        let mut sum = if stagger_m > 0.0 {
            (0..past.touched).map(|foot| 0.25 * (k * self.curved(x - stagger_m * foot as f64 / 3.0) + c * v)).sum()
        } else {
            k * self.curved(x) + c * v
        };
        sum += self.forces.iter().map(|term| term.at(moment)).sum::<f64>();
        sum += y[BRANCH..BRANCH + self.branches.len()].iter().sum::<f64>();
        if let Some(Hidden::TwoStage { x1_m, stiffness_n_m, loss }) = self.hidden {
            let kept = 1.0 - 0.5 * loss * (1.0 - libm::tanh(v / 0.05));
            sum += kept * stiffness_n_m * (x - x1_m).max(0.0);
        }
        if let Some(Hidden::Snap { x1_m, loss }) = self.hidden
            && past.deepest_m > x1_m
        {
            sum -= loss * k * x;
        }
        if sum < 0.0 || x < 0.0 {
            sum *= self.conditions.tension_factor;
        }
        sum + self.stops.iter().map(|stop| stop.at(moment).max(0.0)).sum::<f64>()
    }

    fn rates(&self, y: &State, past: Past) -> State {
        let mut rates = [0.0; STATES];
        let riders = &self.conditions.riders;
        let mut pushed = [0.0; RIDERS];
        for (i, (rider, push)) in riders.iter().zip(&mut pushed).enumerate() {
            *push = rider_m_s2(rider, y, i);
        }
        let held: f64 = riders.iter().zip(&pushed).map(|(rider, a)| rider.share * a).sum();
        let free: f64 = 1.0 - riders.iter().map(|rider| rider.share).sum::<f64>();
        let frame = (self.force_n(y, past) / self.mass_kg - held) / free;
        rates[0] = y[1];
        rates[1] = GRAVITY_M_S2 - frame;
        for (i, a) in pushed.iter().enumerate().take(riders.len()) {
            rates[RIDER + 2 * i] = y[RIDER + 2 * i + 1];
            rates[RIDER + 2 * i + 1] = GRAVITY_M_S2 - a - rates[1];
        }
        for (i, branch) in self.branches.iter().enumerate() {
            rates[BRANCH + i] = branch.at(GeneratorState { x: y[0], v: y[1], q: y[BRANCH + i] });
        }
        let filter_1_s = circular(self.conditions.cutoff_hz);
        let mut input = if self.conditions.on_rider { pushed[0] } else { frame };
        for stage in FILTER..FILTER + self.order {
            rates[stage] = filter_1_s * (input - y[stage]);
            input = y[stage];
        }
        rates
    }

    /// The low-pass's output times the gain, without the limit, g, every `every_s` from first touch on.
    pub fn wave_g(&self, height_m: f64, every_s: f64, count: usize) -> Vec<f64> {
        let steps = (every_s / STEP_S).round().max(1.0) as usize;
        let step_s = every_s / steps as f64;
        let stagger_m = self.conditions.stagger_m;
        let mut y = [0.0; STATES];
        y[1] = self.impact_speed_m_s(height_m);
        let mut past = Past { touched: 1, deepest_m: 0.0 };
        let mut out = Vec::with_capacity(count);
        for _ in 0..count {
            out.push(self.conditions.gain * y[FILTER + self.order - 1] / GRAVITY_M_S2);
            for _ in 0..steps {
                y = self.step(&y, past, step_s);
                past.deepest_m = past.deepest_m.max(y[0]);
                while past.touched < 4 && past.deepest_m > stagger_m * past.touched as f64 / 3.0 {
                    past.touched += 1;
                }
            }
        }
        out
    }

    /// One step of the classical method of order 4.
    fn step(&self, y: &State, past: Past, h: f64) -> State {
        let along = |rates: &State, part: f64| std::array::from_fn(|i| y[i] + part * h * rates[i]);
        let first = self.rates(y, past);
        let second = self.rates(&along(&first, 0.5), past);
        let third = self.rates(&along(&second, 0.5), past);
        let last = self.rates(&along(&third, 1.0), past);
        std::array::from_fn(|i| y[i] + h / 6.0 * (first[i] + 2.0 * second[i] + 2.0 * third[i] + last[i]))
    }
}

fn circular(f_hz: f64) -> f64 {
    2.0 * std::f64::consts::PI * f_hz
}

/// Proper acceleration of a mass on the frame, m/s².
fn rider_m_s2(rider: &Rider, y: &State, i: usize) -> f64 {
    let (lag, rate, circular_1_s) = (y[RIDER + 2 * i], y[RIDER + 2 * i + 1], circular(rider.f_hz));
    circular_1_s * circular_1_s * lag + 2.0 * rider.zeta * circular_1_s * rate
}
