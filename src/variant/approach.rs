//! The search on sketches, before frames are designed one by one.
//!
//! A round searches on sketches by a known frame, which cost little, and designs the best of them; that frame is what the next round's sketches
//! are by. Near it they are right, so rounds come to an end as Newton's method does. What they end with is a frame like any other: designed,
//! ranked, and checked by every rule.

use super::feasible::find;
use super::improve::{NEARLY, improve, settle};
use super::point::Point;
use super::problem::SearchProblem;
use super::search::{Search, ranked};
use super::sketch::Known;

/// The most rounds.
const ROUNDS: usize = 6;
/// How many sketches a round may look at.
const SKETCHES: usize = 150;
/// How far a margin of a sketch may be off, scaled, where it is no more than this.
const OFF: f64 = 0.05;
const TIGHT: f64 = 1.0;

/// Follows sketches, the first of them by what is known of a frame, from these values; says whether it ended with a frame that keeps everything and
/// that sketches by it would not better.
pub(super) fn approach(search: &Search, first: Option<Known>, from: &[f64]) -> bool {
    if search.problem().mechanics.is_some() {
        return false;
    }
    let (mut here, mut known) = (from.to_vec(), first);
    for round in 0..ROUNDS {
        let Some(by) = known.take().filter(|_| search.left() > 0) else { return false };
        // Sketches do not count: who follows the search hears of its frames, and may end it between any two sketches.
        let (told, progress) = (search.problem().follows, search.progress());
        let follows = |_: &_| told(&progress);
        let problem = SearchProblem { most: SKETCHES, follows: &follows, ..search.problem().clone() };
        let sketches = search.of_sketches(&problem, by);
        find(&sketches, &here);
        if round == 0 {
            improve(&sketches, sketches.left());
        }
        settle(&sketches, sketches.left(), &[NEARLY]);
        if sketches.is_ended() {
            search.end();
        }
        let Some((next, sketched)) = best(&sketches) else { return false };
        let before = best(search);
        search.look_at(std::slice::from_ref(&next));
        let Some(there) = search.point_of(&next) else { return false };
        let is_no_better = before.is_some_and(|(_, before)| before.violated == 0.0 && search.aim().is_alike(before.aim, there.aim));
        if there.violated == 0.0 && (is_no_better || is_right(search, &sketched, &there)) {
            return true;
        }
        known = search.sketched_by(&next);
        here = next;
    }
    false
}

fn best(search: &Search) -> Option<(Vec<f64>, Point)> {
    ranked(search).into_iter().next().and_then(|values| search.point_of(&values).map(|point| (values, point)))
}

/// Whether a sketch said what matters of a frame: its aim, and the margins that are small.
fn is_right(search: &Search, sketch: &Point, frame: &Point) -> bool {
    let (Some(sketched), Some(designed)) = (&sketch.margins, &frame.margins) else { return false };
    let is_right = |(a, b): (&f64, &f64)| a.min(*b) > TIGHT || (a - b).abs() < OFF;
    search.aim().is_alike(sketch.aim, frame.aim) && sketched.iter().zip(designed).all(is_right)
}
