//! How much of a figure's variance each axis explains: Sobol' indices of the first order, and total ones.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::outcomes::Outcomes;
use super::plan::Study;
use crate::impact::fit::NORMAL_97_5;

/// Replicates of the bootstrap.
const REPLICATES: usize = 200;

/// An index with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Index {
    /// The estimate, a share of the variance.
    pub share: f64,
    /// Half of its 95 % interval, by the bootstrap over groups.
    pub half_interval: f64,
}

/// The indices of one figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Indices {
    /// Of each axis: what it explains by itself.
    pub first: Vec<Index>,
    /// Of each axis: what it explains with all its interactions.
    pub total: Vec<Index>,
    /// Groups that entered.
    pub groups: usize,
    /// Groups that did not, because one of their rows is no frame: the indices are then those of the frames that there are, and the
    /// axes are not independent any more.
    pub left_out: usize,
}

/// There are no indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum IndicesError {
    /// Another sampling.
    #[error("Sobol' indices are computed from the rows of sampling = \"saltelli\"")]
    Sampling,
    /// Too few groups of which every row has the figure.
    #[error(
        "{whole} of {groups} groups of rows have it in every row, {LEAST_GROUPS} are needed: other rows are not evaluated, or are no frames"
    )]
    TooFew {
        /// Groups of which every row has the figure.
        whole: usize,
        /// Groups of the study.
        groups: usize,
    },
    /// A figure that does not vary.
    #[error("it is the same in all rows")]
    NothingVaries,
}

/// Fewest groups that tell a share.
pub(super) const LEAST_GROUPS: usize = 4;

/// One group: the figure at A, at each mixture, and at B.
struct Group {
    a: f64,
    mixed: Vec<f64>,
    b: f64,
}

/// The Sobol' indices of a column, by its place. First order: mean of B (M - A) over the variance; total: half the mean of (A - M)^2
/// over it (A. Saltelli et al., Comput. Phys. Commun. 181, 2010, table 2, b and f), M being A with one coordinate of B. The mean of
/// all figures is subtracted first. Wrong where the axes depend on each other.
///
/// # Errors
/// When the study is of another sampling, too few of its groups are whole, or nothing varies.
pub fn indices(study: &Study, outcomes: &Outcomes, column: usize) -> Result<Indices, IndicesError> {
    let (count, members) = outcomes.groups(study).ok_or(IndicesError::Sampling)?;
    let group = |group: usize| -> Option<Group> {
        let figures: Option<Vec<f64>> = (0..members).map(|member| outcomes.figure(group * members + member, column)).collect();
        let figures = figures?;
        Some(Group { a: figures[0], mixed: figures[1..members - 1].to_vec(), b: figures[members - 1] })
    };
    let groups: Vec<Group> = (0..count).filter_map(group).collect();
    if groups.len() < LEAST_GROUPS {
        return Err(IndicesError::TooFew { whole: groups.len(), groups: count });
    }
    let all: Vec<&Group> = groups.iter().collect();
    let estimate = estimates(&all, members - 2).ok_or(IndicesError::NothingVaries)?;
    let mut random = Pcg64Mcg::seed_from_u64(u64::from(study.seed));
    let replicates: Vec<[Vec<f64>; 2]> = (0..REPLICATES)
        .filter_map(|_| {
            let drawn: Vec<&Group> = (0..groups.len()).map(|_| &groups[random.random_range(0..groups.len())]).collect();
            estimates(&drawn, members - 2)
        })
        .collect();
    let index = |order: usize, axis: usize| {
        let values: Vec<f64> = replicates.iter().map(|replicate| replicate[order][axis]).collect();
        Index { share: estimate[order][axis], half_interval: NORMAL_97_5 * deviation(&values) }
    };
    let of = |order: usize| (0..members - 2).map(|axis| index(order, axis)).collect();
    Ok(Indices { first: of(0), total: of(1), groups: groups.len(), left_out: count - groups.len() })
}

/// First-order and total indices of each axis.
fn estimates(groups: &[&Group], axes: usize) -> Option<[Vec<f64>; 2]> {
    let both: Vec<f64> = groups.iter().flat_map(|group| [group.a, group.b]).collect();
    let variance = deviation(&both).powi(2) * (both.len() - 1) as f64 / both.len() as f64;
    if variance <= 1e-24 * mean(&both).powi(2) || !variance.is_finite() {
        return None;
    }
    let all: Vec<f64> = groups.iter().flat_map(|group| group.mixed.iter().copied().chain([group.a, group.b])).collect();
    let mean = mean(&all);
    let over = |term: &dyn Fn(&Group) -> f64| groups.iter().map(|group| term(group)).sum::<f64>() / groups.len() as f64 / variance;
    let first = |axis: usize| over(&|group| (group.b - mean) * (group.mixed[axis] - group.a));
    let total = |axis: usize| over(&|group| 0.5 * (group.a - group.mixed[axis]).powi(2));
    Some([(0..axes).map(first).collect(), (0..axes).map(total).collect()])
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn deviation(values: &[f64]) -> f64 {
    let mean = mean(values);
    (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (values.len().max(2) - 1) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A study of three axes whose figure is a function of their shares.
    fn of(function: impl Fn(&[f64]) -> f64, groups: usize) -> (Study, Outcomes) {
        use crate::params::files::Memory;
        let text = format!(
            "sampling = \"saltelli\"\nsamples = {groups}\nmeasures = [\"mass\"]\n[vary]\ncage_rod = [100, 200]\narm_rod = [60, 90]\nstrut_rod = [40, 60]\n"
        );
        let files = Memory([("s.toml".into(), text.into_bytes())].into_iter().collect());
        let study = super::super::plan_file::load("s.toml", &files).expect("is a plan");
        let mut outcomes = Outcomes::none(study.rows());
        for row in 0..study.rows() {
            let shares = study.sampling.shares(3, study.seed, row);
            outcomes.learn(row, super::super::Outcome::Figures(vec![Some(function(&shares))]));
        }
        (study, outcomes)
    }

    /// Indices of a sum are known: shares of the squares of its factors. An interaction counts in the total ones alone.
    #[test]
    fn analytic_indices_of_a_sum_and_of_a_product_are_found() {
        let (study, outcomes) = of(|x| 3.0 * x[0] + x[1] + 100.0, 2048);
        let sum = indices(&study, &outcomes, 0).expect("varies");
        for (found, exact) in sum.first.iter().chain(&sum.total).zip([0.9, 0.1, 0.0, 0.9, 0.1, 0.0]) {
            assert!((found.share - exact).abs() < 0.02 + found.half_interval, "{found:?}, not {exact}");
            assert!(found.half_interval < 0.1);
        }
        let (study, outcomes) = of(|x| (x[0] - 0.5) * (x[1] - 0.5), 2048);
        let product = indices(&study, &outcomes, 0).expect("varies");
        for (found, exact) in product.first.iter().chain(&product.total).zip([0.0, 0.0, 0.0, 1.0, 1.0, 0.0]) {
            assert!((found.share - exact).abs() < 0.05 + found.half_interval, "{found:?}, not {exact}");
        }
    }

    #[test]
    fn planted_a_group_with_a_row_that_is_no_frame_is_left_out_and_a_constant_has_no_indices() {
        let (study, mut outcomes) = of(|x| x[2], 64);
        outcomes.learn(7, super::super::Outcome::Refused("no".into()));
        let found = indices(&study, &outcomes, 0).expect("varies");
        assert_eq!((found.groups, found.left_out), (63, 1));
        let (study, outcomes) = of(|_| 3.0, 64);
        assert_eq!(indices(&study, &outcomes, 0), Err(IndicesError::NothingVaries));
        let (study, mut outcomes) = of(|x| x[2], 4);
        outcomes.learn(0, super::super::Outcome::Refused("no".into()));
        assert_eq!(indices(&study, &outcomes, 0), Err(IndicesError::TooFew { whole: 3, groups: 4 }));
    }
}
