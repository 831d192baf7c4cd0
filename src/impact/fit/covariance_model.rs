//! The model of a trial covariance: a sum of variance components whose amounts are estimated from the records.

use nalgebra::{DMatrix, DVector};

use super::trigger_jitter::{TIMES_S, TriggerJitter};
use super::waves::{BEFORE, Waves};

/// Most sets tried.
const ROUNDS: usize = 60;
/// Components before those of changing parameters, without that of the phase.
const GENERAL: usize = 4;
/// Which of them is one factor a record.
const COMMON: usize = 2;
/// Regularises components that are nearly the same.
const RIDGE: f64 = 1e-9;

/// A sum of variance components, each a covariance of one record at every height.
#[derive(Clone, Debug)]
pub struct CovarianceModel {
    /// Kind by component, height by height, g².
    components: Vec<Vec<DMatrix<f64>>>,
    /// Whether the first of them is the clock's phase.
    phases: usize,
    /// How many of them are changes of parameters.
    changes: usize,
    /// What does not have to be estimated, height by height, g²; nothing where it is empty.
    known: Vec<DMatrix<f64>>,
    /// The metric in which covariances are compared.
    metric: Metric,
}

/// Roots of covariances near the true ones: in their units every part of a covariance is known equally well.
#[derive(Clone, Debug)]
struct Metric {
    inverse_roots: Vec<DMatrix<f64>>,
    /// Components in it, each a column, and their inner products.
    columns: DMatrix<f64>,
    gram: DMatrix<f64>,
}

impl Metric {
    fn of(components: &[Vec<DMatrix<f64>>], near: &[DMatrix<f64>]) -> Option<Self> {
        let inverse_roots: Vec<DMatrix<f64>> = near.iter().map(inverse_root).collect::<Option<_>>()?;
        let columns: Vec<DVector<f64>> = components.iter().map(|component| flat(&inverse_roots, component)).collect();
        let columns = DMatrix::from_columns(&columns);
        let gram = columns.transpose() * &columns;
        Some(Self { inverse_roots, columns, gram })
    }
}

/// Inverse of a covariance's lower root; `None` when it is not positive definite.
pub fn inverse_root(covariance: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let root = covariance.clone().cholesky()?.unpack();
    root.solve_lower_triangular(&DMatrix::identity(root.nrows(), root.nrows()))
}

fn flat(inverse_roots: &[DMatrix<f64>], covariances: &[DMatrix<f64>]) -> DVector<f64> {
    let all = inverse_roots.iter().zip(covariances).flat_map(|(inverse, matrix)| {
        let white = inverse * matrix * inverse.transpose();
        white.as_slice().to_vec()
    });
    DVector::from_vec(all.collect())
}

impl CovarianceModel {
    /// Components for measured waves: the clock's phase ([`Expected::over_phases`], a height each), coloured noise in proportion to the
    /// wave and to its peak, white noise, and records that differ by a factor or by a parameter (`changes`: component by component, a
    /// height each), g².
    ///
    /// `near` are covariances to begin with; `None` when one is not positive definite.
    ///
    /// [`Expected::over_phases`]: super::Expected::over_phases
    pub fn of(waves: &Waves, phases: Vec<DMatrix<f64>>, changes: Vec<Vec<DMatrix<f64>>>, near: &[DMatrix<f64>]) -> Option<Self> {
        let changing = changes.len();
        let components = [vec![phases], general(waves), changes, coloured(waves)].concat();
        let metric = Metric::of(&components, near)?;
        Some(Self { components, phases: 1, changes: changing, known: Vec::new(), metric })
    }

    /// Components beside a part that is known, a height each, g²: noise, and records that differ by a factor.
    pub fn beside(known: Vec<DMatrix<f64>>, waves: &Waves, near: &[DMatrix<f64>]) -> Option<Self> {
        let components = [general(waves), coloured(waves)].concat();
        let metric = Metric::of(&components, near)?;
        Some(Self { components, phases: 0, changes: 0, known, metric })
    }

    /// Standard deviations of the parameters of change in the sum that is nearest to covariances, on their own scales.
    pub fn changing(&self, covariances: &[DMatrix<f64>]) -> Vec<f64> {
        let amounts = self.amounts(covariances);
        (0..self.changes).map(|change| amounts[self.phases + GENERAL + change].max(0.0).sqrt()).collect()
    }

    /// Variation in proportion to the wave in the sum that is nearest to covariances.
    pub fn trigger_jitter(&self, covariances: &[DMatrix<f64>]) -> TriggerJitter {
        let amounts = self.amounts(covariances);
        let coloured = self.phases + GENERAL + self.changes;
        let at = |time: usize| if time < TIMES_S.len() { coloured + 2 * time } else { self.phases + COMMON };
        TriggerJitter { by_time: std::array::from_fn(|time| amounts[at(time)]) }
    }

    /// The same, comparing in units of other covariances.
    #[must_use]
    pub fn near(self, near: &[DMatrix<f64>]) -> Self {
        let metric = Metric::of(&self.components, near);
        Self { metric: metric.unwrap_or(self.metric), ..self }
    }

    fn amounts(&self, covariances: &[DMatrix<f64>]) -> DVector<f64> {
        let mut estimated = covariances.to_vec();
        estimated.iter_mut().zip(&self.known).for_each(|(estimated, known)| *estimated -= known);
        let right = self.metric.columns.transpose() * flat(&self.metric.inverse_roots, &estimated);
        not_negative(&self.metric.gram, &right)
    }

    /// The sum of the components that is nearest to covariances, no amount below zero, with what is known.
    pub fn nearest(&self, covariances: &[DMatrix<f64>]) -> Vec<DMatrix<f64>> {
        let mut nearest = self.nearest_beside_known(covariances);
        nearest.iter_mut().zip(&self.known).for_each(|(nearest, known)| *nearest += known);
        nearest
    }

    /// The same without what is known.
    pub fn nearest_beside_known(&self, covariances: &[DMatrix<f64>]) -> Vec<DMatrix<f64>> {
        let amounts = self.amounts(covariances);
        let sum = |height: usize| self.components.iter().zip(amounts.iter()).map(|(component, amount)| &component[height] * *amount).sum();
        (0..covariances.len()).map(sum).collect()
    }
}

/// Records that are a little early or late, white noise, one factor a record, and the reading at the trigger alone.
fn general(waves: &Waves) -> Vec<Vec<DMatrix<f64>>> {
    let groups = || waves.groups.iter();
    vec![
        groups().map(|group| slope(&group.mean)).collect(),
        groups().map(|_| DMatrix::identity(waves.samples, waves.samples)).collect(),
        groups().map(|group| outer(&DVector::from_vec(group.mean.clone()))).collect(),
        groups().map(|group| outer(&first(&group.mean))).collect(),
    ]
}

/// Coloured noise in proportion to the wave, and to its peak, of each correlation time.
fn coloured(waves: &Waves) -> Vec<Vec<DMatrix<f64>>> {
    let groups = || waves.groups.iter();
    let mut components = Vec::new();
    for time_s in TIMES_S {
        let kept = libm::exp(-waves.step_s / time_s);
        let coloured = |size: &dyn Fn(usize) -> f64| {
            DMatrix::from_fn(waves.samples, waves.samples, |i, j| size(i) * size(j) * libm::pow(kept, i.abs_diff(j) as f64))
        };
        components.push(groups().map(|group| coloured(&|i| group.mean[i])).collect());
        let peak = |group: &super::WaveGroup| group.mean.iter().fold(0.0_f64, |peak, reading| peak.max(reading.abs()));
        components.push(groups().map(|group| coloured(&|_| peak(group))).collect());
    }
    components
}

/// Covariance of records that differ by one column, g².
pub fn outer(column: &DVector<f64>) -> DMatrix<f64> {
    column * column.transpose()
}

/// The sample at the trigger alone: noise lets single records cross it sooner or later.
fn first(mean: &[f64]) -> DVector<f64> {
    DVector::from_fn(mean.len(), |i, _| if i == BEFORE { mean[i] } else { 0.0 })
}

/// Covariance of the phase, even over one step, where a wave is smooth.
fn slope(mean: &[f64]) -> DMatrix<f64> {
    let last = mean.len() - 1;
    outer(&DVector::from_fn(mean.len(), |i, _| 0.5 * (mean[(i + 1).min(last)] - mean[i.saturating_sub(1)]) / 12f64.sqrt()))
}

/// Minimises x'Gx/2 - b'x over x ≥ 0: the active sets of C. L. Lawson and R. J. Hanson, *Solving Least Squares Problems*, 23.3.
fn not_negative(gram: &DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    let sizes = gram.diagonal().map(|square| square.sqrt().max(1e-300));
    let gram = DMatrix::from_fn(gram.nrows(), gram.ncols(), |i, j| gram[(i, j)] / (sizes[i] * sizes[j]) + if i == j { RIDGE } else { 0.0 });
    let right = right.component_div(&sizes);
    let enough = RIDGE * right.amax();
    let mut x: DVector<f64> = DVector::zeros(right.len());
    let mut open: Vec<usize> = Vec::new();
    for _ in 0..ROUNDS {
        let slope = &right - &gram * &x;
        let next = (0..x.len()).filter(|i| !open.contains(i) && slope[*i] > enough).max_by(|a, b| slope[*a].total_cmp(&slope[*b]));
        let Some(next) = next else { break };
        open.push(next);
        while let Some(target) = solved(&gram, &right, &open) {
            let blocked = |(at, i): (usize, &usize)| (target[at] <= 0.0).then(|| x[*i] / (x[*i] - target[at]));
            let part = open.iter().enumerate().filter_map(blocked).fold(1.0, f64::min);
            for (at, i) in open.iter().enumerate() {
                x[*i] += part * (target[at] - x[*i]);
            }
            if part >= 1.0 {
                break;
            }
            for i in 0..x.len() {
                x[i] = if x[i] < 1e-14 { 0.0 } else { x[i] };
            }
            open.retain(|i| x[*i] > 0.0);
        }
    }
    x.component_div(&sizes)
}

/// Minimum over some numbers alone.
fn solved(gram: &DMatrix<f64>, right: &DVector<f64>, open: &[usize]) -> Option<DVector<f64>> {
    let small = DMatrix::from_fn(open.len(), open.len(), |i, j| gram[(open[i], open[j])]);
    Some(small.cholesky()?.solve(&DVector::from_fn(open.len(), |i, _| right[open[i]])))
}
