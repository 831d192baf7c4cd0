//! How the records of one height vary when landings slope at random.
//!
//! Records of random slopes vary late, when only steep landings still push, and there by far more than most records show: a covariance from
//! forty records knows nothing of landings that are steeper than theirs. Of the reading just before the trigger it knows nothing either,
//! where one record in ten has any. So what slopes and the clock's phase do is taken from the simulated population, the rest from the
//! records.
//!
//! *When it is wrong:* where legs or slopes are not the population's, and the sum of both parts then exceeds what the records show.

use nalgebra::{DMatrix, DVector};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::descent::Descent;
use super::fitting::{LandingFit, LandingProblem};
use super::legged_body::{Legs, Slopes};
use super::population::Population;
use super::record_spread::{NUMBERS, SpreadNumbers, numbers, spread_p};
use super::simulated_drops::SimulatedDrops;
use super::table::{LandingTable, phase_covariance};
use super::uncertainty::FitUncertainty;
use crate::impact::diagnose::{Bootstrap, REPLICATES, Replicate};
use crate::impact::fit::{CovarianceModel, FitProblem, TrialCovariance, Waves, Whitening};

/// The covariance of records whose landings slope at random.
#[derive(Clone, Debug)]
pub struct LandingScatter {
    trials: TrialCovariance,
    model: CovarianceModel,
    whitening: Whitening,
}

impl LandingScatter {
    /// Of the fitted heights; `None` where a covariance is degenerate or a landing is lost.
    pub fn of(waves: &Waves, problem: &LandingProblem, fit: &LandingFit) -> Option<Self> {
        let tables = problem.tables(&fit.legs, &fit.slopes)?;
        let mut known = Vec::new();
        for (group, table) in waves.groups.iter().zip(tables.iter()) {
            let population = Population::of(table, &fit.slopes);
            let expected = &problem.waves.expected;
            let descent = Descent::of(problem.model, &fit.slopes, group.height_m);
            let phase = phase_covariance(&problem.body, &fit.legs, descent, problem.model, expected, population.weights())?;
            known.push(population.covariance() + phase);
        }
        let trials = TrialCovariance::of(waves);
        let model = trials.refined(CovarianceModel::beside(known, waves, &trials.plain_covariances())?);
        let whitening = Whitening::of(&trials.covariances(&model)?, trials.counts())?;
        Some(Self { trials, model, whitening })
    }

    /// Mean waves compared in units of it.
    pub fn problem(&self, waves: &FitProblem) -> FitProblem {
        FitProblem { whitening: self.whitening.clone(), ..waves.clone() }
    }

    /// Mean waves as they could have been measured: of drawn records.
    pub fn bootstrap(&self, problem: &LandingProblem, fit: &LandingFit, seed: u64) -> Option<Bootstrap> {
        let simulated =
            simulated(problem, &problem.tables(&fit.legs, &fit.slopes)?, &fit.slopes, &mut Pcg64::new(u128::from(seed), 1 << 32))?;
        let expected: Vec<DVector<f64>> = simulated.iter().map(SimulatedDrops::mean).collect();
        let drawn = |number: usize| {
            let mut rng = Pcg64::new(u128::from(seed), 2 * number as u128 + 1);
            let mut means = Vec::new();
            let mut deviations = Vec::new();
            for ((drops, expected), count) in simulated.iter().zip(&expected).zip(self.trials.counts()) {
                let records = DMatrix::from_columns(&(0..*count).map(|_| drops.record(&mut rng)).collect::<Vec<_>>());
                let mean = records.column_mean();
                means.extend((&mean - expected).iter());
                let mut off = records;
                off.column_iter_mut().for_each(|mut column| column -= &mean);
                deviations.push(off);
            }
            let covariances = TrialCovariance::of_deviations(&deviations).covariances(&self.model)?;
            Some(Replicate { deviation: DVector::from_vec(means), whitening: Whitening::of(&covariances, self.trials.counts())? })
        };
        let each: Vec<Replicate> = (0..REPLICATES).into_par_iter().filter_map(drawn).collect();
        (each.len() >= REPLICATES / 2).then(|| Bootstrap { whitening: self.whitening.clone(), each })
    }
}

/// Populations that may be the true one, and sets of records of each, that are drawn to judge how those that were measured spread.
const POPULATIONS: usize = 20;
const SETS: usize = 15;

impl LandingScatter {
    /// p-value of how single records of the fitted heights spread, under populations that may be the true one: how records spread is not
    /// fitted, so what is not known of legs and slopes moves it, too.
    pub fn spread_p(
        &self,
        problem: &LandingProblem,
        fit: &LandingFit,
        uncertainty: &FitUncertainty,
        waves: &Waves,
        seed: u64,
    ) -> Option<f64> {
        let drawn = uncertainty.drawn(problem, fit, POPULATIONS, seed)?;
        let sets = |(place, (legs, slopes)): (usize, &(Legs, Slopes))| -> Option<Vec<SpreadNumbers>> {
            let mut rng = Pcg64::new(u128::from(seed), 2 * place as u128);
            let simulated = simulated(problem, &problem.tables(legs, slopes)?, slopes, &mut rng)?;
            let mut height = |(drops, count): (&SimulatedDrops, &usize)| -> Vec<[f64; NUMBERS]> {
                (0..*count).map(|_| numbers(drops.record(&mut rng).iter().copied())).collect()
            };
            Some((0..SETS).map(|_| simulated.iter().zip(self.trials.counts()).map(&mut height).collect()).collect())
        };
        let simulated: Vec<SpreadNumbers> = drawn.par_iter().enumerate().filter_map(sets).flatten_iter().collect();
        let measured =
            waves.groups.iter().map(|group| group.windows.iter().map(|window| numbers(window.iter().copied())).collect()).collect();
        (!simulated.is_empty()).then(|| spread_p(&measured, &simulated))
    }
}

/// Drops of each height.
fn simulated(problem: &LandingProblem, tables: &[LandingTable], slopes: &Slopes, rng: &mut Pcg64) -> Option<Vec<SimulatedDrops>> {
    tables.iter().enumerate().map(|(height, table)| SimulatedDrops::of(problem, height, table, slopes, rng)).collect()
}
