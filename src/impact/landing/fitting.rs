//! Stiffness, damping, inertia and the spread of slopes, from drops.

use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::LANDING_TILT;
use super::legged_body::{LeggedBody, Legs, Slopes};
use super::observed::{HeightLandings, ObservedLanding, ObservedLandings};
use super::population::Population;
use super::posterior::given_touches;
use super::table::LandingTable;
use crate::impact::diagnose::EffectEstimate;
use crate::impact::effects::Model;
use crate::impact::fit::{FitProblem, Minimum, inverse, minimise};
use crate::impact::measured::Spread;

/// Keys, units and bounds of what is fitted.
const PARAMETERS: [(&str, &str, [f64; 2]); 5] = [
    ("k", "N/m", [300.0, 5e5]),
    ("c", "N s/m", [0.05, 1000.0]),
    ("inertia_kg_m2", "kg m2", [2e-5, 5e-2]),
    ("sigma_r_rad_s", "rad/s", [0.0, 1.5]),
    ("sigma_0_rad", "rad", [0.0, 0.25]),
];
/// The first so many are fitted as logarithms.
const LOGARITHMIC: usize = 3;
/// Steps of difference quotients, on the scale of the fit.
const STEPS: [f64; 5] = [0.02, 0.02, 0.02, 0.01, 0.004];
/// Where fits begin.
const START: [f64; 5] = [1.5e4, 25.0, 1e-3, 0.25, 0.02];
/// Most steps of a fit from the start, and from another fit's end.
const MOST_STEPS: [usize; 2] = [25, 8];
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
}

fn meaning(scaled: &[f64]) -> (Legs, Slopes) {
    let [k, c, i] = [0, 1, 2].map(|at| libm::exp(scaled[at]));
    (Legs { stiffness_n_m: k, damping_n_s_m: c, inertia_kg_m2: i }, Slopes { rate_rad_s: scaled[3], at_release_rad: scaled[4] })
}

fn inward(at: usize, value: f64) -> f64 {
    if at < LOGARITHMIC { libm::log(value) } else { value }
}

fn outward(at: usize, scaled: f64) -> f64 {
    if at < LOGARITHMIC { libm::exp(scaled) } else { scaled }
}

fn bounds() -> [[f64; 2]; 5] {
    std::array::from_fn(|at| PARAMETERS[at].2.map(|bound| inward(at, bound)))
}

impl LandingProblem<'_> {
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

    /// Fits a population: mean waves, and quartiles of the touch times.
    pub fn fitted(&self, from: Option<&LandingFit>) -> Option<LandingFit> {
        let start =
            from.map_or_else(|| START.iter().enumerate().map(|(at, value)| inward(at, *value)).collect(), |fit| fit.minimum.at.clone());
        let residual = |scaled: &[f64]| {
            let (legs, slopes) = meaning(scaled);
            let tables = self.tables(&legs)?;
            let mut predicted = Vec::with_capacity(self.waves.len());
            let mut delays = Vec::new();
            for (height, table) in self.waves.chosen.iter().zip(&tables) {
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
        Some(LandingFit::of(minimise(residual, &start, &bounds(), &STEPS, MOST_STEPS[usize::from(from.is_some())])?))
    }

    /// Fits the legs to single drops, each with the slope that its own touch times show; slopes are distributed as in `population`.
    pub fn fitted_to_drops(&self, population: &LandingFit, from: Option<&LandingFit>) -> Option<LandingFit> {
        let slopes = population.slopes;
        let start: Vec<f64> = from.unwrap_or(population).minimum.at[..LOGARITHMIC].to_vec();
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
        let minimum = minimise(residual, &start, &bounds()[..LOGARITHMIC], &STEPS[..LOGARITHMIC], MOST_STEPS[usize::from(from.is_some())])?;
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

    /// Change of the predicted mean windows, g, with each parameter on the scale of the fit.
    pub fn sensitivity(&self, fit: &LandingFit) -> Option<DMatrix<f64>> {
        let here = self.mean_windows(&fit.legs, &fit.slopes)?;
        let mut columns = DMatrix::zeros(here.len(), PARAMETERS.len());
        for (at, step) in STEPS.into_iter().enumerate() {
            let mut moved = fit.minimum.at.clone();
            let step = if moved[at] + step > bounds()[at][1] { -step } else { step };
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
        let free: Vec<usize> = (0..PARAMETERS.len()).filter(|at| !minimum.at_bound[*at]).collect();
        let jacobian = minimum.jacobian.select_columns(&free);
        let step = inverse(&(jacobian.transpose() * &jacobian))? * jacobian.transpose();
        let mut rng = Pcg64::seed_from_u64(seed);
        let moved: Vec<DVector<f64>> = (0..RESAMPLED).filter_map(|_| Some(&step * self.change_by_drawing(&mut rng)?)).collect();
        let estimate = |(at, (key, unit, bound)): (usize, (&'static str, &'static str, [f64; 2]))| {
            let scaled = minimum.at[at];
            let column = free.iter().position(|free| *free == at);
            let spread = column.and_then(|column| Spread::middle(moved.iter().map(|step| step[column]), 0.95)).unwrap_or([0.0; 2]);
            let [low, high] = spread.map(|change| outward(at, scaled + change).clamp(bound[0], bound[1]));
            let at_bound = minimum.at_bound[at] && outward(at, scaled) > 0.0;
            EffectEstimate { effect: LANDING_TILT, key, unit, value: outward(at, scaled), ci95: [low, high], at_bound }
        };
        Some(PARAMETERS.into_iter().enumerate().map(estimate).collect())
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
