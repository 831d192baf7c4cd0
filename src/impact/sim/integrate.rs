//! From first touch on: steps whose length follows the error estimate, cut where a switch turns.

use super::dormand_prince::{Dense, Step};
use super::phase::Phase;
use super::switches::Switches;
use super::system::System;

/// How to run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolverOptions {
    /// How long after first touch, s.
    pub duration_s: f64,
    /// Error of a step that is allowed, over the size of the states.
    pub tolerance: f64,
    /// Steps of one length instead, s: for tests of the order of convergence.
    pub fixed_step_s: Option<f64>,
}

impl SolverOptions {
    /// For fits: the sensor's output is good to 0.005 g (docs/decisions/0010-integrator.md).
    pub const FIT: Self = Self { duration_s: 0.06, tolerance: 3e-6, fixed_step_s: None };
    /// For reports: energies balance to 1e-8.
    pub const REPORT: Self = Self { duration_s: 0.06, tolerance: 1e-11, fixed_step_s: None };
}

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// It came to its end.
    End,
    /// The simulation diverges: the body leaves every bound.
    Diverges {
        /// When, s.
        t_s: f64,
    },
    /// Too many steps: forces that chatter, or change faster than any body can follow.
    StepsExhausted {
        /// When, s.
        t_s: f64,
    },
}

/// Whether to go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flow {
    On,
    Enough,
}

/// Longest step, s: events are looked for in eighths of a step, switches in quarters.
const LONGEST_S: f64 = 2e-3;
/// First step tried, s.
const FIRST_S: f64 = 5e-5;
/// Shortest step, s.
const SHORTEST_S: f64 = 1e-13;
/// Most steps tried.
const MOST_STEPS: usize = 50_000;
/// Compression, either way, beyond which the simulation diverges, m.
const FAR_M: f64 = 10.0;
/// Sizes of the states to which the tolerance is added: x in m, v in m/s, all others.
const SIZES: [f64; 3] = [1e-2, 1.0, 10.0];

/// Runs a drop from a height; each step goes to the listener.
#[inline(always)]
pub(super) fn integrate<const N: usize>(
    system: &System,
    height_m: f64,
    settings: &SolverOptions,
    works: bool,
    mut listener: impl FnMut(&Dense<N>, Phase) -> Flow,
) -> Stop {
    let mut phase = Phase { airborne: false, touched: 1, works };
    let (mut t_s, mut y) = (0.0, system.start::<N>(height_m));
    let mut switches = Switches::new(system, phase, &y);
    let mut rates = system.rates(phase, &y);
    let mut h_s = settings.fixed_step_s.unwrap_or(FIRST_S);
    for _ in 0..MOST_STEPS {
        let left_s = settings.duration_s - t_s;
        if left_s <= SHORTEST_S {
            return Stop::End;
        }
        h_s = h_s.min(left_s).min(LONGEST_S);
        let take = |h_s: f64| Step::take(&y, &rates, h_s, |y| system.rates(phase, y));
        let mut step = take(h_s);
        let error = error(&step, system.core, settings.tolerance);
        let longer = settings.fixed_step_s.unwrap_or_else(|| h_s * factor(error));
        if settings.fixed_step_s.is_none() && error > 1.0 {
            if h_s < SHORTEST_S {
                return Stop::StepsExhausted { t_s };
            }
            h_s = longer;
            continue;
        }
        let mut dense = step.dense(t_s);
        let turned = switches.first(system, phase, &dense);
        if let Some((_, theta)) = turned {
            step = take(theta * h_s);
            dense = step.dense(t_s);
        }
        if !(step.to[0].abs() < FAR_M && step.to[..system.core].iter().all(|state| state.is_finite())) {
            return Stop::Diverges { t_s };
        }
        if listener(&dense, phase) == Flow::Enough {
            return Stop::End;
        }
        (t_s, y) = (t_s + step.h_s, step.to);
        rates = *step.rates_at_end();
        if let Some((at, _)) = turned {
            phase = switches.turn(at, phase);
            rates = system.rates(phase, &y);
        }
        h_s = longer;
    }
    Stop::StepsExhausted { t_s }
}

/// Error of a step over what is allowed; infinite when it is no number.
#[inline(always)]
fn error<const N: usize>(step: &Step<N>, core: usize, tolerance: f64) -> f64 {
    let mut worst: f64 = 0.0;
    for (i, error) in step.error().iter().enumerate().take(core) {
        let size = SIZES[i.min(SIZES.len() - 1)] + step.from[i].abs().max(step.to[i].abs());
        let ratio = error.abs() / (tolerance * size);
        worst = if ratio.is_nan() { f64::INFINITY } else { worst.max(ratio) };
        if worst == f64::INFINITY {
            break;
        }
    }
    worst
}

/// By how much the next step is longer: by the fifth root of the error. Seven digits of it suffice, and take a part of the time of sixteen.
fn factor(error: f64) -> f64 {
    (0.9 * f64::from(libm::exp2f(-0.2 * libm::log2f(error as f32)))).clamp(0.2, 5.0)
}
