//! Records that a population may have: each is what the touches of a simulated landing predict, as they would be read, with what the touches
//! of a measured drop left of it.
//!
//! What is left of single drops is taken as it is. A covariance of it from forty records, or the difference between how records vary and how
//! slopes let them vary, let some populations vary four times as much as their records do.
//!
//! *When it is wrong:* what touches leave of a drop is taken to be the same for every slope.

use nalgebra::DVector;
use rand::{Rng, RngExt};

use super::fitting::LandingProblem;
use super::legged_body::Slopes;
use super::population::Population;
use super::posterior::window_given_touches;
use super::table::LandingTable;
use super::touch_errors::READINGS;

/// Landings of a height whose touches are read.
const LANDINGS: usize = 600;

/// Drops from one height.
pub struct SimulatedDrops {
    /// What the touches of landings predict that are as frequent as each other, g.
    predicted: Vec<DVector<f64>>,
    /// What touches left of each measured drop, g.
    left: Vec<DVector<f64>>,
}

impl SimulatedDrops {
    /// Of a height of the fit, by its place there; `None` before its touch times were simulated.
    pub fn of(problem: &LandingProblem, height: usize, table: &LandingTable, slopes: &Slopes, rng: &mut impl Rng) -> Option<Self> {
        let observed = &problem.observed.heights[height];
        let (population, errors) = (Population::of(table, slopes), observed.errors.as_ref()?);
        let predicted = evenly_drawn(population.weights(), rng.random()).filter_map(|point| {
            let touches = errors.touches(point, table.delays_s[point], rng.random_range(0..READINGS))?;
            Some(window_given_touches(&population, &touches, observed.read_s()))
        });
        let predicted: Vec<DVector<f64>> = predicted.collect();
        (!predicted.is_empty()).then(|| Self { predicted, left: problem.left_by_drops(height, &population) })
    }

    /// A record, g.
    pub fn record(&self, rng: &mut impl Rng) -> DVector<f64> {
        &self.predicted[rng.random_range(0..self.predicted.len())] + &self.left[rng.random_range(0..self.left.len())]
    }

    /// The mean of all records that may be drawn, g.
    pub fn mean(&self) -> DVector<f64> {
        let mean = |all: &[DVector<f64>]| all.iter().fold(DVector::zeros(self.left[0].len()), |sum, one| sum + one) / all.len() as f64;
        mean(&self.predicted) + mean(&self.left)
    }
}

/// Points of a table, each as often as it is frequent: in even steps of the sum of weights, the first one at this part of a step.
fn evenly_drawn(weights: &DVector<f64>, begin: f64) -> impl Iterator<Item = usize> {
    let all = weights.sum();
    let (mut point, mut before) = (0, 0.0);
    (0..LANDINGS).map(move |landing| {
        let place = (landing as f64 + begin) / LANDINGS as f64 * all;
        while point + 1 < weights.len() && before + weights[point] < place {
            before += weights[point];
            point += 1;
        }
        point
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_points_are_drawn_as_often_as_they_are_frequent() {
        let weights = DVector::from_vec(vec![0.0, 1.0, 0.0, 3.0, 2.0]);
        let mut counts = [0; 5];
        evenly_drawn(&weights, 0.3).for_each(|point| counts[point] += 1);
        assert_eq!(counts, [0, LANDINGS / 6, 0, LANDINGS / 2, LANDINGS / 3]);
    }
}
