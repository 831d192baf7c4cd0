//! What a report shows of landings: how readings and touch times spread, and one drop.

use super::fitting::LandingFit;
use super::legged_body::Slopes;
use super::observed::{HeightLandings, ObservedLanding};
use super::population::Population;
use super::posterior::given_touches;
use super::table::LandingTable;
use super::touches::{LAST_S, LegTouches};
use crate::impact::measured::Spread;

/// Readings and touch times of a height, measured and of random slopes.
#[derive(Clone, Debug)]
pub struct HeightSpread {
    /// Height, m.
    pub height_m: f64,
    /// Windows of the drops, g.
    pub windows: Vec<Vec<f64>>,
    /// Quartiles of each reading of the drops, g.
    pub measured_g: Vec<[f64; 3]>,
    /// The same of landings that differ by their slope alone, g.
    pub slopes_g: Vec<[f64; 3]>,
    /// Times to the opposite foot of the drops whose feet were all seen, s, ascending.
    pub opposite_s: Vec<f64>,
    /// Times of random slopes, s, ascending, with the share of the landings up to each.
    pub opposite_of_slopes: Vec<(f64, f64)>,
}

/// One drop with the landing that its touches show.
#[derive(Clone, Debug)]
pub struct ShownDrop {
    /// Its name.
    pub trial: String,
    /// Height, m.
    pub height_m: f64,
    /// Its window, g.
    pub window_g: Vec<f64>,
    /// What its touches let expect, g.
    pub predicted_g: Vec<f64>,
    /// Mean window of its height, g.
    pub mean_g: Vec<f64>,
    /// Its touches.
    pub touches: LegTouches,
    /// Expected slope along the first foot's diagonal and along the other one, rad; the first foot is lower.
    pub slopes_rad: [f64; 2],
}

impl HeightSpread {
    /// Of one height.
    pub fn of(height: &HeightLandings, table: &LandingTable, slopes: &Slopes) -> Self {
        let population = Population::of(table, slopes);
        let windows = table.windows();
        let samples = windows.nrows();
        let measured = |i: usize| {
            let spread = Spread::of(height.drops.iter().map(|drop| drop.window[i]));
            spread.map_or([0.0; 3], |spread| [spread.q1, spread.median, spread.q3])
        };
        let mut opposite_s: Vec<f64> = height.seen().map(|drop| drop.touches.opposite.delay_s).collect();
        opposite_s.sort_by(f64::total_cmp);
        let times = table.delays_s.iter().map(|delays| delays[0]).zip(population.weights().iter().copied());
        Self {
            height_m: height.height_m,
            windows: height.drops.iter().map(|drop| drop.window.clone()).collect(),
            measured_g: (0..samples).map(measured).collect(),
            slopes_g: (0..samples)
                .map(|i| quartiles(&summed(windows.row(i).iter().copied().zip(population.weights().iter().copied()))))
                .collect(),
            opposite_s,
            opposite_of_slopes: summed(times.filter(|(delay_s, _)| *delay_s < LAST_S)),
        }
    }
}

/// Values ascending, with the share of the weights up to each.
fn summed(weighed: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut sorted: Vec<(f64, f64)> = weighed.collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let all: f64 = sorted.iter().map(|(_, weight)| weight).sum();
    let mut sum = 0.0;
    for (_, weight) in &mut sorted {
        sum += *weight / all;
        *weight = sum;
    }
    sorted
}

fn quartiles(summed: &[(f64, f64)]) -> [f64; 3] {
    [0.25, 0.5, 0.75].map(|share| summed.iter().find(|(_, sum)| *sum >= share).or(summed.last()).map_or(0.0, |(value, _)| *value))
}

impl ShownDrop {
    /// The drop of a height with the median slope among those whose feet were all seen; legs are those fitted to single drops.
    pub fn of(height: &HeightLandings, table: &LandingTable, fit: &LandingFit) -> Option<Self> {
        let population = Population::of(table, &fit.slopes);
        let slope = |drop: &ObservedLanding| given_touches(&population, &drop.touches, height.read_s()).slope_rad;
        let mut seen: Vec<(f64, &ObservedLanding)> = height.seen().map(|drop| (slope(drop), drop)).collect();
        seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (_, drop) = seen.get(seen.len() / 2)?;
        let expected = given_touches(&population, &drop.touches, height.read_s());
        Some(Self {
            trial: drop.trial.clone(),
            height_m: height.height_m,
            window_g: drop.window.clone(),
            predicted_g: expected.window.as_slice().to_vec(),
            mean_g: height.mean_window().as_slice().to_vec(),
            touches: drop.touches,
            slopes_rad: [expected.slope_rad * libm::cos(expected.direction_rad), expected.slope_rad * libm::sin(expected.direction_rad)],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_quartiles_of_weighed_values() {
        let even = summed((0..=100).map(|i| (f64::from(100 - i), 1.0)));
        assert_eq!(quartiles(&even), [25.0, 50.0, 75.0]);
        assert_eq!(quartiles(&summed([(1.0, 0.1), (2.0, 0.8), (3.0, 0.1)].into_iter())), [2.0; 3]);
    }
}
