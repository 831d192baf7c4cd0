//! From drops to mean waves with their scatter: what every question is put to.

use nalgebra::DMatrix;

use super::candidate::Candidate;
use super::flat_top::{FlatTop, flat_top};
use crate::impact::effects::Model;
use crate::impact::fit::{Expected, Family, Problem, Scatter, Waves, Whitening};
use crate::impact::sim::System;

/// How often scatter is compared in units of what it was found to be.
const REFINEMENTS: usize = 3;

/// Mean waves and how they scatter.
#[derive(Clone, Debug)]
pub struct Ground {
    /// Mean waves, whitened by the scatter.
    pub problem: Problem,
    /// How records differ.
    pub scatter: Scatter,
    /// What that can look like.
    pub family: Family,
    /// A limit that shows in the readings.
    pub flat_top: Option<FlatTop>,
}

impl Ground {
    /// Of measured waves. A first fit of the base model, with a scatter of which nothing is known, says what phase and
    /// parameters of a drop would do to it.
    pub fn of(waves: &Waves, model: &Model) -> Option<Self> {
        let scatter = Scatter::of(waves);
        let plain = scatter.plain_covariances();
        let flat_top = flat_top(waves);
        let spread = flat_top.map_or(0.0, |found| found.spread);
        let problem = Problem::of(waves, Whitening::of(&plain, scatter.counts())?, spread);
        let base = Candidate::base(&problem, model)?;
        let system = System::new(base.model());
        let fine = waves.groups.iter().map(|group| problem.expected.fine(&system, group.height_m)).collect::<Option<Vec<_>>>()?;
        let change = problem.sensitivity(&base.fitted)?;
        let changes: Vec<DMatrix<f64>> =
            (0..waves.groups.len()).map(|height| change.rows(height * waves.samples, waves.samples).into_owned()).collect();
        let mut family = Family::of(waves, &problem.expected, &fine, &changes, &plain)?;
        for _ in 0..REFINEMENTS {
            let near = scatter.nearest(&family);
            family = family.near(&near);
        }
        let whitening = Whitening::of(&scatter.covariances(&family)?, scatter.counts())?;
        // Stiffness is fitted as its logarithm, damping as it is. Where readings are cut, the base model says nothing of how a
        // parameter moves them, and the scatter beyond the cut is counted already.
        let varied = match scatter.changing(&family)[..] {
            [stiffness, damping, ..] if spread == 0.0 => [stiffness, damping / base.model().stiffness_and_damping()[1].max(1.0)],
            _ => [0.0; 2],
        };
        let expected = Expected { varied, flicker: scatter.flicker(&family), ..problem.expected };
        Some(Self { problem: Problem { whitening, expected, ..problem }, scatter, family, flat_top })
    }
}
