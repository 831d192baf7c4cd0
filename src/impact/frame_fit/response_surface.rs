//! The response surface: the model's results over the two numbers, from runs on a grid, interpolated.

use rayon::prelude::*;

use crate::mechanics::model::frame_model::FrameModel;
use crate::mechanics::result::impact::{Impact, ImpactError, Run, sampled_peak_g};
use crate::mechanics::settings::{IMPACT_LOSS, IMPACT_MODULUS, MechanicsSettings};
use crate::paper_logger::BANDWIDTH_HZ;
use crate::units::GRAVITY_MM_MS2;

/// Length of the impulse from first touch, ms: that of the measured one.
const IMPULSE_MS: f64 = 25.0;

/// Moduli of the grid, over the law's.
const MODULI: [f64; 4] = [0.25, 0.4, 0.65, 1.05];
/// Square roots of its losses.
const ROOT_LOSSES: [f64; 4] = [0.0, 0.5, 1.0, 1.5];

/// What is dropped.
pub struct Subject<'a> {
    /// A quarter of the frame.
    pub model: &'a FrameModel,
    /// Its numbers; those that are looked for are replaced.
    pub settings: &'a MechanicsSettings,
}

/// A drop whose readings a logger takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoggedDrop {
    /// From where, m.
    pub height_m: f64,
    /// Time between readings, s.
    pub step_s: f64,
}

/// What the model says of a drop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// Logarithm of the peak, g, as a logger samples it.
    pub ln_peak: f64,
    /// Impulse within 25 ms over the speed before.
    pub impulse_over_v0: f64,
}

impl Response {
    fn map(self, other: Self, join: impl Fn(f64, f64) -> f64) -> Self {
        Self { ln_peak: join(self.ln_peak, other.ln_peak), impulse_over_v0: join(self.impulse_over_v0, other.impulse_over_v0) }
    }
}

impl Subject<'_> {
    /// The numbers at a place of the search: logarithm of the modulus, root of the loss.
    pub fn numbers(&self, at: [f64; 2]) -> MechanicsSettings {
        let [modulus, loss] = [libm::exp(at[0]), at[1] * at[1]];
        MechanicsSettings { impact_modulus: modulus, impact_loss: loss, ..self.settings.clone() }
    }

    /// Runs the model.
    ///
    /// # Errors
    /// When its motion is lost.
    pub fn run(&self, at: [f64; 2], drop: LoggedDrop) -> Result<Response, ImpactError> {
        let longest_ms = IMPULSE_MS + 0.1;
        let run = Run { longest_ms, longest_down_ms: longest_ms, off_ground_ms: f64::INFINITY, ..Run::default() };
        let impact = Impact::new(self.model, &self.numbers(at), drop.height_m, &run)?;
        let reading = impact.through(BANDWIDTH_HZ);
        let pairs = impact.moments.windows(2).zip(reading.windows(2)).filter(|(moment, _)| moment[1].t_ms <= IMPULSE_MS + 1e-9);
        let area: f64 = pairs.map(|(moment, g)| 0.5 * (g[0] + g[1]) * (moment[1].t_ms - moment[0].t_ms)).sum();
        let impulse_over_v0 = area * GRAVITY_MM_MS2 / impact.speed_m_s;
        Ok(Response { ln_peak: libm::log(sampled_peak_g(&reading, run.step_ms, 1e3 * drop.step_s)), impulse_over_v0 })
    }
}

/// The answers of some heights over the grid.
#[derive(Clone)]
pub struct ResponseSurface {
    drops: Vec<LoggedDrop>,
    /// Height by height, row by row of the moduli.
    nodes: Vec<[[Response; 4]; 4]>,
    /// What the model says beyond the interpolation, height by height.
    offsets: Vec<Response>,
}

impl ResponseSurface {
    /// Runs the grid.
    ///
    /// # Errors
    /// When a motion is lost.
    pub fn new(subject: &Subject, drops: &[LoggedDrop]) -> Result<Self, ImpactError> {
        let jobs: Vec<(usize, usize, usize)> =
            (0..drops.len()).flat_map(|h| (0..4).flat_map(move |i| (0..4).map(move |j| (h, i, j)))).collect();
        let answers: Vec<Response> =
            jobs.par_iter().map(|(h, i, j)| subject.run([libm::log(MODULI[*i]), ROOT_LOSSES[*j]], drops[*h])).collect::<Result<_, _>>()?;
        let none = Response { ln_peak: 0.0, impulse_over_v0: 0.0 };
        let mut nodes = vec![[[none; 4]; 4]; drops.len()];
        for ((h, i, j), answer) in jobs.into_iter().zip(answers) {
            nodes[h][i][j] = answer;
        }
        Ok(Self { drops: drops.to_vec(), offsets: vec![none; drops.len()], nodes })
    }

    /// Bounds of the search: those of the grid, which lie within the numbers' own.
    pub fn bounds() -> [[f64; 2]; 2] {
        let moduli = [MODULI[0].max(IMPACT_MODULUS[0]), MODULI[3].min(IMPACT_MODULUS[1])];
        [moduli.map(libm::log), [ROOT_LOSSES[0], ROOT_LOSSES[3].min(IMPACT_LOSS[1].sqrt())]]
    }

    /// The middle of the grid's cells: where a search begins.
    pub fn starts() -> Vec<[f64; 2]> {
        let middle = |i: usize| 0.5 * (libm::log(MODULI[i]) + libm::log(MODULI[i + 1]));
        (0..3).flat_map(|i| (0..3).map(move |j| [middle(i), 0.5 * (ROOT_LOSSES[j] + ROOT_LOSSES[j + 1])])).collect()
    }

    /// The answer at a place: the cubic through the grid in each direction. `height` is the number of a height.
    pub fn at(&self, at: [f64; 2], height: usize) -> Response {
        let rows = basis(&MODULI.map(libm::log), at[0]);
        let columns = basis(&ROOT_LOSSES, at[1]);
        let mut sum = self.offsets[height];
        for (i, row) in rows.iter().enumerate() {
            for (j, column) in columns.iter().enumerate() {
                sum = sum.map(self.nodes[height][i][j], |sum, node| sum + row * column * node);
            }
        }
        sum
    }

    /// Moves the answers to what the model says at a place; gives the largest correction of a peak, as a part of it.
    ///
    /// # Errors
    /// When a motion is lost.
    pub fn correct(&mut self, subject: &Subject, at: [f64; 2]) -> Result<f64, ImpactError> {
        let answered: Vec<Response> = self.drops.par_iter().map(|drop| subject.run(at, *drop)).collect::<Result<_, _>>()?;
        let mut most = 0.0_f64;
        for (height, answer) in answered.into_iter().enumerate() {
            let by = answer.map(self.at(at, height), |answered, here| answered - here);
            most = most.max(by.ln_peak.abs());
            self.offsets[height] = self.offsets[height].map(by, |offset, by| offset + by);
        }
        Ok(most)
    }
}

/// Lagrange's polynomials of four places.
fn basis(places: &[f64; 4], at: f64) -> [f64; 4] {
    [0, 1, 2, 3].map(|own| (0..4).filter(|o| *o != own).map(|o| (at - places[o]) / (places[own] - places[o])).product())
}
