//! How single drops pull at a fit's numbers.

use nalgebra::{DMatrix, DVector};

use crate::impact::fit::Minimum;

/// Of some drops and parameters: the sums of squares of the drops' derivatives, of their scores, and the scores.
pub struct ScoreSums {
    /// Of the derivatives, a row and a column a parameter.
    pub normal: DMatrix<f64>,
    /// Of the scores.
    pub scatter: DMatrix<f64>,
    /// The scores, with which a step of the fit begins.
    pub right: DVector<f64>,
}

impl ScoreSums {
    /// Over drops, by their places below each other in what a fit leaves, of so many readings each, for some of the parameters.
    pub fn of(left: &Minimum, samples: usize, places: std::ops::Range<usize>, columns: &[usize]) -> Self {
        let count = columns.len();
        let mut sums = Self { normal: DMatrix::zeros(count, count), scatter: DMatrix::zeros(count, count), right: DVector::zeros(count) };
        for place in places {
            let jacobian = left.jacobian.rows(place * samples, samples).select_columns(columns);
            let score = jacobian.transpose() * left.residual.rows(place * samples, samples);
            sums.normal += jacobian.transpose() * &jacobian;
            sums.scatter += &score * score.transpose();
            sums.right += score;
        }
        sums
    }
}
