//! The polygon that stands for the circle about which a profile is turned.

use std::f64::consts::TAU;

use crate::units::Angle;

/// Corners closer than this are one, and a step longer by this share needs no further corner, rad.
const SAME_RAD: f64 = 1e-9;

/// Directions of its corners, rad, counter-clockwise from the first: those given, and between them even steps, at least so many in a turn.
pub(super) fn angles_rad(corners: &[Angle], per_turn: u32) -> Vec<f64> {
    let even = |[from, wide]: [f64; 2]| {
        let count = steps(wide, per_turn);
        (0..count).map(move |i| from + wide * f64::from(i) / f64::from(count))
    };
    spans_rad(corners).into_iter().flat_map(even).collect()
}

/// The different steps between neighbouring corners, rad.
pub(super) fn steps_rad(corners: &[Angle], per_turn: u32) -> Vec<f64> {
    let mut found: Vec<f64> = spans_rad(corners).iter().map(|[_, wide]| wide / f64::from(steps(*wide, per_turn))).collect();
    found.sort_by(f64::total_cmp);
    found.dedup_by(|a, b| *a - *b < SAME_RAD);
    found
}

/// From each given corner to the next: where it begins and how wide it is, rad. One that is no number is none, so there is a span always.
fn spans_rad(corners: &[Angle]) -> Vec<[f64; 2]> {
    let mut given: Vec<f64> = corners.iter().map(|angle| angle.to_rad().rem_euclid(TAU)).filter(|angle| angle.is_finite()).collect();
    given.sort_by(f64::total_cmp);
    given.dedup_by(|a, b| *a - *b < SAME_RAD);
    let Some(first) = given.first().copied() else { return vec![[0.0, TAU]] };
    let ends = given.iter().skip(1).copied().chain([first + TAU]);
    let spans: Vec<[f64; 2]> = given.iter().zip(ends).map(|(from, to)| [*from, to - from]).collect();
    spans.into_iter().filter(|[_, wide]| *wide > SAME_RAD).collect()
}

fn steps(wide_rad: f64, per_turn: u32) -> u32 {
    libm::ceil(wide_rad / TAU * f64::from(per_turn) - SAME_RAD) as u32
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn planted_corners_that_are_no_numbers_are_none() {
        assert_eq!(angles_rad(&[f64::NAN, f64::INFINITY].map(Angle::rad), 48), angles_rad(&[], 48));
    }

    proptest! {
        #[test]
        fn analytic_a_turn_has_the_given_corners_and_no_step_longer_than_an_even_one(
            degrees in proptest::collection::vec(-720.0..720.0, 0..6),
            per_turn in 8_u32..100,
        ) {
            let corners: Vec<Angle> = degrees.into_iter().map(Angle::deg).collect();
            let angles = angles_rad(&corners, per_turn);
            let longest = TAU / f64::from(per_turn);
            let next = |i: usize| if i + 1 < angles.len() { angles[i + 1] } else { angles[0] + TAU };
            for (i, angle) in angles.iter().enumerate() {
                let step = next(i) - angle;
                prop_assert!(step > 0.0 && step < longest + 1e-8, "{step}");
                prop_assert!(steps_rad(&corners, per_turn).iter().any(|known| (known - step).abs() < 1e-8));
            }
            for corner in corners {
                let beside = |angle: &f64| libm::sin(0.5 * (angle - corner.to_rad())).abs();
                prop_assert!(angles.iter().map(beside).fold(1.0, f64::min) < 1e-8);
            }
        }
    }
}
