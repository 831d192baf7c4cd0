//! The first phase of a search whose start breaks limits: find a frame that keeps them all, before anything is made small.
//!
//! Starts are the given one and the presets, whose numbers are put in place of those that vary, no farther than their bounds; all
//! else stays as asked for. When none of them keeps everything, COBYLA makes the sum of violated margins small from the nearest
//! ones, one after the other, until a frame keeps everything. Starts and order are fixed: the same problem has the same answer.

use cobyla::{RhoBeg, StopTols};

use super::search::{STEPS, Search, ranked};
use crate::params::{Frame, FrameFile, preset};

/// How many of the starts are followed.
const FOLLOWED: usize = 3;

/// Looks for a frame that keeps everything, with no more than this many frames; the best are then first of the ranked ones.
pub(super) fn find(search: &Search, start: &[f64], most: usize) {
    if most == 0 || search.of(start, |point| point.violated) == 0.0 {
        return;
    }
    for values in transplanted(search) {
        if search.order.borrow().len() < most {
            search.of(&values, |_| ());
        }
    }
    for nearest in ranked(search).into_iter().take(FOLLOWED) {
        let left = most.saturating_sub(search.order.borrow().len());
        follow(search, &nearest, left.min(most / 2));
    }
}

/// The frames of all presets.
pub(super) fn presets() -> impl Iterator<Item = Frame> {
    let files = preset::names().filter_map(|name| FrameFile::parse(name, preset::text(name)?).ok());
    files.filter_map(|file| Frame::resolve(&file).ok())
}

/// The presets' values of what varies, within its bounds.
fn transplanted(search: &Search) -> Vec<Vec<f64>> {
    let share = |frame: Frame| -> Option<Vec<f64>> {
        let shares = search.problem.vary.iter().map(|v| frame.value(v.parameter.table, v.parameter.key).map(|value| v.share(value)));
        shares.collect()
    };
    presets().filter_map(share).map(|shares| search.values(&shares)).collect()
}

/// Makes the violated margins small from a start. Once a frame keeps everything no further one is looked at.
fn follow(search: &Search, start: &[f64], most: usize) {
    if most == 0 || search.found() {
        return;
    }
    let shares: Vec<f64> = search.problem.vary.iter().zip(start).map(|(vary, value)| vary.share(*value)).collect();
    // The logarithm keeps what is missed by far from hiding what is missed by little.
    let objective = |shares: &[f64], (): &mut ()| {
        if search.found() { 0.0 } else { search.of(&search.values(shares), |point| point.violated).ln_1p() }
    };
    let constraints: [fn(&[f64], &mut ()) -> f64; 0] = [];
    let tolerances = StopTols { xtol_abs: vec![STEPS[1]; shares.len()], ..StopTols::default() };
    let bounds = vec![(0.0, 1.0); shares.len()];
    // However it ends, the points that it looked at are what counts.
    let _ = cobyla::minimize(objective, &shares, &bounds, &constraints, (), most, RhoBeg::All(STEPS[0]), Some(tolerances));
}
