//! Mean waves with their trial covariance, prepared for the diagnosis.

use std::sync::Arc;

use super::candidate::Candidate;
use super::clipping::{Clipping, clipping};
use crate::impact::effects::{Model, SENSOR_SATURATION};
use crate::impact::fit::{CovarianceModel, Expected, FitProblem, TrialCovariance, WaveGroup, Waves, Whitening, outer};
use crate::impact::sim::System;

/// Mean waves and their trial covariance.
#[derive(Clone, Debug)]
pub struct PreparedDrops {
    /// Mean waves, whitened by their covariance.
    pub problem: FitProblem,
    /// How records vary between trials.
    pub trial_covariance: TrialCovariance,
    /// Its model.
    pub covariance_model: CovarianceModel,
    /// Clipping of the readings.
    pub clipping: Option<Clipping>,
}

/// Parameters that may differ from drop to drop: stiffness and damping, the first two of every model.
const VARIED: usize = 2;

/// Clipping this near to the model's own limit is that limit, g.
const NEAR_LIMIT_G: f64 = 3.0;

impl PreparedDrops {
    /// Of measured waves. A first fit of the base model, with a plain covariance, says what phase and
    /// parameters of a drop would do to it.
    pub fn of(waves: &Waves, model: &Model) -> Option<Self> {
        Self::shaped(waves, model.sensor.limit_g, |plain| Candidate::base(plain, model))
    }

    /// The same by the wave of a model with effects. Where a force jumps, the wave of the base model has another shape, and drops that do not
    /// differ in stiffness and damping may seem to.
    pub fn around(waves: &Waves, model: &Model) -> Option<Self> {
        Self::shaped(waves, model.sensor.limit_g, |plain| Some(Candidate::best(plain, [model.clone()])?.settled(plain)))
    }

    /// The same with drops that have one stiffness and one damping; `None` where they have already.
    ///
    /// Readings that vary in proportion to the wave can look as if stiffness varied. Where a force jumps, as dry friction does when the motion
    /// turns back, a prediction that is averaged over stiffness has no jump, and misses the mean wave.
    pub fn alike(&self) -> Option<Self> {
        let expected = Expected { varied: [0.0; VARIED], ..self.problem.expected.clone() };
        let differ = self.problem.expected.varied != expected.varied;
        differ.then(|| Self { problem: FitProblem { expected, ..self.problem.clone() }, ..self.clone() })
    }

    /// By the wave of a fit with a plain covariance.
    fn shaped(waves: &Waves, own_limit_g: f64, fitted: impl FnOnce(&FitProblem) -> Option<Candidate>) -> Option<Self> {
        let trial_covariance = TrialCovariance::of(waves);
        let plain = trial_covariance.plain_covariances();
        let clipping = clipping(waves);
        let spread = clipping.map_or_else(Arc::default, |found| found.spread(waves).into());
        let limit = &SENSOR_SATURATION.parameters[0];
        let below = clipping.filter(|found| found.level_g < own_limit_g - NEAR_LIMIT_G && found.level_g >= limit.min);
        let problem = FitProblem::of(waves, Whitening::of(&plain, trial_covariance.counts())?, spread);
        let problem = FitProblem { seen_limit_g: below.map(|found| found.level_g), ..problem };
        let shape = fitted(&problem)?;
        let system = System::new(shape.model());
        let phases = |group: &WaveGroup| Some(problem.expected.over_phases(&problem.expected.fine(&system, group.height_m)?));
        let phases = waves.groups.iter().map(phases).collect::<Option<Vec<_>>>()?;
        let change = problem.sensitivity(&shape.fitted)?;
        let at = |height: usize, column: usize| change.view((height * waves.samples, column), (waves.samples, 1)).column(0).into_owned();
        let changes = (0..VARIED).map(|column| (0..waves.groups.len()).map(|height| outer(&at(height, column))).collect());
        let covariance_model = trial_covariance.refined(CovarianceModel::of(waves, phases, changes.collect(), &plain)?);
        let whitening = Whitening::of(&trial_covariance.covariances(&covariance_model)?, trial_covariance.counts())?;
        // Stiffness is fitted as its logarithm, damping as it is. Where readings are clipped, the model does not show how a
        // parameter moves them, and the variation beyond the limit is counted already.
        let varied = match trial_covariance.changing(&covariance_model)[..] {
            [stiffness, damping] if clipping.is_none() => [stiffness, damping / shape.model().stiffness_and_damping()[1].max(1.0)],
            _ => [0.0; VARIED],
        };
        let expected = Expected { varied, trigger_jitter: trial_covariance.trigger_jitter(&covariance_model), ..problem.expected.clone() };
        Some(Self { problem: FitProblem { whitening, expected, ..problem }, trial_covariance, covariance_model, clipping })
    }
}
