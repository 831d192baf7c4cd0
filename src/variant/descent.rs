//! A local search: steps along the planes of a region that shrinks where they fail.
//!
//! Before anything is kept, a step lessens what is violated; then it makes the aim small. Two steps are looked at side by side, a
//! long and a short one. Where both fail the region shrinks, and planes that were corrected often are made anew.

use super::aim::Aim;
use super::planes::Planes;
use super::search::Search;

/// The first and the largest region, and the least, in shares of the bounds.
const REGION: f64 = 0.12;
const WIDEST: f64 = 0.35;
const LEAST: f64 = 0.001;
/// The least region where values only have to be near others: nobody asks for the last tenths of a millimetre.
const LEAST_NEAR: f64 = 0.015;
/// The short step beside a long one, and the region after a failure of both, in shares of it.
const SHORTER: f64 = 0.3;
/// Over how much of a region planes are made by differences.
const REACH: f64 = 0.25;

/// Follows the planes from values that were looked at, with no more than this many frames; ends when a frame keeps everything
/// where that is all that is asked for. Says whether it came to an end by itself.
pub(super) fn descend(search: &Search, start: &[f64], most: usize, feasible_is_enough: bool) -> bool {
    let budget = search.looked_at() + most;
    let spent = || search.left() == 0 || search.looked_at() >= budget;
    let least = if matches!(search.aim(), Aim::Near(_)) { LEAST_NEAR } else { LEAST };
    let mut radius = REGION;
    let Some(mut planes) = Planes::at(search, start, REACH * radius) else { return true };
    let mut here = best_beside(search, &mut planes, start);
    let mut fresh = true;
    while !spent() {
        if feasible_is_enough && planes.point().violated == 0.0 {
            return true;
        }
        let steps = [radius, SHORTER * radius].map(|radius| planes.best_within(search, radius));
        search.look_at(&steps);
        for values in &steps {
            planes.learn(search, values);
        }
        let better = |values: &&Vec<f64>| search.known(values).is_some_and(|point| point.better_than(planes.point()));
        let found = steps.iter().filter(better).min_by(|a, b| order(search, a, b)).cloned();
        if let Some(values) = found {
            radius = if values == steps[0] { (1.5 * radius).min(WIDEST) } else { (0.7 * radius).max(least) };
            planes.move_to(search, &values);
            (here, fresh) = (values, false);
        } else if radius > least {
            radius *= SHORTER * SHORTER.sqrt();
            if !fresh && let Some(anew) = Planes::at(search, &here, REACH * radius.max(least)) {
                (planes, fresh) = (anew, true);
                here = best_beside(search, &mut planes, &here);
            }
        } else {
            return true;
        }
    }
    false
}

/// Moves the planes to the best of the points that they were made of.
fn best_beside(search: &Search, planes: &mut Planes, centre: &[f64]) -> Vec<f64> {
    let better = |values: &Vec<f64>| search.known(values).is_some_and(|point| point.better_than(planes.point()));
    let best = search.order().into_iter().rev().take(search.problem().vary.len() + 1).filter(better).min_by(|a, b| order(search, a, b));
    match best {
        Some(values) => {
            planes.move_to(search, &values);
            values
        }
        None => centre.to_vec(),
    }
}

fn order(search: &Search, a: &[f64], b: &[f64]) -> std::cmp::Ordering {
    let key = |values: &[f64]| search.known(values).map_or((f64::INFINITY, f64::INFINITY), |point| (point.violated, point.aim));
    let (a, b) = (key(a), key(b));
    a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
}
