//! Where in its ranges a study looks.

use std::sync::{Arc, OnceLock};

use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::axis::{Axis, Input};

/// How the rows of a study are spread over its ranges. Every row is computed by itself.
#[derive(Clone)]
pub enum Sampling {
    /// Every combination of evenly spaced values; the last axis varies fastest.
    Grid {
        /// Values of each axis.
        points: Vec<usize>,
    },
    /// As many rows as layers: of each axis every layer is met once (M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21,
    /// 1979). Each value lies at random within its layer.
    LatinHypercube {
        /// Rows.
        samples: usize,
        /// Where the rows lie.
        layers: Layers,
    },
    /// Sobol' points with Owen's scrambling (crate `sobol_burley`).
    Sobol {
        /// Rows.
        samples: usize,
    },
    /// Rows in groups: each has two Sobol' points A and B, and A with one coordinate after the other
    /// of B (A. Saltelli et al., Comput. Phys. Commun. 181, 2010): A, each mixture, B. Sensitivity indices are computed from it.
    Saltelli {
        /// Groups.
        samples: usize,
    },
    /// A table of values.
    Table {
        /// The inputs of each row.
        rows: Arc<Vec<Vec<Input>>>,
    },
}

/// Where the rows lie along each axis, computed when it is first needed.
#[derive(Clone, Default)]
pub struct Layers(Arc<OnceLock<Vec<Vec<f64>>>>);

/// Names of the samplings, as a plan states them; that of a table is `table`.
pub(super) const NAMES: [&str; 4] = ["latin_hypercube", "sobol", "saltelli", "grid"];

/// Sobol' points that the crate has for one seed.
const SOBOL_POINTS: usize = 1 << 16;

/// Most rows of any sampling.
pub(super) const MOST_ROWS: usize = 1_000_000;

/// Most rows of a sampling, or groups of `saltelli`.
pub fn most_rows(name: &str) -> usize {
    if matches!(name, "sobol" | "saltelli") { SOBOL_POINTS } else { MOST_ROWS }
}

impl Sampling {
    /// How many rows there are over so many axes.
    pub fn rows(&self, axes: usize) -> usize {
        match self {
            Self::Grid { points } => points.iter().product(),
            Self::LatinHypercube { samples, .. } | Self::Sobol { samples } => *samples,
            Self::Saltelli { samples } => samples * (axes + 2),
            Self::Table { rows } => rows.len(),
        }
    }

    /// What the axes are in a row.
    pub(super) fn inputs(&self, axes: &[Axis], seed: u32, row: usize) -> Vec<Input> {
        if let Self::Table { rows } = self {
            return rows[row].clone();
        }
        axes.iter().zip(self.shares(axes.len(), seed, row)).map(|(axis, share)| axis.at(share)).collect()
    }

    /// How far each axis is between its bounds, 0 to 1; for a table nothing is.
    pub(super) fn shares(&self, axes: usize, seed: u32, row: usize) -> Vec<f64> {
        match self {
            Self::Grid { points } => grid(points, row),
            Self::LatinHypercube { samples, layers } => layers.shares(*samples, axes, seed, row),
            Self::Sobol { .. } => (0..axes).map(|axis| sobol(row, axis, seed)).collect(),
            Self::Saltelli { .. } => {
                let (group, member) = (row / (axes + 2), row % (axes + 2));
                let of_b = |axis: usize| member == axes + 1 || member == axis + 1;
                (0..axes).map(|axis| sobol(group, if of_b(axis) { axes + axis } else { axis }, seed)).collect()
            }
            Self::Table { .. } => Vec::new(),
        }
    }
}

/// The place of a row in a grid whose last axis varies fastest.
fn grid(points: &[usize], row: usize) -> Vec<f64> {
    let mut rest = row;
    let mut shares: Vec<f64> = points
        .iter()
        .rev()
        .map(|count| {
            let at = rest % count;
            rest /= count;
            if *count > 1 { at as f64 / (count - 1) as f64 } else { 0.5 }
        })
        .collect();
    shares.reverse();
    shares
}

fn sobol(point: usize, dimension: usize, seed: u32) -> f64 {
    f64::from(sobol_burley::sample(point as u32, dimension as u32, seed))
}

/// Most dimensions of Sobol' points.
pub(super) const SOBOL_DIMENSIONS: usize = sobol_burley::NUM_DIMENSIONS as usize;

impl Layers {
    fn shares(&self, samples: usize, axes: usize, seed: u32, row: usize) -> Vec<f64> {
        let shares = self.0.get_or_init(|| (0..axes).map(|axis| places(samples, seed, axis)).collect());
        shares.iter().map(|shares| shares[row]).collect()
    }
}

/// Places of the rows along an axis, 0 to 1: the layers in a random order, and a random place within each.
fn places(samples: usize, seed: u32, axis: usize) -> Vec<f64> {
    // `seed_from_u64` spreads each bit of its number over the whole state, so axes are independent of each other.
    let mut random = Pcg64Mcg::seed_from_u64(u64::from(seed) << 32 | axis as u64);
    let mut layers: Vec<u32> = (0..samples as u32).collect();
    layers.shuffle(&mut random);
    layers.into_iter().map(|layer| (f64::from(layer) + random.random_range(0.0..1.0)) / samples as f64).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn analytic_a_grid_has_every_combination_once_and_its_corners() {
        let grid = Sampling::Grid { points: vec![3, 1, 2] };
        let all: Vec<Vec<f64>> = (0..grid.rows(3)).map(|row| grid.shares(3, 0, row)).collect();
        assert_eq!(
            all,
            [[0.0, 0.5, 0.0], [0.0, 0.5, 1.0], [0.5, 0.5, 0.0], [0.5, 0.5, 1.0], [1.0, 0.5, 0.0], [1.0, 0.5, 1.0]].map(Vec::from)
        );
    }

    #[test]
    fn analytic_a_saltelli_group_mixes_two_points() {
        let design = Sampling::Saltelli { samples: 4 };
        assert_eq!(design.rows(3), 20);
        for group in 0..4 {
            let rows: Vec<Vec<f64>> = (0..5).map(|member| design.shares(3, 7, 5 * group + member)).collect();
            let (a, b) = (&rows[0], &rows[4]);
            for axis in 0..3 {
                let mut mixed = a.clone();
                mixed[axis] = b[axis];
                assert_eq!(rows[axis + 1], mixed);
            }
            assert_ne!(a, b);
        }
    }

    /// The correlation of two axes over the rows.
    fn correlation(sampling: &Sampling, samples: usize, seed: u32, [a, b]: [usize; 2]) -> f64 {
        let shares: Vec<Vec<f64>> = (0..samples).map(|row| sampling.shares(4, seed, row)).collect();
        let product = shares.iter().map(|share| (share[a] - 0.5) * (share[b] - 0.5)).sum::<f64>() / samples as f64;
        12.0 * product
    }

    #[test]
    fn analytic_axes_are_independent() {
        let samples = 1024;
        for seed in 0..20 {
            for sampling in [Sampling::LatinHypercube { samples, layers: Layers::default() }, Sampling::Sobol { samples }] {
                for (a, b) in (0..4).flat_map(|a| (0..a).map(move |b| (a, b))) {
                    let found = correlation(&sampling, samples, seed, [a, b]);
                    assert!(found.abs() < 5.0 / (samples as f64).sqrt(), "axes {a} and {b}, seed {seed}: {found}");
                }
            }
        }
    }

    proptest! {
        #[test]
        fn analytic_a_latin_hypercube_meets_every_layer_once(samples in 1_usize..200, axes in 1_usize..5, seed in any::<u32>()) {
            let sampling = Sampling::LatinHypercube { samples, layers: Layers::default() };
            for axis in 0..axes {
                let mut layers: Vec<usize> =
                    (0..samples).map(|row| (sampling.shares(axes, seed, row)[axis] * samples as f64) as usize).collect();
                layers.sort_unstable();
                prop_assert_eq!(layers, (0..samples).collect::<Vec<_>>());
            }
        }

        #[test]
        fn analytic_sobol_points_fill_each_half_alike(axes in 1_usize..8, seed in any::<u32>()) {
            let sampling = Sampling::Sobol { samples: 64 };
            for axis in 0..axes {
                let low = (0..64).filter(|row| sampling.shares(axes, seed, *row)[axis] < 0.5).count();
                prop_assert_eq!(low, 32);
            }
        }
    }
}
