//! How long drops fell, against what their height says.

use std::ops::RangeInclusive;

use serde::Serialize;

use super::DropGroup;
use super::flag::Flag;
use super::free_fall::lasting_s;
use super::judged::{Drop, JudgedDrops};
use super::record::DropSet;
use super::spread::Spread;
use crate::units::GRAVITY_M_S2;

/// How far a fall may be from its height's: the hand's release takes a few samples, and weightlessness is detected by a threshold.
pub const RELEASE_S: f64 = 0.015;
/// Height that was fallen over the stated one: beyond these it is another unit, not an error of the height.
const ANOTHER_UNIT: RangeInclusive<f64> = 0.5..=2.0;
/// Ratios that differ by less than this share are the same.
const SAME_RATIO: f64 = 0.1;
/// The same of one height alone, where drops of another height are the more likely the less it looks like a unit.
const SAME_RATIO_OF_ONE: f64 = 0.05;
/// Height that was fallen over the stated one that no mistaken folder has.
const MISTAKEN: RangeInclusive<f64> = 0.1..=10.0;
/// Height that was fallen over the stated one within which a height is read or measured a little wrong, and no other one.
const ALIKE: RangeInclusive<f64> = 0.9..=1.1;
/// A foot, m.
const FOOT_M: f64 = 0.3048;
/// Fewest falls that say something.
const FEWEST: usize = 4;

/// The falls from one height.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Fall {
    /// Stated height, m.
    pub height_m: f64,
    /// Drops whose release was recorded.
    pub drops: usize,
    /// Median from release to first touch, s.
    pub fall_s: f64,
    /// Its standard error, from the quartiles, s.
    pub error_s: f64,
    /// Of a free fall from the stated height, s.
    pub expected_s: f64,
}

impl Fall {
    /// Of every height from which releases were recorded. Clean drops alone, as others may have touched something; but an impulse that no fall
    /// from the stated height has says nothing against the fall's duration.
    pub fn of(set: &DropSet) -> Vec<Self> {
        JudgedDrops::of(set).groups.into_iter().filter_map(|(group, all)| Self::of_group(group, &all)).collect()
    }

    fn of_group(group: &DropGroup, all: &[Drop]) -> Option<Self> {
        let fell = |drop: &&Drop| drop.flags.iter().all(|flag| matches!(flag, Flag::Impulse { .. }));
        let spread = Spread::of(all.iter().filter(fell).filter_map(|drop| drop.impact.as_ref()?.fall_s))?;
        let error_s = spread.median_error();
        let expected_s = lasting_s(group.height_m);
        let fall = Self { height_m: group.height_m, drops: spread.count, fall_s: spread.median, error_s, expected_s };
        (spread.count >= FEWEST).then_some(fall)
    }

    /// Whether the fall lasted as long as its height says, within the release and three standard errors.
    pub fn agrees(&self) -> bool {
        self.lasted(self.expected_s)
    }

    /// The height of a free fall that lasts as long, m.
    pub fn fallen_m(&self) -> f64 {
        0.5 * GRAVITY_M_S2 * self.fall_s * self.fall_s
    }

    /// What falls from all heights say together where these cannot be metres, in a sentence: each lasted as from another height, in one ratio.
    pub fn of_another_unit(falls: &[Self]) -> Option<String> {
        let ratios = Spread::of(falls.iter().map(|fall| fall.fallen_m() / fall.height_m))?;
        let is_far = !ANOTHER_UNIT.contains(&ratios.median) && ratios.q3 - ratios.q1 < SAME_RATIO * ratios.median;
        let are_feet = (ratios.median / FOOT_M - 1.0).abs() < if falls.len() > 1 { SAME_RATIO } else { SAME_RATIO_OF_ONE };
        let is_unit = falls.len() > 1 || are_feet || !MISTAKEN.contains(&ratios.median);
        let fall = falls.first().filter(|_| is_far && is_unit)?;
        let like = if are_feet { ": they look like feet" } else { "" };
        Some(format!(
            "drops from a stated {} m fell for {:.3} s, a free fall from there takes {:.3} s: the heights are not in m{like}. State them in m; where the time stamps are wrong, --rate HZ replaces them",
            fall.height_m, fall.fall_s, fall.expected_s
        ))
    }

    /// Each height from which drops fell as from another one, in a sentence.
    pub fn of_other_heights(falls: &[Self]) -> Vec<String> {
        falls
            .iter()
            .filter(|fall| !fall.agrees() && !ALIKE.contains(&(fall.fallen_m() / fall.height_m)))
            .map(Self::of_another_height)
            .collect()
    }

    fn of_another_height(&self) -> String {
        format!(
            "the fall of {} drops from a stated {} m lasted {:.0} ± {:.0} ms, and {:.0} ms are expected: it belongs to {:.2} m. Do they lie in the \
             wrong folder, or is the height wrong, or the rate of the time stamps (--rate)?",
            self.drops,
            self.height_m,
            1e3 * self.fall_s,
            1e3 * self.error_s,
            1e3 * self.expected_s,
            self.fallen_m()
        )
    }

    /// Whether it lasted so long, s, within the release and three standard errors.
    pub fn lasted(&self, duration_s: f64) -> bool {
        (self.fall_s - duration_s).abs() <= RELEASE_S + 3.0 * self.error_s
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_heights_in_feet_are_seen() {
        let of = |height_m: f64, fallen_m: f64| {
            let [fall_s, expected_s] = [fallen_m, height_m].map(lasting_s);
            Fall { height_m, drops: 10, fall_s, error_s: 0.0, expected_s }
        };
        let in_feet = [of(1.64, 0.5), of(3.28, 1.0), of(4.92, 1.5)];
        let said = Fall::of_another_unit(&in_feet).expect("are no metres");
        assert!(said.contains("1.64 m fell for 0.319 s") && said.contains("feet"), "{said}");
        // Heights that are wrong by a part are no other unit, nor are falls that contradict each other.
        assert_eq!(Fall::of_another_unit(&[of(1.0, 0.7), of(1.5, 1.1)]), None);
        assert_eq!(Fall::of_another_unit(&[of(1.0, 0.3), of(1.5, 1.5)]), None);
        assert_eq!(Fall::of_another_unit(&[]), None);
    }

    #[test]
    fn planted_drops_in_the_folder_of_another_height_are_no_other_unit() {
        let of = |height_m: f64, fallen_m: f64| {
            let [fall_s, expected_s] = [fallen_m, height_m].map(lasting_s);
            Fall { height_m, drops: 12, fall_s, error_s: 0.001, expected_s }
        };
        for (stated_m, fallen_m) in [(2.0, 1.47), (0.5, 1.5), (1.5, 0.5)] {
            let falls = [of(stated_m, fallen_m)];
            assert_eq!(Fall::of_another_unit(&falls), None, "{stated_m}");
            let said = Fall::of_other_heights(&falls).join("; ");
            assert!(said.contains(&format!("it belongs to {fallen_m:.2} m")) && said.contains("wrong folder"), "{said}");
        }
        assert_eq!(Fall::of_other_heights(&[of(1.0, 0.98), of(1.5, 1.55)]), Vec::<String>::new());
        // A single height is one of another unit where it looks like it.
        assert!(Fall::of_another_unit(&[of(3.28, 1.0)]).is_some() && Fall::of_another_unit(&[of(50.0, 0.5)]).is_some());
    }

    #[test]
    fn analytic_a_fall_agrees_within_release_and_error() {
        let expected_s = (2.0_f64 / GRAVITY_M_S2).sqrt();
        let of = |fall_s: f64, error_s: f64| Fall { height_m: 1.0, drops: 20, fall_s, error_s, expected_s };
        assert!(of(expected_s + 0.014, 0.0).agrees() && of(expected_s - 0.020, 0.002).agrees());
        // From 0.8 m it takes 48 ms less.
        assert!(!of((1.6_f64 / GRAVITY_M_S2).sqrt(), 0.003).agrees());
    }
}
