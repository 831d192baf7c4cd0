//! Lengths of rods with which a frame closes that does not.

use std::f64::consts::SQRT_2;

use super::closure::{Closure, StrutWay, TILT_DEG};
use crate::params::Frame;
use crate::params::groups::RodParameters;
use crate::units::Angle;

/// Rods whose lengths decide whether a frame closes.
const KEYS: [&str; 3] = ["arm_rod_length_mm", "cage_rod_length_mm", "strut_rod_length_mm"];
/// Tilts of the struts whose lengths are tried, degrees: just inside of both bounds.
const TRIED_DEG: [f64; 2] = [TILT_DEG.0 + 0.05, TILT_DEG.1 - 0.05];

/// For arm, cage and strut rod: its key, and the length nearest to its own with which the frame closes while the others stay as they are, mm,
/// to a tenth. A rod for which there is no such length within its bounds is not listed.
pub fn closing_lengths(frame: &Frame) -> Vec<(&'static str, f64)> {
    let nearest = |key: &'static str| {
        let bounds = RodParameters::CATALOGUE.iter().find(|parameter| parameter.key == key)?;
        let own_mm = *length_of(&mut frame.clone(), key)?;
        let closes = |length_mm: &f64| {
            let mut other = frame.clone();
            if let Some(own) = length_of(&mut other, key) {
                *own = *length_mm;
            }
            (bounds.min..=bounds.max).contains(length_mm) && Closure::solve(&other).is_ok()
        };
        let ends_mm = TRIED_DEG.map(|tilt_deg| length_for(frame, key, Angle::deg(tilt_deg)));
        let tried = ends_mm.into_iter().flat_map(|mm| [(mm * 10.0).floor() / 10.0, (mm * 10.0).ceil() / 10.0]);
        let nearest = tried.chain([bounds.min, bounds.max]).filter(closes).min_by(|a, b| (a - own_mm).abs().total_cmp(&(b - own_mm).abs()));
        nearest.map(|length_mm| (key, length_mm))
    };
    KEYS.into_iter().filter_map(nearest).collect()
}

fn length_of<'a>(frame: &'a mut Frame, key: &str) -> Option<&'a mut f64> {
    let rods = &mut frame.rods;
    match key {
        "arm_rod_length_mm" => Some(&mut rods.arm_rod_length_mm),
        "cage_rod_length_mm" => Some(&mut rods.cage_rod_length_mm),
        "strut_rod_length_mm" => Some(&mut rods.strut_rod_length_mm),
        _ => None,
    }
}

/// Length of a rod with which the struts tilt so, the others as they are, mm, see [`StrutWay::offset_mm`].
fn length_for(frame: &Frame, key: &str, tilt: Angle) -> f64 {
    let rods = &frame.rods;
    let (strut_way, sine) = (StrutWay::of(frame), tilt.sin());
    let beyond_mm = strut_way.offset_mm() - sine * strut_way.reach_mm;
    match key {
        "arm_rod_length_mm" => rods.arm_rod_length_mm + beyond_mm,
        "cage_rod_length_mm" => rods.cage_rod_length_mm - SQRT_2 * beyond_mm,
        _ => rods.strut_rod_length_mm + beyond_mm / sine,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each length that is told closes the frame, and a millimetre on the way back to its own it does not.
    #[test]
    fn analytic_lengths_that_are_told_close_and_are_the_nearest() {
        let (own, _) = Frame::load("cognifly").expect("is a preset");
        assert!(Closure::solve(&own).is_ok());
        for (key, length_mm) in KEYS.into_iter().flat_map(|key| [(key, 40.0), (key, 75.0), (key, 100.0), (key, 150.0), (key, 230.0)]) {
            let mut frame = own.clone();
            *length_of(&mut frame, key).expect("is a rod") = length_mm;
            let bounds = RodParameters::CATALOGUE.iter().find(|parameter| parameter.key == key).expect("is one");
            if Closure::solve(&frame).is_ok() || !(bounds.min..=bounds.max).contains(&length_mm) {
                continue;
            }
            let told = closing_lengths(&frame);
            assert!(told.iter().any(|(other, _)| *other == key), "{key} = {length_mm}: {told:?}");
            for (other, closes_mm) in told {
                let closes = |mm: f64| {
                    let mut changed = frame.clone();
                    *length_of(&mut changed, other).expect("is a rod") = mm;
                    Closure::solve(&changed).is_ok()
                };
                let back = (*length_of(&mut frame.clone(), other).expect("is a rod") - closes_mm).signum();
                assert!(closes(closes_mm) && !closes(closes_mm + back), "{key} = {length_mm}: {other} = {closes_mm}");
            }
        }
    }
}
