//! The second phase of a search: descents from the best frames that are known, one after the other.

use super::aim::Aim;
use super::descent::{REGION, descend};
use super::search::{Search, ranked};

/// What each descent may spend of the frames that are left.
const SHARES: [f64; 3] = [0.6, 0.7, 1.0];
/// How far from what is known another start has to be, in shares of the bounds.
const APART: f64 = 0.15;
/// The region around what is nearly the best, in shares of the bounds.
pub(super) const NEARLY: f64 = 0.25 * REGION;
/// How often descents begin anew from the best frame, where each finds a better one.
const AGAIN: usize = 3;

/// Regions around the best frame in which it is looked for a better one before the search says that it converged, in shares of the bounds.
pub(super) const REGIONS: [f64; 2] = [NEARLY, REGION];

/// Makes the aim small with so many frames, from the best frame and then from others that lead elsewhere.
pub(super) fn improve(search: &Search, most: usize) {
    let end = search.looked_at() + most;
    let mut begun: Vec<Vec<f64>> = Vec::new();
    // What has to be near a frame is, after one descent; and where nothing varies there is nowhere to go.
    let descents = match search.aim() {
        _ if search.problem().vary.is_empty() => 0,
        Aim::Near(_) => 1,
        _ => SHARES.len(),
    };
    let left = || end.saturating_sub(search.looked_at()).min(search.left());
    for most in SHARES.iter().take(descents).map(|share| (share * left() as f64) as usize) {
        let far = |values: &Vec<f64>| begun.iter().all(|other| search.problem().distance(values, other) > APART * APART);
        // Where no other start is left, as of one parameter, the frames are for the best one.
        let Some(start) = ranked(search).into_iter().find(far) else {
            settle(search, left(), &REGIONS);
            return;
        };
        descend(search, &start, REGION, most, false);
        begun.extend(ranked(search).into_iter().next());
        begun.push(start);
    }
}

/// Makes the aim small with so many frames from the best one, which is nearly the best there is: in each of these regions as long as a descent
/// finds a better one.
pub(super) fn settle(search: &Search, most: usize, regions: &[f64]) {
    let end = search.looked_at() + most;
    let best = || ranked(search).into_iter().next().and_then(|values| Some((search.point_of(&values)?, values)));
    for region in regions {
        for _ in 0..AGAIN {
            let Some((before, values)) = best() else { return };
            descend(search, &values, *region, end.saturating_sub(search.looked_at()), false);
            if best().is_none_or(|(after, _)| after.violated == before.violated && search.aim().is_alike(before.aim, after.aim)) {
                break;
            }
        }
    }
}
