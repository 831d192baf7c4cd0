//! How a fit moves when the drops are others.

use nalgebra::{DMatrix, DVector};

use crate::impact::fit::inverse;

/// How many of a fit's parameters, the last ones, are slopes.
pub const SLOPES: usize = 2;

/// One step of a population's fit, linearised: slopes follow the touch times, legs follow the drops with those slopes.
pub struct FitStep {
    /// The legs' step by a change of the residual.
    legs: DMatrix<f64>,
    /// The slopes' step by a change of the residual.
    slopes: DMatrix<f64>,
    /// Which parameters move; what lies at a bound stays.
    free: [Vec<usize>; 2],
    parameters: usize,
}

impl FitStep {
    /// By how predictions of drops and of touch times change with each parameter; `None` where the fit is degenerate.
    pub fn of(at_bound: &[bool], drops: &DMatrix<f64>, touches: &DMatrix<f64>) -> Option<Self> {
        let parameters = at_bound.len();
        let loose = |all: std::ops::Range<usize>| all.filter(|at| !at_bound[*at]).collect::<Vec<usize>>();
        let free = [loose(0..parameters - SLOPES), loose(parameters - SLOPES..parameters)];
        let [[drops_by_legs, drops_by_slopes], [touches_by_legs, touches_by_slopes]] =
            [drops, touches].map(|change| [change.select_columns(&free[0]), change.select_columns(&free[1])]);
        let solution = |jacobian: &DMatrix<f64>| Some(inverse(&(jacobian.transpose() * jacobian))? * jacobian.transpose());
        // Slopes that explain changed touch times, and how they follow the legs.
        let by_touches = solution(&touches_by_slopes)?;
        let following = -&by_touches * touches_by_legs;
        let legs_by_drops = solution(&(drops_by_legs + &drops_by_slopes * &following))?;
        let legs = side_by_side(&legs_by_drops, &-(&legs_by_drops * drops_by_slopes * &by_touches));
        let none = DMatrix::zeros(by_touches.nrows(), drops.nrows());
        let slopes = side_by_side(&none, &by_touches) + following * &legs;
        Some(Self { legs, slopes, free, parameters })
    }

    /// The step by a change of what was measured.
    pub fn by(&self, change: &DVector<f64>) -> DVector<f64> {
        let mut step = DVector::zeros(self.parameters);
        for (free, moved) in self.free.iter().zip([&self.legs * change, &self.slopes * change]) {
            for (at, value) in free.iter().zip(moved.iter()) {
                step[*at] = *value;
            }
        }
        step
    }
}

fn side_by_side(left: &DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(left.nrows(), left.ncols() + right.ncols());
    all.columns_mut(0, left.ncols()).copy_from(left);
    all.columns_mut(left.ncols(), right.ncols()).copy_from(right);
    all
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Where drops and touch times are linear, a change that other parameters explain leads to these, whatever the fit weighs. What lies
        /// at a bound stays.
        #[test]
        fn analytic_a_change_that_parameters_explain_leads_to_them(
            entries in prop::collection::vec(-1.0_f64..1.0, 5 * (12 + 6)),
            moved in prop::collection::vec(-1.0_f64..1.0, 5),
            held in 0_usize..5,
        ) {
            let jacobian = DMatrix::from_vec(18, 5, entries);
            let (drops, touches) = (jacobian.rows(0, 12).into_owned(), jacobian.rows(12, 6).into_owned());
            let mut moved = DVector::from_vec(moved);
            let mut at_bound = [false; 5];
            (moved[held], at_bound[held]) = (0.0, true);
            let step = FitStep::of(&at_bound, &drops, &touches).expect("is determined").by(&(&jacobian * &moved));
            // The ridge of `inverse`, and how nearly columns may be alike.
            prop_assert!((step - &moved).norm() < 1e-4, "{moved}");
        }
    }
}
