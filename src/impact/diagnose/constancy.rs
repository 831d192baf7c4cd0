//! Whether an effect's parameters are the same at every height, as those of a true effect are.

use super::candidate::Candidate;
use crate::impact::fit::{FitProblem, Layout};
use crate::units::GRAVITY_M_S2;

/// One parameter, estimated at each height alone.
#[derive(Clone, Debug, PartialEq)]
pub struct ByHeight {
    /// Effect's id.
    pub effect: &'static str,
    /// Parameter's key.
    pub key: &'static str,
    /// Height, m, value in the file's unit, and its standard error on the fit's scale.
    pub values: Vec<(f64, f64, f64)>,
    /// Slope of its logarithm over that of the impact speed: 0 if it is constant, 1 if it is a length that represents a fixed time.
    pub slope: Option<f64>,
}

/// A candidate's parameters, height by height.
#[derive(Clone, Debug, PartialEq)]
pub struct Constancy {
    /// What letting them differ takes off the sum of squares.
    pub gain: f64,
    /// How many numbers that costs.
    pub freedom: usize,
    /// p-value of such a gain.
    pub p: f64,
    /// The values.
    pub parameters: Vec<ByHeight>,
}

/// p-value below which parameters are not the same at all heights.
pub const UNSTEADY: f64 = 1e-4;
/// Steps of a fit at one height.
const STEPS: usize = 10;
/// Smallest p-value that is distinguished from zero.
const LEAST_P: f64 = 1e-12;

/// Refits a candidate at each height alone; `None` for a single height.
pub fn constancy(problem: &FitProblem, candidate: &Candidate) -> Option<Constancy> {
    if problem.chosen.len() < 2 {
        return None;
    }
    let layout = &candidate.fitted.layout;
    let alone = |height: &usize| problem.at(&[*height]).fit(Layout { model: layout.model.clone(), free: layout.free.clone() }, STEPS);
    let fits = problem.chosen.iter().map(alone).collect::<Option<Vec<_>>>()?;
    let gain = (candidate.fitted.chi2() - fits.iter().map(|fit| fit.chi2()).sum::<f64>()).max(0.0);
    let freedom = layout.free.len() * (problem.chosen.len() - 1);
    let parameters = layout
        .free
        .iter()
        .enumerate()
        .skip(2)
        .map(|(i, free)| {
            let values: Vec<(f64, f64, f64)> = problem
                .chosen
                .iter()
                .zip(&fits)
                .map(|(height, fit)| {
                    let normal = fit.minimum.jacobian.transpose() * &fit.minimum.jacobian;
                    let sd = crate::impact::fit::inverse(&normal).map_or(f64::INFINITY, |inverse| inverse[(i, i)].sqrt());
                    (problem.means[*height].height_m, free.outward(fit.minimum.at[i]), sd)
                })
                .collect();
            ByHeight { effect: free.spec.id, key: free.key(), slope: slope(&values), values }
        })
        .collect();
    Some(Constancy { gain, freedom, p: upper_tail(gain, freedom).max(LEAST_P), parameters })
}

/// Slope of ln(value) over ln(impact speed); `None` where values change their sign.
fn slope(values: &[(f64, f64, f64)]) -> Option<f64> {
    if values.iter().any(|(_, value, _)| *value * values[0].1 <= 0.0) {
        return None;
    }
    let points: Vec<(f64, f64)> =
        values.iter().map(|(height_m, value, _)| (0.5 * libm::log(2.0 * GRAVITY_M_S2 * height_m), libm::log(value.abs()))).collect();
    let count = points.len() as f64;
    let (mx, my) = (points.iter().map(|p| p.0).sum::<f64>() / count, points.iter().map(|p| p.1).sum::<f64>() / count);
    let (sxy, sxx) = points.iter().fold((0.0, 0.0), |(sxy, sxx), (x, y)| (sxy + (x - mx) * (y - my), sxx + (x - mx) * (x - mx)));
    (sxx > 0.0).then(|| sxy / sxx)
}

/// Probability that a sum of squares of `freedom` normal numbers exceeds a value: by the recurrence of the incomplete gamma function.
pub(super) fn upper_tail(value: f64, freedom: usize) -> f64 {
    let half = 0.5 * value;
    let (mut sum, mut term, mut at) = if freedom.is_multiple_of(2) {
        (0.0, libm::exp(-half), 1.0)
    } else {
        (libm::erfc(half.sqrt()), libm::exp(-half) * 2.0 * (half / std::f64::consts::PI).sqrt(), 1.5)
    };
    for _ in 0..freedom / 2 {
        sum += term;
        term *= half / at;
        at += 1.0;
    }
    sum.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_tails_of_the_tables() {
        for (value, freedom, expected) in
            [(3.841, 1, 0.05), (5.991, 2, 0.05), (7.815, 3, 0.05), (9.488, 4, 0.05), (18.307, 10, 0.05), (30.578, 15, 0.01)]
        {
            assert!((upper_tail(value, freedom) - expected).abs() < 1e-4, "{value} {freedom}: {}", upper_tail(value, freedom));
        }
    }
}
