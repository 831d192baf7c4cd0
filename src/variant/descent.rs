//! A local search: steps along the planes of a region that shrinks where they fail.
//!
//! Before anything is kept, a step lessens what is violated; then it makes the aim small. Two steps are looked at side by side, a
//! long and a short one. Where both fail the region shrinks, and planes that were corrected often are made anew.

use super::aim::Aim;
use super::planes::{Planes, Way};
use super::search::Search;

/// The first region where nothing is known of a good one, the largest, and the least, in shares of the bounds.
pub(super) const REGION: f64 = 0.12;
const WIDEST: f64 = 0.35;
const LEAST: f64 = 0.001;
/// Smallest trust region for a target value, where tenths of a millimetre do not matter.
const LEAST_NEAR: f64 = 0.015;
/// The short step beside a long one, and the region after a failure of both, in shares of it.
const SHORTER: f64 = 0.3;
/// Over how much of a region planes are made by differences.
const REACH: f64 = 0.25;

/// Follows the planes from values that were looked at, first within a region, with no more than this many frames; ends when a frame keeps
/// everything where that is all that is asked for. Where nothing is left to follow, the planes are made once more, by differences on the other side.
pub(super) fn descend(search: &Search, start: &[f64], region: f64, most: usize, feasible_is_enough: bool) {
    let budget = search.looked_at() + most;
    let spent = || search.left() == 0 || search.looked_at() >= budget;
    let least = if matches!(search.aim(), Aim::Near(_)) { LEAST_NEAR } else { LEAST };
    let (mut radius, mut way) = (region, Way::First);
    let Some(mut planes) = Planes::at(search, start, REACH * radius, way) else { return };
    let mut fresh = true;
    while !spent() {
        if feasible_is_enough && planes.point().violated == 0.0 {
            return;
        }
        let steps = [radius, SHORTER * radius].map(|radius| planes.best_within(search, radius));
        search.look_at(&steps);
        for values in &steps {
            planes.learn(search, values);
        }
        if let Some(values) = planes.move_to_better(search, &steps) {
            radius = if *values == steps[0] { (1.5 * radius).min(WIDEST) } else { (0.7 * radius).max(least) };
            fresh = false;
        } else if radius > least {
            radius *= SHORTER * SHORTER.sqrt();
            if !fresh && let Some(anew) = Planes::at(search, planes.here(), REACH * radius.max(least), way) {
                (planes, fresh) = (anew, true);
            }
        } else if way == Way::First
            && let Some(anew) = Planes::at(search, planes.here(), REACH * region, Way::Other)
        {
            (planes, way, radius, fresh) = (anew, Way::Other, region, true);
        } else {
            return;
        }
    }
}
