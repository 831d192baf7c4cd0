//! Where a search begins: frames that are known, and the first phase, which finds a frame that keeps every limit before anything
//! is made small.
//!
//! Starts are the given one, also with the motors as far along their arms as in each preset, the middle of all bounds, and the presets, whose
//! numbers are put in place of those that vary, no farther than their bounds; all else stays as asked for. When none of them keeps
//! everything, the sum of violated margins is made small from the nearest ones, one after the other, until a frame keeps everything. Starts
//! and order are fixed: the same problem has the same answer.

use super::descent::{REGION, descend};
use super::search::{Search, ranked};
use crate::params::{Frame, FrameFile, preset};

/// How many of the starts are followed.
const FOLLOWED: usize = 4;

/// Looks for a frame that keeps everything where none is known; the best are then first of the ranked ones.
pub(super) fn find(search: &Search, start: &[f64]) {
    if search.found() {
        return;
    }
    search.look_at(&[start.to_vec()]);
    if search.found() {
        return;
    }
    let middle = search.values(&vec![0.5; start.len()]);
    search.look_at(&[transplanted(search), motors_moved(search, start), vec![middle]].concat());
    for (at, nearest) in ranked(search).into_iter().take(FOLLOWED).enumerate() {
        if search.found() {
            return;
        }
        descend(search, &nearest, REGION, search.left() / (FOLLOWED - at).min(2), true);
    }
}

/// The frames of all presets.
pub(super) fn presets() -> impl Iterator<Item = Frame> {
    let files = preset::names().filter_map(|name| FrameFile::parse(name, preset::text(name)?).ok());
    files.filter_map(|file| Frame::resolve(&file).ok())
}

/// The given start with the motors as far along their arms as each preset has them: propellers of another size want them elsewhere.
fn motors_moved(search: &Search, start: &[f64]) -> Vec<Vec<f64>> {
    let vary = &search.problem().vary;
    let place = |key: &str| vary.iter().position(|vary| vary.key() == key);
    let (Some(arm), Some(motor)) = (place("rods.arm_rod_length_mm"), place("motor_mount.motor_position_mm")) else { return Vec::new() };
    let moved = |frame: Frame| {
        let [least_mm, most_mm] = vary[motor].bounds;
        let share = frame.motor_mount.motor_position_mm / frame.rods.arm_rod_length_mm;
        let mut values = start.to_vec();
        values[motor] = (share * start[arm]).clamp(least_mm, most_mm);
        search.values(&search.shares(&values))
    };
    presets().map(moved).collect()
}

/// The presets' values of what varies, within its bounds.
fn transplanted(search: &Search) -> Vec<Vec<f64>> {
    let share = |frame: Frame| -> Option<Vec<f64>> {
        let shares = search.problem().vary.iter().map(|v| frame.value(v.parameter.table, v.parameter.key).map(|value| v.share(value)));
        shares.collect()
    };
    presets().filter_map(share).map(|shares| search.values(&shares)).collect()
}
