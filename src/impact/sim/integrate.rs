//! From first touch on: steps whose length follows the error estimate, cut where a switch turns.

use super::dormand_prince::{Dense, Moving, Step};
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
/// Speed, either way, beyond which it diverges, m/s: a drag that feeds energy in reaches any speed before the frame has gone far.
const FAST_M_S: f64 = 1000.0;
/// Sizes of the states to which the tolerance is added: x in m, v in m/s, all others.
const SIZES: [f64; 3] = [1e-2, 1.0, 10.0];

/// A system between two switches.
struct Between<'a> {
    system: &'a System,
    phase: Phase,
}

impl<const N: usize> Moving<N> for Between<'_> {
    #[inline(always)]
    fn rates(&self, y: &[f64; N]) -> [f64; N] {
        self.system.rates(self.phase, y)
    }
}

/// A drop from a height, step by step. No listener is called with the steps, as what is called and not inlined has narrow registers.
pub(super) struct Run<'a, const N: usize> {
    system: &'a System,
    settings: SolverOptions,
    phase: Phase,
    switches: Switches,
    t_s: f64,
    y: [f64; N],
    rates: [f64; N],
    /// Length of the next step, s.
    h_s: f64,
    tried: usize,
}

impl<'a, const N: usize> Run<'a, N> {
    /// At first touch.
    #[inline(always)]
    pub fn from_touch(system: &'a System, height_m: f64, settings: SolverOptions, works: bool) -> Self {
        let phase = Phase { airborne: false, touched: 1, works };
        let y = system.start::<N>(height_m);
        let (switches, rates) = (Switches::new(system, phase, &y), system.rates(phase, &y));
        Self { system, settings, phase, switches, t_s: 0.0, y, rates, h_s: settings.fixed_step_s.unwrap_or(FIRST_S), tried: 0 }
    }

    /// The next step, and what holds in it.
    ///
    /// # Errors
    /// Why the run has ended.
    #[inline(always)]
    pub fn step(&mut self) -> Result<(Dense<N>, Phase), Stop> {
        let (t_s, phase) = (self.t_s, self.phase);
        let moving = Between { system: self.system, phase };
        // Where a switch turns within the step: which, and the length up to there.
        let mut cut = None;
        while self.tried < MOST_STEPS {
            let left_s = self.settings.duration_s - t_s;
            if left_s <= SHORTEST_S {
                return Err(Stop::End);
            }
            let h_s = cut.map_or(self.h_s.min(left_s).min(LONGEST_S), |(_, h_s)| h_s);
            let step = Step::take(&self.y, &self.rates, h_s, &moving);
            let dense = step.dense(t_s);
            if cut.is_none() {
                self.tried += 1;
                let error = error(&step, self.system.core, self.settings.tolerance);
                self.h_s = self.settings.fixed_step_s.unwrap_or_else(|| h_s * factor(error));
                if self.settings.fixed_step_s.is_none() && error > 1.0 {
                    if h_s < SHORTEST_S {
                        break;
                    }
                    continue;
                }
                if let Some((at, theta)) = self.switches.first(self.system, phase, &dense) {
                    cut = Some((at, theta * h_s));
                    continue;
                }
            }
            let near = step.to[0].abs() < FAR_M && step.to[1].abs() < FAST_M_S;
            if !(near && step.to[..self.system.core].iter().all(|state| state.is_finite())) {
                return Err(Stop::Diverges { t_s });
            }
            (self.t_s, self.y, self.rates) = (t_s + step.h_s, step.to, *step.rates_at_end());
            if let Some((at, _)) = cut {
                self.phase = self.switches.turn(at, phase);
                self.rates = self.system.rates(self.phase, &self.y);
            }
            return Ok((dense, phase));
        }
        Err(Stop::StepsExhausted { t_s })
    }
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
