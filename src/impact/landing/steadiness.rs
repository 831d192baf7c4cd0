//! Whether slopes, and the numbers of friction, feet and mount, are those of every height.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::fitting::{LandingFit, LandingProblem};
use super::parameter::Parameter;
use super::score_sums::ScoreSums;
use super::touched_slopes::TouchLikelihood;
use crate::impact::fit::inverse;

impl LandingProblem<'_> {
    /// p-value of one pair of numbers for the slopes of all heights: how much likelier the touch times are with a turning rate of its own at
    /// each height. 1 of one height.
    pub fn slopes_steady_p(&self, fit: &LandingFit) -> Option<f64> {
        let heights = self.heights();
        if heights.len() < 2 {
            return Some(1.0);
        }
        let tables = self.tables(&fit.legs, &fit.slopes)?;
        let fall = TouchLikelihood::of(&heights, &tables)?.fall_with_own_rates(&fit.slopes);
        let numbers = 1 + usize::from(self.parts.at_release);
        let freedom = heights.len().saturating_sub(numbers).max(1);
        Some(ChiSquared::new(freedom as f64).ok()?.sf(fall.max(0.0)))
    }

    /// p-value of one friction, one mass of the feet and one mount for all heights: how far a step of the fit to each height's drops alone, with
    /// these numbers free, leads away from their common values. Errors are by how the drops of a height differ among each other, and the law is
    /// Hotelling's with the heights' drops together: of few drops, only the largest differences are told. `None` without any of them, or from one height
    /// alone.
    pub fn effects_steady_p(&self, fit: &LandingFit) -> Option<f64> {
        let is_effect = |parameter: &Parameter| parameter.kind.is_beside_slopes();
        let columns: Vec<usize> = self.parameters().iter().enumerate().filter(|(_, one)| is_effect(one)).map(|(at, _)| at).collect();
        if columns.is_empty() {
            return None;
        }
        let drops = self.drops_at_fit(fit)?;
        let (heights, samples) = (self.heights(), self.waves.expected.samples);
        let (mut precision_sum, mut weighed_sum) = (DMatrix::zeros(columns.len(), columns.len()), DVector::zeros(columns.len()));
        let (mut chi_squared, mut first, mut differences) = (0.0, 0, 0);
        for height in &heights {
            let count = height.drops.len();
            let ScoreSums { normal, scatter, right } = ScoreSums::of(&drops, samples, first..first + count, &columns);
            first += count;
            differences += count.checked_sub(1).filter(|free| *free > 0)?;
            // Around their mean: the scores of a height add up to nothing at its own best numbers only.
            let scatter = (scatter - &right * right.transpose() / count as f64) * (count as f64 / (count - 1) as f64);
            let step = inverse(&normal)? * right;
            let precision = &normal * inverse(&scatter)? * &normal;
            chi_squared += step.dot(&(&precision * &step));
            weighed_sum += &precision * step;
            precision_sum += precision;
        }
        chi_squared -= weighed_sum.dot(&(inverse(&precision_sum)? * &weighed_sum));
        let freedom = columns.len() * heights.len().checked_sub(1).filter(|free| *free > 0)?;
        let left = (differences + 1).checked_sub(columns.len()).filter(|left| *left > 0)?;
        let ratio = chi_squared.max(0.0) / freedom as f64 * left as f64 / differences as f64;
        Some(FisherSnedecor::new(freedom as f64, left as f64).ok()?.sf(ratio))
    }
}
