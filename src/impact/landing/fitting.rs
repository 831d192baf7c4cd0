//! Stiffness, damping, inertia and the spread of slopes, from drops.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;

use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::LANDING_TILT;
use super::legged_body::{LeggedBody, Legs, Slopes};
use super::mount::{MOUNT_LOW_PASS, Mount};
use super::observed::{HeightLandings, ObservedLanding, ObservedLandings};
use super::population::Population;
use super::posterior::given_touches;
use super::table::LandingTable;
use crate::impact::diagnose::EffectEstimate;
use crate::impact::effects::Model;
use crate::impact::fit::{FitProblem, Minimum, inverse, minimise};
use crate::impact::measured::Spread;

/// What is fitted.
struct Parameter {
    key: &'static str,
    unit: &'static str,
    bounds: [f64; 2],
    /// Step of difference quotients, on the scale of the fit.
    step: f64,
    /// Where a fit begins.
    start: f64,
    kind: Kind,
}

/// Legs and mount are fitted as logarithms, slopes as they are.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Leg,
    Mount,
    Slope,
}

impl Parameter {
    const fn new(key: &'static str, unit: &'static str, bounds: [f64; 2], step: f64, start: f64, kind: Kind) -> Self {
        Self { key, unit, bounds, step, start, kind }
    }

    fn inward(&self, value: f64) -> f64 {
        if self.kind == Kind::Slope { value } else { libm::log(value) }
    }

    fn outward(&self, scaled: f64) -> f64 {
        if self.kind == Kind::Slope { scaled } else { libm::exp(scaled) }
    }
}

/// Legs, mount, slopes, in this order; the mount may be left out.
const PARAMETERS: [Parameter; 7] = [
    Parameter::new("k", "N/m", [300.0, 5e5], 0.02, 1.5e4, Kind::Leg),
    Parameter::new("c", "N s/m", [0.05, 1000.0], 0.02, 25.0, Kind::Leg),
    Parameter::new("inertia_kg_m2", "kg m2", [2e-5, 5e-2], 0.02, 1e-3, Kind::Leg),
    Parameter::new("f_hz", "Hz", [50.0, 1500.0], 0.02, 160.0, Kind::Mount),
    Parameter::new("zeta", "1", [0.02, 1.5], 0.02, 0.3, Kind::Mount),
    Parameter::new("sigma_r_rad_s", "rad/s", [0.0, 1.5], 0.01, 0.25, Kind::Slope),
    Parameter::new("sigma_0_rad", "rad", [0.0, 0.25], 0.004, 0.02, Kind::Slope),
];
/// How many of them are slopes.
const SLOPES: usize = 2;
/// Where the mount's begin.
const MOUNT_AT: usize = 3;
/// Frequencies at which a fit with a mount begins, Hz.
const MOUNTS_HZ: [f64; 2] = [120.0, 200.0];
/// Most steps of a fit from the start, and from another fit's end.
const MOST_STEPS: [usize; 2] = [25, 8];
/// Legs whose landings a fit keeps: those of a step, and of its difference quotients.
const MOST_KEPT: usize = 8;
/// Resampled sets of drops.
const RESAMPLED: usize = 400;

/// What is compared with what.
#[derive(Clone, Debug)]
pub struct LandingProblem<'a> {
    /// What lands.
    pub body: LeggedBody,
    /// Fall and sensor.
    pub model: &'a Model,
    /// Mean waves with their covariance.
    pub waves: &'a FitProblem,
    /// Touches, the same heights.
    pub observed: &'a ObservedLandings,
    /// Whether the sensor has a mount that gives way.
    pub mounted: bool,
}

/// A fit.
#[derive(Clone, Debug)]
pub struct LandingFit {
    /// The legs.
    pub legs: Legs,
    /// The slopes.
    pub slopes: Slopes,
    /// On the scale of the fit.
    pub minimum: Minimum,
}

impl LandingFit {
    fn of(minimum: Minimum) -> Self {
        let (legs, slopes) = meaning(&minimum.at);
        Self { legs, slopes, minimum }
    }

    /// Whether a number of the mount ended at its bound.
    pub fn has_mount_at_bound(&self) -> bool {
        let mounted = self.legs.mount.is_some();
        mounted && self.minimum.at_bound[MOUNT_AT..].iter().rev().skip(SLOPES).any(|at_bound| *at_bound)
    }
}

/// What numbers on the scale of the fit mean: those of the legs, of the mount where there are seven, and of the slopes.
fn meaning(scaled: &[f64]) -> (Legs, Slopes) {
    let [k, c, i] = [0, 1, 2].map(|at| libm::exp(scaled[at]));
    let mount = match scaled[MOUNT_AT..scaled.len() - SLOPES] {
        [f_hz, zeta] => Some(Mount { f_hz: libm::exp(f_hz), zeta: libm::exp(zeta) }),
        _ => None,
    };
    let slopes = &scaled[scaled.len() - SLOPES..];
    let legs = Legs { stiffness_n_m: k, damping_n_s_m: c, inertia_kg_m2: i, mount };
    (legs, Slopes { rate_rad_s: slopes[0], at_release_rad: slopes[1] })
}

/// Landings of the legs that were looked at last: a step of a fit moves the slopes alone, too.
#[derive(Default)]
struct KeptTables(RefCell<VecDeque<(Legs, Rc<Vec<LandingTable>>)>>);

impl KeptTables {
    fn of(&self, problem: &LandingProblem, legs: &Legs) -> Option<Rc<Vec<LandingTable>>> {
        if let Some((_, tables)) = self.0.borrow().iter().find(|(known, _)| known == legs) {
            return Some(tables.clone());
        }
        let tables = Rc::new(problem.tables(legs)?);
        let mut kept = self.0.borrow_mut();
        kept.truncate(MOST_KEPT - 1);
        kept.push_front((*legs, tables.clone()));
        Some(tables)
    }
}

impl LandingProblem<'_> {
    fn parameters(&self) -> Vec<&'static Parameter> {
        PARAMETERS.iter().filter(|parameter| self.mounted || parameter.kind != Kind::Mount).collect()
    }

    fn bounds(&self) -> Vec<[f64; 2]> {
        self.parameters().iter().map(|parameter| parameter.bounds.map(|bound| parameter.inward(bound))).collect()
    }

    fn steps(&self) -> Vec<f64> {
        self.parameters().iter().map(|parameter| parameter.step).collect()
    }

    /// The landings of the chosen heights.
    pub fn tables(&self, legs: &Legs) -> Option<Vec<LandingTable>> {
        let table =
            |height: &usize| LandingTable::of(&self.body, legs, self.model, &self.waves.expected, self.waves.means[*height].height_m);
        self.waves.chosen.iter().map(table).collect()
    }

    /// The same at some heights alone.
    #[must_use]
    pub fn at<'b>(&'b self, waves: &'b FitProblem) -> LandingProblem<'b> {
        LandingProblem { waves, ..self.clone() }
    }

    /// Mean windows of the chosen heights, one below the other, g.
    pub fn mean_windows(&self, legs: &Legs, slopes: &Slopes) -> Option<DVector<f64>> {
        let tables = self.tables(legs)?;
        let parts: Vec<f64> =
            tables.iter().flat_map(|table| Population::of(table, slopes).mean_window().iter().copied().collect::<Vec<_>>()).collect();
        Some(DVector::from_vec(parts))
    }

    /// Fits a population with a mount: from the end of one without, and from several frequencies of the mount.
    pub fn fitted_with_mount(&self, without: &LandingFit) -> Option<LandingFit> {
        let at = &without.minimum.at;
        let (legs, slopes) = at.split_at(at.len() - SLOPES);
        let fit = |f_hz: &f64| {
            let start = [legs, &[libm::log(*f_hz), libm::log(PARAMETERS[MOUNT_AT + 1].start)], slopes].concat();
            self.fitted_from(&start, MOST_STEPS[1])
        };
        let best = MOUNTS_HZ.iter().filter_map(fit).min_by(|a, b| a.minimum.sum.total_cmp(&b.minimum.sum))?;
        self.fitted_from(&best.minimum.at, MOST_STEPS[0])
    }

    /// Fits a population: mean waves, and quartiles of the touch times.
    pub fn fitted(&self, from: Option<&LandingFit>) -> Option<LandingFit> {
        let plain = || self.parameters().iter().map(|parameter| parameter.inward(parameter.start)).collect();
        let start = from.map_or_else(plain, |fit: &LandingFit| fit.minimum.at.clone());
        self.fitted_from(&start, MOST_STEPS[usize::from(from.is_some())])
    }

    fn fitted_from(&self, start: &[f64], most_steps: usize) -> Option<LandingFit> {
        let kept = KeptTables::default();
        let residual = |scaled: &[f64]| {
            let (legs, slopes) = meaning(scaled);
            let tables = kept.of(self, &legs)?;
            let mut predicted = Vec::with_capacity(self.waves.len());
            let mut delays = Vec::new();
            for (height, table) in self.waves.chosen.iter().zip(&*tables) {
                let population = Population::of(table, &slopes);
                predicted.extend(population.mean_window().iter());
                let quartiles = self.observed.heights[*height].opposite_quartiles_s()?;
                for ((measured_s, error_s), share) in quartiles.into_iter().zip([0.25, 0.5, 0.75]) {
                    delays.push((measured_s - population.opposite_delay_s(share)) / error_s);
                }
            }
            let waves = self.waves.whitened(&(self.waves.measured() - DVector::from_vec(predicted)));
            Some(DVector::from_iterator(waves.len() + delays.len(), waves.iter().copied().chain(delays)))
        };
        Some(LandingFit::of(minimise(residual, start, &self.bounds(), &self.steps(), most_steps)?))
    }

    /// Fits the legs to single drops, each with the slope that its own touch times show; slopes are distributed as in `population`.
    pub fn fitted_to_drops(&self, population: &LandingFit, from: Option<&LandingFit>) -> Option<LandingFit> {
        let slopes = population.slopes;
        let legs = self.parameters().len() - SLOPES;
        let start: Vec<f64> = from.unwrap_or(population).minimum.at[..legs].to_vec();
        let residual = |scaled: &[f64]| {
            let whole: Vec<f64> = scaled.iter().copied().chain([slopes.rate_rad_s, slopes.at_release_rad]).collect();
            let tables = self.tables(&meaning(&whole).0)?;
            let mut all = Vec::new();
            for (height, table) in self.waves.chosen.iter().zip(&tables) {
                for left in self.left_by_drops(*height, table, &slopes) {
                    all.extend(left.iter().map(|left| left / self.unit_g(*height)));
                }
            }
            Some(DVector::from_vec(all))
        };
        let most_steps = MOST_STEPS[usize::from(from.is_some())];
        let minimum = minimise(residual, &start, &self.bounds()[..legs], &self.steps()[..legs], most_steps)?;
        let at = minimum.at.iter().copied().chain([slopes.rate_rad_s, slopes.at_release_rad]).collect();
        Some(LandingFit::of(Minimum { at, ..minimum }))
    }

    /// What the prediction from their touches leaves of the drops of a height, g.
    pub fn left_by_drops(&self, height: usize, table: &LandingTable, slopes: &Slopes) -> Vec<DVector<f64>> {
        let population = Population::of(table, slopes);
        let left =
            |drop: &ObservedLanding| DVector::from_column_slice(&drop.window) - given_touches(table, &population, &drop.touches).window;
        self.observed.heights[height].drops.iter().map(left).collect()
    }

    /// Root mean square of a height's mean wave, g: readings vary in proportion to it.
    fn unit_g(&self, height: usize) -> f64 {
        let mean = &self.waves.means[height].wave;
        (mean.iter().map(|reading| reading * reading).sum::<f64>() / mean.len() as f64).sqrt().max(1.0)
    }

    /// p-value of one mount for all heights: how far a step of the fit at each height alone, with the mount's numbers free, leads away from
    /// their common values. `None` without a mount, or from one height alone.
    pub fn mount_steady_p(&self, fit: &LandingFit) -> Option<f64> {
        fit.legs.mount?;
        let (samples, heights) = (self.waves.expected.samples, self.waves.chosen.len());
        let columns = [MOUNT_AT, MOUNT_AT + 1];
        let (mut normal_sum, mut right_sum) = (DMatrix::zeros(2, 2), DVector::zeros(2));
        let mut apart = 0.0;
        for at in 0..heights {
            let jacobian = fit.minimum.jacobian.rows(at * samples, samples).select_columns(&columns);
            let (normal, right) =
                (jacobian.transpose() * &jacobian, jacobian.transpose() * fit.minimum.residual.rows(at * samples, samples));
            apart += right.dot(&(inverse(&normal)? * &right));
            normal_sum += normal;
            right_sum += right;
        }
        apart -= right_sum.dot(&(inverse(&normal_sum)? * &right_sum));
        let freedom = columns.len() * heights.checked_sub(1).filter(|free| *free > 0)?;
        Some(ChiSquared::new(freedom as f64).ok()?.sf(apart.max(0.0)))
    }

    /// Change of the predicted mean windows, g, with each parameter on the scale of the fit.
    pub fn sensitivity(&self, fit: &LandingFit) -> Option<DMatrix<f64>> {
        let here = self.mean_windows(&fit.legs, &fit.slopes)?;
        let (steps, bounds) = (self.steps(), self.bounds());
        let mut columns = DMatrix::zeros(here.len(), steps.len());
        for (at, step) in steps.into_iter().enumerate() {
            let mut moved = fit.minimum.at.clone();
            let step = if moved[at] + step > bounds[at][1] { -step } else { step };
            moved[at] += step;
            let (legs, slopes) = meaning(&moved);
            columns.set_column(at, &((self.mean_windows(&legs, &slopes)? - &here) / step));
        }
        Some(columns)
    }

    /// The parameters of a population's fit with intervals, by drops drawn with replacement and one step of the fit for each set.
    ///
    /// Wrong where the fit is far from linear within the interval, or a height has few drops.
    pub fn estimates(&self, fit: &LandingFit, seed: u64) -> Option<Vec<EffectEstimate>> {
        let minimum = &fit.minimum;
        // What lies at a bound is not moved by other drops, or to the inside only: it is left out of the step.
        let parameters = self.parameters();
        let free: Vec<usize> = (0..parameters.len()).filter(|at| !minimum.at_bound[*at]).collect();
        let jacobian = minimum.jacobian.select_columns(&free);
        let step = inverse(&(jacobian.transpose() * &jacobian))? * jacobian.transpose();
        let mut rng = Pcg64::seed_from_u64(seed);
        let moved: Vec<DVector<f64>> = (0..RESAMPLED).filter_map(|_| Some(&step * self.change_by_drawing(&mut rng)?)).collect();
        let estimate = |(at, parameter): (usize, &&'static Parameter)| {
            let Parameter { key, unit, bounds, kind, .. } = **parameter;
            let effect = if kind == Kind::Mount { MOUNT_LOW_PASS } else { LANDING_TILT };
            let scaled = minimum.at[at];
            let column = free.iter().position(|free| *free == at);
            let spread = column.and_then(|column| Spread::middle(moved.iter().map(|step| step[column]), 0.95)).unwrap_or([0.0; 2]);
            let [low, high] = spread.map(|change| parameter.outward(scaled + change).clamp(bounds[0], bounds[1]));
            let value = parameter.outward(scaled);
            EffectEstimate { effect, key, unit, value, ci95: [low, high], at_bound: minimum.at_bound[at] && value > 0.0 }
        };
        Some(parameters.iter().enumerate().map(estimate).collect())
    }

    /// How the residual changes when drops are drawn with replacement, each with its wave and its touches.
    fn change_by_drawing(&self, rng: &mut Pcg64) -> Option<DVector<f64>> {
        let (mut means, mut delays) = (Vec::with_capacity(self.waves.len()), Vec::new());
        for height in &self.waves.chosen {
            let here = &self.observed.heights[*height];
            let drops = (0..here.drops.len()).map(|_| here.drops[rng.random_range(0..here.drops.len())].clone()).collect();
            let drawn = HeightLandings { height_m: here.height_m, drops };
            means.extend((drawn.mean_window() - here.mean_window()).iter());
            let (before, after) = (here.opposite_quartiles_s()?, drawn.opposite_quartiles_s()?);
            delays.extend(before.iter().zip(after).map(|((before_s, error_s), (after_s, _))| (after_s - before_s) / error_s));
        }
        let white = self.waves.whitened(&DVector::from_vec(means));
        Some(DVector::from_iterator(white.len() + delays.len(), white.iter().copied().chain(delays)))
    }
}
