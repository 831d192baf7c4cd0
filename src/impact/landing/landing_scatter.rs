//! How the records of one height vary when landings slope at random.
//!
//! Records of random slopes vary late, when only steep landings still push, and there by far more than most records show: a covariance from
//! forty records knows nothing of landings that are steeper than theirs. Of the reading just before the trigger it knows nothing either,
//! where one record in ten has any. So what slopes and the clock's phase do is taken from the simulated population, the rest from the
//! records.
//!
//! *When it is wrong:* where legs or slopes are not the population's, and the sum of both parts then exceeds what the records show.

use nalgebra::{DMatrix, DVector};
use rand::distr::Distribution;
use rand::distr::weighted::WeightedIndex;
use rand_distr::StandardNormal;
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::fitting::{LandingFit, LandingProblem};
use super::population::Population;
use super::record_spread::{SpreadNumbers, numbers, spread_p};
use super::table::{LandingTable, phase_covariance};
use crate::impact::diagnose::{Bootstrap, REPLICATES, Replicate};
use crate::impact::fit::{CovarianceModel, Expected, FitProblem, TrialCovariance, Waves, Whitening};

/// The covariance of records whose landings slope at random.
#[derive(Clone, Debug)]
pub struct LandingScatter {
    trials: TrialCovariance,
    model: CovarianceModel,
    /// By the clock's phase alone, height by height, g².
    phases: Vec<DMatrix<f64>>,
    whitening: Whitening,
}

impl LandingScatter {
    /// Of the fitted heights; `None` where a covariance is degenerate or a landing is lost.
    pub fn of(waves: &Waves, problem: &LandingProblem, fit: &LandingFit) -> Option<Self> {
        let tables = problem.tables(&fit.legs)?;
        let (mut phases, mut known) = (Vec::new(), Vec::new());
        for (group, table) in waves.groups.iter().zip(&tables) {
            let population = Population::of(table, &fit.slopes);
            let expected = &problem.waves.expected;
            let phase = phase_covariance(&problem.body, &fit.legs, problem.model, expected, group.height_m, population.weights())?;
            known.push(population.covariance() + &phase);
            phases.push(phase);
        }
        let trials = TrialCovariance::of(waves);
        let model = trials.refined(CovarianceModel::beside(known, waves, &trials.plain_covariances())?);
        let whitening = Whitening::of(&trials.covariances(&model)?, trials.counts())?;
        Some(Self { trials, model, phases, whitening })
    }

    /// Mean waves compared in units of it.
    pub fn problem(&self, waves: &FitProblem) -> FitProblem {
        let expected = Expected { trigger_jitter: self.trials.trigger_jitter(&self.model), ..waves.expected };
        FitProblem { whitening: self.whitening.clone(), expected, ..waves.clone() }
    }

    /// Mean waves as they could have been measured: slopes are drawn from the population, what else varies is drawn normally.
    pub fn bootstrap(&self, problem: &LandingProblem, fit: &LandingFit, seed: u64) -> Option<Bootstrap> {
        let tables = problem.tables(&fit.legs)?;
        let populations: Vec<Population> = tables.iter().map(|table| Population::of(table, &fit.slopes)).collect();
        let roots = self.roots()?;
        let drawn = |number: usize| {
            let mut rng = Pcg64::new(u128::from(seed), 2 * number as u128 + 1);
            let mut means = Vec::new();
            let mut deviations = Vec::new();
            for (((table, population), root), count) in tables.iter().zip(&populations).zip(&roots).zip(self.trials.counts()) {
                let records = records(table, population, root, *count, &mut rng)?;
                let mean = records.column_mean();
                means.extend((&mean - population.mean_window()).iter());
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

/// Sets of records that are drawn to judge how those that were measured spread.
const SETS: usize = 300;

impl LandingScatter {
    /// Roots of the covariances of what varies beside the slopes, height by height, g.
    fn roots(&self) -> Option<Vec<DMatrix<f64>>> {
        let rest = self.trials.nearest_beside_known(&self.model).into_iter().zip(&self.phases);
        rest.map(|(rest, phases)| Some((rest + phases).cholesky()?.unpack())).collect()
    }

    /// p-value of how single records of the fitted heights spread, under the population.
    pub fn spread_p(&self, problem: &LandingProblem, fit: &LandingFit, waves: &Waves, seed: u64) -> Option<f64> {
        let (tables, roots) = (problem.tables(&fit.legs)?, self.roots()?);
        let populations: Vec<Population> = tables.iter().map(|table| Population::of(table, &fit.slopes)).collect();
        let set = |number: usize| -> Option<SpreadNumbers> {
            let mut rng = Pcg64::new(u128::from(seed), 2 * number as u128);
            let each = tables.iter().zip(&populations).zip(&roots).zip(self.trials.counts());
            each.map(|(((table, population), root), count)| {
                let records = records(table, population, root, *count, &mut rng)?;
                Some(records.column_iter().map(|record| numbers(record.iter().copied())).collect())
            })
            .collect()
        };
        let simulated: Vec<SpreadNumbers> = (0..SETS).into_par_iter().filter_map(set).collect();
        let measured =
            waves.groups.iter().map(|group| group.windows.iter().map(|window| numbers(window.iter().copied())).collect()).collect();
        (!simulated.is_empty()).then(|| spread_p(&measured, &simulated))
    }
}

/// Records of one height, g, a column each.
fn records(table: &LandingTable, population: &Population, root: &DMatrix<f64>, count: usize, rng: &mut Pcg64) -> Option<DMatrix<f64>> {
    let law = WeightedIndex::new(population.weights().iter()).ok()?;
    let mut all = DMatrix::zeros(root.nrows(), count);
    for mut record in all.column_iter_mut() {
        let noise = DVector::from_fn(root.nrows(), |_, _| StandardNormal.sample(rng));
        record.copy_from(&(root * noise + table.windows.column(law.sample(rng))));
    }
    Some(all)
}
