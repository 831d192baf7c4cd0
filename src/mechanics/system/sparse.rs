//! A symmetric sparse matrix whose pattern stays while its values change, and its factorisation L D Lᵀ.
//!
//! The factorisation is [`faer`]'s, on one thread, so that the same values give the same bits. It is not Cholesky's: past a
//! limit point the tangent is indefinite. There is no pivoting; a pivot of nothing at all shows as a number that is none.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};

/// An entry that is left out of the matrix.
pub const NOWHERE: usize = usize::MAX;

/// Why a matrix cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SparseError {
    /// The pattern was refused.
    #[error("the pattern of the stiffness matrix was refused: {0}")]
    Pattern(String),
    /// A pivot is no number.
    #[error("the stiffness matrix is singular: something can move without resistance")]
    Singular,
}

/// Where the entries of groups of unknowns stand in the values of the lower triangle.
pub struct Pattern {
    matrix: SymbolicSparseColMat<usize>,
    symbolic: SymbolicCholesky<usize>,
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
        let matrix = SymbolicSparseColMat::new_checked(size, size, columns.clone(), None, rows.clone());
        let symbolic = factorize_symbolic_cholesky(matrix.as_ref(), Side::Lower, SymmetricOrdering::Amd, CholeskySymbolicParams::default())
            .map_err(|error| SparseError::Pattern(error.to_string()))?;
        Ok(Self { matrix, symbolic, columns, rows })
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
    /// When a pivot is no number.
    pub fn factorise(&self, values: &[f64], work: &mut Work) -> Result<(), SparseError> {
        let matrix = SparseColMatRef::new(self.matrix.as_ref(), values);
        let stack = MemStack::new(&mut work.memory);
        let factors = self.symbolic.factorize_numeric_ldlt(
            &mut work.factors,
            matrix,
            Side::Lower,
            Default::default(),
            Par::Seq,
            stack,
            Default::default(),
        );
        factors.map_err(|_| SparseError::Singular)?;
        let sound = work.factors.iter().all(|value| value.is_finite());
        if sound { Ok(()) } else { Err(SparseError::Singular) }
    }

    /// Solves in place, with factors made before.
    pub fn solve(&self, work: &mut Work, rhs: &mut [f64]) {
        let stack = MemStack::new(&mut work.memory);
        let size = rhs.len();
        let rhs = MatMut::from_column_major_slice_mut(rhs, size, 1);
        LdltRef::new(&self.symbolic, &work.factors).solve_in_place_with_conj(Conj::No, rhs, Par::Seq, stack);
    }

    /// Room for factorising and solving.
    pub fn work(&self) -> Work {
        let need = self
            .symbolic
            .factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default())
            .or(self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        Work { factors: vec![0.0; self.symbolic.len_val()], memory: MemBuffer::new(need) }
    }

    /// How many directions the factorised matrix is unstable in: negative pivots (J. J. Sylvester's law of inertia).
    pub fn negative_pivots(&self, work: &Work) -> usize {
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Simplicial(factor) => {
                (0..factor.ncols()).filter(|column| work.factors[factor.col_ptr()[*column]] < 0.0).count()
            }
            SymbolicCholeskyRaw::Supernodal(symbolic) => {
                let factor = faer::sparse::linalg::cholesky::supernodal::SupernodalLdltRef::new(symbolic, &work.factors);
                let of = |block: usize| {
                    let pivots = factor.supernode(block);
                    let pivots = pivots.val();
                    (0..pivots.ncols()).filter(|at| pivots[(*at, *at)] < 0.0).count()
                };
                (0..symbolic.n_supernodes()).map(of).sum()
            }
        }
    }
}

/// Room for factorising and solving, and the factors.
pub struct Work {
    factors: Vec<f64>,
    memory: MemBuffer,
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
}
