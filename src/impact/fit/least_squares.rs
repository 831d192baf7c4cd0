//! Least squares within bounds: the method of Levenberg and Marquardt on the parameters that are not at a bound.
//!
//! D. W. Marquardt, J. Soc. Indust. Appl. Math. 11 (1963) 431. Why not a library: docs/decisions/0016-least-squares.md.

use nalgebra::{DMatrix, DVector};

/// A minimum within bounds.
#[derive(Clone, Debug)]
pub struct Minimum {
    /// Where.
    pub at: Vec<f64>,
    /// Residual there.
    pub residual: DVector<f64>,
    /// Change of the *prediction*: minus that of the residual.
    pub jacobian: DMatrix<f64>,
    /// Sum of squares.
    pub sum: f64,
    /// Which parameters lie at a bound.
    pub at_bound: Vec<bool>,
    /// Whether no step was left that lowers the sum; otherwise more steps were needed than were allowed.
    pub settled: bool,
}

/// Fall of the sum of squares, absolute, below which a step is the last: far below what any decision rests on.
const ENOUGH: f64 = 1e-3;
/// Damping to begin with.
const DAMPING: f64 = 1e-3;
/// Damping at which no step is left to try.
const MOST_DAMPING: f64 = 1e8;

/// Regularises parameters that change nearly the same.
const RIDGE: f64 = 1e-10;

/// Minimises the sum of squares of `residual`; `None` where it has no value at the start.
pub fn minimise(
    residual: impl Fn(&[f64]) -> Option<DVector<f64>>,
    start: &[f64],
    bounds: &[[f64; 2]],
    steps: &[f64],
    most_steps: usize,
) -> Option<Minimum> {
    minimise_until(ENOUGH, residual, start, bounds, steps, most_steps)
}

/// The same, until a step lowers the sum by less than `enough`.
pub fn minimise_until(
    enough: f64,
    residual: impl Fn(&[f64]) -> Option<DVector<f64>>,
    start: &[f64],
    bounds: &[[f64; 2]],
    steps: &[f64],
    most_steps: usize,
) -> Option<Minimum> {
    let mut at: Vec<f64> = start.iter().zip(bounds).map(|(value, [min, max])| value.clamp(*min, *max)).collect();
    let mut here = residual(&at)?;
    let mut sum = here.norm_squared();
    let mut damping = DAMPING;
    let mut jacobian = quotients(&residual, &at, &here, bounds, steps);
    let mut settled = false;
    for _ in 0..most_steps {
        let Some((next, there)) = step(&residual, &at, &here, &jacobian, bounds, &mut damping) else {
            settled = true;
            break;
        };
        let fell = sum - there.norm_squared();
        (at, here, sum) = (next, there.clone(), there.norm_squared());
        jacobian = quotients(&residual, &at, &here, bounds, steps);
        if fell < enough {
            settled = true;
            break;
        }
    }
    let at_bound = at_bounds(&at, bounds);
    Some(Minimum { at, residual: here, jacobian, sum, at_bound, settled })
}

/// Part of the room between two bounds that still belongs to a bound: a fit that runs towards it ends a little before.
const NEAR_BOUND: f64 = 2e-4;

/// Which values lie at a bound.
pub fn at_bounds(at: &[f64], bounds: &[[f64; 2]]) -> Vec<bool> {
    at.iter().zip(bounds).map(|(value, [min, max])| (value - min).min(max - value) <= NEAR_BOUND * (max - min)).collect()
}

/// A step that lowers the sum; `None` where there is none.
fn step(
    residual: &impl Fn(&[f64]) -> Option<DVector<f64>>,
    at: &[f64],
    here: &DVector<f64>,
    jacobian: &DMatrix<f64>,
    bounds: &[[f64; 2]],
    damping: &mut f64,
) -> Option<(Vec<f64>, DVector<f64>)> {
    let (normal, gradient) = (jacobian.transpose() * jacobian, jacobian.transpose() * here);
    while *damping < MOST_DAMPING {
        let next = bounded(at, &direction(&normal, &gradient, at, bounds, *damping)?, bounds);
        if next.iter().zip(at).all(|(a, b)| a == b) {
            return None;
        }
        if let Some(there) = residual(&next).filter(|there| there.norm_squared() < here.norm_squared()) {
            *damping = (*damping / 9.0).max(1e-9);
            return Some((next, there));
        }
        *damping *= 8.0;
    }
    None
}

/// Damped step of those parameters that the gradient does not push against a bound.
fn direction(normal: &DMatrix<f64>, gradient: &DVector<f64>, at: &[f64], bounds: &[[f64; 2]], damping: f64) -> Option<DVector<f64>> {
    let held = |i: usize| (at[i] <= bounds[i][0] && gradient[i] < 0.0) || (at[i] >= bounds[i][1] && gradient[i] > 0.0);
    let loose: Vec<usize> = (0..at.len()).filter(|i| !held(*i)).collect();
    let small = DMatrix::from_fn(loose.len(), loose.len(), |i, j| {
        let extra = if i == j { damping * normal[(loose[i], loose[i])] } else { 0.0 };
        normal[(loose[i], loose[j])] + extra
    });
    let right = DVector::from_fn(loose.len(), |i, _| gradient[loose[i]]);
    let solved = inverse(&small)? * right;
    let mut step = DVector::zeros(at.len());
    for (i, value) in loose.iter().zip(solved.iter()) {
        step[*i] = *value;
    }
    Some(step)
}

/// Inverse of a normal matrix, whatever the units of its parameters; a parameter that changes nothing stays.
pub fn inverse(normal: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let sizes = normal.diagonal().map(|square| if square > 0.0 { square.sqrt() } else { 1.0 });
    let scaled = DMatrix::from_fn(normal.nrows(), normal.ncols(), |i, j| {
        let own = if i == j { RIDGE + f64::from(u8::from(normal[(i, i)] <= 0.0)) } else { 0.0 };
        normal[(i, j)] / (sizes[i] * sizes[j]) + own
    });
    let inverse = scaled.cholesky()?.inverse();
    Some(DMatrix::from_fn(normal.nrows(), normal.ncols(), |i, j| inverse[(i, j)] / (sizes[i] * sizes[j])))
}

fn bounded(at: &[f64], step: &DVector<f64>, bounds: &[[f64; 2]]) -> Vec<f64> {
    at.iter().zip(step.iter()).zip(bounds).map(|((value, step), [min, max])| (value + step).clamp(*min, *max)).collect()
}

/// Difference quotients of the prediction, inward where a bound is near; no change where there is no value.
fn quotients(
    residual: &impl Fn(&[f64]) -> Option<DVector<f64>>,
    at: &[f64],
    here: &DVector<f64>,
    bounds: &[[f64; 2]],
    steps: &[f64],
) -> DMatrix<f64> {
    let mut columns = DMatrix::zeros(here.len(), at.len());
    for i in 0..at.len() {
        let step = if at[i] + steps[i] > bounds[i][1] { -steps[i] } else { steps[i] };
        let mut moved = at.to_vec();
        moved[i] += step;
        if let Some(there) = residual(&moved) {
            columns.set_column(i, &((here - there) / step));
        }
    }
    columns
}
