//! Where the energy is at a moment: what came in, what each term has stored and lost, what is left in the motion.

use serde::Serialize;

use super::phase::Phase;
use super::system::System;
use crate::impact::effects::{LINEAR_DAMPER, LINEAR_SPRING, MotionState};
use crate::units::GRAVITY_M_S2;

/// Which moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Moment {
    /// Compression is largest, and the gap is not used up.
    TurningPoint,
    /// The gap is used up: what is left in the motion goes into the collision.
    GapReached,
    /// The ground ceases to push.
    Release,
}

/// A term's share.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TermEnergy {
    /// The effect.
    pub effect: &'static str,
    /// Work done on it since first touch, J.
    pub work_j: f64,
    /// What of it it could give back, J.
    pub stored_j: f64,
    /// What it has lost for good, J: the work less what is stored.
    pub dissipated_j: f64,
}

/// A balance: `input_j` is the sum of everything below it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Balance {
    /// Which moment.
    pub moment: Moment,
    /// When, ms after first touch.
    pub t_ms: f64,
    /// Compression, mm.
    pub x_mm: f64,
    /// Gravity's work since release, m g (h + x), J.
    pub input_j: f64,
    /// Stored in springs, J.
    pub stored_j: f64,
    /// Lost in dampers, J.
    pub dissipated_j: f64,
    /// Left in the motion, J; 0 when it goes into a collision.
    pub kinetic_j: f64,
    /// What the collision at the gap takes, J.
    pub collision_j: f64,
    /// Lost to the air in the fall, J.
    pub air_j: f64,
    /// Terms one by one.
    pub terms: Vec<TermEnergy>,
}

impl Balance {
    /// The balance of a state.
    pub(super) fn of(system: &System, moment: Moment, height_m: f64, at: (f64, &[f64], Phase)) -> Self {
        let (t_s, y, phase) = at;
        let (mass_kg, fall) = (system.body.mass_kg, system.arrangement.fall);
        let [lag_m, lag_rate_m_s] = system.lag(y);
        let payload_kg = mass_kg * system.arrangement.attached.map_or(0.0, |payload| payload.share);
        let (x_m, v_m_s) = (y[0], y[1]);
        let carried = v_m_s + lag_rate_m_s;
        let motion_j = 0.5 * (mass_kg - payload_kg) * v_m_s * v_m_s + 0.5 * payload_kg * carried * carried;
        let fallen_j = mass_kg * GRAVITY_M_S2 * fall.height_m(height_m);
        let impact_m_s = fall.impact_speed_m_s(height_m);
        let terms = terms(system, phase, y);
        let collides = moment == Moment::GapReached;
        Self {
            moment,
            t_ms: t_s * 1e3,
            x_mm: x_m * 1e3,
            input_j: fallen_j + mass_kg * GRAVITY_M_S2 * x_m + payload_kg * GRAVITY_M_S2 * lag_m,
            stored_j: terms.iter().map(|term| term.stored_j).sum(),
            dissipated_j: terms.iter().map(|term| term.dissipated_j).sum(),
            kinetic_j: if collides { 0.0 } else { motion_j },
            collision_j: if collides { motion_j } else { 0.0 },
            air_j: if fall.drag_1_m == 0.0 { 0.0 } else { fallen_j - 0.5 * mass_kg * impact_m_s * impact_m_s },
            terms,
        }
    }

    /// What the balance misses, over its input.
    pub fn residual(&self) -> f64 {
        let found = self.stored_j + self.dissipated_j + self.kinetic_j + self.collision_j + self.air_j;
        (found - self.input_j) / self.input_j
    }
}

/// Terms with their work, in the order of the states.
fn terms(system: &System, phase: Phase, y: &[f64]) -> Vec<TermEnergy> {
    let works = &y[system.core..];
    let base = MotionState { x_m: y[0], v_m_s: y[1], own: &[] };
    let spring_j = system.spring_j(&base, phase.touched);
    let mut stored = vec![(LINEAR_SPRING.id, spring_j), (LINEAR_DAMPER.id, 0.0)];
    stored.extend(system.forces.iter().map(|term| (term.id, term.effect.stored_j(&term.motion(y)))));
    let mut found: Vec<TermEnergy> = stored.into_iter().zip(works).map(|((id, stored_j), work_j)| term(id, *work_j, stored_j)).collect();
    let behind = 2 + system.forces.len();
    if let Some(stop) = &system.stop {
        found.push(term(stop.id, works[behind], stop.effect.stored_j(&stop.motion(y))));
    }
    if let Some(payload) = &system.arrangement.attached {
        let [lag_m, _] = system.lag(y);
        let stored_j = 0.5 * payload.share * system.body.mass_kg * payload.stiffness_1_s2 * lag_m * lag_m;
        found.push(term(payload.effect, works[behind + 1], stored_j));
    }
    found
}

fn term(effect: &'static str, work_j: f64, stored_j: f64) -> TermEnergy {
    TermEnergy { effect, work_j, stored_j, dissipated_j: work_j - stored_j }
}

/// Shares of m g h as the paper counts them: gravity's work over the stroke is left out, the damper is what remains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PaperShares {
    /// Damper, %.
    pub damper_percent: f64,
    /// Spring, %.
    pub spring_percent: f64,
    /// Rigid collision at the gap, %.
    pub rigid_percent: f64,
}

impl PaperShares {
    /// The shares of a balance.
    pub(super) fn of(system: &System, height_m: f64, balance: &Balance) -> Self {
        let input_j = system.body.mass_kg * GRAVITY_M_S2 * height_m;
        let x_m = balance.x_mm * 1e-3;
        let spring_percent = 100.0 * 0.5 * system.spring.stiffness_n_m * x_m * x_m / input_j;
        let rigid_percent = 100.0 * balance.collision_j / input_j;
        Self { damper_percent: 100.0 - spring_percent - rigid_percent, spring_percent, rigid_percent }
    }
}
