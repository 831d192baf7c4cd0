//! What the slopes' cosine does to the mean wave of a sensor that turns with the body.

use super::fitting::{LandingFit, LandingProblem};
use super::population::Population;
use super::simulation::SensorAxis;
use super::table::LandingTable;

/// At one height.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct CosineSize {
    /// Height, m.
    pub height_m: f64,
    /// Change of the largest reading of the mean wave, as a part of it.
    pub peak_change: f64,
    /// The largest change of a reading of the mean wave, g.
    pub largest_g: f64,
}

impl CosineSize {
    /// At the heights of a problem, by a fit and the tables of its landings; `None` where a landing is lost.
    pub fn of(problem: &LandingProblem, tables: &[LandingTable], fit: &LandingFit) -> Option<Vec<Self>> {
        let heights = problem.waves.chosen.iter().map(|height| problem.waves.means[*height].height_m);
        heights.zip(tables).map(|(height_m, table)| Self::at(problem, table, fit, height_m)).collect()
    }

    fn at(problem: &LandingProblem, table: &LandingTable, fit: &LandingFit, height_m: f64) -> Option<Self> {
        let expected = &problem.waves.expected;
        let upright = LandingTable::along(SensorAxis::Vertical, &problem.body, &fit.legs, &fit.slopes, problem.model, expected, height_m)?;
        let [turned, upright] = [table, &upright].map(|table| Population::of(table, &fit.slopes).mean_window());
        let largest_g = (&upright - &turned).amax();
        Some(Self { height_m, peak_change: turned.max() / upright.max() - 1.0, largest_g })
    }
}
