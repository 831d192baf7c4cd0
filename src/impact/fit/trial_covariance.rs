//! How the records of one height vary between trials, as a covariance over time.

use nalgebra::{DMatrix, DVector};
use rand::Rng;
use rand_distr::{ChiSquared, Distribution, StandardNormal};

use super::covariance_model::{CovarianceModel, inverse_root};
use super::trigger_jitter::TriggerJitter;
use super::waves::Waves;

/// Least standard deviation of a reading, g: a fraction of a count of the converter.
const LEAST_G: f64 = 0.03;
/// Least level of a height.
const LEAST_LEVEL: f64 = 0.05;
/// How often a covariance model is refined in units of its own result.
const REFINEMENTS: usize = 3;

/// Sums of products of the records' deviations from their height's mean.
#[derive(Clone, Debug)]
pub struct TrialCovariance {
    /// A height each: sum over records of deviation times its transpose, g².
    sums: Vec<DMatrix<f64>>,
    /// Records a height.
    counts: Vec<usize>,
}

impl TrialCovariance {
    /// Of measured waves.
    pub fn of(waves: &Waves) -> Self {
        let deviations = |group: &super::WaveGroup| {
            DMatrix::from_fn(waves.samples, group.windows.len(), |i, drop| group.windows[drop][i] - group.mean[i])
        };
        Self::of_deviations(&waves.groups.iter().map(deviations).collect::<Vec<_>>())
    }

    /// Of records less their height's mean, g, a column each.
    pub fn of_deviations(deviations: &[DMatrix<f64>]) -> Self {
        let sums = deviations.iter().map(|deviations| deviations * deviations.transpose()).collect();
        Self { sums, counts: deviations.iter().map(DMatrix::ncols).collect() }
    }

    /// What another set of normal records of the same covariances would show.
    pub fn drawn(covariances: &[DMatrix<f64>], counts: &[usize], rng: &mut impl Rng) -> Option<Self> {
        let mut sums = Vec::new();
        for (covariance, count) in covariances.iter().zip(counts) {
            let root = covariance.clone().cholesky()?.unpack();
            let free = count - 1;
            let half =
                if free > covariance.nrows() { bartlett(covariance.nrows(), free, rng)? } else { normal(covariance.nrows(), free, rng) };
            let deviations = root * half;
            sums.push(&deviations * deviations.transpose());
        }
        Some(Self { sums, counts: counts.to_vec() })
    }

    /// Covariance of one record, g², a height each, with a covariance model.
    ///
    /// The nearest sum of the components, each height at its own level, and on top of it, in that sum's own units, the part of the mean difference from the
    /// records which its uncertainty does not explain (after J. Schäfer, K. Strimmer, Stat. Appl. Genet. Mol. Biol. 4 (2005)
    /// 32, with this target). Wrong where heights vary for different reasons that no component describes.
    pub fn covariances(&self, model: &CovarianceModel) -> Option<Vec<DMatrix<f64>>> {
        let free = |count: &usize| (count - 1) as f64;
        let (sampled, nearest) = (self.sampled(), self.levelled(self.nearest(model))?);
        let freedom: f64 = self.counts.iter().map(free).sum();
        let samples = self.sums[0].nrows();
        let mut excess = DMatrix::zeros(samples, samples);
        for ((nearest, sampled), count) in nearest.iter().zip(&sampled).zip(&self.counts) {
            let inverse = inverse_root(nearest)?;
            excess += (&inverse * sampled * inverse.transpose() - DMatrix::identity(samples, samples)) * (free(count) / freedom);
        }
        let uncertain = (samples * (samples + 1)) as f64 / freedom;
        let kept = (1.0 - uncertain / excess.norm_squared().max(1e-300)).max(0.0);
        let inner = DMatrix::identity(samples, samples) + excess * kept;
        nearest.into_iter().map(|nearest| nearest.cholesky().map(|root| root.l() * &inner * root.l().transpose())).collect()
    }

    /// Covariances, each times the level at which the records of its height vary, as far as its uncertainty does not explain that heights differ.
    ///
    /// The uncertainty is that of normal records. Heavier tails let more of a difference stand.
    fn levelled(&self, covariances: Vec<DMatrix<f64>>) -> Option<Vec<DMatrix<f64>>> {
        let (mut over, mut expected) = (Vec::new(), 0.0);
        for ((covariance, sampled), count) in covariances.iter().zip(self.sampled()).zip(&self.counts) {
            let inverse = inverse_root(covariance)?;
            let samples = covariance.nrows() as f64;
            over.push((&inverse * sampled * inverse.transpose()).trace() / samples - 1.0);
            expected += 2.0 / (samples * (count - 1) as f64);
        }
        let found: f64 = over.iter().map(|over| over * over).sum();
        let kept = (1.0 - expected / found.max(1e-300)).max(0.0);
        Some(covariances.into_iter().zip(over).map(|(covariance, over)| covariance * (1.0 + kept * over).max(LEAST_LEVEL)).collect())
    }

    /// Standard deviations between records of the model's parameters of change, on their own scales.
    pub fn changing(&self, model: &CovarianceModel) -> Vec<f64> {
        model.changing(&self.sampled())
    }

    /// Variation of readings in proportion to the wave.
    pub fn trigger_jitter(&self, model: &CovarianceModel) -> TriggerJitter {
        model.trigger_jitter(&self.sampled())
    }

    /// The nearest sum of the components alone.
    pub fn nearest(&self, model: &CovarianceModel) -> Vec<DMatrix<f64>> {
        regularised(model.nearest(&self.sampled()))
    }

    /// The same without what the model knows.
    pub fn nearest_beside_known(&self, model: &CovarianceModel) -> Vec<DMatrix<f64>> {
        regularised(model.nearest_beside_known(&self.sampled()))
    }

    fn sampled(&self) -> Vec<DMatrix<f64>> {
        self.sums.iter().zip(&self.counts).map(|(sum, count)| sum / (count - 1) as f64).collect()
    }

    /// A model that compares covariances in units of its own sum that is nearest to these records.
    pub fn refined(&self, model: CovarianceModel) -> CovarianceModel {
        (0..REFINEMENTS).fold(model, |model, _| {
            let near = self.nearest(&model);
            model.near(&near)
        })
    }

    /// Covariance of one record, g², a height each, before its components are known: variances of each height,
    /// correlations of all heights together, drawn towards correlations that depend on the lag alone.
    pub fn plain_covariances(&self) -> Vec<DMatrix<f64>> {
        let samples = self.sums[0].nrows();
        let freedom: f64 = self.counts.iter().map(|count| (count - 1) as f64).sum();
        let mut pooled = DMatrix::zeros(samples, samples);
        let deviations = self.deviations();
        for (sum, sd) in self.sums.iter().zip(&deviations) {
            pooled += DMatrix::from_fn(samples, samples, |i, j| sum[(i, j)] / (sd[i] * sd[j]));
        }
        let correlation = shrunk(&(pooled / freedom), freedom);
        deviations.iter().map(|sd| DMatrix::from_fn(samples, samples, |i, j| correlation[(i, j)] * sd[i] * sd[j])).collect()
    }

    fn deviations(&self) -> Vec<DVector<f64>> {
        self.sums.iter().zip(&self.counts).map(|(sum, count)| standard_deviations(sum, *count)).collect()
    }

    /// Records a height.
    pub fn counts(&self) -> &[usize] {
        &self.counts
    }

    /// Standard error of the mean wave, g, a height each.
    pub fn standard_errors(&self) -> Vec<Vec<f64>> {
        let of = |(sum, count): (&DMatrix<f64>, &usize)| {
            let n = *count as f64;
            sum.diagonal().iter().map(|square| (square / ((n - 1.0) * n)).sqrt()).collect()
        };
        self.sums.iter().zip(&self.counts).map(of).collect()
    }
}

fn regularised(mut covariances: Vec<DMatrix<f64>>) -> Vec<DMatrix<f64>> {
    for covariance in &mut covariances {
        *covariance += DMatrix::from_diagonal_element(covariance.nrows(), covariance.nrows(), LEAST_G * LEAST_G);
    }
    covariances
}

fn standard_deviations(sum: &DMatrix<f64>, count: usize) -> DVector<f64> {
    sum.diagonal().map(|square| (square / (count - 1) as f64 + LEAST_G * LEAST_G).sqrt())
}

/// Correlations drawn towards those of the lag alone.
fn shrunk(correlation: &DMatrix<f64>, freedom: f64) -> DMatrix<f64> {
    let samples = correlation.nrows();
    // Sums over a diagonal divided by the whole length keep the target positive definite.
    let by_lag: Vec<f64> =
        (0..samples).map(|lag| (lag..samples).map(|i| correlation[(i, i - lag)]).sum::<f64>() / samples as f64).collect();
    // A sample that hardly varies is correlated with none.
    let target = |i: usize, j: usize| by_lag[i.abs_diff(j)] * (correlation[(i, i)] * correlation[(j, j)]).sqrt();
    let (mut uncertain, mut excess) = (0.0, 0.0);
    for i in 0..samples {
        for j in 0..i {
            let r = correlation[(i, j)];
            uncertain += (1.0 - r * r) * (1.0 - r * r) / freedom;
            excess += (r - target(i, j)) * (r - target(i, j));
        }
    }
    let weight = if excess > 0.0 { (uncertain / excess).clamp(0.02, 1.0) } else { 1.0 };
    DMatrix::from_fn(samples, samples, |i, j| if i == j { 1.0 } else { (1.0 - weight) * correlation[(i, j)] + weight * target(i, j) })
}

fn normal(rows: usize, columns: usize, rng: &mut impl Rng) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |_, _| StandardNormal.sample(rng))
}

/// A triangle whose product with its transpose is a Wishart draw (M. S. Bartlett, 1933): as many numbers for 10,000
/// records as for 50.
fn bartlett(rows: usize, free: usize, rng: &mut impl Rng) -> Option<DMatrix<f64>> {
    let mut triangle = DMatrix::zeros(rows, rows);
    for i in 0..rows {
        triangle[(i, i)] = ChiSquared::new((free - i) as f64).ok()?.sample(rng).sqrt();
        for j in 0..i {
            triangle[(i, j)] = StandardNormal.sample(rng);
        }
    }
    Some(triangle)
}

/// Turns deviations of mean waves into independent numbers of variance 1.
#[derive(Clone, Debug)]
pub struct Whitening {
    inverse_roots: Vec<DMatrix<f64>>,
}

impl Whitening {
    /// From covariances of one record and how many make a mean; `None` when one is not positive definite.
    pub fn of(covariances: &[DMatrix<f64>], counts: &[usize]) -> Option<Self> {
        let of_mean = |(covariance, count): (&DMatrix<f64>, &usize)| inverse_root(&(covariance / *count as f64));
        let inverse_roots = covariances.iter().zip(counts).map(of_mean).collect::<Option<Vec<_>>>()?;
        Some(Self { inverse_roots })
    }

    /// Of one height.
    pub fn height(&self, height: usize) -> &DMatrix<f64> {
        &self.inverse_roots[height]
    }

    /// Columns with all heights one below the other.
    pub fn stacked(&self, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let mut out = DMatrix::zeros(columns.nrows(), columns.ncols());
        let mut at = 0;
        for inverse in &self.inverse_roots {
            let rows = inverse.nrows();
            inverse.mul_to(&columns.rows(at, rows), &mut out.rows_mut(at, rows));
            at += rows;
        }
        out
    }
}
