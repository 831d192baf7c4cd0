//! The factorisation L D Lᵀ of a sparse symmetric matrix, without pivoting, of which only the numbers change.
//!
//! Rows are eliminated one after another (T. A. Davis, Direct Methods for Sparse Linear Systems, SIAM 2006, section 4.8), in the
//! order of approximate minimum degree. Columns of L with the same rows form a block, which is stored and worked on as a dense
//! matrix: the six unknowns of a node always do. Sums are taken in one order on every processor.

/// Why a matrix cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SparseError {
    /// The pattern was refused.
    #[error("the pattern of the stiffness matrix was refused: {0}")]
    Pattern(String),
    /// A pivot is nothing or no number.
    #[error("the stiffness matrix is singular: something can move without resistance")]
    Singular,
}

/// Neighbouring columns of L with the same rows below them, stored column after column.
struct Block {
    /// First column.
    first: usize,
    /// Number of columns.
    width: usize,
    /// Rows below the last of the columns, ascending.
    below: Vec<usize>,
    /// Place of its first value.
    at: usize,
}

impl Block {
    /// Values of a column.
    fn height(&self) -> usize {
        self.width + self.below.len()
    }

    /// Place of the values of one of its columns.
    fn column(&self, column: usize) -> usize {
        self.at + column * self.height()
    }
}

/// Where the values of L and D stand, for one pattern.
pub struct Ldlt {
    /// The unknown of each row of L.
    unknowns: Vec<usize>,
    /// Of each row of the matrix in the order of elimination: columns up to the diagonal, and the values' places.
    rows: Vec<Vec<(usize, usize)>>,
    blocks: Vec<Block>,
    /// Of each row of L: the blocks with a value in it, ascending; the last holds the diagonal.
    meets: Vec<Vec<usize>>,
    values: usize,
}

/// L, D and the room to work in.
pub struct Factors {
    lower: Vec<f64>,
    pivots: Vec<f64>,
    row: Vec<f64>,
    local: Vec<f64>,
    filled: Vec<usize>,
}

impl Ldlt {
    /// The structure of the factors of a lower triangle, by its columns' starts and its rows.
    ///
    /// # Errors
    /// When the triangle is none.
    pub fn new(columns: &[usize], rows: &[usize]) -> Result<Self, SparseError> {
        let size = columns.len() - 1;
        let (unknowns, place, _) =
            amd::order(size, columns, rows, &amd::Control::default()).map_err(|status| SparseError::Pattern(format!("{status:?}")))?;
        let mut by_row = vec![Vec::new(); size];
        for column in 0..size {
            for at in columns[column]..columns[column + 1] {
                let (a, b) = (place[column], place[rows[at]]);
                by_row[a.max(b)].push((a.min(b), at));
            }
        }
        let (blocks, values) = blocks(lower(&by_row));
        let mut meets = vec![Vec::new(); size];
        for (index, block) in blocks.iter().enumerate() {
            for row in (block.first..block.first + block.width).chain(block.below.iter().copied()) {
                meets[row].push(index);
            }
        }
        Ok(Self { unknowns, rows: by_row, blocks, meets, values })
    }

    /// Room for the factors.
    pub fn factors(&self) -> Factors {
        let (size, highest) = (self.unknowns.len(), self.blocks.iter().map(Block::height).max().unwrap_or(0));
        Factors {
            lower: vec![0.0; self.values],
            pivots: vec![0.0; size],
            row: vec![0.0; size],
            local: vec![0.0; highest],
            filled: vec![0; self.blocks.len()],
        }
    }

    /// The factors of a matrix.
    ///
    /// # Errors
    /// When a pivot is nothing or no number.
    pub fn factorise(&self, values: &[f64], factors: &mut Factors) -> Result<(), SparseError> {
        factors.filled.fill(0);
        factors.row.fill(0.0);
        for (row, entries) in self.rows.iter().enumerate() {
            for &(column, at) in entries {
                factors.row[column] = values[at];
            }
            let mut pivot = std::mem::take(&mut factors.row[row]);
            for &block in &self.meets[row] {
                pivot -= self.eliminate(block, row, factors);
            }
            if pivot == 0.0 || !pivot.is_finite() {
                return Err(SparseError::Singular);
            }
            factors.pivots[row] = pivot;
        }
        Ok(())
    }

    /// Takes the columns of a block out of a row, and stores the row's part of L. What it takes from the pivot.
    fn eliminate(&self, index: usize, row: usize, factors: &mut Factors) -> f64 {
        let Factors { lower, pivots, row: open, local, filled } = factors;
        let block = &self.blocks[index];
        let width = block.width.min(row - block.first);
        let known = filled[index];
        // Inside the block only the columns before the row's own matter, and no row below is there yet.
        let (place, below) = if width < block.width { (width, 0) } else { (width + known, known) };
        let local = &mut local[..width + below];
        let (head, tail) = local.split_at_mut(width);
        head.copy_from_slice(&open[block.first..block.first + width]);
        tail.fill(0.0);
        for column in 0..width {
            let start = block.column(column);
            let (done, rest) = local.split_at_mut(column + 1);
            subtract(rest, &lower[start + column + 1..start + width + below], done[column]);
        }
        for (&at, change) in block.below.iter().zip(&local[width..]) {
            open[at] += change;
        }
        let mut taken = 0.0;
        for (column, &entry) in local[..width].iter().enumerate() {
            let factor = entry / pivots[block.first + column];
            lower[block.column(column) + place] = factor;
            open[block.first + column] = 0.0;
            taken += factor * entry;
        }
        if width == block.width {
            filled[index] += 1;
        }
        taken
    }

    /// Solves in place.
    pub fn solve(&self, factors: &mut Factors, rhs: &mut [f64]) {
        let Factors { lower, pivots, row: x, local, .. } = factors;
        for (x, unknown) in x.iter_mut().zip(&self.unknowns) {
            *x = rhs[*unknown];
        }
        for block in &self.blocks {
            let local = &mut local[..block.height()];
            local[..block.width].copy_from_slice(&x[block.first..block.first + block.width]);
            local[block.width..].fill(0.0);
            for column in 0..block.width {
                let start = block.column(column);
                let (done, rest) = local.split_at_mut(column + 1);
                subtract(rest, &lower[start + column + 1..start + block.height()], done[column]);
            }
            x[block.first..block.first + block.width].copy_from_slice(&local[..block.width]);
            for (&at, change) in block.below.iter().zip(&local[block.width..]) {
                x[at] += change;
            }
        }
        x.iter_mut().zip(pivots).for_each(|(x, pivot)| *x /= *pivot);
        for block in self.blocks.iter().rev() {
            let local = &mut local[..block.height()];
            local[..block.width].copy_from_slice(&x[block.first..block.first + block.width]);
            for (value, &at) in local[block.width..].iter_mut().zip(&block.below) {
                *value = x[at];
            }
            for column in (0..block.width).rev() {
                let start = block.column(column);
                local[column] -= product(&local[column + 1..], &lower[start + column + 1..start + block.height()]);
            }
            x[block.first..block.first + block.width].copy_from_slice(&local[..block.width]);
        }
        for (x, unknown) in x.iter().zip(&self.unknowns) {
            rhs[*unknown] = *x;
        }
    }
}

impl Factors {
    /// How many pivots are negative.
    pub fn negative_pivots(&self) -> usize {
        self.pivots.iter().filter(|pivot| **pivot < 0.0).count()
    }
}

/// Takes a multiple of a vector from another.
fn subtract(from: &mut [f64], column: &[f64], times: f64) {
    for (value, entry) in from.iter_mut().zip(column) {
        *value -= times * entry;
    }
}

/// Sum of products, in four sums that a processor can take side by side.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (fours_a, fours_b) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = fours_a.remainder().iter().zip(fours_b.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in fours_a.zip(fours_b) {
        for at in 0..4 {
            sums[at] += a[at] * b[at];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Rows below the diagonal of each column of L: the matrix's own, and those of every column whose first row this one is.
fn lower(by_row: &[Vec<(usize, usize)>]) -> Vec<Vec<usize>> {
    let mut below: Vec<Vec<usize>> = vec![Vec::new(); by_row.len()];
    for (row, entries) in by_row.iter().enumerate() {
        entries.iter().filter(|(column, _)| *column < row).for_each(|(column, _)| below[*column].push(row));
    }
    for column in 0..below.len() {
        below[column].sort_unstable();
        below[column].dedup();
        if let [next, rest @ ..] = &below[column].clone()[..] {
            below[*next].extend_from_slice(rest);
        }
    }
    below
}

/// Columns of L gathered into blocks, and the number of their values.
fn blocks(below: Vec<Vec<usize>>) -> (Vec<Block>, usize) {
    let mut blocks: Vec<Block> = Vec::new();
    for (column, below) in below.into_iter().enumerate() {
        match blocks.last_mut() {
            // The column before has this row first, so its other rows are among this one's: as many are the same.
            Some(block) if block.below.first() == Some(&column) && block.below.len() == below.len() + 1 => {
                block.width += 1;
                block.below = below;
            }
            _ => blocks.push(Block { first: column, width: 1, below, at: 0 }),
        }
    }
    let mut values = 0;
    for block in &mut blocks {
        block.at = values;
        values += block.width * block.height();
    }
    (blocks, values)
}
