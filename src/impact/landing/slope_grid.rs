//! The slopes at which landings are simulated, and the denser ones between them.
//!
//! Four feet on two diagonals land alike when the slope is mirrored at a diagonal or at an edge: slopes along the two diagonals,
//! in polar coordinates, need an eighth of the circle only.

use std::f64::consts::FRAC_PI_4;
use std::sync::LazyLock;

/// Largest slope, rad: beyond it lies one landing in a thousand of those that were measured.
const STEEPEST_RAD: f64 = 0.5;
/// Slopes that are simulated, and directions.
const SIMULATED: [usize; 2] = [16, 9];
/// Steps between two simulated ones.
const BETWEEN: [usize; 2] = [5, 2];

/// A slope with its share of the landings between its neighbours.
#[derive(Clone, Copy, Debug)]
pub struct GridPoint {
    /// Size, rad.
    pub slope_rad: f64,
    /// Angle to the nearest diagonal, rad.
    pub direction_rad: f64,
    /// Size times direction that it stands for, rad², as a part of all directions.
    pub cell: f64,
    /// Simulated slopes around it with their weights.
    pub around: [(usize, f64); 4],
}

/// Slopes to simulate, along the two diagonals, rad: none, which has no direction, and then each slope in all directions.
pub fn simulated() -> Vec<[f64; 2]> {
    let each = |(slope, direction): (f64, f64)| [slope * libm::cos(direction), slope * libm::sin(direction)];
    let sloped = (1..SIMULATED[0]).flat_map(|i| (0..SIMULATED[1]).map(move |j| each((size(i as f64), angle(j as f64)))));
    std::iter::once([0.0; 2]).chain(sloped).collect()
}

/// The place of a slope and a direction among those that are simulated.
fn node([slope, direction]: [usize; 2]) -> usize {
    slope.checked_sub(1).map_or(0, |sloped| 1 + sloped * SIMULATED[1] + direction)
}

/// The points between them.
pub fn points() -> &'static [GridPoint] {
    static POINTS: LazyLock<Vec<GridPoint>> = LazyLock::new(computed_points);
    &POINTS
}

fn computed_points() -> Vec<GridPoint> {
    let counts: [usize; 2] = std::array::from_fn(|axis| (SIMULATED[axis] - 1) * BETWEEN[axis]);
    let along = |axis: usize, at: usize| {
        let place = at as f64 / BETWEEN[axis] as f64;
        let left = (place.floor() as usize).min(SIMULATED[axis] - 2);
        (left, place - left as f64)
    };
    let mut points = Vec::new();
    for i in 0..=counts[0] {
        let (left, right_share) = along(0, i);
        let slope_rad = fine(i, 0, size);
        for j in 0..=counts[1] {
            let (low, high_share) = along(1, j);
            let around = [
                (node([left, low]), (1.0 - right_share) * (1.0 - high_share)),
                (node([left, low + 1]), (1.0 - right_share) * high_share),
                (node([left + 1, low]), right_share * (1.0 - high_share)),
                (node([left + 1, low + 1]), right_share * high_share),
            ];
            let cell = width(i, 0, size) * width(j, 1, angle) / FRAC_PI_4;
            points.push(GridPoint { slope_rad, direction_rad: fine(j, 1, angle), cell, around });
        }
    }
    points
}

/// Denser near zero, where touch times grow in proportion to the slope.
fn size(place: f64) -> f64 {
    STEEPEST_RAD * libm::pow(place / (SIMULATED[0] - 1) as f64, 1.5)
}

/// Even: when the second foot touches goes nearly in proportion to the angle from the edge between two diagonals.
fn angle(place: f64) -> f64 {
    FRAC_PI_4 * place / (SIMULATED[1] - 1) as f64
}

/// What lies at a fine place along an axis: straight between two simulated ones.
fn fine(at: usize, axis: usize, of: fn(f64) -> f64) -> f64 {
    let place = at as f64 / BETWEEN[axis] as f64;
    let left = place.floor().min((SIMULATED[axis] - 2) as f64);
    of(left) + (of(left + 1.0) - of(left)) * (place - left)
}

/// Half the distance between the neighbours of a fine place; at the ends, to the one neighbour.
fn width(at: usize, axis: usize, of: fn(f64) -> f64) -> f64 {
    let last = (SIMULATED[axis] - 1) * BETWEEN[axis];
    0.5 * (fine((at + 1).min(last), axis, of) - fine(at.saturating_sub(1), axis, of))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_cells_cover_all_slopes_once() {
        let points = points();
        let all: f64 = points.iter().map(|point| point.cell).sum();
        assert!((all - STEEPEST_RAD).abs() < 1e-9, "{all}");
        for point in points {
            assert!((point.around.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-12);
            assert!(point.around.iter().all(|(at, weight)| *at < simulated().len() && *weight >= 0.0));
        }
    }

    #[test]
    fn analytic_points_lie_between_what_is_simulated() {
        let simulated = simulated();
        for point in points() {
            let [p, q] =
                point.around.iter().fold([0.0; 2], |[p, q], (at, weight)| [p + weight * simulated[*at][0], q + weight * simulated[*at][1]]);
            // A chord of the arc between two directions is a little shorter than the arc.
            assert!((libm::hypot(p, q) - point.slope_rad).abs() <= 0.01 * point.slope_rad + 1e-12);
        }
    }
}
