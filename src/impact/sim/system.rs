//! A model made ready to run: its right-hand side.
//!
//! States in order: x, v, the low-pass's stages, the effects' own, the payload's lag and its rate; then, when energies
//! are asked for, the work done on each term.

use super::phase::Phase;
use super::switch::Switch;
use crate::impact::body::DropBody;
use crate::impact::effects::{
    Arrangement, AttachedMass, CATALOGUE, Effect, LINEAR_DAMPER, LINEAR_SPRING, LinearDamper, LinearSpring, MOST_STAGES, Model,
    MotionState, Reach, Stage, Threshold, states, working,
};
use crate::units::GRAVITY_M_S2;

/// Room for states of effects from outside the catalogue.
const SPARE: usize = 4;
/// States without energies at the most: x, v, the low-pass's stages, those of all effects.
pub(super) const CORE: usize = 2 + MOST_STAGES + states(&CATALOGUE) + SPARE;
/// States with energies at the most: the work on each effect, too.
pub(super) const ALL: usize = CORE + working(&CATALOGUE) + SPARE;

/// Index of the low-pass's first stage.
const FILTER: usize = 2;

/// A force with its place among the states.
#[derive(Debug)]
pub(super) struct Term {
    pub id: &'static str,
    pub effect: Box<dyn Effect>,
    at: usize,
    states: usize,
}

impl Term {
    pub fn motion<'y>(&self, y: &'y [f64]) -> MotionState<'y> {
        MotionState { x_m: y[0], v_m_s: y[1], own: &y[self.at..self.at + self.states] }
    }
}

/// What pushes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Push {
    /// Sum of the forces before the tension factor, N.
    pub sum_n: f64,
    /// What that is multiplied by.
    pub factor: f64,
    /// The stop, N.
    pub stop_n: f64,
    /// All of it, N.
    pub total_n: f64,
}

/// A model made ready to run.
#[derive(Debug)]
pub struct System {
    pub(super) body: DropBody,
    pub(super) spring: LinearSpring,
    pub(super) damper: LinearDamper,
    pub(super) arrangement: Arrangement,
    pub(super) forces: Vec<Term>,
    pub(super) stop: Option<Term>,
    /// Effects that change fall, contact or sensor.
    arranging: Vec<(&'static str, Box<dyn Effect>)>,
    pub(super) core: usize,
    lag: usize,
    filter_rate_1_s: f64,
    frame_share: f64,
}

/// Which way a frame is moved in a static test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlowWay {
    /// Down.
    Loading,
    /// Up again.
    Unloading,
}

impl System {
    /// Makes a model ready; effects that are off are left out.
    pub fn new(model: &Model) -> Self {
        let [stiffness_n_m, damping_n_s_m] = model.stiffness_and_damping();
        let arrangement = model.arrangement();
        let mut core = FILTER + arrangement.sensor.order;
        let (mut forces, mut stop, mut arranging) = (Vec::new(), None, Vec::new());
        for (spec, effect) in model.acting() {
            let term = |effect| Term { id: spec.id, effect, at: core, states: spec.states.len() };
            match spec.stage {
                Stage::Arrangement => {
                    arranging.push((spec.id, effect));
                    continue;
                }
                Stage::Stop => stop = Some(term(effect)),
                Stage::Force => forces.push(term(effect)),
            }
            core += spec.states.len();
        }
        let lag = core;
        core += arrangement.attached.map_or(0, |_| AttachedMass::STATES.len());
        Self {
            body: model.body.clone(),
            spring: LinearSpring { stiffness_n_m },
            damper: LinearDamper { damping_n_s_m },
            filter_rate_1_s: arrangement.sensor.rate_1_s(),
            frame_share: 1.0 - arrangement.attached.map_or(0.0, |attached| attached.share),
            arrangement,
            forces,
            stop,
            arranging,
            core,
            lag,
        }
    }

    /// The body.
    pub fn body(&self) -> &DropBody {
        &self.body
    }

    /// Force of a frame that is compressed so slowly that nothing depends on the rate, N: relaxing branches give none, every foot stands, and
    /// dry friction, which knows no rate, resists as ever: it adds to the force while the frame is loaded, and takes from it on the way back.
    pub fn slow_force_n(&self, x_m: f64, way: SlowWay) -> f64 {
        let feet = self.arrangement.feet.map_or(0, |feet| feet.at_m.iter().filter(|at| **at <= x_m).count());
        let phase = Phase { airborne: false, touched: feet, works: false };
        let mut y = vec![0.0; self.core];
        y[0] = x_m;
        let friction_n: f64 = self.forces.iter().map(|term| term.effect.resists_slow_motion_n()).sum();
        match way {
            SlowWay::Loading => self.push(phase, &y).total_n + friction_n,
            SlowWay::Unloading => (self.push(phase, &y).total_n - friction_n).max(0.0),
        }
    }

    /// Lets the sensor read without limit.
    pub fn lift_limit(&mut self) {
        self.arrangement.sensor.limit_g = f64::INFINITY;
    }

    /// Replaces the sensor's low-pass by one with this cutoff, whatever the model's effects say.
    pub fn set_cutoff(&mut self, cutoff_hz: f64) {
        self.arrangement.sensor.cutoff_hz = cutoff_hz;
        self.filter_rate_1_s = self.arrangement.sensor.rate_1_s();
    }

    /// Fall, contact and sensor.
    pub fn arrangement(&self) -> &Arrangement {
        &self.arrangement
    }

    /// Why effects do not hold in a drop that went so far.
    pub(super) fn outside(&self, reach: &Reach) -> Vec<(&'static str, String)> {
        let base: [(&'static str, &dyn Effect); 2] = [(LINEAR_SPRING.id, &self.spring), (LINEAR_DAMPER.id, &self.damper)];
        let terms = self.forces.iter().chain(&self.stop).map(|term| (term.id, term.effect.as_ref()));
        let arranging = self.arranging.iter().map(|(id, effect)| (*id, effect.as_ref()));
        let all = base.into_iter().chain(terms).chain(arranging);
        all.filter_map(|(id, effect)| Some((id, effect.outside(reach)?))).collect()
    }

    /// Index of the state that the sensor reads.
    pub(super) fn sensed(&self) -> usize {
        FILTER + self.arrangement.sensor.order - 1
    }

    /// The state at first touch.
    pub(super) fn start<const N: usize>(&self, height_m: f64) -> [f64; N] {
        let mut y = [0.0; N];
        y[1] = self.arrangement.fall.impact_speed_m_s(height_m);
        y
    }

    /// What ends a step.
    pub(super) fn switches(&self) -> Vec<Switch> {
        let terms = self.forces.iter().chain(&self.stop);
        let mut found: Vec<Switch> = terms
            .flat_map(|term| term.effect.thresholds())
            .map(|threshold| match threshold {
                Threshold::Compression(level) => Switch::Compression(level),
                Threshold::Speed(level) => Switch::Speed(level),
            })
            .collect();
        if let Some(feet) = self.arrangement.feet {
            found.extend((1..feet.at_m.len()).map(|foot| Switch::Foot { foot, at_m: feet.at_m[foot] }));
        }
        if self.arrangement.tension_factor != 1.0 {
            found.extend([Switch::Ground, Switch::Push]);
        }
        found
    }

    /// Spring's and damper's forces, N.
    #[inline(always)]
    pub(super) fn base_n(&self, phase: Phase, y: &[f64]) -> [f64; 2] {
        let at = MotionState { x_m: y[0], v_m_s: y[1], own: &[] };
        match &self.arrangement.feet {
            None => [self.spring_n(&at), self.damper.force_n(&at)],
            Some(feet) => [
                self.spring.stiffness_n_m * self.mean_compression_m(feet, at.x_m, phase.touched),
                0.25 * phase.touched as f64 * self.damper.force_n(&at),
            ],
        }
    }

    /// What pushes the body.
    #[inline(always)]
    pub(super) fn push(&self, phase: Phase, y: &[f64]) -> Push {
        let [spring, damper] = self.base_n(phase, y);
        let mut sum_n = spring + damper;
        for term in &self.forces {
            sum_n += term.effect.force_n(&term.motion(y));
        }
        let factor = if phase.airborne || sum_n < 0.0 { self.arrangement.tension_factor } else { 1.0 };
        let stop_n = self.stop.as_ref().map_or(0.0, |stop| stop.effect.force_n(&stop.motion(y)));
        Push { sum_n, factor, stop_n, total_n: factor * sum_n + stop_n }
    }

    /// Proper acceleration of the frame and of the payload, m/s².
    #[inline(always)]
    pub(super) fn proper_m_s2(&self, push: &Push, y: &[f64]) -> [f64; 2] {
        match &self.arrangement.attached {
            None => [push.total_n / self.body.mass_kg, 0.0],
            Some(payload) => {
                let of_payload = payload.proper_m_s2(y[self.lag], y[self.lag + 1]);
                let on_frame_n = push.total_n - payload.share * self.body.mass_kg * of_payload;
                [on_frame_n / (self.frame_share * self.body.mass_kg), of_payload]
            }
        }
    }

    /// Lag of the payload behind the frame, m, and its rate, m/s.
    pub(super) fn lag(&self, y: &[f64]) -> [f64; 2] {
        if self.arrangement.attached.is_some() { [y[self.lag], y[self.lag + 1]] } else { [0.0; 2] }
    }

    /// The right-hand side.
    #[inline(always)]
    pub(super) fn rates<const N: usize>(&self, phase: Phase, y: &[f64; N]) -> [f64; N] {
        let push = self.push(phase, y);
        let [frame, payload] = self.proper_m_s2(&push, y);
        let mut rates = [0.0; N];
        rates[0] = y[1];
        rates[1] = GRAVITY_M_S2 - frame;
        let mut input = if self.arrangement.sensor.on_payload { payload } else { frame };
        for stage in FILTER..FILTER + self.arrangement.sensor.order {
            rates[stage] = self.filter_rate_1_s * (input - y[stage]);
            input = y[stage];
        }
        for term in self.forces.iter().filter(|term| term.states > 0) {
            term.effect.rates(&term.motion(y), &mut rates[term.at..term.at + term.states]);
        }
        if self.arrangement.attached.is_some() {
            rates[self.lag] = y[self.lag + 1];
            rates[self.lag + 1] = GRAVITY_M_S2 - payload - rates[1];
        }
        if phase.works {
            self.powers(phase, y, &push, &mut rates[self.core..]);
        }
        rates
    }

    /// Power into each term, W: spring, damper, forces, stop, payload's spring and damper.
    fn powers(&self, phase: Phase, y: &[f64], push: &Push, powers: &mut [f64]) {
        let v_m_s = y[1];
        let [spring, damper] = self.base_n(phase, y);
        powers[0] = push.factor * spring * v_m_s;
        powers[1] = push.factor * damper * v_m_s;
        for (term, power) in self.forces.iter().zip(&mut powers[2..]) {
            *power = push.factor * term.effect.force_n(&term.motion(y)) * v_m_s;
        }
        let behind = 2 + self.forces.len();
        powers[behind] = push.stop_n * v_m_s;
        if let Some(payload) = &self.arrangement.attached {
            let [lag, rate] = self.lag(y);
            powers[behind + 1] = payload.share * self.body.mass_kg * payload.proper_m_s2(lag, rate) * rate;
        }
    }
}
