//! A symmetric sparse matrix whose pattern stays while its values change, and its factorisation L D Lᵀ.
//!
//! It is not Cholesky's: past a limit point the tangent is indefinite. There is no pivoting; a pivot of nothing at all is an error.

pub use super::ldlt::SparseError;
use super::ldlt::{Factors, Ldlt};

/// An entry that is left out of the matrix.
pub const NOWHERE: usize = usize::MAX;

/// Where the entries of groups of unknowns stand in the values of the lower triangle.
pub struct Pattern {
    ldlt: Ldlt,
    columns: Vec<usize>,
    rows: Vec<usize>,
}

impl Pattern {
    /// The pattern in which every group is a full block; [`NOWHERE`] among its unknowns is left out.
    ///
    /// # Errors
    /// When the factorisation refuses it.
    pub fn new(size: usize, groups: &[Vec<usize>]) -> Result<Self, SparseError> {
        let mut below: Vec<Vec<usize>> = (0..size).map(|at| vec![at]).collect();
        for group in groups {
            for &column in group.iter().filter(|at| **at != NOWHERE) {
                below[column].extend(group.iter().copied().filter(|row| *row != NOWHERE && *row > column));
            }
        }
        let (mut columns, mut rows) = (vec![0], Vec::new());
        for column in &mut below {
            column.sort_unstable();
            column.dedup();
            rows.extend_from_slice(column);
            columns.push(rows.len());
        }
        Ok(Self { ldlt: Ldlt::new(&columns, &rows)?, columns, rows })
    }

    /// How many values a matrix has.
    pub fn values(&self) -> usize {
        self.rows.len()
    }

    /// How many unknowns.
    pub fn size(&self) -> usize {
        self.columns.len() - 1
    }

    /// Place of an entry among the values, its row and column in any order.
    pub fn place(&self, a: usize, b: usize) -> usize {
        if a == NOWHERE || b == NOWHERE {
            return NOWHERE;
        }
        let (row, column) = (a.max(b), a.min(b));
        let span = self.columns[column]..self.columns[column + 1];
        self.rows[span.clone()].binary_search(&row).map_or(NOWHERE, |at| span.start + at)
    }

    /// The product with a vector.
    pub fn times(&self, values: &[f64], x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; x.len()];
        for column in 0..self.size() {
            let span = self.columns[column]..self.columns[column + 1];
            for (&row, value) in self.rows[span.clone()].iter().zip(&values[span]) {
                y[row] += value * x[column];
                if row != column {
                    y[column] += value * x[row];
                }
            }
        }
        y
    }

    /// The factors of a matrix.
    ///
    /// # Errors
    /// When a pivot is nothing or no number.
    pub fn factorise(&self, values: &[f64], work: &mut Work) -> Result<(), SparseError> {
        self.ldlt.factorise(values, &mut work.factors)
    }

    /// Solves in place, with factors made before.
    pub fn solve(&self, work: &mut Work, rhs: &mut [f64]) {
        self.ldlt.solve(&mut work.factors, rhs);
    }

    /// Room for factorising and solving.
    pub fn work(&self) -> Work {
        Work { factors: self.ldlt.factors() }
    }

    /// How many directions the factorised matrix is unstable in: negative pivots (J. J. Sylvester's law of inertia).
    pub fn negative_pivots(&self, work: &Work) -> usize {
        work.factors.negative_pivots()
    }
}

/// Room for factorising and solving, and the factors.
pub struct Work {
    factors: Factors,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_an_indefinite_matrix_is_solved_and_its_negative_pivots_counted() {
        // [[2, 1, 0], [1, -3, 1], [0, 1, 4]], and a fourth unknown that only meets the third.
        let groups = [vec![0, 1], vec![1, 2], vec![2, 3, NOWHERE]];
        let pattern = Pattern::new(4, &groups).expect("is a pattern");
        let mut values = vec![0.0; pattern.values()];
        for (row, column, value) in [(0, 0, 2.0), (0, 1, 1.0), (1, 1, -3.0), (2, 1, 1.0), (2, 2, 4.0), (3, 3, 1.0), (3, 2, 0.5)] {
            values[pattern.place(row, column)] = value;
        }
        assert_eq!(pattern.place(3, 0), NOWHERE);
        let mut work = pattern.work();
        pattern.factorise(&values, &mut work).expect("is regular");
        let x = [1.0, -2.0, 0.5, 3.0];
        let mut b = pattern.times(&values, &x);
        assert_eq!(b, [0.0, 7.5, 1.5, 3.25]);
        pattern.solve(&mut work, &mut b);
        assert!(b.iter().zip(x).all(|(a, b)| (a - b).abs() < 1e-13), "{b:?}");
        assert_eq!(pattern.negative_pivots(&work), 1);
    }

    /// Nodes of six unknowns in a closed grid, some unknowns held, diagonals of both signs.
    fn grid(across: usize, along: usize) -> (Pattern, Vec<f64>) {
        let size = 6 * across * along - 1;
        let unknowns = |a: usize, b: usize| {
            let node = a % across + across * (b % along);
            (6 * node..6 * node + 6).map(|at| if at < size { at } else { NOWHERE }).collect::<Vec<_>>()
        };
        let nodes = (0..across).flat_map(|a| (0..along).map(move |b| (a, b)));
        let groups: Vec<_> =
            nodes.flat_map(|(a, b)| [(a + 1, b), (a, b + 1)].map(|(c, d)| [unknowns(a, b), unknowns(c, d)].concat())).collect();
        let pattern = Pattern::new(size, &groups).expect("is a pattern");
        let mut values: Vec<f64> = (0..pattern.values()).map(|at| libm::sin(at as f64)).collect();
        for at in 0..size {
            values[pattern.place(at, at)] += if at % 7 < 2 { -20.0 } else { 20.0 };
        }
        (pattern, values)
    }

    #[test]
    fn analytic_pivots_have_the_signs_of_the_eigenvalues_and_solutions_their_residual() {
        for (across, along) in [(1, 1), (1, 9), (3, 4), (5, 7)] {
            let (pattern, values) = grid(across, along);
            let size = pattern.size();
            let x: Vec<f64> = (0..size).map(|at| libm::cos(2.0 * at as f64)).collect();
            let mut work = pattern.work();
            // Twice, since what the first leaves behind must not matter.
            for _ in 0..2 {
                pattern.factorise(&values, &mut work).expect("is regular");
                let mut b = pattern.times(&values, &x);
                pattern.solve(&mut work, &mut b);
                assert!(b.iter().zip(&x).all(|(a, b)| (a - b).abs() < 1e-12), "{across} by {along}");
            }
            let entry = |a, b| values.get(pattern.place(a, b)).copied().unwrap_or(0.0);
            let eigenvalues = nalgebra::DMatrix::from_fn(size, size, entry).symmetric_eigenvalues();
            let negative = eigenvalues.iter().filter(|value| **value < 0.0).count();
            assert!(negative > 0 && negative < size);
            assert_eq!(pattern.negative_pivots(&work), negative, "{across} by {along}");
        }
    }

    #[test]
    fn analytic_a_matrix_without_resistance_is_singular() {
        let pattern = Pattern::new(2, &[vec![0, 1]]).expect("is a pattern");
        let mut work = pattern.work();
        assert_eq!(pattern.factorise(&[1.0, 2.0, 4.0], &mut work), Err(SparseError::Singular));
        assert_eq!(pattern.factorise(&[f64::NAN, 2.0, 4.0], &mut work), Err(SparseError::Singular));
        assert_eq!(pattern.factorise(&[1.0, 2.0, 5.0], &mut work), Ok(()));
    }
}
